# SPDX-License-Identifier: MIT
"""Edit's screen, cell by cell, against edit/ORIGINAL.md section 3 and the list in firmware/edit/DIFFERENCES.md."""

import pytest

from cm5sim import library
from tests.sim.edit_robot import JOINTS, new_page, page, robot, seal

HEADER = [
    "(Reserved) :",
    "PlayCount:",
    "(Reserved) :",
    "Blend Right:",
    "Blend Left:",
    "(Reserved) :",
    "Page Step:",
    "ControlCode:",
    "Page Speed:",
    "DXL Setup:",
    "Accel Time:",
    "Link to Next:",
    "Link to Exit:",
    "Linked Page1:",
    "Page1Remocon:",
    "Linked Page2:",
    "Page2Remocon:",
]


def word_text(word):
    if word >= 0x8000:
        return f"{word % 10000:04d}"
    if word & 0x2000:
        return "????"
    return f"{word:04d}" if word < 1024 else "----"


def frame(data, number, pose, cursor=(0, 0), pose_tail=(0, 64), live=None):
    """The 34 rows above the command row, derived from the page's bytes as in the specification."""
    live = live or {}
    rows = []
    steps = data[20]
    name = bytes(data[:14]).split(b"\0")[0].decode()
    side = [" %-15s" % name, " PageNumber:%04d" % number, " Addr:%08X" % (0xE000 + 512 * number)]
    side += ["%13s%03d" % (label, data[14 + i]) for i, label in enumerate(HEADER)]
    for joint in range(31):
        code = f"{joint:02X}" if joint < 0x1A else f"{joint:02x}"
        inner = "0x" + code if joint not in live else "%04d" % live[joint]
        row = "Dynamixel %2d(%s)[%s]" % (joint, inner, pose.get(joint, "????" if joint in live else "----"))
        for k in range(7):
            row += ("|" if k == steps else " ") + word_text(data[64 + 64 * k + 2 * joint] | data[65 + 64 * k + 2 * joint] << 8)
        row += ("|" if steps == 7 else " ") + "%03d" % data[32 + joint]
        rows.append((row + (side[joint] if joint < len(side) else "")).ljust(80))
    for label, place in (("   PauseTime       [", 62), ("   Time( x 7.8mSec)[" if data[16] == 10 else "   Speed           [", 63)):
        row = label + "%03d]" % pose_tail[place - 62]
        for k in range(7):
            row += "  %03d" % data[64 + 64 * k + place] if k else "  %03d" % data[64 + place]
        rows.append(row)
    x, y = cursor
    address = 512 + 2 * y if x == 0 else 64 * x + 2 * y
    rows[32] = rows[32].ljust(60) + "[X:%02d,Y:%02d,A:%04d]" % (x, y, address)
    rows.append(" " * 19 + "STP7  STP0 STP1 STP2 STP3 STP4 STP5 STP6    Go Step:")
    return [row.ljust(80) for row in rows]


def assert_frame(r, expected):
    shown = [r.terminal.row(i + 1) for i in range(len(expected))]
    for number, (got, want) in enumerate(zip(shown, expected), 1):
        assert got == want, f"row {number}:\n{got!r}\n{want!r}"


READY = page("ready", [(40, {1: 480, 2: 544}, 3), (50, {3: 300})], code=7, next=3, exit=4, link1_page=5, link1_code=6, link2_page=7, link2_code=8)


@pytest.mark.parametrize(
    "number, made",
    [
        (1, READY),
        (1, page("speed base", [(64, {1: 0}), (1, {1: 1023})] * 3 + [(9, {})], schedule=0)),
        (1, page("", [], joints=())),
        (1, page("123456789012345"[:13], [(255, {}, 255)] * 7, joints=range(31))),
    ],
)
def test_frame_after_start_is_that_of_the_original(number, made):
    with robot(pages={number: made}) as r:
        live = {joint: 512 for joint in JOINTS}
        assert_frame(r, frame(made.data, number, {}, live=live))
        assert r.terminal.row(35).rstrip() == "] Arrows move, HELP explains, EXIT leaves"
        assert r.cursor == (1, 20)


def test_frame_without_servos_has_no_live_positions():
    with robot(pages={1: READY}, servos=()) as r:
        assert_frame(r, frame(READY.data, 1, {}))


def test_frame_shows_goals_of_servos_that_hold():
    with robot(pages={1: READY}) as r:
        r.line("on")
        r.board.reset()
        r.terminal.screen.reset()
        r.settle(ms=1500)
        assert_frame(r, frame(READY.data, 1, {joint: "0512" for joint in JOINTS}))


def test_erased_page_shows_a_new_one():
    with robot() as r:
        r.board.flash[0xE000 + 512 * 9 : 0xE000 + 512 * 10] = b"\xff" * 512
        r.line("page 9")
        live = {joint: 512 for joint in JOINTS}
        expected = frame(new_page(), 9, {}, live=live)
        assert_frame(r, expected)
        assert r.message == "page 9"


def test_page_change_sends_only_what_differs_and_ends_equal_to_a_redraw():
    pages = {1: READY, 2: page("two", [(40, {1: 480, 2: 544}, 3), (50, {3: 301})], code=7)}
    with robot(pages=pages) as r:
        r.settle(200)
        start = len(r.board.console)
        r.line("page 2")
        sent = len(r.board.console) - start
        changed = r.show()
        r.line("re")
        assert sent < 300
        assert [a for a in r.show().splitlines()[:34]] == changed.splitlines()[:34]


def test_only_the_cell_that_changes_is_sent_and_nothing_while_nothing_changes():
    with robot(pages={1: READY}) as r:
        r.line("goto 1 3")
        r.keys("set 70")
        start = len(r.board.console)
        r.keys("0\r", ms=500)
        assert r.cell(1, 3) == "0700" and r.unsaved and len(r.board.console) - start < 100
        start = len(r.board.console)
        r.board.run(ms=3000)
        assert len(r.board.console) == start


def test_step_marker_moves():
    with robot(pages={1: READY}) as r:
        for count in (0, 7, 3):
            r.line(f"step {count}")
            for row in range(1, 32):
                for n in range(8):
                    assert r.text(row, 25 + 5 * n, 1) == ("|" if n == count else " ")
            assert r.text(10, 77, 3) == f"{count:03d}"


def test_words_of_every_kind_are_shown_as_the_original_shows_them():
    data = bytearray(READY.data)
    words = [0, 512, 1023, 0x2000, 0x2151, 0x6000, 0x4000, 0x4200, 1024, 0x1FFF, 0x8000, 0xFFFF]
    for joint, value in enumerate(words):
        data[64 + 64 * 6 + 2 * joint] = value & 0xFF
        data[65 + 64 * 6 + 2 * joint] = value >> 8
    made = page()
    made.data[:] = seal(data)
    with robot(pages={1: made}) as r:
        shown = [r.cell(7, joint) for joint in range(len(words))]
    assert shown == ["0000", "0512", "1023", "????", "????", "????", "----", "----", "----", "----", "2768", "5535"]


def test_hex_shows_and_takes_hexadecimal_and_dec_ends_it():
    with robot(pages={1: READY}) as r:
        r.line("goto 1 1")
        r.line("hex")
        assert r.cell(1, 1) == "01E0" and r.cell(8, 0) == "55 " and r.xya == ("01", "01", "0042")
        assert r.text(6, 13, 6) == "(0200)"  # position of a joint without torque
        r.line("set 1f")
        assert r.cell(1, 1) == "001F"
        r.line("set 0x3ff")
        assert r.cell(1, 1) == "03FF"
        assert r.line("set 400").endswith("Position must be 0x00..0x03FF")
        assert r.line("on 1a").endswith("Not there: ID 26")
        r.line("dec")
        assert r.cell(1, 1) == "1023" and r.cell(8, 0) == "085" and r.text(6, 13, 6) == "(0512)"


def test_damaged_pages_are_shown_as_what_they_are():
    torn = page("torn", [(30, {})])
    torn.data[100] ^= 0x10
    nine = page("nine", [(30, {})])
    nine.steps = 9
    nine.seal()
    cases = {
        2: (torn, "checksum is wrong"),
        3: (nine, "more than 7 steps"),
        4: (page("s", [(30, {})], schedule=5), "unknown schedule"),
        5: (page("p", [(30, {})], speed=0), "page speed is 0"),
        6: (page("l", [(30, {})], next=200), ""),  # counts as 0; `m512 pages check` reports it
        7: (page("w", [(30, {3: 1500})]), "position above 1023"),
    }
    with robot(pages={1: READY, **{n: made for n, (made, _) in cases.items()}}) as r:
        for number, (made, text) in cases.items():
            r.line(f"page {number}")
            assert r.fault == text
            assert r.text(1, 65, 4).strip() == made.name.decode()
        r.line("page 1")
        assert r.fault == ""


def test_small_terminal_leaves_out_absent_joints_and_keeps_the_rest():
    with robot(pages={1: READY}, rows=24) as r:
        for row, joint in enumerate(JOINTS, 1):
            assert r.text(row, 1, 12) == "Dynamixel %2d" % joint
            assert r.text(row, 26, 4) == word_text(READY.word(0, joint))
        assert r.text(19, 1, 20).strip() == "" and r.text(20, 64, 16) == "Page2Remocon:008"
        assert r.terminal.row(21).startswith("   PauseTime") and r.terminal.row(22).startswith("   Time(")
        assert r.terminal.row(23)[19:].startswith("STP7  STP0") and r.terminal.row(24).startswith("] Arrows move")
        assert r.text(22, 61, 18) == "[X:00,Y:01,A:0514]" and r.cursor == (1, 20)
        r.keys("\x1b[B" * 18)
        assert r.text(22, 61, 18) == "[X:00,Y:31,A:0574]"
        assert r.line("goto 0 20").endswith("That joint has no row")
        r.line("goto 9 19")  # the header beside the table keeps all rows
        r.keys("\x1b[A\x1b[A\x1b[B\x1b[D")
        assert r.text(22, 61, 11) == "[X:08,Y:18,"


def test_small_terminal_scrolls_with_the_cursor():
    with robot(pages={1: page("all", [(40, {}), (40, {})], joints=range(31))}, rows=24, servos=range(0, 31)) as r:
        assert r.text(20, 1, 12) == "Dynamixel 19"
        r.line("goto 1 30")
        assert r.text(20, 1, 12) == "Dynamixel 30" and r.text(1, 1, 12) == "Dynamixel 11"
        assert r.text(1, 65, 3) == "all" and r.cursor == (20, 26)
        assert r.text(20, 36, 1) == "|" or r.text(20, 35, 1) == "|"
        r.line("goto 1 0")
        assert r.text(1, 1, 12) == "Dynamixel  0" and r.cursor == (1, 26)


def test_live_position_of_a_released_joint_follows_the_hand_five_times_a_second():
    with robot(pages={1: READY}) as r:
        r.settle(500)
        seen = set()
        for step in range(10):
            r.board.servos[5].push_to(400 + step)
            r.board.run(ms=200)
            r.terminal.feed(r.board.take())
            seen.add(r.text(6, 13, 6))
            assert r.cell(0, 5) == "????"
        assert len(seen) >= 9, seen
        r.board.servos[5].push_to(0)
        r.settle(400)
        assert r.text(6, 13, 6) == "(0000)"


def test_redraw_asks_for_the_size_again_and_rows_sets_it():
    with robot(pages={1: READY}) as r:
        assert r.text(33, 61, 3) == "[X:"
        r.terminal.screen.resize(24, 80)
        r.line("re", ms=800)
        assert r.text(22, 61, 3) == "[X:" and r.terminal.row(24).startswith("]")
        r.terminal.screen.resize(36, 80)
        r.line("rows 35", ms=800)
        assert r.text(33, 61, 3) == "[X:" and r.terminal.row(35).startswith("]")
        r.line("goto 0 0")
        assert_frame(r, frame(READY.data, 1, {}, live={joint: 512 for joint in JOINTS}))


def started_anew(r, ms):
    """The board `ms` after a reset, before its screen is complete."""
    r.board.reset()
    r.terminal.screen.reset()
    r.board.run(ms=ms)


@pytest.mark.parametrize("ms", [200, 500])
def test_what_is_typed_before_the_first_screen_is_answered_on_it(ms):
    with robot(pages={1: READY}) as r:
        started_anew(r, ms)
        r.keys("bogus\r", ms=1200)
        assert r.message == "bogus Bad Command"
        r.settle(4000)
        assert r.message == "Arrows move, HELP explains, EXIT leaves"
        started_anew(r, ms)
        r.keys("new\r", ms=1200)
        assert r.message == "new The page would be emptied. Are you sure?[y/N]"
        r.keys("n")
        assert r.message == "new The page would be emptied. Are you sure?[y/N] no"
        assert_frame(r, frame(READY.data, 1, {}, live={joint: 512 for joint in JOINTS}))


def test_first_message_outlives_a_late_answer_about_the_size_but_no_typed_line():
    with robot(pages={1: READY}) as r:
        greeting = "Arrows move, HELP explains, EXIT leaves"
        r.settle(2000)
        assert r.message == greeting
        r.terminal.screen.resize(24, 80)
        r.keys("\x1b[24;80R", ms=1500)
        assert r.terminal.row(24).rstrip() == f"] {greeting}"
        r.line("goto 0 20")
        r.settle(5000)
        r.terminal.screen.resize(30, 80)
        r.keys("\x1b[30;80R", ms=1500)
        assert r.terminal.row(30).rstrip() == "] _"


def test_question_stays_while_a_redraw_goes_on():
    with robot(pages={1: READY}) as r:
        r.keys("re\rnew\r", ms=1200)
        assert r.message == "new The page would be emptied. Are you sure?[y/N]"


def test_page_changes_send_a_quarter_of_the_originals_bytes_at_most():
    """On real pages: every fourth one of our library."""
    image = (library.build_folder() / "motions" / "motions.bin").read_bytes()
    with robot(motions=image) as r:
        used = [n for n in range(1, 128) if image[512 * n + 20] in range(1, 8) and sum(image[512 * n : 512 * n + 512]) & 0xFF == 0xFF]
        sent = []
        for number in used[::4]:
            start = len(r.board.console)
            r.line(f"page {number}")
            sent.append(len(r.board.console) - start)
        mean = sum(sent) / len(sent)
        print(f"page change: {mean:.0f} bytes on average of {len(sent)}, at most {max(sent)} (original 7000..7700)")
        assert len(sent) >= 8 and mean <= 0.25 * 7000
