# SPDX-License-Identifier: MIT
"""m512 against the simulated board with our real loader and Play, over a pty. Needs the build's products."""
import json
import threading
import time

import pytest
from conftest import REPO
from m512.board import driving, sim
from m512.board.client import Client
from m512.board.link import Link
from m512.errors import MissingError
from m512.files.text import read_text
from pty_peer import Peer

MOTIONS = """motion512 1
page 1 stand
  step 0.5s | 1..18:512
page 3 walk
  next self; exit stand
  step 50 | 1..18:440
  step 50 | 1..18:584
page 100 nod
  step 25 | 1:560
"""


@pytest.fixture(autouse=True)
def build(monkeypatch):
    monkeypatch.setenv("M512_BUILD", str(REPO / "build"))


@pytest.fixture
def robot(tmp_path):
    """A board that has older motions, so that flashing ours does not take the whole 12 s of 64 KiB."""
    old = tmp_path / "old.m512"
    old.write_text(MOTIONS.replace("nod", "old").replace("1:560", "1:490"))
    try:
        with sim.Simulator(["boot-cm5.hex", "play-cm5.hex"], old) as simulator:
            time.sleep(1.0)
            yield simulator
            if simulator.process.poll() is not None:
                simulator.said += simulator.process.stdout.read()
            assert simulator.process.poll() is None, simulator.said.decode()
    except MissingError as error:
        pytest.skip(str(error))


@pytest.fixture
def motions(tmp_path):
    path = tmp_path / "lib.m512"
    path.write_text(MOTIONS)
    return path


def test_board_flash_run_play_stop_get(m512, robot, motions, tmp_path):
    def run(*args, code=0):
        result = m512(*args, "-p", robot.url)
        assert result.exit_code == code, result.stderr
        return result

    # Play restarts by itself and the loader is caught: no button.
    assert "MODE" not in run("flash", motions, "--wait", "5").stderr
    assert json.loads(run("flash", motions, "--json").stdout)["written"] == 0
    run("run")
    time.sleep(1.2)
    assert "plays" in run("play", "stand", "--wait").stderr
    pose = json.loads(run("pose", "--json").stdout)
    assert len(pose) == 18 and all(abs(joint["position"] - 512) < 6 for joint in pose.values())
    assert json.loads(run("play", "walk", "--json").stdout)["state"] in ("ready", "approach", "playing")
    time.sleep(1.0)
    result = m512("flash", motions, "-p", robot.url)
    assert result.exit_code == 5 and "something plays" in result.stderr
    run("stop")
    for _ in range(60):
        if json.loads(run("stop", "--json").stdout)["state"] == "idle":
            break
        time.sleep(0.1)
    run("pose", "1:600", "2:30deg", "--speed", "120")
    pose = json.loads(run("pose", "--json").stdout)
    assert abs(pose["1"]["position"] - 600) < 6 and abs(pose["2"]["position"] - 614) < 6
    run("torque", "off", "1", "2")
    assert not json.loads(run("pose", "--json").stdout)["1"]["torque"]
    run("get", "all", "-o", tmp_path / "got.bin")
    assert (tmp_path / "got.bin").read_bytes() == read_text(MOTIONS).to_bytes()
    assert m512("diff", robot.url, motions).exit_code == 0
    assert "100  nod" in m512("pages", robot.url, "list").stdout
    assert "cannot save pages" in run("put", motions, "nod:7", code=8).stderr
    assert "no page of the board is called 'fly'" in run("play", "fly", code=8).stderr
    assert run("doctor").stdout.count("BAD") == 0


def test_board_backup_and_restore(m512, robot, motions, tmp_path):
    folder = tmp_path / "b"
    assert m512("flash", motions, "-p", robot.url, "--wait", "5").exit_code == 0
    result = m512("backup", folder, "-p", robot.url, "--wait", "5")
    assert result.exit_code == 0, result.stderr
    manifest = json.loads((folder / "manifest.json").read_text())
    assert manifest["board"] == "cm5" and "Motion512 play" in manifest["application"]
    changed = tmp_path / "changed.m512"
    changed.write_text(MOTIONS.replace("1:560", "1:460"))
    assert m512("flash", changed, "-p", robot.url, "--wait", "5").exit_code == 0
    result = m512("restore", folder, "--yes", "-p", robot.url, "--wait", "5", "--what", "motions,app")
    assert result.exit_code == 0, result.stderr
    assert 'page 100 "nod", step 0, ID 1: 460 -> 560 (+100)' in result.stderr
    assert "1 of 448 flash pages written" in result.stderr
    assert m512("diff", folder, motions).exit_code == 0


class Relay(Peer):
    """A cable between m512 and the board that can be pulled."""

    def __init__(self, url):
        import serial

        self.board = serial.Serial(url, 57600, timeout=0.02)
        super().__init__()
        self.back = threading.Thread(target=self._back, daemon=True)
        self.back.start()

    def on_byte(self, byte):
        self.board.write(bytes([byte]))

    def _back(self):
        while self.running:
            data = self.board.read(256)
            if data:
                self.send(data)

    def __exit__(self, *exc):
        super().__exit__(*exc)
        self.back.join(2)
        self.board.close()


def test_board_cable_pulled(m512, robot, motions):
    with Relay(robot.url) as cable:
        assert m512("flash", motions, "-p", cable.path, "--wait", "5").exit_code == 0
        for cut in (300, 900, 1500, 1900):
            motions.write_text(MOTIONS.replace("440", str(300 + cut // 10)).replace("560", str(400 + cut // 10)))
            cable.plug()
            cable.cut_after = cut
            result = m512("flash", motions, "-p", cable.path)
            with cable.lock:
                assert cable.master is None, result.stderr
            assert result.exit_code in (6, 7) and result.stderr
            cable.plug()
            result = m512("flash", motions, "-p", cable.path, "--wait", "10")
            assert result.exit_code == 0, result.stderr
        cable.plug()
        # Everything is as it should be by the loader's own sums, which also means: nothing else was touched.
        assert json.loads(m512("flash", motions, "-p", cable.path, "--json").stdout)["written"] == 0


def test_board_put_through_edit(m512, motions, tmp_path):
    try:
        with sim.Simulator(["boot-cm5.hex", "edit-cm5.hex"]) as simulator:     # without a loader nobody can save
            time.sleep(1.0)
            assert "waits in its boot loader" in m512("pose", "-p", simulator.url).stderr
            assert m512("run", "-p", simulator.url).exit_code == 0
            time.sleep(2.0)
            result = m512("put", motions, "walk:30", "stand", "-p", simulator.url, "--json")
            assert result.exit_code == 0, result.stderr
            assert json.loads(result.stdout)["saved"] == [30, 1]
            assert m512("pages", simulator.url, "rename", "30", "march", "--yes").exit_code == 0
            assert m512("get", "all", "-o", tmp_path / "got.bin", "-p", simulator.url).exit_code == 0
    except MissingError as error:
        pytest.skip(str(error))
    from m512.files.image import from_bytes

    got = from_bytes((tmp_path / "got.bin").read_bytes())
    assert got[30].name == b"march" and (got[30].next, got[30].exit) == (30, 1) and got[1].name == b"stand"
    assert got[30].words(0) == read_text(MOTIONS)[3].words(0)


def test_sim_option_plays_without_a_robot(m512, motions):
    try:
        sim.find_cm5sim()
        sim.find_image("play-cm5.hex")
    except MissingError as error:
        pytest.skip(str(error))
    result = m512("play", "nod", "--sim", "--motions", motions, "--json")
    assert result.exit_code == 0, result.stderr
    assert "playing: page 100" in result.stderr and json.loads(result.stdout)["state"] == "idle"


def test_flash_restarts_edit_and_asks_where_edits_would_be_lost(m512, motions, tmp_path):
    old = tmp_path / "old.m512"
    old.write_text(MOTIONS.replace("nod", "old").replace("1:560", "1:490"))
    try:
        simulator = sim.Simulator(["boot-cm5.hex", "edit-cm5.hex"], old)
    except MissingError as error:
        pytest.skip(str(error))
    with simulator:
        time.sleep(1.0)
        assert m512("run", "-p", simulator.url).exit_code == 0
        time.sleep(2.0)
        looked = m512("flash", motions, "-p", simulator.url, "--dry-run")
        assert looked.exit_code == 0 and '"old" -> "nod"' in looked.stderr and "edit" in looked.stderr
        with Link(simulator.url) as link:
            client = Client(link)
            client.ask("open 3")
            assert not client.has_edits()
            client.ask("open 3")
            client.ask("data 64 0102")
            assert client.has_edits()
        result = m512("flash", motions, "-p", simulator.url, "--wait", "5")
        assert result.exit_code == 5 and "not saved" in result.stderr and "--yes" in result.stderr
        result = m512("flash", motions, "-p", simulator.url, "--wait", "5", "--yes")
        assert result.exit_code == 0 and "MODE" not in result.stderr, result.stderr


def start(m512, robot):
    assert m512("run", "-p", robot.url).exit_code == 0
    time.sleep(2.0)


def test_play_is_shaped(m512, robot):
    start(m512, robot)
    with Link(robot.url) as link:
        if "rate" not in Client(link).version.get("can", "") + " ".join(Client(link).where()):
            pytest.skip("this Play cannot shape")
    assert m512("play", "walk", "--rate", "150", "--amplitude", "80", "-p", robot.url).exit_code == 0
    found = json.loads(m512("shape", "--json", "-p", robot.url).stdout)
    assert found["rate"] == "150" and found["amplitude"] == "80" and found["blend"] == "0"
    assert "rate 90" in m512("shape", "--rate", "90", "--blend", "-40", "-p", robot.url).stdout
    assert json.loads(m512("shape", "--reset", "--json", "-p", robot.url).stdout)["rate"] == "100"
    assert m512("shape", "--rate", "5", "-p", robot.url).exit_code == 2


def test_drive_ends_through_the_exit_page_when_the_line_falls_silent(m512, robot):
    start(m512, robot)
    with Link(robot.url) as link:
        client = Client(link)
        if "rate" not in client.where():
            pytest.skip("this Play cannot shape")
        client.play(client.find("walk"))
        client.ask(driving.Stick(rate=120).line())
        assert client.where()["rate"] == "120"
        pages = set()
        for _ in range(200):
            state = client.where()
            pages.add(state["page"])
            if state["state"] == "idle":
                break
            time.sleep(0.05)
        assert state["state"] == "idle" and {"3", "1"} <= pages       # walk, and stand, its exit
