# SPDX-License-Identifier: MIT
"""Play on a PC, through adapters that are slow, noisy, echo what they are sent, or are pulled out.

The tests check counts and states only. The frames must be those that play-cm5.hex sends on the board.
"""

import itertools

import pytest

from cm5sim import Board
from m512.files.image import Image
from tests.sim.made_page import page

JOINTS = range(1, 19)
SECONDS = 5


def motions():
    """Page 1 stands, page 2 swings all joints for some seconds, page 3 for hours."""
    image = Image.empty()
    image[1] = page("stand", [(40, {joint: 512 for joint in JOINTS})])
    left, right = ({joint: 512 + way * (20 + 5 * joint) for joint in JOINTS} for way in (1, -1))
    image[2] = page("swing", [(64, left), (64, right)], repeat=SECONDS)
    image[3] = page("long", [(64, left), (64, right)], next=3, exit=1)
    return image.to_bytes()


@pytest.fixture
def files(tmp_path):
    path = tmp_path / "motions.bin"
    path.write_bytes(motions())
    return path


def distinct(frames):
    """Drops consecutive repetitions: in interactive use the robot stands still for as long as the user takes."""
    return [frame for frame, _ in itertools.groupby(frames)]


@pytest.fixture(scope="module")
def of_the_board():
    """The goals of the same session on the strict board."""
    board = Board(images=["play-cm5.hex"], motions=motions(), servos=JOINTS)
    board.expect("] ", ms=2000)
    board.run(ms=300)
    for line in ("play 1", "play 2"):
        board.send(line + "\r")
        board.expect("Ended", ms=20000)
        board.run(ms=100)
    return distinct([frame.goals for frame in board.trace])


def play(robot):
    """Runs that session."""
    at = robot.expect("18 servos: 1-18")
    for line in ("play 1", "play 2"):
        robot.send(line + "\r")
        at = robot.expect("\r\n] ", robot.expect("Ended", at))


@pytest.mark.parametrize(
    "adapter",
    [(), ("--latency", 4, "--jitter", 2), ("--latency", 1, "--echo"), ("--latency", 16, "--jitter", 4, "--echo")],
    ids=lambda words: "_".join(map(str, words)).replace("--", "") or "good",
)
def test_frames_are_those_of_the_board_and_no_servo_is_lost(make, files, of_the_board, adapter):
    robot = make(motions=files, adapter=adapter).run()
    play(robot)
    assert b"does not answer" not in robot.console
    assert "No servo has a fault" in robot.ask("faults")
    assert distinct(robot.frames()) == of_the_board, robot.console.decode()
