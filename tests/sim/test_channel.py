# SPDX-License-Identifier: MIT
"""The programs' channel (firmware/common/PROTOCOL.md): a user types in every mode of Edit and Play while a program sends requests at random
moments. The same input is typed once more without the program. The terminal must show the same after each step, and each request must be
answered, or refused by its name, in time. M512_CHANNEL_SEEDS sets the number of seeds, default 1."""

import os
import random

import pytest

from m512.files.image import Image
from tests.sim import edit_robot, play_robot
from tests.sim.channel import Ear, request
from tests.sim.made_page import page

SEEDS = int(os.environ.get("M512_CHANNEL_SEEDS", "1"))
BYTE_MS = 10 / 57.6
# A request waits for output that a user has started: a whole screen of Edit takes 0.5 s, Play's help 0.4 s.
WAIT_MS = 700
CUT_OFF_MS = 250
SETTLE_MS = 500  # of a step
PLAY_MS = 1200  # the play of the page, including its approach
MANY = 6  # requests without a pause between them
SERVOS = (1, 2, 3, 4)

PAGES = {
    1: page("one", [(20, {1: 480}), (25, {1: 520, 2: 500}), (25, {1: 500, 2: 520})]),
    2: page("two", [(30, {})]),
    **{n: page(f"page {n}", [(30, {1: 500 + n})]) for n in range(20, 70)},
}

FULL = {n: page(f"thirteen {n:04}", [(30, {1: 500})]) for n in range(128)}

# (input, split where a program may send; expected terminal text, or None)
UP, DOWN, PAGE_UP = [b"\x1b", b"[", b"A"], [b"\x1b", b"[B"], [b"\x1b[", b"5", b"~"]
EDIT = [
    ("a table", [*DOWN, *DOWN, *UP, *PAGE_UP, *DOWN, b"]", b"["], None),
    ("a command", list("goto 1 3\r"), None),
    ("an edit", list("set 700\r"), "* unsaved"),
    ("half a line", list("pge\b\bag"), "pag"),
    ("the other half", list("e 2\r"), "[y/N]"),
    ("the answer", ["n"], "no"),
    ("a line that is emptied", [*"new 5", b"\x15", *"re"], "re"),
    ("a line from before", [b"\x03", *"s", *UP], "page 2"),
    ("a line that is left", [b"\x03"], None),
    ("a name", list("name\r"), "name:"),
    ("half a name", list("wa@v"), "wa@v"),
    ("the rest of it", list("e\r"), "wa@ve"),
    ("a list, typed ahead of", [*"list\r", " "], "-- more"),
    ("its end", ["q"], None),
    ("help", list("help\r"), "-- more"),
    ("more of it", [" "], None),
    ("away from it", ["q"], None),
    ("a list of one page", list("list 1\r"), "-- end --"),
    ("behind it", ["\r"], None),
    ("a question, typed ahead of", [b"page 2\r", b"y", b"es\r"], "[y/N]"),
    ("its answer", ["\r"], "no"),
    ("a play", [*"play 2\r", *"xyz"], None),
    ("a line behind it", list("set 701\r"), None),
    ("a request by hand", list("@cr"), None),
    ("the rest of that", list("c\r"), "@crc"),
    ("the screen again", DOWN, "* unsaved"),
]
PLAY = [
    ("half a line", list("setx\btings ta"), "settings ta"),
    ("the other half", list("lk\r"), None),
    ("a list", list("list\r"), "page 69"),
    ("help, typed ahead of", list("help\rver"), "ver"),
    ("the line typed ahead", list("sion\r"), "Motion512"),
    ("a line from before", UP, "version"),
    ("another", [b"\x15", *"law"], "law"),
    ("its end", list("\r"), "exact"),
    ("a play", list("play 2\r"), None),
    ("half a line in it", list("la"), "la"),
    ("the rest", list("w\r"), "exact"),
    ("a request by hand", list("@pag"), "@pag"),
    ("the rest of that", list("e 200\r"), "@page ERR 3"),
]
ASKED = ("@where", "@ver", "@pose", "@list 1 3", "@page 1", "@dense 2", "@crcs 0 20", "@crcs 0 127", "@watch 0", "@nonsense", "@page 300", "@where 1")
ASKED_EDIT = (*ASKED, "@crc", "@data 9999 00", "@save 3 0x1")


class EditSide:
    """Edit and its screen."""

    def __init__(self, pages=PAGES):
        self.robot = edit_robot.robot(pages=pages, servos=SERVOS)
        self.board, self.steps, self.asked = self.robot.board, EDIT, ASKED_EDIT
        self.ear = Ear()

    def show(self, data):
        self.robot.terminal.feed(data)

    def pump(self):
        self.show(self.ear.hear(self.board.take()))
        while self.robot.terminal.answers:
            self.board.send(self.robot.terminal.answers.pop(0).encode())

    def picture(self):
        return "\n".join(self.robot.terminal.screen.display), self.robot.cursor


class PlaySide:
    """Play and the output on its terminal."""

    def __init__(self, pages=PAGES):
        image = Image.empty()
        for number, made in pages.items():
            image[number] = made
        self.board, self.steps, self.asked = play_robot.robot(SERVOS, image.to_bytes()), PLAY, ASKED
        self.ear, self.text = Ear(), b""
        self.board.take()

    def show(self, data):
        self.text += data

    def pump(self):
        self.show(self.ear.hear(self.board.take()))

    def picture(self):
        return play_robot.shown(self.text), len(self.text.rpartition(b"\n")[2])


class Program:
    """Sends random requests when `may_ask` is called, one at a time; sometimes several, each when the one before it is answered."""

    def __init__(self, side, seed):
        self.side, self.rng = side, random.Random(seed)
        self.since, self.open, self.longest, self.count, self.more = 0.0, None, 0.0, 0, 0
        self.resets = side.board.resets

    def may_ask(self):
        if self.open is None and self.rng.random() < 0.4:
            self.more = self.rng.choice((0, 0, 0, MANY))
            self.ask()

    def ask(self):
        self.open = self.rng.choice(self.side.asked)
        self.since = self.side.board.now_ms
        self.side.board.send(request(self.open))

    def listen(self):
        if self.open is None:
            return
        on_the_line = (len(self.open) + 7 + self.side.board.waiting) * BYTE_MS
        if self.side.ear.answers:
            [answer] = self.side.ear.answers
            self.side.ear.answers.clear()
            assert answer.split()[0] == self.open.split()[0] and (answer.endswith(" OK") or " ERR " in answer), answer
            assert " ERR 15 " not in answer, answer
            self.longest = max(self.longest, self.side.board.now_ms - self.since - len(answer) * BYTE_MS - on_the_line)
            self.open, self.count = None, self.count + 1
            if self.more:
                self.more -= 1
                self.ask()
        else:
            assert self.side.board.now_ms - self.since < WAIT_MS + 1500, f"{self.open}: no answer"
            assert self.side.board.resets == self.resets, f"{self.open}: reset by {self.side.board.reset_cause}"


def typed(side, seed, with_program):
    """The pictures after each step, and the program's figures."""
    hands, program = random.Random(seed), Program(side, seed if with_program else None)
    pictures = []

    def run(ms):
        for _ in range(ms):
            side.board.run(ms=1)
            side.pump()
            program.listen()

    for what, keys, shows in side.steps:
        for key in keys:
            side.board.send(key)
            if with_program:
                program.may_ask()
            # No pause within a key; sometimes one between keys.
            is_part = isinstance(key, bytes) and len(keys) > 1
            run(0 if is_part else hands.choice((0, 0, 1, 3, 40)))
        for _ in range((PLAY_MS if what == "a play" else SETTLE_MS) // 100):
            if with_program:
                program.may_ask()
            run(100)
        while program.open is not None:
            run(1)
        run(SETTLE_MS)  # a list goes on after the last request
        pictures.append((what, *side.picture()))
        assert shows is None or shows in pictures[-1][1], f"{what}: {pictures[-1][1]}"
    return pictures, program


@pytest.mark.parametrize("seed", range(SEEDS))
@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_a_program_that_asks_changes_nothing_for_a_person(side, seed):
    alone, _ = typed(side(), seed, False)
    together, program = typed(side(), seed, True)
    for mine, its in zip(alone, together, strict=True):
        assert its == mine, f"seed {seed}: {mine[0]}"
    print(f"{side.__name__}, seed {seed}: {program.count} requests, the longest wait {program.longest:.0f} ms")
    assert program.count > len(alone) and program.longest < WAIT_MS


@pytest.mark.parametrize(
    "side, first, asked, at_once",
    [
        (EditSide, "list", "@crcs 0 127", 3),
        (EditSide, "list", "@list", 1),
        (EditSide, "help", "@dense 12", 3),
        (EditSide, "re", "@list", 3),
        (EditSide, "play 2", "@list", 3),
        (EditSide, "", "@crcs 0 127", 1),
        (PlaySide, "list", "@list", 3),
        (PlaySide, "help", "@crcs 0 127", 1),
    ],
)
def test_requests_without_a_pause_between_them_restart_nothing(side, first, asked, at_once):
    """While text is printed, each of them after the answer to the one before it, or three at a time."""
    side = side(FULL)
    board, ear = side.board, side.ear
    is_edit = isinstance(side, EditSide)
    if is_edit:
        side.robot.line("step 6")
        assert side.robot.unsaved
    resets, end = board.resets, board.now_ms + 1300
    board.send(first + "\r")
    board.run(ms=60)
    waiting = 0
    while board.now_ms < end or waiting:
        if waiting < at_once and board.now_ms < end:
            board.send(request(asked))
            waiting += 1
        board.run(ms=2)
        side.pump()
        assert board.resets == resets, f"{asked} at {board.now_ms - end + 1300:.0f} ms: reset by {board.reset_cause}"
        assert all(answer.endswith(" OK") for answer in ear.answers), ear.answers
        waiting -= len(ear.answers)
        ear.answers.clear()
    if is_edit:
        side.robot.settle(1000)
        side.robot.keys("q")
        side.robot.settle(1000)
        assert side.robot.unsaved


@pytest.mark.parametrize(
    "side, line", [(EditSide, "@list"), (EditSide, "list"), (EditSide, "re"), (EditSide, "on"), (PlaySide, "@page 12"), (PlaySide, "help")]
)
def test_lines_typed_ahead_restart_nothing(side, line):
    """The answer to one @list takes 0.5 s, and 32 bytes of typing hold five of them."""
    side = side(FULL)
    resets = side.board.resets
    for _ in range(30):
        while side.board.waiting < 60:
            side.board.send(line + "\r")
        side.board.run(ms=100)
        side.pump()
        assert side.board.resets == resets, f"reset by {side.board.reset_cause}"


def answers_to(side, data, ms=400):
    """The answers to the program, and the terminal's output meanwhile."""
    side.pump()
    side.board.send(data, wait=True)
    side.board.run(ms=ms)
    shown = side.ear.hear(side.board.take())
    side.show(shown)
    answers = list(side.ear.answers)
    side.ear.answers.clear()
    return answers, shown.decode("latin-1")


@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_a_request_that_has_lost_a_byte_is_refused_by_name(side):
    side = side()
    before = bytes(side.board.flash[0xC000:0x1E000])
    whole = request("@save 31 0x1")
    for lost in range(1, len(whole) - 1):
        answers, shown = answers_to(side, whole[:lost] + whole[lost + 1 :])
        assert len(answers) == 1 and shown == "", lost
        word = (whole[1:lost] + whole[lost + 1 :]).decode().split()[0]
        assert answers[0] == f"{word} ERR 15 Bytes of this line were lost: nothing was done", lost
    # The CRC shows that only the CR is missing. Without its first byte it is an ordinary line with one word too many.
    assert " ERR 15 " not in answers_to(side, whole[:-1])[0][0]
    answers, shown = answers_to(side, whole[1:])
    assert answers == [] and "@save ERR " in shown
    assert bytes(side.board.flash[0xC000:0x1E000]) == before
    assert answers_to(side, request("@nonsense"))[0] == ["@nonsense ERR 1 Unknown word"]


@pytest.mark.parametrize("schedule, label", [(0, "Speed           ["), (10, "Time( x 7.8mSec)[")])
def test_data_that_makes_speeds_of_times_or_the_reverse_changes_the_label(schedule, label):
    side = EditSide()
    side.robot.line("speed" if schedule else "time")
    assert label not in side.picture()[0]
    assert answers_to(side, request(f"@data 16 {schedule:02x}"))[0] == ["@data OK"]
    assert label in side.picture()[0]


@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_the_longest_line_is_taken_and_a_longer_one_refused(side):
    side = side()
    for blanks, answer in ((99, "@where state=idle"), (100, "@where ERR 15")):
        data = request("@where" + " " * blanks)
        assert len(data) == 2 + 11 + blanks  # 110 characters between the first byte and CR
        answers, _ = answers_to(side, data)
        assert len(answers) == 1 and answers[0].startswith(answer)


@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_a_request_that_is_cut_off_is_refused_and_the_line_is_free_again(side):
    side = side()
    side.board.send(b"\x1e@wh")
    side.board.run(ms=CUT_OFF_MS - 20)
    assert answers_to(side, b"", 0)[0] == []
    assert answers_to(side, b"", 60)[0] == ["@wh ERR 15 Bytes of this line were lost: nothing was done"]
    assert "list" in answers_to(side, b"list")[1]


def test_edit_opens_no_page_while_a_person_answers_for_another():
    side = EditSide()
    r = side.robot
    r.line("name")
    assert r.message.endswith("name:")
    assert answers_to(side, request("@open 2"))[0] == ["@open ERR 16 Edit waits for an answer on its terminal"]
    r.keys("\x03")
    r.line("new")
    assert "[y/N]" in r.command
    assert answers_to(side, request("@open 2"))[0] == ["@open ERR 16 Edit waits for an answer on its terminal"]
    r.keys("n")
    assert answers_to(side, request("@open 2"))[0] == ["@open OK"]
    r.settle(300)
    assert r.text(2, 76, 4) == "0002"


@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_a_watch_goes_to_the_program_and_stays_while_a_person_types(side):
    side = side()
    assert answers_to(side, request("@watch 50"), 20)[0] == ["@watch OK"]
    side.board.run(ms=1000)
    side.pump()
    assert 18 <= len(side.ear.answers) <= 21 and {answer.split()[0] for answer in side.ear.answers} == {"@now"}
    side.ear.answers.clear()
    shown = answers_to(side, b"hel", 1000)[1]
    assert shown.endswith("l") and "@" not in shown
    answers, _ = answers_to(side, b"", 1000)
    assert 18 <= len(answers) <= 22
    assert answers_to(side, request("@watch 0"), 60)[0][-1] == "@watch OK"
    assert answers_to(side, b"", 300)[0] == []


@pytest.mark.parametrize("side", [EditSide, PlaySide])
def test_a_watch_that_asks_for_more_than_50_ms_allow_gets_that(side):
    side = side()
    assert answers_to(side, request("@watch 1"), 20)[0] == ["@watch OK"]
    assert 18 <= len(answers_to(side, b"", 1000)[0]) <= 22


def test_a_list_that_is_printed_keeps_no_program_waiting():
    side = EditSide()
    side.board.send(b"list\r")
    side.board.run(ms=60)
    start = side.board.now_ms
    side.board.send(request("@where"))
    while not side.ear.answers and side.board.now_ms - start < 300:
        side.board.run(ms=1)
        side.pump()
    assert side.board.now_ms - start < 60  # the bytes of request and answer, and one line of the list
    assert "-- more" not in side.picture()[0]


def test_a_long_answer_within_a_key_leaves_it_one_key():
    """ESC alone counts as a key after 50 ms; @crcs takes 250 ms."""
    side = EditSide()
    row, column = side.robot.cursor
    answers, _ = answers_to(side, b"\x1b" + request("@crcs") + b"[B", 900)
    assert len(answers) == 1 and side.robot.cursor == (row + 1, column) and not side.robot.unsaved
