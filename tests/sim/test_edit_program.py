# SPDX-License-Identifier: MIT
"""Program requests in Edit (firmware/common/PROTOCOL.md), and the full screen during them."""

import random

import pytest

from m512.crc16 import crc16
from tests.sim.channel import request
from tests.sim.edit_robot import page, robot

PAGES = {1: page("one", [(40, {1: 480}), (255, {1: 700, 2: 300}), (255, {1: 300, 2: 700})], repeat=5), 2: page("two", [(30, {})])}


def ask(r, line, ms=120):
    r.board.take()
    r.board.send(line.encode() + b"\r")
    r.board.run(ms=ms)
    answers = [
        text for text in r.board.take().translate(None, b"\x11\x13").decode().split("\r\n") if text.startswith("@") and not text.startswith("@now")
    ]
    assert len(answers) == 1, answers
    return answers[0]


def test_a_page_goes_in_and_comes_out():
    data = page("made", [(77, {5: 600})]).data
    with robot(pages=PAGES) as r:
        assert ask(r, "@open 9") == "@open OK"
        for offset in range(0, 512, 32):
            assert ask(r, f"@data {offset} {data[offset : offset + 32].hex()}") == "@data OK"
        assert ask(r, "@crc") == f"@crc {crc16(bytes(data)):04X} OK"
        assert ask(r, "@save 9 0x1").startswith("@save ERR 9 ")
        assert ask(r, "@save 9 xyz").startswith("@save ERR 3 ")
        assert ask(r, "@save 9 1 2").startswith("@save ERR 2 ")
        assert ask(r, f"@save 9 0x{crc16(bytes(data)):04X}", ms=250) == "@save OK"
        assert r.flash_page(9) == bytes(data)
        answer = ask(r, "@page 9", ms=400).split()
        assert answer[:2] == ["@page", "9"] and answer[2].lower() == bytes(data).hex() and answer[-1] == "OK"
        r.board.take()
        r.keys("\x1b[B", ms=800)
        assert r.text(1, 65, 4) == "made" and r.text(2, 76, 4) == "0009"
        assert ask(r, f"@data 0 {bytes(data[:4]).hex()}") == "@data OK" and ask(r, "@open 2") == "@open OK"  # no edit: the same bytes


def dense_page(text):
    """Bytes of an answer to `@dense`, decoded as in PROTOCOL.md."""
    sixes = [ord(letter) - 0x30 for letter in text]
    assert all(0 <= six <= 63 for six in sixes)
    made = []
    assert sixes[2] & 3 == 0
    for group in [sixes[:3]] + [sixes[at : at + 4] for at in range(3, len(sixes), 4)]:
        *low, high = group
        newest_first = [(high << shift) & 0xC0 for shift in (2, 4, 6)][: len(low)]
        made += [six | top for six, top in zip(low, reversed(newest_first), strict=True)]
    return bytes(made)


def test_a_dense_page_is_the_page(rng=random.Random(512)):
    chosen = {n: bytes(rng.randrange(256) for _ in range(512)) for n in (3, 127)}
    with robot(pages=PAGES) as r:
        for n, data in chosen.items():
            r.board.flash[0xE000 + 512 * n : 0xE200 + 512 * n] = data
        for n in (1, 3, 2, 127, 40):
            answer = ask(r, f"@dense {n}", ms=300).split()
            assert (answer[0], answer[1], len(answer[2]), answer[-1]) == ("@dense", str(n), 683, "OK")
            assert dense_page(answer[2]) == r.flash_page(n) == chosen.get(n, r.flash_page(n))
            assert answer[3] == f"{crc16(r.flash_page(n)):04X}" == ask(r, f"@page {n}", ms=400).split()[3]
        assert ask(r, "@dense 128").startswith("@dense ERR 3 ")
        assert ask(r, "@dense").startswith("@dense ERR 2 ")
        assert "dense" in next(word for word in ask(r, "@ver").split() if word.startswith("can=")).removeprefix("can=").split(",")


def test_data_stays_within_the_page():
    with robot(pages=PAGES) as r:
        assert ask(r, "@open 9") == "@open OK"
        assert ask(r, "@data 508 00112233") == "@data OK"
        for words in ("508 0011223344", "512 00", "511 0011", f"0 {33 * '00'}", "0 123", "0 1g"):
            assert ask(r, f"@data {words}").startswith("@data ERR 3 "), words


def test_open_does_not_drop_edits():
    with robot(pages=PAGES) as r:
        r.line("goto 1 1")
        r.line("set 77")
        assert ask(r, "@open 2").startswith("@open ERR 12 ")
        assert ask(r, "@frobnicate").startswith("@frobnicate ERR 1 ")
        assert ask(r, "@open").startswith("@open ERR 2 ")
        assert ask(r, "@page 128").startswith("@page ERR 3 ")


@pytest.mark.parametrize("keys", [b" ", b"\x03", b"pag\x03", b"@wh\x03"])
def test_play_misses_no_tick_and_a_key_breaks_it(keys):
    with robot(pages=PAGES) as r:
        assert ask(r, "@play 1") == "@play OK"
        missed = [text for text in ask(r, "@where").split() if text.startswith("missed=")]
        r.board.run(ms=2000)
        assert [text for text in ask(r, "@where").split() if text.startswith("missed=")] == missed
        assert "state=play" in ask(r, "@where")
        r.board.send(keys)
        r.board.run(ms=800)
        r.board.take()
        r.board.send(request("@where"))
        r.board.run(ms=800)  # drawing takes 0.5 s
        assert b"state=idle" in r.board.take()


def fields(answer):
    return dict(word.split("=", 1) for word in answer.split() if "=" in word)


def test_version_list_and_pose():
    with robot(pages=PAGES) as r:
        version = ask(r, "@ver")
        assert version.startswith("@ver ") and version.endswith(" OK") and "edit" in version and "cm5" in version.lower()
        listed = ask(r, "@list", ms=600)
        assert listed.startswith("@list ") and listed.endswith(" OK") and " 1" in listed and " 2" in listed and " 3" not in listed
        r.board.servos[4].push_to(0x155)
        r.board.run(ms=400)
        pose = ask(r, "@pose").split()
        assert pose[0] == "@pose" and pose[-1] == "OK" and pose[1:-1] == [f"{j}:{341 if j == 4 else 512}:0" for j in range(1, 19)]


def test_torque_and_move():
    with robot(pages=PAGES) as r:
        assert ask(r, "@torque on", ms=300) == "@torque OK"
        assert all(r.board.servos[joint].torque for joint in range(1, 19))
        assert ask(r, "@move 90 3 258---1F4") == "@move OK"
        r.board.run(ms=2500)
        assert (r.board.servos[3].goal, r.board.servos[4].goal, r.board.servos[5].goal) == (0x258, 512, 0x1F4)
        for wrong in ("@move 0 3 258", "@move 90 31 258", "@move 90 3 25", "@move 90 3 400", "@move 90 30 200200", "@move 90 3 xyz"):
            assert ask(r, wrong).startswith("@move ERR 3 "), wrong
        assert ask(r, "@move 90 25 258").startswith("@move ERR 7 ")  # missing joints are skipped, but a pose of only these is an error
        assert ask(r, "@move 90 18 258---1F4") == "@move OK"
        r.board.run(ms=1000)
        assert ask(r, "@torque off 3 5") == "@torque OK"
        assert [r.board.servos[joint].torque for joint in (3, 4, 5)] == [False, True, False]
        assert ask(r, "@torque maybe").startswith("@torque ERR ")


def test_play_pause_resume_stop():
    with robot(pages=PAGES) as r:
        assert ask(r, "@play 0").startswith("@play ERR 3 ") and ask(r, "@play 9").startswith("@play ERR 6 ")
        assert ask(r, "@play 1") == "@play OK"
        r.board.run(ms=1500)
        assert fields(ask(r, "@where"))["page"] == "1"
        assert ask(r, "@pause") == "@pause OK"
        r.board.run(ms=1000)
        stood = [r.board.servos[joint].goal for joint in (1, 2)]
        r.board.run(ms=500)
        assert [r.board.servos[joint].goal for joint in (1, 2)] == stood
        assert ask(r, "@resume") == "@resume OK"
        r.board.run(ms=800)
        assert [r.board.servos[joint].goal for joint in (1, 2)] != stood
        assert ask(r, "@break") == "@break OK"
        r.board.run(ms=600)
        assert fields(ask(r, "@where"))["state"] == "idle"


def test_nothing_is_saved_and_nothing_drawn_while_something_plays():
    """A save blocks interrupts for seven ticks; redrawing the hidden screen would take seventy."""
    with robot(pages=PAGES) as r:
        assert ask(r, "@play 1") == "@play OK"
        r.board.run(ms=1500)
        operations, missed = r.board.operations, fields(ask(r, "@where"))["missed"]  # some ticks are missed while the servos are prepared
        assert ask(r, f"@save 9 0x{crc16(bytes(PAGES[1].data)):04X}").startswith("@save ERR 4 ")
        r.keys("save,9\r")  # keys wait until the robot stands; a space would be the break
        assert r.board.operations == operations and fields(ask(r, "@where"))["missed"] == missed


def test_reset_restarts_the_controller():
    with robot(pages=PAGES) as r:
        resets = r.board.resets
        r.board.send(b"@reset\r")
        r.board.run(ms=1500)
        assert r.board.resets == resets + 1


MOVING_REFUSED = (
    "@open 0",
    "@open 2",
    "@data 64 0002",
    f"@save 1 0x{crc16(bytes(PAGES[1].data)):04X}",
    "@play 2",
    "@move 60 1 200",
    "@torque on",
    "@reset",
)
MOVING_ALLOWED = (
    "@ver",
    "@list 0 3",
    "@page 1",
    "@dense 1",
    "@crcs 0 3",
    "@pose",
    "@where",
    "@crc",
    "@watch 0",
    "@torque off 18",
    "@pause",
    "@resume",
    "@stop",
    "@break",
)


def test_what_must_not_be_while_something_moves_is_refused_and_the_rest_is_not():
    """Each request of PROTOCOL.md during a play. Trim, page and ticks must not change."""
    trimmed = {**PAGES, 0: page("Offset", [(0, {1: 512}), (0, {1: 612}), (0, {1: 100})])}
    with robot(pages=trimmed) as r:
        assert ask(r, "@play 1") == "@play OK"
        r.board.run(ms=1500)
        missed, resets, operations = fields(ask(r, "@where"))["missed"], r.board.resets, r.board.operations
        for request in MOVING_REFUSED:
            assert ask(r, request).split()[1:3] == ["ERR", "4"], request
        assert fields(ask(r, "@where"))["missed"] == missed and (r.board.resets, r.board.operations) == (resets, operations)
        assert ask(r, "@crc") == f"@crc {crc16(bytes(PAGES[1].data)):04X} OK"
        for request in MOVING_ALLOWED:
            assert ask(r, request, ms=400).endswith(" OK"), request


@pytest.mark.parametrize("typed", [True, False])
def test_save_of_page_0_puts_the_trim_in_force_typed_or_not(typed):
    data = page("Offset", [(0, {1: 512}), (0, {1: 562}), (0, {1: 50})]).data
    with robot(pages=PAGES) as r:
        ask(r, "@torque on", ms=300)
        assert ask(r, "@open 0") == "@open OK"
        for offset in range(0, 512, 32):
            ask(r, f"@data {offset} {data[offset : offset + 32].hex()}", ms=40)
        if typed:
            r.line("save", ms=1000)
            assert r.message.endswith("OK")
        else:
            assert ask(r, f"@save 0 0x{crc16(bytes(data)):04X}", ms=250) == "@save OK"
        assert ask(r, "@open 1") == "@open OK"
        assert ask(r, "@move 90 1 200") == "@move OK"
        r.board.run(ms=1500)
        assert r.board.servos[1].goal == 0x200 + 50


def test_crcs_of_all_pages():
    with robot(pages=PAGES) as r:
        start = r.board.now_ms
        r.board.take()
        r.board.send(b"@crcs\r")
        heard = b""
        while not heard.endswith(b"OK\r\n"):
            r.board.run(ms=5)
            heard += r.board.take().translate(None, b"\x11\x13")
        assert r.board.now_ms - start < 1000  # 20 s are allowed
        sums = heard.split()[-2].decode()
        assert sums == "".join(f"{crc16(r.flash_page(number)):04X}" for number in range(128))
        assert ask(r, "@crcs 1 2") == f"@crcs {sums[4:12]} OK"
        assert ask(r, "@crcs 1 128").startswith("@crcs ERR 3 ")


def watched(r, ms):
    """Words of the @now lines within `ms`."""
    r.board.take()
    r.board.run(ms=ms)
    return [line.split() for line in r.board.take().translate(None, b"\x11\x13").decode().split("\r\n")[1:-1] if line.startswith("@now")]


def test_watch_streams_goals_and_positions_and_costs_no_tick():
    with robot(pages=PAGES) as r:
        assert ask(r, "@watch 50") == "@watch OK"
        idle = watched(r, 1000)
        assert 19 <= len(idle) <= 21
        assert idle[-1][1:4] == ["0", "0", "0007FFFE"] and idle[-1][4] == "---200" * 18
        r.board.expect("@now", ms=100)
        r.board.expect("\r\n", ms=100)  # 26 ms are left until the next line
        assert ask(r, "@play 1", ms=20) == "@play OK"
        r.board.run(ms=1500)
        missed = fields(ask(r, "@where", ms=100))["missed"]
        lines = watched(r, 2000)
        assert 36 <= len(lines) <= 42 and {line[1] for line in lines} == {"1"}
        assert len({line[4][0:3] for line in lines}) > 15  # joint 1 is moving
        assert len({line[4][3:6] for line in lines}) > 8  # each servo is read once in 18 ticks
        assert fields(ask(r, "@where", ms=100))["missed"] == missed
        assert ask(r, "@watch 0") == "@watch OK"
        assert watched(r, 300) == []


def test_watch_ends_when_a_person_takes_the_screen():
    with robot(pages=PAGES) as r:
        assert ask(r, "@watch 50") == "@watch OK"
        r.board.run(ms=200)
        r.keys("\x1b[B", ms=900)
        assert r.text(1, 1, 9) == "Dynamixel" and watched(r, 300) == []


def test_a_line_that_is_typed_while_a_program_moves_the_robot_is_carried_out_or_refused():
    with robot(pages=PAGES) as r:
        r.line("on")
        r.board.send(request("@move 60 1 3FF"))
        r.board.run(ms=300)
        assert r.line("save") == "save Something moves"
        r.keys("]1 ")  # not a line: these keys would edit
        assert r.board.servos[1].torque
        r.line("off")
        assert not any(r.board.servos[joint].torque for joint in range(1, 19))


# ---- a program's motion while a person types ----

# With commas: a space would break the play.
WORDS = (
    "page,2 next before copy,2 new save exit name,x step,1 go,0 write insert,1 delete move,0,1 swap,0,1 paste mirror,0 set,1 on play "
    "time speed undo redo"
).split()
HARMLESS = "take,0 pairs monitor goto,1,2 list,1,2 help re rows,35 hex dec off,3".split()


def test_lines_that_a_play_needs_unchanged_are_refused_while_a_program_plays():
    with robot(pages=PAGES) as r:
        r.board.send(request("@play 1"))
        r.board.run(ms=1500)
        for line in WORDS:
            assert r.line(line) == f"{line} Something moves"
        for line in HARMLESS:
            assert "Something moves" not in r.line(line), line
            r.keys("q" if line in ("list,1,2", "help") else "")
        assert fields(ask(r, "@where"))["state"] == "playing" and r.ram_page() == bytes(PAGES[1].data)


@pytest.fixture(name="short")
def _short():
    """A robot with a play that ends with joint 1 at 421 (page 3), one that takes it to 600 from there (4), a long one (1), and a trim of
    50 for joint 1 in page 0."""
    trim = page("Offset", [(0, {1: 512}), (0, {1: 562}), (0, {1: 50})])
    with robot(pages={**PAGES, 3: page("short", [(20, {1: 421})]), 4: page("on", [(10, {1: 421}), (128, {1: 600})]), 0: trim}) as r:
        yield r


def program_plays(r, typed=""):
    """A program plays page 3 while the person has typed this. The goal of joint 1 afterwards."""
    r.keys(request("@play 3"))
    r.keys(typed, ms=2500)
    return r.board.servos[1].goal


def test_the_end_of_a_programs_play_does_not_end_the_next_one(short):
    """The rate is for this play: the end of an earlier one does not take it away."""
    program_plays(short, "play")
    short.board.clear_trace()
    short.keys(" 4 50\r", ms=4000)
    assert short.message == "Page 4 step 1 repetition 1 OK"
    way = [(frame.tick, frame.goals[1] - 50) for frame in short.board.trace if 1 in frame.goals]
    ticks = min(tick for tick, goal in way if goal == 600) - max(tick for tick, goal in way if goal == 421)
    assert 200 < ticks <= 2 * 128  # a ramp begins and ends with ticks without a change


def test_a_move_by_one_unit_moves():
    with robot(pages=PAGES) as r:
        for target in (513, 515, 518, 516):
            assert ask(r, f"@move 20 5 {target:03X}") == "@move OK"
            r.board.run(ms=500)
            assert r.board.servos[5].goal == target


def test_behind_a_play_nothing_has_a_goal_and_a_move_has_no_page(short):
    """PROTOCOL.md: `---` means that nothing drives the joint; a move plays no page."""
    program_plays(short)
    assert ask(short, "@watch 50") == "@watch OK"
    page_, step, _, joints = watched(short, 300)[-1][1:]
    assert (page_, step) == ("0", "0") and {joints[at : at + 3] for at in range(0, len(joints), 6)} == {"---"}
    assert ask(short, "@move 30 1 3A0") == "@move OK"
    where = fields(ask(short, "@where"))
    assert where["state"] != "idle" and where["page"] == "0"
    assert {tuple(line[1:3]) for line in watched(short, 500)} == {("0", "0")}


def test_write_and_keys_take_the_pose_in_which_a_programs_play_ended(short):
    assert program_plays(short, "write") == 421 + 50
    short.line(" 5")
    assert short.cell(0, 1) == short.cell(6, 1) == "0421"
    short.line("goto 0 1")
    short.line("list 1 2")
    program_plays(short)
    short.keys("]")
    assert short.board.servos[1].goal == 422 + 50


def test_a_programs_plays_have_the_trim_and_its_moves_none_while_page_0_is_open(short):
    """Page 0 is edited without trim."""
    short.line("page 0")
    assert program_plays(short) == 421 + 50
    short.keys(request("@play 1"), ms=500)
    short.keys(" ", ms=1000)
    assert program_plays(short) == 421 + 50
    short.keys(request("@play 3"))
    assert program_plays(short) == 421 + 50  # refused, and the trim stays
    short.keys(request("@move 90 1 1A5"), ms=2500)
    assert short.board.servos[1].goal == 0x1A5 and short.cell(0, 1) == "0421"
    short.line("page 1")
    assert short.cell(0, 1) == "0371"
