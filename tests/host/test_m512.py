# SPDX-License-Identifier: MIT
"""m512 -p bus:...: the commands of m512 with a program of this PC in place of a board."""

import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pexpect
import pytest

from m512.board.bus import wrong_file
from m512.files.image import Image
from tests.host.pc_robot import GOAL, SYNC_WRITE, until
from tests.sim.made_page import page


@pytest.fixture
def motions(tmp_path):
    image = Image.empty()
    image[1] = page("ready", [(40, {1: 480, 2: 544})])
    image[2] = page("bow", [(40, {11: 600, 12: 424}), (40, {})])
    image[3] = page("nod", [(64, {1: 600}), (64, {1: 424})], next=3)
    path = tmp_path / "motions.bin"
    path.write_bytes(image.to_bytes())
    return path


@pytest.fixture
def m512(make, tmp_path):
    """m512("pose") returns its output; the adapter's servos are those of `make`."""
    robot = make()
    environment = dict(os.environ, M512_ROBOT=str(tmp_path / "robot"))

    def start(*words, bus=f"bus:{robot.port}"):
        command = [sys.executable, "-m", "m512", *(str(word).replace("BUS", bus) for word in words)]
        pipe = subprocess.PIPE
        started.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=pipe, stderr=pipe, text=True, env=environment))
        return started[-1]

    def run(*words, code=0, **how):
        process = start(*words, **how)
        said = "".join(process.communicate())
        assert process.returncode == code, said
        return said

    run.robot, run.start, started = robot, start, []
    yield run
    for process in started:
        process.kill()
        process.communicate()


def test_pages_go_in_and_come_back_and_play(m512, motions, tmp_path):
    assert "saved: pages 1 2 3" in m512("put", motions, "all", "-p", "BUS")
    assert "they were there already" in m512("put", motions, "all", "-p", "BUS")
    listed = m512("pages", "BUS", "list")
    assert "ready" in listed and "bow" in listed
    m512("diff", "BUS", motions)
    back = tmp_path / "back.bin"
    m512("get", "all", "-o", back, "-p", "BUS")
    whole = motions.read_bytes()
    assert back.read_bytes()[512 : len(whole)] == whole[512:]  # a PC has more pages than a board
    said = m512("play", "bow", "-p", "BUS")
    assert "idle" in said and "go on holding it" in said and "m512 torque off" in said  # m512 passes the program's messages on
    assert m512.robot.frames()[-1] == {joint: 512 for joint in range(1, 19)}


def test_poses_and_torque(m512):
    assert "limp" in m512("pose", "-p", "BUS") and m512.robot.frames() == []
    m512("pose", "1:560", "-p", "BUS")
    assert m512.robot.frames()[-1][1] == 560
    assert "next command that moves (play, pose ID:POSITION) switches its joints on again" in m512("torque", "off", "-p", "BUS")
    assert "holds" not in m512("pose", "-p", "BUS")
    m512("pose", "1:500", "-p", "BUS")
    held = [line.split()[1] for line in m512("pose", "-p", "BUS").splitlines() if line.endswith("holds")]
    assert held == ["1"]
    assert "note: the next" not in m512("torque", "on", "-p", "BUS")


def test_what_needs_a_boot_loader_is_refused_and_what_to_do_is_said(m512, motions):
    for words in (("flash", motions), ("run", motions), ("backup",)):
        assert "m512 put" in m512(*words, "-p", "BUS", code=5)


def test_a_port_that_is_not_there_is_named(m512):
    assert "/dev/nowhere: no such port" in m512("pose", "-p", "BUS", code=6, bus="bus:/dev/nowhere")
    assert "say bus:DEVICE" in m512("pose", "-p", "BUS", code=6, bus="bus:")
    assert "@5: the rate is 9600.." in m512("pose", "-p", "BUS", code=6, bus=f"bus:{m512.robot.port}@5")
    assert all(packet[4] != SYNC_WRITE or packet[5] != GOAL for packet in m512.robot.packets())


def test_a_file_of_the_robot_that_is_none_is_the_error(m512, tmp_path, monkeypatch):
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "pages.bin").write_bytes(bytes(65536))
    sentence = f"{tmp_path}/robot/pages.bin: not a file of 131072 bytes. Move it away, and a new one is made"
    for words in (("pose",), ("torque", "off"), ("pages", "BUS", "list")):
        said = m512(*words, *(() if "BUS" in words else ("-p", "BUS")), code=4)
        assert said.count(sentence) == 1 and "plugged in" not in said, said
    found = m512("doctor", "-p", "BUS", code=3, bus="bus:/dev/nowhere")  # examines the folder all the same
    assert f"{tmp_path}/robot/pages.bin: not a file of 131072 bytes" in found and "-> Move it away" in found
    (tmp_path / "robot" / "pages.bin").unlink()
    m512("pose", "-p", "BUS")
    monkeypatch.setenv("M512_ROBOT", str(tmp_path / "robot"))
    assert (tmp_path / "robot" / "pages.bin").exists() and wrong_file() is None


@pytest.mark.parametrize("words", [("aim", "1:650"), ("swing", 1, 512, 60, "2s"), ("layer", 2), ("shape", "--rate", 200), ("shape", "--reset")])
def test_what_would_end_with_the_program_is_refused(m512, words):
    said = m512(*words, "-p", "BUS", code=5)
    assert "ends with this command" in said and "m512 term" in said
    assert not m512.robot.frames()


def playing(m512, motions):
    """m512 while it plays a page without an end."""
    m512("put", motions, "all", "-p", "BUS")
    process = m512.start("play", "nod", "--wait", "-p", "BUS")
    while "playing: page 3" not in process.stderr.readline():
        assert process.poll() is None
    return process


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux ends a child with its parent")
def test_the_program_ends_softly_with_an_m512_that_was_killed(m512, motions):
    process = playing(m512, motions)
    until(lambda: any(goal.get(1, 512) != 512 for goal in m512.robot.frames()), "nothing moves")
    said = m512("stop", "--now", "-p", "BUS", code=6)
    program = re.search(r"in use by another program.*\(motion512-play, process (\d+)\)", said)
    assert program, said
    process.kill()
    until(lambda: not os.path.exists(f"/proc/{program[1]}"), "the program goes on")
    frames = m512.robot.frames()
    ways = [max(abs(after[joint] - before[joint]) for joint in before) for before, after in zip(frames, frames[1:])]
    assert ways[-1] <= 1 and max(ways) <= 12  # slows down to a stand
    m512("pose", "-p", "BUS")


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux lists the children of a process")
def test_a_play_that_the_program_comes_late_for_is_told_as_broken_off(m512, motions):
    m512("put", motions, "all", "-p", "BUS")
    process = m512.start("play", "nod", "--wait", "-p", "BUS")
    until(lambda: any(goal.get(1, 512) != 512 for goal in m512.robot.frames()), "nothing moves")
    with suppress(OSError):  # on a busy computer it has been late already, and has ended
        for program in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split():
            os.kill(int(program), signal.SIGSTOP)
            time.sleep(0.6)
            os.kill(int(program), signal.SIGCONT)
    said = "".join(process.communicate())
    assert process.returncode == 8 and "the robot has broken off the motion: The computer came 0.1 s late" in said, said


def test_an_adapter_pulled_during_a_play_is_a_lost_port(m512, motions):
    process = playing(m512, motions)
    m512.robot.pull()
    _, said = process.communicate()
    assert process.returncode == 6, said
    assert "was unplugged, which ends any motion" in said and "`m512 torque on -p bus:" in said and "say `on`" not in said
    assert "no such port" in m512("play", "nod", "-p", "BUS", code=6)


def test_edits_that_end_with_the_terminal_are_asked_for(m512, tmp_path):
    environment = dict(os.environ, M512_ROBOT=str(tmp_path / "robot"), TERM="xterm")
    words = ["-m", "m512", "term", "-p", f"bus:{m512.robot.port}"]
    with pexpect.spawn(sys.executable, words, env=environment, encoding="utf-8", timeout=120) as child:
        child.expect("to quit")
        child.send("\x1dl")
        child.expect("no board with a boot loader")
        child.send("page 3\r")
        child.expect("H0003")
        child.send("name mine\r")
        child.expect("unsaved")
        child.send("\x1dq")
        child.expect("edits that are not saved. q again")
        child.send("x")
        child.send("save\r")  # the key that stays does not go to Edit
        child.expect("save OK")
        child.send("name other\r")
        child.expect("unsaved")
        child.send("\x1dq")
        child.expect("q again")
        child.send("q")
        child.expect(pexpect.EOF)
    assert "mine" in m512("pages", "BUS", "list")


def test_edits_that_end_with_the_lines_of_a_pipe_are_told(m512, tmp_path):
    for lines, is_told in (("page 3\nname mine\n", True), ("page 3\nname mine\nsave\n", False)):
        environment = dict(os.environ, M512_ROBOT=str(tmp_path / "robot"))
        words = [sys.executable, "-m", "m512", "term", "-p", f"bus:{m512.robot.port}"]
        said = subprocess.run(words, input=lines, capture_output=True, text=True, check=True, env=environment).stderr
        assert ("edits that were not saved; they are lost" in said) == is_told, said
