# SPDX-License-Identifier: MIT
"""The motion library (tools/motions) on the shipped Play image: pages of every kind to their end, and a walk driven by the remote.
tools/motions/test_motions.py checks the pages alone; tests/models/test_library_speeds.py plays every page."""

import os
import pathlib
import re

import pytest

from m512.files.image import from_bytes
from m512.motion.speed import no_load_units_per_tick
from tests.sim.play_robot import DOWN, JOINTS, LEFT, RIGHT, STOP, UP, ask, robot

MOTIONS = (pathlib.Path(os.environ["M512_BUILD"]) / "motions" / "motions.bin").read_bytes()
LIBRARY = from_bytes(MOTIONS)
WALK_JOINT = 11
PAGES = {number: page for number, page in LIBRARY.items() if number and page.is_playable and page.word(0, WALK_JOINT) < 1024}  # no layers
NUMBER = {page.title: number for number, page in PAGES.items()}
TICK_CYCLES = 125_000
MOST_UNITS_PER_TICK = 0.9 * no_load_units_per_tick(11.1) + 1  # goals are whole units


@pytest.fixture(scope="module")
def library():
    """One robot for all pages."""
    return robot(pages=MOTIONS)


def last_pose(page):
    return {joint: page.word(page.steps - 1, joint) for joint in JOINTS}


def fastest(trace):
    """Units per tick of the fastest joint between any two frames, with the ticks between them taken into account."""
    most = 0.0
    for before, after in zip(trace, trace[1:]):
        ticks = max(1, round((after.cycle - before.cycle) / TICK_CYCLES))
        most = max([most] + [abs(after.goals[j] - before.goals[j]) / ticks for j in after.goals if j in before.goals])
    return most


LEFT_ALONE = {"get_up": {1, 2}}  # its first steps do not use them


def get_ready(board):
    """Plays `ready`, unless the robot stands in its last pose already."""
    if any(board.servos[joint].goal != target for joint, target in last_pose(PAGES[NUMBER["ready"]]).items()):
        assert ask(board, "play ready").endswith("OK")
        board.expect("Ended", ms=8000)
    board.clear_trace()


@pytest.mark.parametrize("name", ["ready", "bow", "clap", "sit", "get_up", "walk", "side_r", "kick_r", "dance"])
def test_page_plays_to_its_end(library, name):
    """Started by name; a page with a next link is stopped and ends through its exit page. The robot must stand in the pose of the last
    page, every joint must be driven, none faster than it can move, and the servos must have followed."""
    board, page = library, PAGES[NUMBER[name]]
    get_ready(board)
    assert ask(board, f"play {name}").endswith("OK")
    text = board.expect(f"Page {NUMBER[name]} step {page.steps}" if page.steps > 1 else "step 1", ms=20_000)
    if page.next:
        ask(board, "stop")
        text += board.expect("Stopped after page ", ms=20_000)
    else:
        text += board.expect("Ended after page ", ms=12_000)
    board.run(ms=100)
    final = PAGES[int(board.take().split()[0])]
    assert "damaged" not in text and "fault" not in text.lower()
    for joint, target in last_pose(final).items():
        assert board.servos[joint].goal == target, joint
        assert abs(board.servos[joint].present - board.servos[joint].goal) <= 3, joint
    driven = set(JOINTS) - LEFT_ALONE.get(name, set())
    assert all(driven <= set(frame.goals) <= set(JOINTS) for frame in board.trace)
    assert fastest(board.trace) <= MOST_UNITS_PER_TICK


def drive(board, value, until, ms=6000):
    """Holds buttons until the status lines name a page, then releases them. Returns the pages played until then."""
    board.rc(value)
    text = board.expect(f"({until}) step 1", ms=ms)
    board.rc(0)
    return re.findall(r"Playing page \d+ (\(\w+\)) step 1", text)


def test_remote_drives_a_walk():
    """Start, left, straight on, right, stop; then back, and forward while going back is a stop."""
    board = robot(pages=MOTIONS)
    ask(board, "play ready")
    board.expect("Ended", ms=6000)
    board.clear_trace()
    assert drive(board, UP, "walk_l") == ["(walk)", "(walk_r)", "(walk_l)"]
    assert drive(board, LEFT, "turn_l") == ["(walk_r)", "(turn_l)"]
    assert drive(board, LEFT, "turn_l") == ["(turn_l2)", "(turn_l)"]  # keeps turning
    assert drive(board, UP, "walk_l") == ["(walk_r)", "(walk_l)"]
    assert drive(board, RIGHT, "turn_r") == ["(turn_r)"]
    assert drive(board, LEFT, "turn_l") == ["(walk_l)", "(walk_r)", "(turn_l)"]  # through the walk
    assert drive(board, UP, "walk_r") == ["(walk_r)"]
    board.rc(STOP)
    board.expect("Stopped after page 26 (end_l)", ms=5000)
    board.rc(0)
    assert drive(board, DOWN, "back_l") == ["(back)", "(back_r)", "(back_l)"]
    board.rc(UP)
    board.expect("Ended after page 30 (back_end_r)", ms=5000)
    board.run(ms=100)
    assert {joint: board.servos[joint].goal for joint in JOINTS} == last_pose(PAGES[NUMBER["ready"]])
    assert fastest(board.trace) <= MOST_UNITS_PER_TICK


def test_every_code_calls_its_page():
    """From the remote, robot at rest; buttons 1, 2, 3, 4 of the remote are 16, 32, 64, 128."""
    board = robot(pages=MOTIONS)
    for number, page in PAGES.items():
        if page.code:
            board.rc(page.code)
            board.expect(f"Playing page {number} ({page.title})", ms=4000)
            board.rc(0)
            ask(board, "break")
            board.run(ms=1500)
            board.take()
