# SPDX-License-Identifier: MIT
"""Editing commands that make, move, exchange and copy steps, and UNDO. The tests derive the 512 bytes from edit/ORIGINAL.md and
firmware/edit/DIFFERENCES.md."""

import pytest

from tests.sim.edit_base import BASE, FULL, PAGES, bytes_of, opened, step
from tests.sim.edit_robot import UNUSED, changed, robot, seal, word

# ---- steps ----


def time_at(k):
    return 64 + 64 * k + 63


def test_step_sets_the_count(r):
    r.line("step 2")
    assert bytes_of(r) == changed(BASE, {20: 2})
    r.line("s 0")
    assert bytes_of(r) == changed(BASE, {20: 0})


@pytest.mark.parametrize("how", ["step", "set", "key"])
def test_a_step_that_comes_into_use_has_time_for_its_move(r, how):
    """Unused steps of a file have time 0 (PAGE_FORMAT.md), which the player takes as one tick. Times that somebody has set stay."""
    r.line("goto 2 32")
    r.line("set 0")
    if how == "step":
        r.line("step 5")
    else:
        r.line("goto 9 9")
        assert r.cell(9, 9) == "003"
        r.line("set 5") if how == "set" else r.keys("]]")
    assert bytes_of(r) == changed(BASE, {time_at(1): 0, 20: 5, time_at(3): 64, time_at(4): 64})
    r.line("undo")
    r.line("undo" if how == "key" else "re")
    assert bytes_of(r) == changed(BASE, {time_at(1): 0})


def test_steps_that_are_shifted_or_pasted_keep_a_time_of_0(r):
    r.line("goto 3 32")
    r.line("set 0")
    r.line("insert 0")
    assert bytes_of(r)[time_at(3)] == 0
    r.line("take 3")
    assert r.line("paste") == "paste"
    data = bytes_of(r)
    assert data[20] == 5 and data[time_at(3)] == data[time_at(4)] == 0


def test_go_to_an_unused_step_leaves_the_work_pose_its_time(r):
    r.line("on")
    before = r.cell(0, 32)
    r.line("go 5")
    r.keys("y")
    assert r.cell(0, 32) == before != "000"
    r.line("off")


def pose_step(r):
    """The work pose as on the screen, as 64 bytes of a stored step (???? is stored as unused)."""
    data = bytearray()
    for y in range(31):
        text = r.cell(0, y)
        if text == "????":
            live = r.text(y + 1, 14, 4)
            value = UNUSED | (int(live) if live.isdigit() else 0)
        else:
            value = UNUSED if text == "----" else int(text)
        data += bytes([value & 0xFF, value >> 8])
    return bytes(data) + bytes([int(r.cell(0, 31)), int(r.cell(0, 32))])


def stored(data, changes):
    data = bytearray(data)
    for k, content in changes.items():
        data[64 + 64 * k : 128 + 64 * k] = content
    return data


def test_write_appends_the_work_pose(r):
    r.line("on")
    pose = pose_step(r)
    r.line("write")
    data = stored(BASE.data, {3: pose})
    data[20] = 4
    assert bytes_of(r) == seal(data)
    r.line("step 7")
    assert r.line("w") == "w No room: 7 steps at most"
    r.line("off")


@pytest.mark.parametrize("line, step", [("write", 3), ("write 1", 1), ("insert 1", 1)])
def test_joints_that_are_not_there_are_not_written(r, line, step):
    """Whatever the work pose shows for them: here ????, by the space bar. So an ordinary SAVE reports nothing."""
    r.line("on")
    for y in (0, 19, 30):
        r.line(f"goto 0 {y}")
        if r.cell(0, y) != "????":
            r.keys(" ")
        assert r.cell(0, y) == "????"
    r.line(line)
    assert r.message == line and [r.cell(step + 1, y) for y in (0, 19, 30)] == ["----"] * 3
    saved = r.line("save 126")
    if "[y/N]" in saved:
        r.keys("y")
    assert "????" not in r.message, r.message
    assert [word(r.flash_page(126), step, y) for y in (0, 19, 30)] == [UNUSED] * 3
    for y in (0, 19, 30):
        r.line(f"goto 0 {y}")
        r.keys(" ")
    r.line("off")


def test_write_n_does_not_count(r):
    r.line("on")
    pose = pose_step(r)
    r.line("w 6")
    assert bytes_of(r) == seal(stored(BASE.data, {6: pose}))
    r.line("off")


def test_insert_moves_up_and_the_last_step_falls_out(r):
    r.line("page 3")
    r.line("on")
    pose = pose_step(r)
    assert r.line("insert 2").startswith("insert 2 Step 6 fell out")
    full = FULL.data
    assert bytes_of(r) == seal(stored(full, {2: pose, **{k: step(full, k - 1) for k in range(3, 7)}}))
    r.line("undo")  # undoes the change of ???? by SAVE
    r.line("undo")
    assert bytes_of(r) == bytes(full)
    r.line("page 1")
    r.line("i 1")
    data = stored(BASE.data, {1: pose, **{k: step(BASE.data, k - 1) for k in range(2, 7)}})
    data[20] = 4
    assert bytes_of(r) == seal(data)
    r.line("off")


def test_delete(r):
    r.line("page 3")
    r.line("delete 2")
    data = stored(FULL.data, {k: step(FULL.data, k + 1) for k in range(2, 6)})
    data[20] = 6
    assert bytes_of(r) == seal(data)
    r.line("undo")
    r.line("d 6")
    assert bytes_of(r) == changed(FULL, {20: 6})
    r.line("d")
    assert bytes_of(r) == changed(FULL, {20: 5})
    r.line("step 0")
    assert r.line("d") == "d There is no step"


def test_move_copies(r):
    r.line("on")
    assert r.line("move 0 4") == "move 0 4:000->004"
    assert bytes_of(r) == seal(stored(BASE.data, {4: step(BASE.data, 0)}))
    assert r.line("move 1 7").startswith("move 1 7:001->007")
    assert r.cell(0, 3) == "0300" and r.cell(0, 32) == "050"
    r.line("off")


def test_swap(r):
    r.line("swap 0 2")
    assert bytes_of(r) == seal(stored(BASE.data, {0: step(BASE.data, 2), 2: step(BASE.data, 0)}))
    r.line("undo")
    assert bytes_of(r) == bytes(BASE.data)


def test_take_and_paste_between_pages(r):
    r.line("page 3")
    r.line("take 1 2")
    r.line("page 1")
    r.line("paste")
    data = stored(BASE.data, {3: step(FULL.data, 1), 4: step(FULL.data, 2)})
    data[20] = 5
    assert bytes_of(r) == seal(data)
    r.line("paste 0")
    data = stored(data, {0: step(FULL.data, 1), 1: step(FULL.data, 2)})
    assert bytes_of(r) == seal(data)
    assert r.line("paste 6") == "paste 6 No room: 7 steps at most"


def test_paste_leaves_no_empty_steps_before_the_pasted_ones(r):
    r.line("take 0")
    before = bytes_of(r)
    assert before[20] == 3 and r.line("paste 4") == "paste 4 That step is not used"
    assert bytes_of(r) == before
    r.line("paste 3")
    assert bytes_of(r)[20] == 4


def test_paste_within_a_page_reads_before_it_writes(r):
    r.line("take 0 2")
    r.line("paste 1")
    data = stored(BASE.data, {k + 1: step(BASE.data, k) for k in range(3)})
    data[20] = 4
    assert bytes_of(r) == seal(data)
    r.line("undo")
    r.line("take 1 2")
    r.line("paste 0")
    assert bytes_of(r) == seal(stored(BASE.data, {k: step(BASE.data, k + 1) for k in range(2)}))


CHANGED = "paste 0 Nothing noted, or changed: TAKE first"


@pytest.fixture
def own():
    """A robot for itself, because the test saves."""
    with robot(pages=PAGES) as made:
        yield opened(made)


def say(r, line):
    """Types the line and a yes to its question. The message."""
    message = r.line(line)
    if "[y/N]" in r.command:
        r.keys("y")
    return message


@pytest.mark.parametrize("edit", ["delete 1", "swap 0 1", "new", "goto 2 4; set 333", "copy 3"])
@pytest.mark.parametrize("saved", [True, False])
def test_paste_refuses_noted_steps_that_have_changed(own, edit, saved):
    own.line("take 1 2")
    for line in [*edit.split("; "), *(["save"] if saved else [])]:
        say(own, line)
    assert own.line("paste 0") == CHANGED
    say(own, "page 2")  # without a save the stored page still has the noted steps
    assert own.line("paste 0") == (CHANGED if saved else "paste 0")


def test_paste_takes_the_noted_steps_again_when_they_are_as_they_were(own):
    own.line("take 0 1")
    own.line("delete 0")
    assert own.line("paste 0") == CHANGED
    own.line("undo")
    assert own.line("paste") == "paste" and own.line("paste") == "paste"  # behind them: they are the same after it
    data = stored(BASE.data, {3: step(BASE.data, 0), 4: step(BASE.data, 1), 5: step(BASE.data, 0), 6: step(BASE.data, 1)})
    data[20] = 7
    assert bytes_of(own) == seal(data)


def test_paste_refuses_noted_steps_that_were_never_saved(own):
    own.line("goto 1 3")
    own.line("set 700")
    assert own.line("take 0") == "take 0 Noted for PASTE (save it first)"
    say(own, "page 3")
    assert own.line("paste 0") == CHANGED
    assert own.line("take 0") == "take 0 Noted for PASTE" and own.line("paste 1") == "paste 1"


def test_paste_refuses_noted_steps_whose_torque_marks_a_save_has_removed(own):
    own.line("off")
    own.line("write")
    assert own.cell(4, 3) == "????"
    assert own.line("take 3") == "take 3 Noted for PASTE (save it first)"
    own.line("save")
    assert own.cell(4, 3) == "----" and own.line("paste 0") == CHANGED
    own.line("take 3")
    assert own.line("paste 0") == "paste 0" and own.cell(1, 3) == "----"
