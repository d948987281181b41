# SPDX-License-Identifier: MIT
"""m512 -p bus:...: the commands of m512 with a program of this PC in place of a board."""

import os
import subprocess
import sys

import pytest

from m512.files.image import Image
from tests.host.pc_robot import GOAL, SYNC_WRITE
from tests.sim.made_page import page


@pytest.fixture
def motions(tmp_path):
    image = Image.empty()
    image[1] = page("ready", [(40, {1: 480, 2: 544})])
    image[2] = page("bow", [(40, {11: 600, 12: 424}), (40, {})])
    path = tmp_path / "motions.bin"
    path.write_bytes(image.to_bytes())
    return path


@pytest.fixture
def m512(make, tmp_path):
    """m512("pose") returns its output; the adapter's servos are those of `make`."""
    robot = make()
    environment = dict(os.environ, M512_ROBOT=str(tmp_path / "robot"))

    def run(*words, code=0, bus=f"bus:{robot.port}"):
        done = subprocess.run(
            [sys.executable, "-m", "m512", *(str(word).replace("BUS", bus) for word in words)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            env=environment,
        )
        assert done.returncode == code, done.stdout + done.stderr
        return done.stdout + done.stderr

    run.robot = robot
    return run


def test_pages_go_in_and_come_back_and_play(m512, motions, tmp_path):
    assert "saved: pages 1 2" in m512("put", motions, "all", "-p", "BUS")
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
    m512("torque", "off", "-p", "BUS")
    assert "holds" not in m512("pose", "-p", "BUS")


def test_what_needs_a_boot_loader_is_refused_and_what_to_do_is_said(m512, motions):
    for words in (("flash", motions), ("run", motions), ("backup",)):
        assert "m512 put" in m512(*words, "-p", "BUS", code=5)


def test_a_port_that_is_not_there_is_named(m512):
    assert "/dev/nowhere: no such port" in m512("pose", "-p", "BUS", code=6, bus="bus:/dev/nowhere")
    assert "say bus:DEVICE" in m512("pose", "-p", "BUS", code=6, bus="bus:")
    assert "@5: the rate is 9600.." in m512("pose", "-p", "BUS", code=6, bus=f"bus:{m512.robot.port}@5")
    assert all(packet[4] != SYNC_WRITE or packet[5] != GOAL for packet in m512.robot.packets())


@pytest.mark.parametrize("words", [("aim", "1:650"), ("swing", 1, 512, 60, "2s"), ("layer", 2), ("shape", "--rate", 200), ("shape", "--reset")])
def test_what_would_end_with_the_program_is_refused(m512, words):
    said = m512(*words, "-p", "BUS", code=5)
    assert "ends with this command" in said and "m512 term" in said
    assert not m512.robot.frames()
