# SPDX-License-Identifier: MIT
"""m512 against the simulated board with our real loader, Play and Edit, in simulated time. Needs the build products."""

import json
import re
import signal
from contextlib import nullcontext
from types import SimpleNamespace

import pytest
from virtual_peer import VirtualLink

from m512.board import doctor, driving
from m512.board.client import Client
from m512.board.sim import Simulator
from m512.errors import BoardError, MissingError
from m512.files import formats
from m512.files.text import read_text

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


OLD = MOTIONS.replace("nod", "old").replace("1:560", "1:490")


@pytest.fixture
def robot(started):
    """A board with older motions, so that flashing ours does not take the full 12 s for 64 KiB."""
    return started("boot-cm5.hex", "play-cm5.hex", text=OLD)


@pytest.fixture
def motions(tmp_path):
    path = tmp_path / "lib.m512"
    path.write_text(MOTIONS)
    return path


def test_board_flash_run_play_stop_get(m512, robot, motions, tmp_path):
    def run(*args, code=0):
        result = m512(*args, "-p", robot.path)
        assert result.exit_code == code, result.stderr
        return result

    # Play restarts by itself and the loader is caught: no button is needed.
    assert "MODE" not in run("flash", motions, "--wait", "5").stderr
    assert json.loads(run("flash", motions, "--json").stdout)["written"] == 0
    run("run")
    robot.pass_time(1.2)
    assert "plays" in run("play", "stand", "--wait").stderr
    pose = json.loads(run("pose", "--json").stdout)
    assert len(pose) == 18 and all(abs(joint["position"] - 512) < 6 for joint in pose.values())
    assert json.loads(run("play", "walk", "--json").stdout)["state"] in ("ready", "approach", "playing")
    robot.pass_time(1.0)
    result = m512("flash", motions, "-p", robot.path)
    assert result.exit_code == 5 and "something plays" in result.stderr
    run("stop")
    for _ in range(60):
        if json.loads(run("stop", "--json").stdout)["state"] == "idle":
            break
        robot.pass_time(0.1)
    run("pose", "1:600", "2:30deg", "--speed", "120")
    pose = json.loads(run("pose", "--json").stdout)
    assert abs(pose["1"]["position"] - 600) < 6 and abs(pose["2"]["position"] - 614) < 6
    run("torque", "off", "1", "2")
    assert not json.loads(run("pose", "--json").stdout)["1"]["torque"]
    run("get", "all", "-o", tmp_path / "got.bin")
    assert (tmp_path / "got.bin").read_bytes() == read_text(MOTIONS).to_bytes()
    other = read_text(MOTIONS)
    other[120].data[26] = 5  # has no effect: the page is empty
    other[120].seal()
    (tmp_path / "other.bin").write_bytes(other.to_bytes())
    assert m512("diff", motions, tmp_path / "other.bin").exit_code == 3
    assert m512("diff", robot.path, tmp_path / "other.bin").exit_code == 0
    assert "100  nod" in m512("pages", robot.path, "list").stdout
    assert "m512 run edit-cm5.hex" in run("put", motions, "nod:7", code=8).stderr
    assert "no page of the board is called 'fly'" in run("play", "fly", code=8).stderr
    assert run("doctor").stdout.count("BAD") == 0


def test_board_backup_and_restore(m512, robot, motions, tmp_path):
    folder = tmp_path / "b"
    assert m512("flash", motions, "-p", robot.path, "--wait", "5").exit_code == 0
    result = m512("backup", folder, "-p", robot.path, "--wait", "5")
    assert result.exit_code == 0, result.stderr
    manifest = json.loads((folder / "manifest.json").read_text())
    assert manifest["board"] == "cm5" and "Motion512 play" in manifest["application"]
    changed = tmp_path / "changed.m512"
    changed.write_text(MOTIONS.replace("1:560", "1:460"))
    assert m512("flash", changed, "-p", robot.path, "--wait", "5").exit_code == 0
    result = m512("restore", folder, "--yes", "-p", robot.path, "--wait", "5", "--what", "motions,app")
    assert result.exit_code == 0, result.stderr
    assert 'page 100 "nod", step 1, ID 1: 460 -> 560 (+100)' in result.stderr
    assert "1 of 448 flash pages written" in result.stderr
    assert m512("diff", folder, motions).exit_code == 0


def test_board_put_through_edit(m512, started, motions, tmp_path):
    edit = started("boot-cm5.hex", "edit-cm5.hex")  # saving needs the loader
    assert "waits in its boot loader" in m512("pose", "-p", edit.path).stderr
    start(m512, edit)
    result = m512("put", motions, "walk:30", "stand", "-p", edit.path, "--json")
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["saved"] == [30, 1]
    assert m512("pages", edit.path, "rename", "30", "march", "--yes").exit_code == 0
    assert m512("get", "all", "-o", tmp_path / "got.bin", "-p", edit.path).exit_code == 0
    from m512.files.image import from_bytes

    got = from_bytes((tmp_path / "got.bin").read_bytes())
    assert got[30].name == b"march" and (got[30].next, got[30].exit) == (30, 1) and got[1].name == b"stand"
    assert got[30].words(0) == read_text(MOTIONS)[3].words(0)
    refused = m512("put", motions, "walk:30", "stand:1", "nod:31", "-p", edit.path)  # 30 has another name now, 1 is equal, 31 is free
    assert refused.exit_code != 0 and 'This replaces page 30 "march" on the robot.' in refused.stderr and "--yes" in refused.stderr
    assert m512("get", "all", "--force", "-o", tmp_path / "after.bin", "-p", edit.path).exit_code == 0
    assert (tmp_path / "after.bin").read_bytes() == (tmp_path / "got.bin").read_bytes()
    assert m512("put", motions, "walk:30", "--yes", "-p", edit.path).stderr.endswith("\nsaved: page 30\n")
    motions.write_text(MOTIONS.replace("440", "450"))
    assert m512("put", motions, "walk:30", "-p", edit.path).exit_code == 0  # the same name: no question
    trim = tmp_path / "trim.m512"
    trim.write_text("motion512 1\npage 0\n  offset | 3:-12\n")
    assert m512("put", trim, "0", "-p", edit.path).exit_code == 0  # the board had no trim
    assert m512("pose", "3:500", "-p", edit.path).exit_code == 0
    assert edit.board.servos[3].goal == 488  # with the trim, which page 0 open in Edit would leave out
    trim.write_text("motion512 1\npage 0\n  offset | 3:-10\n")
    refused = m512("put", trim, "0", "-p", edit.path)
    assert refused.exit_code != 0 and "This replaces the trim (page 0) on the robot." in refused.stderr
    trim.write_text("motion512 1\npage 0 bow\n  step 1s | 1:512\n  step 1s | 1:480\n  step 1s | 1:512\n")
    refused = m512("put", trim, "0", "--yes", "-p", edit.path)
    assert refused.exit_code != 0 and "looks like a motion: ID 1 has" in refused.stderr
    assert m512("get", "0", "-o", tmp_path / "zero.bin", "-p", edit.path).exit_code == 0
    assert from_bytes((tmp_path / "zero.bin").read_bytes())[0].word(2, 3) == 0x10000 - 12


@pytest.mark.parametrize("there, new", [("page 51", "page 51"), ("page 51", ""), ("page 51 bow", ""), ("page 51 bow", "page 51")])
def test_put_does_not_lose_a_motion_unasked_where_a_name_is_missing(m512, started, tmp_path, there, new):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=f"{MOTIONS}{there}\n  step 25 | 1:300\n")
    start(m512, edit)
    path = tmp_path / "new.m512"
    path.write_text(MOTIONS + (new and f"{new}\n  step 25 | 1:310\n"))
    before = bytes(edit.board.flash[0xE000:0x1E000])
    result = m512("put", path, "51", "-p", edit.path)
    assert result.exit_code != 0 and re.search(r"\b51\b", result.stderr)
    assert bytes(edit.board.flash[0xE000:0x1E000]) == before
    if there == new:
        assert "This replaces page 51 on the robot. Save? Nobody can be asked here: say --yes" in result.stderr
        assert m512("put", path, "51", "--yes", "-p", edit.path).exit_code == 0


@pytest.mark.parametrize("there", ["bow", "nod"])
def test_put_asks_before_it_replaces_a_damaged_page(m512, started, tmp_path, there):
    image = read_text(f"{MOTIONS}page 51 {there}\n  step 25 | 1:300\n")
    image[51].data[100] ^= 4
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=MOTIONS)
    edit.board.flash[0xE000 + 51 * 512 : 0xE000 + 52 * 512] = bytes(image[51])
    start(m512, edit)
    path = tmp_path / "new.m512"
    path.write_text(MOTIONS + "page 51 bow\n  step 25 | 1:310\n")
    before = bytes(edit.board.flash[0xE000:0x1E000])
    result = m512("put", path, "51", "-p", edit.path)
    assert result.exit_code == 5 and f'This replaces the damaged page 51 "{there}" on the robot. Save?' in result.stderr, result.stderr
    assert bytes(edit.board.flash[0xE000:0x1E000]) == before
    assert m512("put", path, "51", "--yes", "-p", edit.path).stderr == "saved: page 51\n"


def test_put_goes_on_where_one_was_broken_off_over_erased_flash_which_is_a_new_page_in_edit(m512, started, motions):
    edit = started("boot-cm5.hex", "edit-cm5.hex")
    start(m512, edit)
    new = bytes(read_text(MOTIONS)[3])

    def sent(*pieces):
        with VirtualLink(edit.path) as link:
            client = Client(link)
            client.ask("open 3")
            for at, data in pieces:
                client.ask(f"data {at} {data.hex()}")

    sent(*[(at, new[at : at + 32]) for at in range(0, 128, 32)])  # the cable was pulled here
    result = m512("put", motions, "walk", "-p", edit.path)
    assert result.exit_code == 0 and result.stderr.endswith("saved: page 3\n"), result.stderr
    assert bytes(edit.board.flash[0xE000 + 3 * 512 : 0xE000 + 4 * 512]) == new
    sent((0, b"mine"))
    result = m512("put", motions, "nod:3", "--yes", "-p", edit.path)
    assert result.exit_code != 0 and "unsaved edits. In Edit, SAVE keeps them" in result.stderr, result.stderr
    assert bytes(edit.board.flash[0xE000 + 3 * 512 : 0xE000 + 4 * 512]) == new


def test_put_leaves_nothing_in_edit_that_the_board_cannot_save(m512, started, motions):
    edit = started("edit-cm5.hex")  # no boot loader can write
    edit.pass_time(1.5)
    result = m512("put", motions, "walk:30", "-p", edit.path)
    assert result.exit_code != 0 and "No boot loader can write" in result.stderr, result.stderr
    with VirtualLink(edit.path) as link:
        assert not Client(link).has_edits()


def test_sim_option_plays_without_a_robot(m512, motions):
    motions.write_text(MOTIONS.replace("page 100 nod", "page 100 nod\n  repeat 20"))  # 4 s, so that a busy computer sees it play
    result = m512("play", "nod", "--sim", "--motions", motions, "--json")
    assert result.exit_code == 0, result.stderr
    assert "playing: page 100" in result.stderr and json.loads(result.stdout)["state"] == "idle"


def test_flash_restarts_edit_and_asks_where_edits_would_be_lost(m512, motions, started, tmp_path):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=OLD)
    start(m512, edit)
    looked = m512("flash", motions, "-p", edit.path, "--dry-run")
    assert looked.exit_code == 0 and '"old" -> "nod"' in looked.stderr and "edit" in looked.stderr
    with VirtualLink(edit.path) as link:
        client = Client(link)
        client.ask("open 3")
        assert not client.has_edits()
        client.ask("open 3")
        client.ask("data 64 0102")
        assert client.has_edits()
    backup = ("backup", tmp_path / "kept", "-p", edit.path, "--wait", "5")
    for words in (("flash", motions, "-p", edit.path, "--wait", "5"), backup):
        result = m512(*words)
        assert result.exit_code == 5 and "not saved" in result.stderr and "--yes" in result.stderr
    result = m512(*backup, "--yes", "--what", "eeprom")
    assert result.exit_code == 0 and "MODE" not in result.stderr, result.stderr
    with VirtualLink(edit.path) as link:
        Client(link).ask("data 64 0102")
    result = m512("flash", motions, "-p", edit.path, "--wait", "5", "--yes")
    assert result.exit_code == 0 and "MODE" not in result.stderr, result.stderr


@pytest.fixture
def damaged(started):
    """A board whose pages 3 "walk" and 100 "old" have wrong checksums. It waits in its boot loader."""
    board = started("boot-cm5.hex", "play-cm5.hex", text=OLD)
    for number in (3, 100):
        board.board.flash[0xE000 + 512 * number + 70] ^= 1
    return board


def test_a_damaged_page_is_found_by_its_name(m512, damaged, tmp_path):
    start(m512, damaged)
    result = m512("get", "walk", "-o", tmp_path / "got.bin", "-p", damaged.path)
    assert result.exit_code == 0 and 'note: damaged on the board, read as they are: page 3 "walk"\n' in result.stderr, result.stderr
    assert (tmp_path / "got.bin").read_bytes()[512 * 3 : 512 * 4] == bytes(damaged.board.flash[0xE000 + 512 * 3 : 0xE000 + 512 * 4])
    result = m512("play", "WALK", "-p", damaged.path)
    assert result.exit_code == 8 and "Page 3 is damaged" in result.stderr, result.stderr
    result = m512("play", "fly", "-p", damaged.path)
    assert 'called \'fly\'; it has 1 stand; damaged: pages 3 "walk" and 100 "old"' in result.stderr, result.stderr


def test_names_of_many_damaged_pages_are_not_all_read(m512, damaged):
    for number in range(40, 80):
        damaged.board.flash[0xE000 + 512 * number : 0xE000 + 512 * (number + 1)] = bytes([1] * 512)
    start(m512, damaged)
    result = m512("play", "old", "-p", damaged.path)
    assert "damaged: pages 3, 40..79 and 100, whose names are not all known" in result.stderr, result.stderr


@pytest.mark.parametrize("image", ["play-cm5.hex", "edit-cm5.hex"])
def test_a_command_right_after_a_restart_needs_no_button(m512, started, tmp_path, image):
    """README.md: a running Play or Edit restarts by itself. Right after `backup` neither listens yet."""
    board = started("boot-cm5.hex", image, text=OLD, applied=True)
    board.pass_time(2)
    for folder, pause in (("a", 0), ("b", 0.1)):
        assert m512("backup", tmp_path / folder, "--what", "eeprom", "-p", board.path, "--wait", "0").exit_code == 0
        board.pass_time(pause)
        result = m512("run", "-p", board.path, "--wait", "5")
        assert result.exit_code == 0 and "MODE" not in result.stderr, result.stderr
        board.pass_time(2)


@pytest.mark.parametrize("image", ["play-cm5.hex", "edit-cm5.hex"])
def test_a_board_that_answers_while_the_button_is_awaited_restarts_by_itself(m512, started, image):
    board = started("boot-cm5.hex", image, text=OLD, applied=True)
    board.pass_time(2)
    hears_from, on_byte = board.now() + 15, board.on_byte
    board.on_byte = lambda byte: on_byte(byte) if board.now() >= hears_from else board.pass_time(0.0002)
    result = m512("run", "-p", board.path, "--wait", "60")
    assert result.exit_code == 0 and "MODE" in result.stderr, result.stderr
    assert board.now() < hears_from + 10


@pytest.mark.parametrize("words", [("aim", "2:584"), ("swing", "2", "512", "40", "1s"), ("layer", "walk", "--joints", "2")])
def test_what_moves_single_joints_waits_for_the_first_pose_of_a_play(m512, robot, words):
    """Play refuses it until then, and a script has it right behind `m512 play`."""
    start(m512, robot)
    assert m512("play", "walk", "-p", robot.path).exit_code == 0
    result = m512(*words, "-p", robot.path)
    assert result.exit_code == 0, result.stderr


@pytest.mark.parametrize("image, words", [("play", ("play", "walk", "--wait")), ("play", ("pose", "1:900")), ("edit", ("pose", "1:900"))])
def test_a_motion_that_a_restart_of_the_board_ends_is_told(m512, started, image, words):
    board = started("boot-cm5.hex", f"{image}-cm5.hex", text=OLD, applied=True)
    board.pass_time(3)
    pressed, pass_time = [], board.pass_time

    def with_mode(seconds):
        pass_time(seconds)
        if not pressed and any(servo.moving for servo in board.board.servos):
            pressed.append(True)
            board.board.press("MODE")
            pass_time(0.1)
            board.board.release("MODE")

    board.pass_time = with_mode
    result = m512(*words, "-p", board.path)
    assert result.exit_code == 8 and "has broken off the motion: the board has restarted" in result.stderr, result.stderr


@pytest.mark.parametrize("words", [("swing", "3", "512", "40", "1s"), ("aim", "3:900", "--speed", "5")])
def test_flash_does_not_restart_a_board_whose_joints_are_moved_by_code(m512, robot, motions, words):
    """Play refuses @reset while joints move (PROTOCOL.md, ERR 4). m512 then typed `#` into Play and asked for the MODE button."""
    start(m512, robot)
    assert m512("torque", "on", "-p", robot.path).exit_code == 0
    result = m512(*words, "-p", robot.path)
    assert result.exit_code == 0, result.stderr
    result = m512("flash", motions, "-p", robot.path, "--wait", "1")
    assert result.exit_code == 5 and "`m512 stop` first" in result.stderr and "MODE" not in result.stderr, result.stderr
    assert m512("stop", "-p", robot.path).exit_code == 0
    robot.pass_time(2)
    assert m512("flash", motions, "-p", robot.path, "--wait", "1").exit_code == 0


def test_doctor_takes_edits_drawing_for_no_missed_motion(m512, started):
    edit = started("edit-cm5.hex", text=OLD)
    edit.pass_time(1.5)
    for _ in range(3):
        with VirtualLink(edit.path) as link:
            missed = int(Client(link).where()["missed"])
        for keys in (b"help\r", b"q"):  # and the screen is redrawn
            edit.put(keys)
            edit.pass_time(0.7)
    assert missed > 100
    result = m512("doctor", "-p", edit.path)
    assert result.exit_code == 0 and "image" in result.stdout and "ticks" not in result.stdout, result.stdout


@pytest.mark.parametrize("missed, told", [("0", False), ("1", True)])
def test_doctor_tells_of_motion_that_play_missed(missed, told):
    findings = []
    client = SimpleNamespace(version={"image": "play"}, where=lambda: {"missed": missed, "dv": "111", "faulty": "00000000"})
    doctor._robot(client, lambda *parts: findings.append(parts))
    assert any(what == "ticks" for what, *_ in findings) == told


@pytest.mark.parametrize("edits, where", [(False, "type `faults` in `m512 term`"), (True, "Edit's screen")])
def test_doctor_leads_to_the_reason_of_a_fault(edits, where):
    """Edit has no word `faults`."""
    findings = []
    client = SimpleNamespace(version={}, can_save=edits, where=lambda: {"faulty": "00000010"})
    doctor._robot(client, lambda *parts: findings.append(parts))
    assert [(what, text) for what, _, text, _ in findings] == [("faults", "servos with a fault: 4")] and where in findings[0][3]


def start(m512, robot):
    assert m512("run", "-p", robot.path).exit_code == 0
    robot.pass_time(2.0)


def test_run_says_why_an_application_does_not_start(m512, started):
    robot = started("boot-cm5.hex", "play-cm5.hex")
    robot.board.flash[0x1000] ^= 1
    result = m512("run", "-p", robot.path)
    assert result.exit_code == 8 and "application: damaged, which cannot start: flash one: m512 run" in result.stderr, result.stderr


def test_a_play_whose_cable_is_pulled_goes_on_and_m512_says_so(m512, robot):
    start(m512, robot)
    robot.cut_after = robot.moved + 2000
    lost = m512("play", "walk", "--wait", "-p", robot.path)
    assert lost.exit_code == 6 and "hat plays on the robot goes on" in lost.stderr, lost.stderr


@pytest.mark.parametrize("presses", [1, 2])
def test_a_play_that_ctrl_c_has_stopped_is_no_success(m512, robot, monkeypatch, presses):
    """`m512 play a --wait && m512 play b` once continued with b."""
    start(m512, robot)
    sleep, left = VirtualLink.sleep, [presses]

    def pressed(link, seconds):
        sleep(link, seconds)
        if left[0]:
            left[0] -= 1
            raise KeyboardInterrupt

    monkeypatch.setattr(VirtualLink, "sleep", pressed)
    result = m512("play", "walk", "--wait", "--json", "-p", robot.path)
    assert result.exit_code == 130 and "stopped by Ctrl-C" in result.stderr, result.stderr
    assert json.loads(result.stdout)["state"] == "idle"


def test_a_play_whose_follower_is_ended_is_stopped(m512, robot, monkeypatch):
    """A closed terminal window (SIGHUP) and `kill` act like Ctrl-C. The robot once walked on with nobody to stop it."""
    start(m512, robot)
    sleep, left = VirtualLink.sleep, [1]

    def ended(link, seconds):
        sleep(link, seconds)
        if left[0]:
            left[0] -= 1
            signal.raise_signal(signal.SIGHUP)

    monkeypatch.setattr(VirtualLink, "sleep", ended)
    assert m512("play", "walk", "--wait", "-p", robot.path).exit_code == 128 + signal.SIGHUP
    robot.pass_time(5.0)
    assert json.loads(m512("stop", "--json", "-p", robot.path).stdout)["state"] == "idle"


@pytest.mark.parametrize(
    "image, words, fault",
    [
        *(("play", ("play", "walk", "--wait"), fault) for fault in ("overload", "silent", "dead")),
        ("play", ("pose", "5:900"), "blocked"),  # in a walk its servo switches off only after minutes
        ("play", ("drive", "walk"), "silent"),
        ("edit", ("play", "walk", "--wait"), "overload"),
    ],
)
def test_a_motion_that_the_fault_of_a_servo_breaks_off_is_no_success(m512, started, monkeypatch, image, words, fault):
    monkeypatch.setattr("m512.cli.shape._keys", lambda: nullcontext(driving.Keys()))
    robot = started(f"{image}-cm5.hex", text=MOTIONS)
    robot.pass_time(1.5)
    sleep, waits = VirtualLink.sleep, []

    def fails(link, seconds):
        waits.append(seconds)
        if len(waits) == 3:
            robot.board.servos[5].fault(fault)
        sleep(link, seconds)

    monkeypatch.setattr(VirtualLink, "sleep", fails)
    result = m512(*words, "-p", robot.path)
    assert result.exit_code == 8 and "m512: the robot has broken off the motion: " in result.stderr, result.stderr
    said = result.stderr.partition("broken off the motion: ")[2]
    assert ("Servo 5 " in said and "Ended for the fault of a servo in " in said) or image == "edit", said
    assert said.endswith("fault of servo 5 (m512 doctor)\n")


@pytest.mark.parametrize("error, code", [(KeyboardInterrupt(), 130), (BoardError("Edits would be lost"), 8)])
def test_put_that_ends_half_way_says_what_it_has_saved(m512, started, monkeypatch, tmp_path, error, code):
    edit, save = started("boot-cm5.hex", "edit-cm5.hex", text=OLD, applied=True), Client.save_page
    pages = "".join(f"page {number} p{number}\n  step 1s | 1:{500 + number}\n" for number in (20, 21, 22))
    (tmp_path / "x.m512").write_text("motion512 1\n" + pages)

    def third_fails(client, number, page):
        if number == 22:
            raise error
        save(client, number, page)

    monkeypatch.setattr(Client, "save_page", third_fails)
    result = m512("put", tmp_path / "x.m512", "all", "-p", edit.path)
    assert result.exit_code == code and "page 22, after pages 20 and 21 had been saved" in result.stderr, result.stderr
    monkeypatch.setattr(Client, "save_page", save)
    assert "saved: page 22\n" in m512("put", tmp_path / "x.m512", "all", "-p", edit.path).stderr


def p20(tmp_path):
    """A text with page 20, and that page."""
    (tmp_path / "x.m512").write_text("motion512 1\npage 20 p20\n  step 1s | 1..18:500\n")
    return tmp_path / "x.m512", bytes(formats.load(tmp_path / "x.m512")[20])


@pytest.mark.parametrize("sent", [1, 7, 16])
def test_put_that_the_cable_ended_in_a_page_can_be_repeated(m512, started, tmp_path, sent):
    """The part of a page that was sent stays in Edit's RAM as edits, which Edit does not give up."""
    edit, (file, page) = started("boot-cm5.hex", "edit-cm5.hex", text=OLD, applied=True), p20(tmp_path)
    with VirtualLink(edit.path) as link:
        Client(link).ask("open 20")
        for at in range(0, 32 * sent, 32):
            Client(link).ask(f"data {at} {page[at : at + 32].hex()}")
    result = m512("put", file, "20", "-p", edit.path)
    assert result.exit_code == 0 and bytes(edit.board.flash[0xE000 + 512 * 20 :][:512]) == page, result.stderr


def test_put_does_not_take_edits_of_a_person_for_its_own(m512, started, tmp_path):
    edit, (file, _) = started("boot-cm5.hex", "edit-cm5.hex", text=OLD, applied=True), p20(tmp_path)
    with VirtualLink(edit.path) as link:
        Client(link).ask("open 20")
        Client(link).ask("data 64 0102")
        Client(link).ask("data 0 4D")
    result = m512("put", file, "20", "-p", edit.path)
    assert result.exit_code == 8 and "unsaved edits" in result.stderr and edit.board.flash[0xE000 + 512 * 20] != ord("p")


class Restarts:
    """The power of the board fails for a moment at byte `at` of the request that is `step` requests behind the first @open; then `wait`
    seconds pass before the PC goes on."""

    def __init__(self, edit, step, at, wait):
        self.edit, self.step, self.at, self.wait = edit, step, at, wait
        self.requests, self.has_been, self.line, self.sent_after = -1, False, b"", []
        edit.garble = self.look

    def look(self, direction, index, byte):
        if direction != "->":
            return byte
        if byte == 0x1E:
            self.requests += self.requests >= 0
            self.line = b""
        self.line += bytes([byte])
        if self.line == b"\x1e@open ":
            self.requests = max(self.requests, 0)
        if self.has_been and self.line in (b"\x1e@open ", b"\x1e@data "):
            self.sent_after.append(self.line[1:-1].decode())
        if not self.has_been and self.requests == self.step and self.line.endswith(self.at):
            self.has_been, self.line = True, b"cut"
            self.edit.board.power_off()
            self.edit.board.run(ms=50)
            self.edit.board.power_on()
            self.edit.pass_time(self.wait)
        return byte


def pages_in_flash(edit):
    return [bytes(edit.board.flash[at : at + 512]) for at in range(0xE000, 0x1E000, 512)]


@pytest.mark.parametrize("at, wait, steps", [(b"\x1e", 0, 7), (b"\x1e", 5, 7), (b"\r", 0, 7), (b"\x1e", 0, 0), (b"\x1e", 5, 0)])
def test_put_writes_into_no_page_of_a_board_that_restarts(m512, started, tmp_path, at, wait, steps):
    """At every sixth request, others in each case. A restarted Edit has page 1 open, and what is sent then lies there, as edits that the
    next `save` writes over it. Without steps page 1 is as empty as the pages that are put, so that its content does not tell them apart."""
    one = "page 1 one\n" + "".join(f"  step 1s | 1..18:{300 + 20 * step}\n" for step in range(steps)) if steps else ""
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=f"motion512 1\npage 2 two\n  step 1s | 1:5\n{one}", applied=True, servos=())
    step, over = wait % 4 + (steps > 0) - 6, False
    while not over:
        step += 6
        number, file = 20 + step, tmp_path / f"{step}.m512"
        file.write_text(f"motion512 1\npage {number} p{step}\n" + "".join(f"  step 1s | 1..18:{400 + 9 * n}\n" for n in range(7)))
        new, before = bytes(formats.load(file)[number]), pages_in_flash(edit)
        restarts = Restarts(edit, step, at, wait)
        result = m512("put", file, number, "--yes", "-p", edit.path)
        over, edit.garble = step > 0 and not restarts.has_been, None
        told = f"request {step}: {result.stderr}, then sent {restarts.sent_after}"
        assert result.exit_code == 0 or "the board has restarted" in result.stderr, told
        # After 5 s the request comes whole, so a piece is in that page before m512 can know; then it has to be put back.
        assert restarts.sent_after[:1] != ["@data"] or wait or not steps, told
        after = pages_in_flash(edit)
        assert after[number] in (before[number], new) and after[:number] + after[number + 1 :] == before[:number] + before[number + 1 :], told
        with VirtualLink(edit.path) as link:
            assert not Client(link).has_edits(), told
        again = m512("put", file, number, "--yes", "-p", edit.path)
        assert again.exit_code == 0 and pages_in_flash(edit)[number] == new, f"{told}, repeated: {again.stderr}"
    assert step > 16


@pytest.mark.parametrize("end, code", [(KeyboardInterrupt, 130), (SystemExit(143), 143)])
def test_put_that_is_ended_in_a_page_saves_it_first(m512, started, tmp_path, end, code):
    edit, (file, page) = started("boot-cm5.hex", "edit-cm5.hex", text=OLD, applied=True), p20(tmp_path)
    typed = bytearray()

    def press(direction, index, byte):
        if direction == "->":
            typed.append(byte)
            if typed.endswith(b"@data 96"):
                edit.garble = None
                raise end
        return byte

    edit.garble = press
    assert m512("put", file, "20", "-p", edit.path).exit_code == code
    assert bytes(edit.board.flash[0xE000 + 512 * 20 :][:512]) == page
    with VirtualLink(edit.path) as link:
        assert not Client(link).has_edits()


def test_a_number_of_no_page_is_told_with_what_there_is(m512, robot, tmp_path):
    start(m512, robot)
    for command, word, *more in (("play", "0"), ("play", "128"), ("layer", "300"), ("get", "128", "-o", tmp_path / "x.bin")):
        result = m512(command, word, *more, "-p", robot.path)
        assert result.exit_code == 8 and f"page {word}" in result.stderr and "1 stand, 3 walk" in result.stderr, result.stderr


def test_a_pose_of_no_servo_is_no_success(m512, started):
    robot = started("boot-cm5.hex", "play-cm5.hex", servos=())
    start(m512, robot)
    for words in ((), ("--json",), ("--text",)):
        result = m512("pose", *words, "-p", robot.path)
        assert result.exit_code == 8 and "no servo answers" in result.stderr and not result.stdout


def test_joints_are_named_by_ranges_too(m512, robot):
    start(m512, robot)

    def limp():
        pose = json.loads(m512("pose", "--json", "-p", robot.path).stdout)
        return {int(joint) for joint, found in pose.items() if not found["torque"]}

    for words, left in ((["on"], set()), (["off", "1..3", "7,9"], {1, 2, 3, 7, 9}), (["on", "1..2"], {3, 7, 9})):
        result = m512("torque", *words, "-p", robot.path)
        assert result.exit_code == 0 and limp() == left, result.stderr
    assert m512("free", "1..3", "-p", robot.path).exit_code == 0
    for command in (("torque", "on"), ("free",)):
        refused = m512(*command, "3-5", "-p", robot.path)
        assert refused.exit_code == 2 and "'3-5'" in refused.stderr and "1..6" in refused.stderr, refused.stderr


def test_play_is_shaped(m512, robot):
    start(m512, robot)
    with VirtualLink(robot.path) as link:
        assert "rate" in Client(link).where()
    assert m512("play", "walk", "--rate", "150", "--amplitude", "80", "-p", robot.path).exit_code == 0
    found = json.loads(m512("shape", "--json", "-p", robot.path).stdout)
    assert found["rate"] == 150 and found["amplitude"] == 80 and found["blend"] == 0
    assert "rate 90" in m512("shape", "--rate", "90", "--blend", "-40", "-p", robot.path).stdout
    assert json.loads(m512("shape", "--reset", "--json", "-p", robot.path).stdout)["rate"] == 100
    assert m512("shape", "--rate", "5", "-p", robot.path).exit_code == 2


def test_a_page_is_laid_over_the_walk_on_joints_of_its_own(m512, robot):
    start(m512, robot)
    refused = m512("layer", "old", "-p", robot.path)
    assert refused.exit_code == 8 and "A layer needs a page that plays" in refused.stderr
    assert m512("play", "walk", "-p", robot.path).exit_code == 0
    robot.pass_time(3)
    laid = m512("layer", "old", "--joints", "1,3", "-p", robot.path)
    assert laid.exit_code == 0 and "layer 100" in laid.stdout, laid.stderr
    assert laid.stderr == "note: page 100 never moves joint 3: it stays where it is until `m512 layer off`\n"
    assert m512("layer", "old", "--joints", "1", "-p", robot.path).stderr == ""
    assert m512("layer", "off", "-p", robot.path, "--json").exit_code == 0
    assert json.loads(m512("shape", "--json", "-p", robot.path).stdout)["layer"] == 0
    assert m512("layer", "fly", "-p", robot.path).exit_code == 8
    assert "belongs to a page" in m512("layer", "off", "--joints", "1", "-p", robot.path).stderr


def test_joints_are_moved_by_code_and_given_back(m512, robot):
    start(m512, robot)

    def run(*args, code=0):
        result = m512(*args, "-p", robot.path)
        assert result.exit_code == code, result.stderr
        return result

    run("torque", "on")
    assert "aim 1,2" in run("aim", "1:30deg", "2:400", "--speed", "120").stdout
    robot.pass_time(2)
    assert [robot.board.servos[joint].goal for joint in (1, 2)] == [614, 400]
    assert json.loads(run("swing", "3", "512", "20deg", "2s", "--phase", "90", "--json").stdout)["aim"] == "1,2,3"
    robot.pass_time(1)
    seen = set()
    for _ in range(40):
        robot.pass_time(0.05)
        seen.add(robot.board.servos[3].goal)
    assert min(seen) in range(440, 450) and max(seen) in range(575, 585)  # 20 degrees are 68 units
    assert "aim 1,3" in run("free", "2").stdout and "aim none" in run("free").stdout
    assert "no answer from servos 25: nothing was moved" in run("aim", "25:512", code=8).stderr
    assert "amplitude is 0..511" in run("swing", "3", "512", "600", "2s", code=2).stderr
    assert "such as 2s" in run("swing", "3", "512", "60", "2", code=2).stderr
    assert "0..1023" in run("aim", "3:2000", code=2).stderr
    for word in ("3:-5", "3:+5", "3:-", "3:."):
        assert f"{word}: a position is 0..1023" in run("aim", word, code=2).stderr


def test_amplitudes_of_single_joints_are_told_with_their_joints(m512, robot):
    start(m512, robot)
    with VirtualLink(robot.path) as link:
        client = Client(link)
        client.ask("amplitude 60")
        client.ask("amplitude 120 3 4")
        assert client.shape()["amplitude"] == "60 3,4:120"


def test_edit_refuses_what_takes_play_and_nothing_moves(m512, started):
    edit = started("edit-cm5.hex", text=OLD)
    edit.pass_time(1.5)
    for words in (("shape",), ("drive", "walk"), ("layer", "old"), ("aim", "1:512"), ("play", "walk", "--rate", "120")):
        result = m512(*words, "-p", edit.path)
        assert result.exit_code == 8 and "Edit does not know @" in result.stderr and "m512 run play-cm5.hex" in result.stderr, result.stderr
    edit.pass_time(1)
    assert not edit.board.trace


def test_drive_ends_through_the_exit_page_when_the_line_falls_silent(m512, robot):
    start(m512, robot)
    with VirtualLink(robot.path) as link:
        client = Client(link)
        client.play(client.find("walk"))
        client.ask(driving.Stick(rate=120).line())
        assert client.where()["rate"] == "120"
        pages = set()
        for _ in range(200):
            state = client.where()
            pages.add(state["page"])
            if state["state"] == "idle":
                break
            robot.pass_time(0.05)
        assert state["state"] == "idle" and {"3", "1"} <= pages  # walk, and its exit page stand


@pytest.mark.parametrize("board", ["cm5", "cm2"])
def test_the_simulated_board_is_the_one_that_the_image_is_for(monkeypatch, board):
    """Otherwise the image starts on the wrong pins, and m512 waits five minutes for it."""
    monkeypatch.setenv("M512_CM5SIM", "/bin/echo")
    with pytest.raises(MissingError, match=f"--board={board} "):
        Simulator(f"play-{board}.hex")


def test_a_pose_of_a_servo_that_is_not_there_is_an_error(m512, started):
    play = started("play-cm5.hex", servos=range(1, 4))
    result = m512("pose", "2:600", "25:512", "-p", play.path)
    assert result.exit_code == 8 and "servos 25" in result.stderr
    found = json.loads(m512("pose", "--json", "-p", play.path).stdout)
    assert found["2"] == {"position": 512, "torque": False}


def test_help_says_what_moving_one_joint_of_a_limp_robot_does(m512, started):
    """A board moves nothing after `torque off`."""
    play = started("play-cm5.hex")

    def holding():
        return [joint for joint, found in json.loads(m512("pose", "--json", "-p", play.path).stdout).items() if found["torque"]]

    assert holding() == [] and m512("pose", "1:500", "-p", play.path).exit_code == 0 and holding() == ["1"]
    assert "The others stay as they are, limp or holding." in " ".join(m512("pose", "--help").stdout.split())
    told = m512("torque", "off", "-p", play.path)
    assert told.exit_code == 0 and "note" not in told.stderr
    refused = m512("pose", "1:512", "-p", play.path)
    assert refused.exit_code == 8 and "switch them on first" in refused.stderr and holding() == []
    assert "A board moves nothing that was switched off until `torque on`" in " ".join(m512("torque", "--help").stdout.split())


def test_put_says_which_page_of_the_board_a_link_leads_to(m512, started, tmp_path):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text="motion512 1\npage 1 ready\n  step 1s | 1:500\n", applied=True)
    (tmp_path / "a.m512").write_text(
        "motion512 1\npages 0..255\npage 3 a\n  next 1\n  exit 9\n  link1 U 0xC8\n  link2 D 4\n  step 1s | 1:5\npage 4 d\n  step 9 | 1:5\n"
    )
    result = m512("put", tmp_path / "a.m512", "3:20", "4:9", "-p", edit.path)
    leads = ['next 1 @page 1 "ready" of the target', 'exit 9 @page 9 "d" of the target', "link1 page 200 @page 200, which the target does not have"]
    told = [f'note: page 20 "a": {text.replace("@", "is not among the pages taken and leads to ")}' for text in leads]
    assert result.exit_code == 0 and result.stderr.splitlines() == [*told, "saved: pages 20 9"], result.stderr
    assert "note" not in m512("put", tmp_path / "a.m512", "4:30", "-p", edit.path).stderr
