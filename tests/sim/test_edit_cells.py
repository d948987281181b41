# SPDX-License-Identifier: MIT
"""Editing one cell: SET, the keys that change a value, Space, arrows; edit/ORIGINAL.md sections 4 and 5."""

import pytest

from tests.sim.edit_base import BASE, bytes_of
from tests.sim.edit_robot import UNUSED, changed, word

# ---- cells ----

COLUMNS = [20, 26, 31, 36, 41, 46, 51, 56, 61, 77]  # of the cursor, ORIGINAL.md section 3


@pytest.mark.parametrize(
    "x, y, value, address",
    [
        (1, 5, 1023, 64 + 10),
        (7, 30, 0, 64 * 7 + 60),
        (4, 31, 255, 64 * 4 + 62),
        (4, 32, 1, 64 * 4 + 63),
        (8, 0, 0x77, 32),
        (8, 30, 0x11, 62),
        (9, 3, 9, 14),
        (9, 4, 0, 15),
        (9, 9, 2, 20),
        (9, 10, 255, 21),
        (9, 11, 64, 22),
        (9, 14, 127, 25),
        (9, 19, 200, 30),
    ],
)
def test_set_writes_the_cell(r, x, y, value, address):
    r.line(f"goto {x} {y}")
    assert r.xya == (f"{x:02d}", f"{y:02d}", f"{address:04d}") and r.cursor == (y + 1, COLUMNS[x] + (y > 30))
    r.line(f"set {value}")
    changes = {address: value & 0xFF}
    if x in range(1, 8) and y <= 30:
        changes[address + 1] = value >> 8
    assert bytes_of(r) == changed(BASE, changes)
    assert int(r.cell(x, y)) == value


@pytest.mark.parametrize(
    "x, y, wrong, message",
    [
        (4, 31, 256, "Value must be 0..255"),
        (8, 0, 1023, "Value must be 0..255"),
        (9, 9, 8, "Page Step must be 0..7"),
        (9, 6, 200, "Link must be 0..127"),
        (9, 7, 128, "Link must be 0..127"),
        (9, 14, 128, "Link must be 0..127"),
        (9, 16, 200, "Link must be 0..127"),
    ],
)
def test_set_refuses_what_the_cell_cannot_hold(r, x, y, wrong, message):
    r.line(f"goto {x} {y}")
    assert r.line(f"set {wrong}") == f"set {wrong} {message}"
    assert bytes_of(r) == bytes(BASE.data)


@pytest.mark.parametrize("keys, expected", [("]", 481), ("[", 479), ("}", 490), ("{", 470), ("}}]]", 502)])
def test_keys_change_positions(r, keys, expected):
    r.line("goto 1 1")
    r.keys(keys)
    assert r.cell(1, 1) == f"{expected:04d}" and r.unsaved
    assert bytes_of(r) == changed(BASE, {66: expected & 0xFF, 67: expected >> 8})


def test_keys_do_not_leave_the_range_and_bytes_wrap(r):
    r.line("goto 1 1")
    r.line("set 1020")
    r.keys("}")
    assert r.cell(1, 1) == "1020"
    r.line("set 3")
    r.keys("{")
    assert r.cell(1, 1) == "0003"
    r.line("goto 1 31")
    r.keys("[[[[")
    assert r.cell(1, 31) == "255"
    r.keys("]")
    assert r.cell(1, 31) == "000"
    r.line("goto 9 9")
    r.keys("}")
    assert r.cell(9, 9) == "007"
    r.keys("{")
    assert r.cell(9, 9) == "000"


def test_space_marks_torque_off_and_back(r):
    r.line("goto 1 1")
    r.keys(" ", ms=200)
    assert r.cell(1, 1) == "????"
    r.keys("]")
    assert r.cell(1, 1) == "????"
    r.keys(" ")
    assert r.cell(1, 1) == "0480" and not r.unsaved
    r.line("goto 1 0")
    r.keys("]")
    assert r.cell(1, 0) == "----"
    r.keys(" ", ms=200)
    assert r.cell(1, 0) == "????"
    r.keys(" ")
    assert r.cell(1, 0) == "----"
    r.line("goto 8 0")
    r.keys(" ")
    assert not r.unsaved


def test_torque_off_marks_are_saved_as_unused(r):
    r.line("goto 1 1")
    r.keys(" ")
    data = changed(BASE, {67: 0x41})
    assert word(data, 0, 1) == UNUSED | 480
    assert bytes_of(r) == data and r.cell(1, 1) == "----"


def test_home_end_and_pages_of_rows_move_the_cursor_far(r):
    r.line("goto 3 10")
    for keys, xy in (
        ("\x1b[F", ("09", "10")),
        ("\x1b[H", ("00", "10")),
        ("\x1b[6~", ("00", "18")),
        ("\x1b[6~\x1b[6~", ("00", "32")),
        ("\x1b[4~", ("07", "32")),  # the row of speeds has no softness cell
        ("\x1b[5~", ("07", "24")),
        ("\x1b[5~\x1b[5~\x1b[5~\x1b[1~", ("00", "00")),
    ):
        r.keys(keys)
        assert r.xya[:2] == xy, keys


def test_arrows_move_as_the_original_does(r):
    r.line("goto 9 3")
    for keys, xy in (
        ("\x1b[A", ("08", "02")),
        ("\x1b[C", ("08", "02")),
        ("\x1b[B", ("08", "03")),
        ("\x1b[C", ("09", "03")),
        ("\x1b[D", ("08", "03")),
        ("\x1bOB", ("08", "04")),
    ):
        r.keys(keys)
        assert r.xya[:2] == xy
    r.line("goto 8 30")
    r.keys("\x1b[B")
    assert r.xya == ("07", "31", "0510")
    r.line("goto 0 0")
    r.keys("\x1b[D\x1b[A")
    assert r.xya == ("00", "00", "0512") and r.cursor == (1, 20)
