# SPDX-License-Identifier: MIT
"""Every editing command, key, error and question of editor-original.md sections 4 to 6: the message, the screen, and the
512 bytes, worked out here from the specification. Intended differences: firmware/edit/DIFFERENCES.md."""
import pytest

from edit_robot import changed, new_page, page, robot, seal, word, UNUSED

BASE = page("base", [(40, {1: 480, 2: 544}, 3), (50, {3: 300}), (60, {4: 10})], code=7, next=3)
OTHER = page("other", [(11, {1: 900}), (22, {2: 100})])
FULL = page("full", [(10 + k, {1: 100 * k}) for k in range(7)])
PAGES = {1: BASE, 2: OTHER, 3: FULL}


@pytest.fixture(scope="module")
def shared():
    """One robot for all tests that leave the flash as it was; each begins with page 1 from flash at X1 Y0."""
    with robot(pages=PAGES) as r:
        yield r


@pytest.fixture
def r(shared):
    shared.line("page 1")
    if "[y/N]" in shared.command:
        shared.keys("y")
    shared.line("goto 1 0")
    return shared


def bytes_of(r):
    """The page in RAM, as a program reads it: saved to page 127 and read from flash, sealed by SAVE."""
    r.line("save 127")
    if "[y/N]" in r.command:
        r.keys("y")
    assert "OK" in r.message, r.message
    return r.flash_page(127)


def step(data, k):
    return bytes(data[64 + 64 * k:128 + 64 * k])


# ---- messages ----

@pytest.mark.parametrize("line, message", [
    ("foo", "Bad Command"), ("pag 1", "Bad Command"), ("dump", "Bad Command"), ("led 1", "Bad Command"),
    ("page", "Invalid Parameter"), ("page 1 2", "Invalid Parameter"), ("p", "Invalid Parameter"),
    ("page 128", "Page must be 0..127"), ("page -5", "Page must be 0..127"), ("page x", "Page must be 0..127"),
    ("page 65536", "Page must be 0..127"), ("page 0b1", "Page must be 0..127"), ("copy", "Invalid Parameter"),
    ("copy 200", "Page must be 0..127"), ("step", "Invalid Parameter"), ("s 8", "Step must be 0..7"),
    ("go 7", "Step must be 0..6"), ("go", "Invalid Parameter"), ("write 7", "Step must be 0..6"),
    ("insert", "Invalid Parameter"), ("i 7", "Step must be 0..6"), ("delete 7", "Step must be 0..6"),
    ("move 1", "Invalid Parameter"), ("move 8 1", "Step must be 0..7"), ("mirror 7", "Step must be 0..6"),
    ("mirror", "Invalid Parameter"), ("swap 1 7", "Step must be 0..6"), ("set", "Invalid Parameter"),
    ("set 1024", "Position must be 0..1023"), ("set a", "Position must be 0..1023"), ("goto 1", "Invalid Parameter"),
    ("goto 10 0", "X must be 0..9"), ("goto 0 33", "Y must be 0..32"), ("goto 9 0", "There is no cell"),
    ("goto 8 31", "There is no cell"), ("on 31", "ID must be 0..30"), ("off 254", "ID must be 0..30"),
    ("on 25", "Not there: ID 25"), ("play 0", "Page must be 1..127"), ("play 200", "Page must be 1..127"),
    ("save 128", "Page must be 0..127"), ("undo", "Nothing to undo"), ("redo", "Nothing to redo"),
    ("scale 5", "Percent must be 10..1000"), ("int 0 6", "That step is not used"), ("paste", "Nothing noted: TAKE first"),
    ("help foo", "No such command: HELP"), ("take 3 1", "The first step comes first"), ("rows 10", "Rows must be 24..255"),
])
def test_errors_say_what_is_wrong(r, line, message):
    assert r.line(line) == f"{line} {message}"
    assert bytes_of(r) == bytes(BASE.data)


@pytest.mark.parametrize("line", ["PAGE 2", "page 2", "P 2", "p,2", "p:2", "p;2", "p.2", "p  2", "page 0x2"])
def test_case_separators_and_abbreviation(r, line):
    assert r.line(line) == line
    assert r.text(2, 76, 4) == "0002" and r.text(1, 65, 5) == "other"


# ---- pages ----

def test_next_and_before(r):
    r.line("next")
    assert r.text(2, 76, 4) == "0002" and r.text(3, 65, 13) == "Addr:0000E400"
    r.line("b")
    assert r.text(2, 76, 4) == "0001"
    r.line("before")
    assert r.text(2, 76, 4) == "0000"
    assert r.line("b") == "b Page must be 0..127"
    r.line("page 127")
    assert r.line("n") == "n Page must be 0..127"


@pytest.mark.parametrize("command", ["page 2", "next", "before", "copy 2", "exit"])
@pytest.mark.parametrize("answer", ["n", "\r", " ", "\x1b[A"])
def test_unsaved_edits_are_asked_for_and_kept_with_any_key_but_y(r, command, answer):
    r.line("set 77")
    assert r.unsaved
    r.line(command, answer)
    assert r.command == f"] {command} The edits would be lost. Are you sure?[y/N] no"
    assert r.text(2, 76, 4) == "0001" and r.cell(1, 0) == "0077" and r.unsaved


def test_page_change_with_y_drops_edits(r):
    r.line("set 77")
    r.line("page 2", "Y")
    assert r.text(2, 76, 4) == "0002" and not r.unsaved
    r.line("page 1")
    assert r.cell(1, 0) == "----"


def test_two_pages_of_one_name_are_told():
    """`play base` of Play would not know which."""
    with robot(pages=PAGES) as r:
        assert r.line("copy 2") == "copy 2 Page 2 has this name too"
        assert r.line("save") == "save OK Page 2 has this name too"
        r.line("name Third")
        assert r.line("save") == "save OK"
        assert r.line("save 5") == "save 5 OK Page 1 has this name too"
        assert r.line("copy 1") == "copy 1 Page 5 has this name too"
        r.line("name")
        r.line(" ")   # no name at all
        assert r.line("save") == "save OK" and r.line("save 6") == "save 6 OK"


def test_copy_takes_a_flash_page_into_this_one(r):
    r.line("copy 2")
    assert r.text(2, 76, 4) == "0001" and r.text(1, 65, 5) == "other" and r.unsaved
    assert bytes_of(r) == bytes(OTHER.data)
    r.line("undo")
    assert bytes_of(r) == bytes(BASE.data) and not r.unsaved


def test_new_always_asks_and_makes_the_new_page(r):
    r.line("new", "n")
    assert bytes_of(r) == bytes(BASE.data)
    r.line("new", "y")
    assert bytes_of(r) == seal(new_page())
    r.line("undo")
    assert bytes_of(r) == bytes(BASE.data)


def test_name_is_asked_for_and_padded_with_zeros(r):
    r.line("name")
    assert r.message == "name name:"
    r.line("walk 2")
    assert r.text(1, 65, 14) == "walk 2".ljust(14)
    assert bytes_of(r)[:14] == b"walk 2".ljust(14, b"\0")
    r.line("name")
    r.line("1234567890123")
    assert bytes_of(r)[:14] == b"1234567890123\0"
    for kept in ("12345678901234", ""):
        r.line("name")
        r.line(kept)
        assert "ame kept" in r.message and bytes_of(r)[:14] == b"1234567890123\0"
    r.line("name")
    r.line(" ")
    assert bytes_of(r)[:14] == bytes(14) and r.text(1, 65, 14).strip() == ""


def test_time_and_speed_count_as_edits_and_change_the_label(r):
    assert "Time( x 7.8mSec)" in r.terminal.row(33)
    r.line("speed")
    assert r.terminal.row(33).startswith("   Speed           [") and r.unsaved and bytes_of(r)[16] == 0
    r.line("time")
    assert "Time( x 7.8mSec)" in r.terminal.row(33) and not r.unsaved and bytes_of(r)[16] == 10


# ---- steps ----

def test_step_sets_the_count(r):
    r.line("step 5")
    assert bytes_of(r) == changed(BASE, {20: 5})
    r.line("s 0")
    assert bytes_of(r) == changed(BASE, {20: 0})


def pose_step(r):
    """The work pose as the screen shows it, as 64 bytes of a stored step (???? is stored as unused)."""
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
        data[64 + 64 * k:128 + 64 * k] = content
    return data


def test_write_appends_the_work_pose(r):
    r.line("on")
    pose = pose_step(r)
    r.line("write")
    data = stored(BASE.data, {3: pose})
    data[20] = 4
    assert bytes_of(r) == seal(data)
    r.line("step 7")
    assert r.line("w") == "w All 7 steps are used"
    r.line("off")


@pytest.mark.parametrize("line, step", [("write", 3), ("write 1", 1), ("insert 1", 1)])
def test_joints_that_are_not_there_are_not_written(r, line, step):
    """Whatever the work pose shows for them: here ????, by the space bar. So an ordinary SAVE has nothing to say."""
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
    r.line("undo")   # what SAVE made of ????
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


def between(made, a, b, percent):
    """The 64 bytes of step a with each joint `percent` of the way to step b, no pause, time 0."""
    data = bytearray(step(made.data, a))
    for joint in range(1, 19):
        first, second = made.word(a, joint), made.word(b, joint)
        value = first + int(abs(second - first) * percent / 100 + 0.5) * (1 if second > first else -1)
        data[2 * joint:2 * joint + 2] = value.to_bytes(2, "little")
    data[62:64] = b"\0\0"
    return data


def test_int_makes_a_step_between_two_and_the_page_takes_as_long_as_before(r):
    r.line("int 0 1 34")
    data = stored(BASE.data, {1: between(BASE, 0, 1, 34), **{k: step(BASE.data, k - 1) for k in range(2, 7)}})
    data[20], data[64 + 64 + 63], data[64 + 128 + 63] = 4, 17, 33   # of 50: a third of the way, a third of the time
    assert bytes_of(r) == seal(data)
    r.line("undo")
    assert bytes_of(r) == bytes(BASE.data)


def test_int_between_steps_that_do_not_follow_each_other_takes_the_time_of_the_second(r):
    r.line("int 0 2")
    data = stored(BASE.data, {1: between(BASE, 0, 2, 50), **{k: step(BASE.data, k - 1) for k in range(2, 7)}})
    data[20], data[64 + 64 + 63] = 4, 60
    assert bytes_of(r) == seal(data)
    r.line("undo")
    r.line("speed")   # a speed is the same on both halves of a way
    r.line("int 0 1")
    data = stored(BASE.data, {1: between(BASE, 0, 1, 50), **{k: step(BASE.data, k - 1) for k in range(2, 7)}})
    data[16], data[20], data[64 + 64 + 63] = 0, 4, 50
    assert bytes_of(r) == seal(data)


def test_scale_changes_times_and_pauses(r):
    r.line("scale 150")
    assert bytes_of(r) == changed(BASE, {64 + 62: 5, 64 + 63: 60, 128 + 63: 75, 192 + 63: 90})


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


# ---- undo ----

def test_eight_commands_are_undone_and_redone(r):
    states = [bytes_of(r)]
    for line in ("set 11", "swap 0 1", "step 5", "move 0 6", "int 0 1", "delete 0", "speed", "copy 2", "new"):
        r.line(line)
        if "[y/N]" in r.command:
            r.keys("y")
        states.append(bytes_of(r))
    for state in reversed(states[:-1]):
        assert r.line("u") == "u"
        assert bytes_of(r) == state
    assert not r.unsaved
    for state in states[1:]:
        r.line("redo")
        assert bytes_of(r) == state


# ---- cells ----

@pytest.mark.parametrize("x, y, value, address", [
    (1, 5, 1023, 64 + 10), (7, 30, 0, 64 * 7 + 60), (4, 31, 255, 64 * 4 + 62), (4, 32, 1, 64 * 4 + 63), (8, 0, 0x77, 32),
    (8, 30, 0x11, 62), (9, 3, 9, 14), (9, 4, 0, 15), (9, 9, 7, 20), (9, 10, 255, 21), (9, 11, 64, 22), (9, 14, 127, 25),
    (9, 19, 200, 30)])
def test_set_writes_the_cell(r, x, y, value, address):
    r.line(f"goto {x} {y}")
    assert r.xya == (f"{x:02d}", f"{y:02d}", f"{address:04d}")
    r.line(f"set {value}")
    changes = {address: value & 0xFF}
    if x in range(1, 8) and y <= 30:
        changes[address + 1] = value >> 8
    assert bytes_of(r) == changed(BASE, changes)
    assert int(r.cell(x, y)) == value


@pytest.mark.parametrize("x, y, wrong, message", [
    (4, 31, 256, "Value must be 0..255"), (8, 0, 1023, "Value must be 0..255"), (9, 9, 8, "Page Step must be 0..7"),
    (9, 14, 128, "Link must be 0..127"), (9, 16, 200, "Link must be 0..127")])
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
    r.keys(" ")
    assert r.cell(1, 1) == "????"
    r.keys("]")
    assert r.cell(1, 1) == "????"
    r.keys(" ")
    assert r.cell(1, 1) == "0480" and not r.unsaved
    r.line("goto 1 0")
    r.keys("]")
    assert r.cell(1, 0) == "----"
    r.keys(" ")
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


def test_arrows_move_as_the_original_does(r):
    r.line("goto 9 3")
    for keys, xy in (("\x1b[A", ("08", "02")), ("\x1b[C", ("08", "02")), ("\x1b[B", ("08", "03")), ("\x1b[C", ("09", "03")),
                     ("\x1b[D", ("08", "03")), ("\x1bOB", ("08", "04"))):
        r.keys(keys)
        assert r.xya[:2] == xy
    r.line("goto 8 30")
    r.keys("\x1b[B")
    assert r.xya == ("07", "31", "0510")
    r.line("goto 0 0")
    r.keys("\x1b[D\x1b[A")
    assert r.xya == ("00", "00", "0512") and r.cursor == (1, 20)


# ---- the line ----

def test_line_editing(r):
    r.keys("pagx")
    assert r.command == "] pagx" and r.cursor == (35, 7)
    r.keys("\x7f")
    r.keys("e\b\be")
    assert r.command == "] pae"
    r.keys("\x15")
    r.keys("page 2\r")
    assert r.text(2, 76, 4) == "0002"
    r.keys("x\x01")
    assert r.command == "] page 2"
    r.keys("\x03")
    assert r.xya[0] == "01"


@pytest.mark.parametrize("ending", ["\r", "\n", "\r\n"])
def test_each_line_end_ends_a_line_once(r, ending):
    r.keys("page 2" + ending + "page 3" + ending + "s 2" + ending)
    assert r.message == "s 2" and r.text(2, 76, 4) == "0003" and r.cell(9, 9) == "002"


def test_control_keys_start_an_empty_line(r):
    r.keys("!")
    assert r.command == "]" and r.cursor == (35, 3)
    r.keys("\r")
    assert r.cursor == (1, 26)


def test_too_long_a_line_is_not_run(r):
    r.line("x" * 130)
    assert r.command == "] Line too long"
    r.line("page 2")
    assert r.text(2, 76, 4) == "0002"


def test_goto_set_keeps_the_cursor_over_a_page_change(r):
    r.line("goto 4 12")
    r.line("page 2")
    assert r.xya == ("04", "12", "0280") and r.cursor == (13, 41)


# ---- lists ----

def test_help_list_find_show_and_give_the_screen_back(r):
    assert r.line("help go") == "help go go      g   n  moves the robot to step n"
    r.line("list 1 3")
    shown = r.show()
    for text in ("base", "other", "full", "1.19 s", "0.25 s", "0.71 s"):
        assert text in shown, shown
    r.keys(" ")
    assert r.text(1, 65, 4) == "base"
    r.line("find OTH")
    assert "other" in r.show() and "base" not in r.show()
    r.keys("p")
    assert r.command == "] p"
    r.keys("\x03")
    r.line("help")
    assert "page" in r.show()
    r.keys("q")
    assert r.text(2, 65, 15) == "PageNumber:0001"


def test_check_knows_how_fast_a_servo_is_at_this_battery():
    """100 units in 12 ticks are 313 degrees/s: an AX-12 does 283 at 9.6 V and 354 at 12 V."""
    pages = {1: page("fast", [(30, {5: 400}), (12, {5: 500})], code=1)}
    for volts, too_fast in ((9.6, True), (12, False)):
        with robot(pages=pages) as r:
            r.board.battery(volts)
            r.line("check", ms=3000)
            assert ("Page   1: step 1 ID 5 too fast" in r.show()) == too_fast, r.show()


@pytest.mark.parametrize("units, said", [(90, None), (91, 284)])
def test_check_counts_units_as_the_servo_does(units, said):
    """An AX-12 does 59 rpm at 12 V, 300 degrees are 1024 units: 283.2 degrees/s = 90.6 units in 12 ticks at 9.6 V."""
    with robot(pages={1: page("fast", [(30, {5: 400}), (12, {5: 400 + units})], code=1)}) as r:
        r.board.battery(9.6)
        r.line("check", ms=3000)
        assert ("too fast" in r.show()) == (said is not None), r.show()
        assert said is None or f"step 1 ID 5 too fast, {said} degrees/s" in r.show(), r.show()


def test_check_names_what_is_wrong():
    torn = page("torn", [(30, {})])
    torn.data[100] ^= 1
    pages = {1: page("a", [(30, {})], next=2, code=1), 2: torn, 3: page("alone", [(30, {}), (2, {5: 1000})]),
             4: page("b", [(30, {})], next=9, code=2)}
    with robot(pages=pages) as r:
        r.line("check", ms=3000)
        shown = r.show()
        assert "Page   1: leads to page 2, which is not valid" in shown
        assert "Page   2: checksum is wrong" in shown
        assert "Page   3: no code and no other page calls it" in shown
        assert "Page   3: step 1 ID 5 too fast" in shown
        assert "Page   4: leads to page 9, which has no steps" in shown or "Page   4: leads to page 9, which is not valid" in shown


def test_check_names_partners_that_cannot_be_blended():
    """Bytes 17 and 18. A partner needs no code and no link to be in use."""
    two = [(30, {}), (30, {})]
    torn = page("torn", two)
    torn.data[100] ^= 1
    pages = {1: page("walk", two, code=1, blend_right=2, blend_left=3), 2: page("right", two), 3: page("left", two + two),
             4: page("x", two, code=2, blend_right=5, blend_left=9), 5: torn, 6: page("y", two, code=3, blend_left=200)}
    with robot(pages=pages) as r:
        r.line("check", ms=4000)
        lines = [line.strip() for line in r.show().splitlines() if line.startswith("Page ")]
        assert lines == ["Page   1: blends with page 3, which has another number of steps",
                         "Page   4: blends with page 5, which is not valid", "Page   4: blends with page 9, which has no steps",
                         "Page   5: checksum is wrong", "Page   6: blends with page 200, which is not valid"]


def test_check_of_a_page_that_fills_many_lines_is_no_hang():
    """126 lines take longer than the watchdog waits."""
    with robot(pages={5: page("far", [(30, {})] * 7, code=1)}) as r:
        for servo in r.board.servos:
            servo.write(6, [600 & 255, 600 >> 8, 700 & 255, 700 >> 8])
        r.board.forbid("unexpected-reset")
        r.line("check 5", ms=3000)
        assert r.show().count("outside the servo's limits") > 10
        r.keys("\x1b")
        r.line("list 5")
        assert "far" in r.show()
