# SPDX-License-Identifier: MIT
"""Editing commands of edit/ORIGINAL.md sections 4 to 6: messages, questions, pages, the line, lists. Checks the message, the screen, and
the 512 bytes, which the tests derive from the specification. Intended differences: firmware/edit/DIFFERENCES.md."""

import pathlib
import re

import pytest

from tests.sim.edit_base import BASE, OTHER, PAGES, bytes_of
from tests.sim.edit_robot import new_page, robot, seal

# ---- messages ----


@pytest.mark.parametrize(
    "line, message",
    [
        ("foo", "Bad Command"),
        ("pag 1", "Bad Command"),
        ("pages 1", "Bad Command"),
        ("sa 1", "Bad Command"),
        ("dump", "Bad Command"),
        ("led 1", "Bad Command"),
        ("check", "Bad Command"),
        ("int 0 1", "Bad Command"),
        ("page", "Invalid Parameter"),
        ("page 2 200", "Invalid Parameter"),
        ("p", "Invalid Parameter"),
        ("page 128", "Page must be 0..127"),
        ("page -5", "Page must be 0..127"),
        ("page 2x", "Page must be 0..127"),
        ("page 65536", "Page must be 0..127"),
        ("page 0b1", "Page must be 0..127"),
        ("copy", "Invalid Parameter"),
        ("copy 200", "Page must be 0..127"),
        ("step", "Invalid Parameter"),
        ("s 8", "Step must be 0..7"),
        ("g 7", "Step must be 0..6"),
        ("go", "Invalid Parameter"),
        ("write 7", "Step must be 0..6"),
        ("insert", "Invalid Parameter"),
        ("i 7", "Step must be 0..6"),
        ("delete 7", "Step must be 0..6"),
        ("delete 3", "That step is not used"),
        ("move 1", "Invalid Parameter"),
        ("move 1 2 3", "Invalid Parameter"),
        ("move 0 8", "Step must be 0..7"),
        ("m 7", "Step must be 0..6"),
        ("mirror", "Invalid Parameter"),
        ("swap 1 7", "Step must be 0..6"),
        ("set", "Invalid Parameter"),
        ("set 1024", "Position must be 0..1023"),
        ("set a", "Position must be 0..1023"),
        ("goto 1", "Invalid Parameter"),
        ("goto 10 0", "X must be 0..9"),
        ("goto 0 33", "Y must be 0..32"),
        ("goto 9 0", "There is no cell"),
        ("goto 8 31", "There is no cell"),
        ("on 31", "ID must be 0..30"),
        ("off 254", "ID must be 0..30"),
        ("on 25", "Not there: ID 25"),
        ("play 0", "Page must be 1..127"),
        ("play 200", "Page must be 1..127"),
        ("sav 300", "Page must be 0..127"),
        ("undo", "Nothing to undo"),
        ("redo", "Nothing to redo"),
        ("paste", "Nothing noted, or changed: TAKE first"),
        ("help foo", "No such command: HELP"),
        ("take 3 1", "Say the lower number first"),
        ("take 0 3", "That step is not used"),
        ("swap 0 3", "That step is not used"),
        ("swap 3 0", "That step is not used"),
        ("list 30 10", "Say the lower number first"),
        ("next 5", "Invalid Parameter"),
        ("before 5", "Invalid Parameter"),
        ("new 3", "Invalid Parameter"),
        ("exit now", "Invalid Parameter"),
        ("time 1", "Invalid Parameter"),
        ("speed 1", "Invalid Parameter"),
        ("re 1", "Invalid Parameter"),
        ("hex 1", "Invalid Parameter"),
        ("dec 1", "Invalid Parameter"),
        ("rows 10", "Rows must be 24..255"),
    ],
)
def test_errors_say_what_is_wrong(r, line, message):
    assert r.line(line) == f"{line} {message}"
    assert bytes_of(r) == bytes(BASE.data)


@pytest.mark.parametrize("line", ["PAGE 2", "page 2", "P 2", "p,2", "p:2", "p;2", "p.2", "page.:;, 2", "page 0x2"])
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
    assert r.line("b") == "b No such page"
    r.line("page 127")
    assert r.line("n") == "n No such page"


@pytest.mark.parametrize("command", ["page 2", "next", "before", "copy 2", "exit"])
@pytest.mark.parametrize("answer", ["n", "\r", " ", "\x1b[A"])
def test_unsaved_edits_are_asked_for_and_kept_with_any_key_but_y(r, command, answer):
    r.line("set 77")
    assert r.unsaved
    r.line(command, answer)
    assert r.command == f"] {command} The edits would be lost. Are you sure?[y/N] no"
    assert r.text(2, 76, 4) == "0001" and r.cell(1, 0) == "0077" and r.unsaved


def test_a_line_that_answers_a_question_is_no_command_and_what_is_typed_ahead_no_answer(r):
    r.line("set 77")
    r.line("page 2")
    r.keys("on 99\r")  # its first key says no
    assert r.command.endswith("[y/N] no") and r.cursor == (1, 26) and r.unsaved
    r.keys("page 2\ryes\rsave 3\r")
    assert r.command.endswith("[y/N]") and r.text(2, 76, 4) == "0001" and r.flash_page(3) == bytes(PAGES[3].data)
    r.keys("n")
    assert r.unsaved


def test_packets_of_a_remote_are_not_keys(r):
    """D+R and U+L+R: the packets have U (UNDO), LF and CR among their bytes (REMOTE.md)."""
    r.line("set 77")
    r.line("name")
    for packet in (b"\xff\x55\x0a\xf5\x00\xff", b"\xff\x55\x0d\xf2\x00\xff") * 5:
        r.board.send(packet)
        r.board.run(ms=50)
    r.keys(b"\xff\x55\x0a")  # the rest of it is lost
    r.line("wave")
    assert r.text(1, 65, 5) == "wave " and r.cell(1, 0) == "0077"


def test_exit_restarts_after_a_yes():
    with robot(pages=PAGES) as r:
        r.line("goto 1 0")
        r.line("set 77")
        resets = r.board.resets
        r.line("exit", "y")
        r.settle(ms=1500)
        assert r.board.resets == resets + 1 and not r.unsaved


def test_a_terminals_size_report_answers_no_question(r):
    r.line("set 77")
    r.keys("page 2\r")
    assert r.command.endswith("[y/N]")
    r.keys("\x1b[8;36;80t", ms=500)
    assert r.command.endswith("[y/N]") and r.unsaved
    r.keys("y")
    assert r.text(2, 76, 4) == "0002"


def test_page_change_with_y_drops_edits(r):
    r.line("set 77")
    r.line("page 2", "Y")
    assert r.text(2, 76, 4) == "0002" and not r.unsaved
    r.line("page 1")
    assert r.cell(1, 0) == "----"


def test_two_pages_of_one_name_are_told():
    """`play base` of Play would be ambiguous."""
    with robot(pages=PAGES) as r:
        assert r.line("copy 2") == "copy 2 Page 2 has this name too"
        assert r.line("save") == "save OK Page 2 has this name too"
        r.line("name Third")
        assert r.line("save") == "save OK"
        assert r.line("save 5") == "save 5 OK Page 1 has this name too"
        assert r.line("copy 1") == "copy 1 Page 5 has this name too No change"
        r.line("page 0")
        assert r.flash_page(0)[0] in (0, 0xFF)  # no name, like other pages; that does not count as a common name
        r.line("goto 1 1")
        r.line("set 401")
        assert r.line("save") == "save OK"
        r.line("page 1")
        r.line("name")
        r.line(" ")  # clears the name
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


def test_line_longer_than_the_row_is_rubbed_out_from_its_end(r):
    """The row shows the first 77 of at most 111 characters (columns 3 to 79)."""
    text = "".join(chr(ord("A") + k % 26) for k in range(111))
    table = r.terminal.screen.display[:34]
    r.keys(text)
    for left in [*range(110, 78, -7), 78, 77, 76, 75, 40, 3, 2, 1, 0, 0]:
        r.keys("\x7f" * (len(text) - left) or "\x7f")
        text = text[:left]
        assert (r.command, r.cursor) == (("] " + text[:77]).rstrip(), (35, min(3 + left, 80)))
    assert r.terminal.screen.display[:34] == table
    r.keys("z" * 100 + "\x15pagx\x7fe 2\r")
    assert r.command == "] page 2" and r.text(2, 76, 4) == "0002"


def test_control_keys_start_an_empty_line(r):
    r.keys("!")
    assert r.command == "]" and r.cursor == (35, 3)
    r.keys("\r")
    assert r.cursor == (1, 26)


def test_empty_line_does_nothing(r):
    r.keys("\r")
    r.keys("  \r")
    assert r.message == "" and r.cursor == (1, 26)


def test_goto_set_keeps_the_cursor_over_a_page_change(r):
    r.line("goto 4 12")
    r.line("page 2")
    assert r.xya == ("04", "12", "0280") and r.cursor == (13, 41)


# ---- lists ----

# Every word of the original, and those that DIFFERENCES.md adds.
WORDS = (
    "page next before copy new save exit name step go write insert delete move mirror set goto on off play time speed re hex dec monitor "
    "help list undo redo swap take paste pairs rows"
).split()


def test_help_of_each_command_fits_into_the_row(r):
    source = (pathlib.Path(__file__).parents[2] / "firmware" / "edit" / "commands.c").read_text()
    texts = {text.split()[0]: text.split() for text in re.findall(r'TEXT_NAMED\(word_\w+, "(.*?)"\);', source)}
    assert set(texts) == set(WORDS)
    for word, text in texts.items():
        assert r.line(f"help {word}").split() == ["help", word, *text]


def test_help_and_list_show_and_give_the_screen_back(r):
    assert r.line("? g") == "? g go      g   n  moves the robot to step n"
    r.line("list 1 3")
    shown = r.show()
    for text in ("base", "other", "full", "1.19 s", "0.25 s", "0.71 s"):
        assert text in shown, shown
    r.keys(" ")
    assert r.text(1, 65, 4) == "base"
    r.line("list 2")
    assert "other" in r.show() and "base" not in r.show()
    r.keys("p")
    assert r.command == "] p"
    r.keys("\x03")
    r.line("help")
    assert "page" in r.show() and "space torque on/off" in r.show()
    r.keys("q")
    assert r.text(2, 65, 15) == "PageNumber:0001"
