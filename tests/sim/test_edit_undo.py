# SPDX-License-Identifier: MIT
"""UNDO and REDO of at least the last eight editing commands, including commands that change the whole page."""

import random

import pytest

from tests.sim.edit_base import opened
from tests.sim.edit_robot import JOINTS, page


def big(seed, joints):
    rng = random.Random(seed)
    return page(
        f"big {seed}",
        [(rng.randrange(1, 256), {joint: rng.randrange(1024) for joint in joints}, rng.randrange(256)) for _ in range(7)],
        joints=joints,
        code=seed,
        repeat=seed,
        speed=30 + seed,
    )


PAGES = {1: big(1, range(31)), 2: big(2, range(31)), 3: page("three", [(40, {1: 480}), (50, {2: 300})]), 4: big(4, JOINTS), 5: big(5, JOINTS)}
PAGES[6] = page("three", [(40, {1: 481}), (50, {2: 300})])


@pytest.fixture
def r(shared):
    shared.keys("\x03")
    opened(shared).page_address()
    return shared


def ram_page(r):
    """The 512 bytes in RAM without byte 31, which SAVE sets."""
    at = r.page_address()
    data = bytearray(r.board.ram[at : at + 512])
    data[31] = 0
    return bytes(data)


def edit(r, *lines):
    for line in lines:
        r.line(line)
        if "[y/N]" in r.command:
            r.keys("y")
        assert "cannot be undone" not in r.command, line


@pytest.mark.parametrize("saved", [True, False])
@pytest.mark.parametrize("command", ["new", "copy 2", "copy 3", "insert 3", "paste 0", "swap 0 6"])
def test_a_whole_page_of_31_joints_and_7_steps_comes_back(r, command, saved):
    """UNDO restores it with its unsaved edits; REDO applies the command again."""
    if command == "paste 0":
        edit(r, "page 2", "take 0 6", "page 1")
    if not saved:
        edit(r, "goto 3 17", f"set {(PAGES[1].word(2, 17) + 100) % 1024}", "goto 9 10", "set 99")
    before = ram_page(r)
    edit(r, command)
    after = ram_page(r)
    assert after != before and r.unsaved
    edit(r, "undo")
    assert ram_page(r) == before and r.unsaved == (not saved)
    edit(r, "redo")
    assert ram_page(r) == after
    edit(r, "undo")
    assert ram_page(r) == before


def test_what_a_play_has_overwritten_is_not_brought_back_as_rubbish(r):
    """The snapshot of a whole page is in the memory of the idle player."""
    edit(r, "goto 3 17", "set 999", "new")
    empty = ram_page(r)
    r.line("play 3", ms=3000)
    assert r.message == "Page 3 step 1 repetition 1 OK"
    assert r.line("undo").endswith("Nothing to undo") and ram_page(r) == empty


def test_a_save_between_changes_nothing(r):
    before = ram_page(r)
    edit(r, "goto 3 17", "set 999", "undo", "new", "save 9")
    edit(r, "undo")
    assert ram_page(r) == before


def test_the_last_eight_commands_come_back_one_by_one(r):
    r.line("page 3")
    r.line("on")
    states = [ram_page(r)]
    for line in ("write", "insert 0", "delete 1", "insert 1", "speed", "move 1 4", "swap 0 2", "name x", "write 6", "step 2"):
        edit(r, line)
        states.append(ram_page(r))
        assert states[-1] != states[-2], line
    undone = 0
    while "Nothing" not in r.line("undo"):
        undone += 1
        assert ram_page(r) == states[-1 - undone]
    assert undone >= 8
    for state in states[len(states) - undone :]:
        r.line("redo")
        assert ram_page(r) == state
    assert r.line("redo").endswith("Nothing to redo")
    r.line("off")


NOTHING = ["swap 2 2", "swap 0 1", "move 2 2", "step 7", "name twice", "set 5", "time", "write 6", "insert 6", "insert 4", "paste 1", "paste 2"]


@pytest.mark.parametrize("nothing", NOTHING)
def test_an_edit_that_changes_nothing_says_so_and_keeps_undo_and_redo(r, nothing):
    """Steps 0 and 1 are equal, steps 4 to 6 are the pose of the robot."""
    edit(r, "page 4", "on", "move 0 1", "write 4", "write 5", "write 6", "name twice", "goto 9 4", "set 5")
    if nothing.startswith("paste"):
        edit(r, "save", f"take {nothing[-1]}", "set 6", "set 5")
    before = ram_page(r)
    edit(r, "set 6", "undo")
    assert r.line(nothing).endswith(" No change")
    assert ram_page(r) == before
    edit(r, "redo")
    assert ram_page(r) != before
    edit(r, "undo", nothing, "redo", "undo", "undo")
    assert ram_page(r) != before
    edit(r, "redo")
    assert ram_page(r) == before
    r.line("off")


@pytest.mark.parametrize("nothing", ["new", "copy 9"])
def test_a_whole_page_that_is_the_same_already_is_no_edit(r, nothing):
    edit(r, "page 8", nothing, "save", "step 3", "undo")
    r.line(nothing)
    if "[y/N]" in r.command:
        r.keys("y")
    assert r.command.endswith("No change") and not r.unsaved
    edit(r, "redo")
    assert r.unsaved


def test_a_joint_that_is_not_there_does_not_make_an_edit_of_a_write(r):
    """A ???? of an absent joint is stored as not used, which it is already."""
    edit(r, "page 4", "on", "goto 0 20", "write 6", "name some", "undo")
    r.keys(" ")
    assert r.cell(0, 20) == "????" and r.cell(7, 20) == "----"
    assert r.line("write 6") == "write 6 No change"
    edit(r, "redo")
    assert r.line("redo").endswith("Nothing to redo")
    r.keys(" ")
    r.line("off")


@pytest.mark.parametrize("lines", [["new"], ["new", "undo"], ["new", "play 3"], ["new", "undo", "play 3"]])
def test_what_a_program_has_written_stays(r, lines):
    """PROTOCOL.md: UNDO does not undo edits made with @data, nor those before them. The spare page is dropped as well."""
    edit(r, *lines)
    if "play" in lines[-1]:
        r.keys("", ms=3000)
    r.line("@data 0 50524F4700", ms=300)
    after = ram_page(r)
    assert after[:5] == b"PROG\0"
    r.line("re", ms=1500)
    for word in ("undo", "redo"):
        assert r.line(word).endswith(f"Nothing to {word}") and ram_page(r) == after


def test_a_new_edit_ends_what_could_be_redone(r):
    edit(r, "goto 1 1", "set 5", "set 6", "undo", "set 7")
    assert r.line("redo").endswith("Nothing to redo")
    edit(r, "undo")
    assert r.cell(1, 1) == "0005"


def test_failed_commands_and_page_changes(r):
    edit(r, "goto 1 1", "set 5")
    for line in ("set 1024", "foo", "write 9", "copy 999", "page"):
        r.line(line)
    edit(r, "undo")
    assert not r.unsaved
    for numbers in ((1, 2), (3, 6)):  # pages that differ in all cells, and in one
        edit(r, f"page {numbers[0]}", "goto 1 1", "set 5", "set 6", f"page {numbers[1]}")
        before = ram_page(r)
        assert r.line("undo").endswith("Nothing to undo") and ram_page(r) == before  # the history belongs to the open page


def test_undo_keeps_cursor_and_work_pose(r):
    r.line("goto 0 3")
    r.line("off 3")
    r.keys(" ")
    pose = [r.cell(0, y) for y in range(1, 19)]
    edit(r, "goto 2 5", "set 5", "swap 0 1", "undo", "undo")
    assert r.xya[:2] == ("02", "05") and [r.cell(0, y) for y in range(1, 19)] == pose
