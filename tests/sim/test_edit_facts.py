# SPDX-License-Identifier: MIT
"""Facts of edit/ORIGINAL.md that the other test_edit_*.py do not test, one short session each: keys, lines, steps, servos, the monitor,
lists. README.md says which test checks which fact."""

import re

import pytest

from tests.sim.edit_base import opened
from tests.sim.edit_robot import changed, new_page, page, robot, seal

BASE = page(
    "base",
    [(40, {1: 480, 2: 544}, 3), (50, {3: 300}), (60, {4: 10})],
    code=7,
    next=3,
    exit=5,
    link1_page=11,
    link1_code=12,
    link2_page=13,
    link2_code=14,
)
NEUTRAL = page("neutral", [(40, {1: 300, 2: 700, 3: 20, 4: 1000})])
PAGES = {1: BASE, 2: page("other", [(11, {1: 900}), (22, {2: 100})]), 8: NEUTRAL}


@pytest.fixture
def r(shared):
    """Page 1 as in flash, X1 Y0, decimal, all servos without torque."""
    shared.keys("\x03")
    shared.line("dec")
    opened(shared).page_address()
    shared.line("off")
    for servo in range(1, 19):
        shared.board.servos[servo].push_to(512)
    shared.board.clear_trace()
    return shared


def sent(r):
    """Packets on the bus, without the constant polls (READ of 20 bytes at 24)."""
    return [packet for _, packet in r.board.packets if packet[4:7] != bytes([2, 24, 20])]


def goals(r):
    return {joint: r.board.servos[joint].goal for joint in range(1, 19)}


# ---- section 4: keys and lines ----


@pytest.mark.parametrize("key", ["!", '"', "/", "|", "~", "\x7f", "\t", "\b", "\r", "\n", "\x05", "\xe4"])
def test_other_keys_start_an_empty_line(r, key):
    r.keys(key.encode("latin-1"))
    assert r.command in ("]", "] _", "]  ") or key in "\r\n\xe4"
    r.keys("page 2\r")
    assert r.text(2, 76, 4) == "0002"


@pytest.mark.parametrize("key", ["0", "9", ":", "A", "Z", "\\", "^", "_", "`", "a", "z"])
def test_word_characters_start_a_line_with_themselves(r, key):
    r.keys(key)
    assert r.command.startswith(f"] {key}".rstrip())
    r.keys("\x03")


def test_deleting_at_the_start_of_a_line_does_nothing(r):
    r.keys("p\b\b\x7f\x7fage 2\b3\r")
    assert r.message == "age 3 Bad Command" and r.text(2, 76, 4) == "0001"


def test_earlier_lines_come_back_with_arrow_and_ctrl_a(r):
    for line in ("step 2", "step 3", "step 4"):
        r.line(line)
    r.keys("x\x1b[A")
    assert r.command == "] step 4"
    r.keys("\x1b[A")
    assert r.command == "] step 3"
    r.keys("\x01")
    assert r.command == "] step 2"
    r.keys("\x1b[B\r")
    assert r.message == "step 3" and r.cell(9, 9) == "003"


def test_nul_and_escape_sequences_do_not_reach_a_line(r):
    r.keys("pa\0ge\x1b[5~ \x1b[C\x1bOP2\r")
    assert r.text(2, 76, 4) == "0002"


def test_bracket_typed_after_a_lone_escape_is_a_character(r):
    r.keys("name a\x1b")
    r.settle(ms=100)  # a terminal sends a sequence at once, a user types later
    r.keys("[O]\r")
    assert r.text(1, 65, 6) == "a[O]  "
    r.line("undo")


def test_message_behind_a_long_line_has_the_row_for_itself(r):
    r.keys("x" * 60 + "\r")
    assert r.command == "] Bad Command"
    r.keys("set 1" + "0" * 70 + "\r")
    assert r.command == "] Position must be 0..1023"
    r.keys("page" + " " * 40 + "200\r")
    assert r.command == "] Page must be 0..127"


def test_signs_may_stand_within_a_line(r):
    r.line("name a|b~!")
    assert r.text(1, 65, 6) == "a|b~! "
    r.line("undo")


def test_first_wave_of_help_can_be_typed_as_it_stands():
    with robot(pages={1: page("one", [(40, {})])}) as r:
        r.line("help")
        rows = [r.terminal.row(number).rstrip() for number in range(1, 36)]
        first = rows.index("A first wave:")
        assert first <= 1 and rows[first + 8].startswith("Keys: ") and rows[first + 9] == "Commands:"
        lines = [row.split("  ")[0] for row in rows[first + 1 : first + 8]]
        assert lines == ["page 99", "off", "on", "write", "name hi", "play", "save"]
        r.keys("q")
        for line in lines[:4]:
            r.line(line)
        r.board.servos[3].push_to(300)
        for line in lines[1:5]:
            r.line(line)
        r.line("play", ms=5000)
        assert r.line("save").endswith(" OK") and r.flash_page(99)[:3] == b"hi\0" and r.flash_page(99)[20] == 2


def test_letter_that_is_not_ascii_is_seen_to_be_none(r):
    r.line("name gr\u00fcn")  # two bytes in UTF-8
    assert r.message == "name gr??n" and r.text(1, 65, 6) == "gr??n "
    r.line("undo")


def test_longest_line(r):
    r.keys("page 2" + " " * 105)  # 111 characters
    r.keys("\r")
    assert r.text(2, 76, 4) == "0002"
    r.keys("page 1" + " " * 106 + "\r")
    assert r.command == "] The line is too long: nothing was done" and r.text(2, 76, 4) == "0002"


def test_ctrl_c_leaves_line_question_and_name(r):
    r.keys("page 2\x03")
    assert r.cursor == (1, 26)
    r.keys("new\r")
    r.keys("\x03")
    r.keys("name\r")
    r.keys("abc\x03")
    assert r.ram_page() == bytes(BASE.data)


def test_a_recalled_command_in_the_name(r):
    r.line("step 3")
    r.keys("name\r\x01\r")
    assert r.ram_page()[:14] == b"name".ljust(14, b"\0")  # the previous line


def test_name_on_the_line_and_same_name_is_no_edit(r):
    assert r.line("name fourteen-chars") == "name fourteen-chars At most 13 characters: name kept"
    r.line("name walk")
    assert r.ram_page() == changed(BASE, dict(enumerate(b"walk".ljust(14, b"\0")))) and r.unsaved
    r.line("name base")
    assert r.ram_page() == bytes(BASE.data) and not r.unsaved


# ---- sections 4 and 5: cells and numbers ----


def test_work_pose_of_absent_joints_and_its_pause_and_speed(r):
    r.line("goto 0 25")
    assert r.cell(0, 25) == "----"
    r.line("set 300")
    assert r.cell(0, 25) == "0300"
    r.keys("]")
    assert r.cell(0, 25) == "0300"
    r.keys(" ")
    assert r.cell(0, 25) == "????"
    r.line("goto 0 31")
    r.line("set 9")
    r.line("goto 0 32")
    assert r.xya == ("00", "32", "0575")
    r.line("set 70")
    assert r.cell(0, 31) == "009" and r.cell(0, 32) == "070" and not r.unsaved
    assert sent(r) == []  # no WRITE to a servo
    r.line("write 5")
    assert r.ram_page()[64 * 6 + 62 : 64 * 6 + 64] == bytes([9, 70])


def test_time_mode_is_byte_16_and_its_own_cell(r):
    r.line("goto 9 5")
    r.line("set 0")
    assert r.terminal.row(33).startswith("   Speed ") and r.unsaved
    r.keys("}")
    assert "Time( x 7.8mSec)" in r.terminal.row(33) and not r.unsaved


def test_hex_keys_and_page_number(r):
    r.line("hex")
    r.line("goto 1 1")
    r.keys("}")
    assert r.cell(1, 1) == "01EA"
    r.line("page 2", "y")
    assert r.text(2, 76, 4) == "0002"
    r.line("page 1A")
    assert r.text(2, 76, 4) == "001A"
    r.line("page 9g")
    assert "Page must be" in r.command


def test_run_and_monitor_words_are_no_commands(r):
    for word in ("run", "rd", "read 1", "ping", "toss"):
        assert r.line(word) == f"{word} Bad Command"


# ---- section 6: steps ----


def test_copy_of_the_own_number_takes_the_edits_back(r):
    r.line("set 77")
    r.line("copy 1", "y")
    assert r.ram_page() == bytes(BASE.data) and not r.unsaved


def test_copy_of_an_erased_page_gives_a_new_one(r):
    r.board.flash[0xE000 + 512 * 40 : 0xE000 + 512 * 41] = b"\xff" * 512
    r.line("copy 40")
    assert r.ram_page() == seal(new_page())


def test_insert_behind_the_last_step_does_not_count(r):
    r.line("on")
    r.line("insert 5")
    data = r.ram_page()
    assert data[20] == 3 and data[64 : 64 + 64 * 5] == bytes(BASE.data[64 : 64 + 64 * 5])
    assert data[64 * 6 : 64 * 6 + 62] != bytes(BASE.data[64 * 6 : 64 * 6 + 62])


def test_move_takes_the_work_pose_too(r):
    r.line("goto 0 25")
    r.line("set 300")
    r.line("move 7 3")
    data = r.ram_page()
    assert data[20] == 3 and data[64 * 4 + 50] | data[64 * 4 + 51] << 8 == 300


def test_write_with_joints_let_go_says_so_and_keeps_the_position(r):
    assert r.line("write 4").endswith("Off: 1-18")
    assert r.cell(5, 3) == "????"
    at = 64 * 5 + 6
    assert r.ram_page()[at : at + 2] == (0x2000 | 512).to_bytes(2, "little")


# ---- sections 7 and 8: servos ----


def test_mirror_about_the_first_step_of_page_1_in_flash():
    with robot(pages={1: NEUTRAL, 5: page("pose", [(40, {1: 350, 2: 712, 3: 900, 4: 990}, 9)])}) as r:
        r.line("pairs page1")
        r.line("goto 1 1")
        r.line("set 1000")  # page 1 in RAM, which does not matter: the one in flash does
        r.line("page 5", "y")
        r.line("on")
        r.line("mirror 0")
        shown = goals(r)
        assert shown[1] == 300 - (712 - 700) and shown[2] == 700 - (350 - 300)
        assert shown[3] == 30 and shown[4] == 120  # 20 + 1000 - 990, 1000 + 20 - 900
        assert r.cell(0, 31) == "009" and r.text(34, 72, 3).strip() == ""  # the pause is copied too; Go Step belongs to GO
        r.line("pairs 512")
        r.line("mirror 0")
        shown = goals(r)
        assert shown[1] == 1024 - 712 and shown[3] == 1024 - 990 and shown[4] == 124
        r.settle(ms=600)
        r.board.reset()  # the setting survives a reset
        r.terminal.screen.reset()
        r.settle(ms=1500)
        assert r.line("pairs").startswith("pairs about 512: 1-2 3-4")
        assert r.line("pairs page1").startswith("pairs page1 about page1: 1-2 3-4")


@pytest.mark.parametrize("word", ["3", "pag1", "page12", "51"])
def test_pairs_refuses_a_word_that_it_does_not_know(word):
    with robot(pages={1: NEUTRAL}) as r:
        r.line("pairs page1")
        r.settle(ms=600)
        before = bytes(r.board.eeprom)
        assert r.line(f"pairs {word}").endswith("Say two IDs, 512 or page1")
        r.settle(ms=600)
        assert bytes(r.board.eeprom) == before


def test_pairs_about_page_1_wants_a_page_1_that_can_be_read():
    damaged = page("neutral", [(40, {})])
    damaged.data[100] ^= 0xFF
    with robot(pages={1: damaged}) as r:
        assert r.line("pairs page1") == "pairs page1 Page 1 is damaged: checksum is wrong"
        assert r.line("pairs").startswith("pairs about 512: ")


def test_mirror_stays_inside_the_range(r):
    r.line("on")
    r.line("goto 1 1")
    r.line("set 0")
    r.line("goto 1 2")
    r.line("set 1023")
    r.line("mirror 0")
    assert goals(r)[1] == 1 and goals(r)[2] == 1023  # 1024 - 1023, and 1024 - 0 limited to the range


def test_on_does_not_touch_joints_that_hold(r):
    r.line("on 3")
    r.line("goto 0 3")
    r.line("set 700")
    r.line("on")
    assert goals(r)[3] == 700 and r.cell(0, 3) == "0700"
    r.line("on 3")
    assert goals(r)[3] == 700


def test_off_lets_go_with_one_packet_before_it_asks_each_servo(r):
    r.line("on")
    r.board.clear_trace()
    r.line("off 2 5 9")
    writes = [packet for packet in sent(r) if packet[4] != 2]  # the poses are read as well
    assert writes[0][4:13] == bytes([0x83, 24, 1, 2, 0, 5, 0, 9, 0])
    assert [(packet[2], packet[4:7]) for packet in writes[1:]] == [(j, bytes([3, 24, 0])) for j in (2, 5, 9)]
    assert [r.board.servos[j].torque for j in (2, 5, 9, 1)] == [False, False, False, True]


def test_ids_outside_the_table_are_left_alone():
    with robot(pages={1: page("all", [(64, {0: 400, 30: 600})], joints=range(31))}, servos=(0, 30, 31, 40)) as r:
        r.line("on")
        assert r.board.servos[0].torque and r.board.servos[30].torque
        assert not r.board.servos[31].torque and not r.board.servos[40].torque
        r.line("go 0")
        assert r.board.servos[0].goal == 400 and r.board.servos[30].goal == 600
        assert r.board.servos[31].goal == 512 and r.board.servos[40].goal == 512


# ---- section 10: PLAY ----


def test_play_ignores_other_keys_and_the_last_of_stop_and_exit_counts():
    """The exit is chosen when the last step of a repetition begins, after 1.6 s: all keys come well before or after that."""
    pages = {1: page("one", [(200, {1: 560}), (200, {1: 464})], schedule=10, repeat=20, exit=2), 2: page("two", [(40, {1: 700})])}
    with robot(pages=pages) as r:
        r.keys("play\r", ms=2200)
        r.keys("abc]{5\t", ms=200)
        assert re.fullmatch(r"Page 1 step [01] repetition \d", r.message), r.message
        assert r.board.servos[1].goal != 700 and not r.unsaved
        r.keys("\r\x1b", ms=300)
        assert r.message.endswith("[STOP][Exit]"), r.message
        r.settle(ms=4000)
        assert r.message.endswith("[STOP][Exit] OK") and r.board.servos[1].goal != 700
        r.keys("play\r", ms=1500)
        r.keys("\x1b", ms=200)
        r.keys("\r", ms=8000)
        r.settle(ms=1000)
        assert r.message.endswith("[Exit][STOP] OK") and r.board.servos[1].goal == 700


def test_a_break_slows_down_and_stands_within_a_quarter_of_a_second():
    pages = {1: page("fast", [(100, {1: 100}), (100, {1: 900})], repeat=9)}
    with robot(pages=pages) as r:
        r.keys("play\r", ms=4000)
        r.board.clear_trace()
        r.board.run(ms=100)
        key = r.board.now_cycles
        r.board.send(b" ")
        r.board.run(ms=700)
        track = [(cycle, frame[1]) for cycle, _, frame in r.board.trace if 1 in frame]
        steps = [abs(b[1] - a[1]) for a, b in zip(track, track[1:]) if b[0] > key]
        assert steps[0] > 2, "it did not move when the key came"
        moving = [step for step in steps if step > 0]
        assert all(b <= a + 1 for a, b in zip(moving, moving[1:])) and moving[-1] <= moving[0] / 2
        assert len(moving) <= 32  # ticks of 7.8 ms


def test_play_ends_at_a_damaged_page():
    torn = page("torn", [(30, {})])
    torn.data[99] ^= 1
    with robot(pages={1: page("one", [(30, {1: 500})], next=2), 2: torn}) as r:
        r.line("play", ms=3000)
        r.settle(ms=1000)
        assert "2" in r.message and ("invalid" in r.message or "damaged" in r.message), r.message


# ---- lists ----


def test_list_shows_every_field(r):
    r.line("list 1")
    row = next(row for row in r.terminal.screen.display if " base " in row)
    assert row.split() == ["1", "base", "3", "3", "5", "11", "12", "13", "14", "7", "1.19", "s"]
    assert "Page name" in r.show() and "steps next exit" in r.show()
    r.keys("q")


def test_list_shows_times_above_512_s():
    """Seven steps at the slowest speed. The firmware limits each to 32,767 ticks of 1/128 s (motion/step_ticks.h)."""
    slow = page("slow", [(1, {1: 0 if step % 2 else 1023}) for step in range(7)], schedule=0, speed=1)
    with robot(pages={1: slow}) as r:
        r.line("list 1")
        row = next(row for row in r.terminal.screen.display if " slow " in row)
        assert row.split()[-2] == f"{(6 * 32767 + 1) / 128:.2f}"
        r.keys("q")


def test_list_pages_by_the_screen_and_q_ends_it():
    with robot(pages={n: page(f"page {n}", [(30, {})]) for n in range(1, 60)}) as r:
        r.line("list", ms=800)
        assert "-- more: space --" in r.show() and "page 40" not in r.show()
        r.keys(" ", ms=800)
        assert "page 50" in r.show()
        r.keys("q", ms=300)
        assert r.text(1, 65, 6) == "page 1"


# ---- 12: fixed weaknesses ----
def test_links_are_checked_not_cut(r):
    r.line("goto 9 14")
    r.line("set 127")
    r.keys("]")
    assert r.cell(9, 14) == "000"  # the keys wrap at 127
    r.keys("[")
    assert r.cell(9, 14) == "127" and r.ram_page()[25] == 127


@pytest.mark.parametrize("restart", ["exit", "@reset"])
def test_setting_answered_ok_outlives_a_restart_at_once(restart):
    with robot() as r:
        r.keys("pairs 1 5\r")
        r.board.send(restart + "\r", wait=True)
        r.board.run(ms=1000)  # through the loader
        r.terminal.screen.reset()
        r.settle(ms=1500)
        assert "1-5" in r.line("pairs")
