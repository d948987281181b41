# SPDX-License-Identifier: MIT
"""Keys and a stick become `@drive` lines; the shape of a play from the command line."""

import os
import sys
import time
import tty

import pytest

from m512.board import driving
from m512.errors import BoardError, CancelledError, NoAnswerError


class Line:
    def __init__(self):
        self.time = 0.0

    def now(self):
        return self.time

    def sleep(self, seconds):
        self.time += seconds


class Board:
    def __init__(self, link, fails_from=None, refuses="", ends_at=None):
        self.asked, self.link, self.fails_from, self.refuses, self.ends_at = [], link, fails_from, refuses, ends_at

    def ask(self, request, seconds=3.0, tries=3):
        self.asked.append((round(self.link.now(), 3), request))
        if self.fails_from is not None and len(self.asked) >= self.fails_from:
            self.link.sleep(seconds * tries)
            raise NoAnswerError("no answer")
        if self.refuses and request.startswith(self.refuses):
            raise BoardError("Nothing is playing", 14)
        return ""

    def where(self, *_):
        return {"state": "idle" if self.ends_at is not None and self.link.now() >= self.ends_at else "playing"}


class Script(driving.Keys):
    """Presses keys at given times."""

    def __init__(self, keys):
        super().__init__()
        self.keys, self.time = list(keys), 0.0

    def update(self, stick, seconds):
        self.time += seconds
        while self.keys and self.keys[0][0] <= self.time + 1e-9:
            self.press(self.keys.pop(0)[1])
        super().update(stick, seconds)


def play(keys, layer=0, **options):
    link = Line()
    board = Board(link, **options)
    driving.drive(board, Script(keys), link, lambda stick: None, layer)
    return board.asked


def test_drive_sends_twenty_lines_a_second_and_stops_softly():
    asked = play([(1.0, " ")])
    lines = [at for at, request in asked if request.startswith("drive")]
    assert all(abs(b - a - 0.05) < 1e-6 for a, b in zip(lines, lines[1:])) and len(lines) == 21
    assert asked[0][1] == "drive 0 100 100" and asked[-1][1] == "stop"


def test_drive_steers_while_a_key_repeats_and_goes_straight_when_it_ends():
    asked = dict(play([(0.0, "d"), (0.05, "d"), (0.1, "d"), (0.15, "d"), (0.2, "d"), (0.3, "w"), (3.0, "x")]))
    assert asked[0.2] == "drive 100 100 100"  # 5 x 25, at most 100
    assert asked[0.4] == "drive 88 110 100"  # returns by 60 percent per second, from 0.2 s on
    assert asked[2.9] == "drive 0 110 100"
    assert play([(0.1, "x")])[-1][1] == "break"


def test_drive_lays_a_second_page_over_the_walk_and_takes_it_off():
    asked = [request for _, request in play([(0.2, "f"), (0.6, "f"), (1.0, "F"), (1.5, " ")], layer=60) if not request.startswith("drive")]
    assert asked == ["layer 60", "layer off", "layer 60", "stop"]
    assert not any("layer" in request for _, request in play([(0.2, "f"), (1.0, " ")]))


def test_a_layer_that_is_refused_is_told_and_the_walk_goes_on():
    link, told = Line(), []
    board = Board(link, refuses="layer")
    driving.drive(board, Script([(0.2, "f"), (1.0, " ")]), link, lambda stick: told.append(stick.said), 60)
    assert "Nothing is playing" in told and board.asked[-1][1] == "stop"
    assert len([1 for _, request in board.asked if request.startswith("drive")]) == 21


def test_drive_ends_when_the_play_has_ended():
    asked = play([], ends_at=2.0)
    assert 2.0 <= asked[-1][0] <= 3.1 and asked[-1][1].startswith("drive")


def test_drive_that_fails_stops_the_robot():
    link = Line()
    board = Board(link, fails_from=3)
    with pytest.raises(NoAnswerError):
        driving.drive(board, Script([]), link, lambda stick: None)
    assert board.asked[-1][1] == "stop" and link.now() < 5


@pytest.mark.parametrize("press_s", [0.05, 0.1, 0.9, 1.6, 2.3])
def test_ctrl_c_ends_the_drive_of_a_board_that_has_lost_its_power(press_s):
    link = Line()
    board = Board(link, fails_from=3)
    with pytest.raises(CancelledError, match="stopped by Ctrl-C, but no answer"):
        driving.drive(board, Script([(press_s, "\x03")]), link, lambda stick: None)
    assert board.asked[-1][1] == "break" and link.now() - press_s < 2


def test_a_line_without_an_answer_does_not_end_the_drive():
    link = Line()
    board = Interrupted(link, drive=[NoAnswerError("no answer to @drive")] * 3)
    driving.drive(board, Script([(1.0, " ")]), link, lambda stick: None)
    assert [request for _, request in board.asked][-1] == "stop" and len(board.asked) > 20


@pytest.mark.parametrize("at, last", [(4, "stop"), (5, "break")])
def test_a_second_ctrl_c_ends_the_drive_of_a_silent_board_at_once(at, last):
    """at: the request during which it comes. That is a line before the first Ctrl-C is looked at, or the stop of the first."""

    class Interrupts(Board):
        def ask(self, request, seconds=3.0, tries=3):
            if len(self.asked) + 1 == at:
                self.asked.append((self.link.now(), request))
                raise KeyboardInterrupt
            return super().ask(request, seconds, tries)

    link = Line()
    board = Interrupts(link, fails_from=3)
    with pytest.raises(KeyboardInterrupt):
        driving.drive(board, Script([(1.0, "\x03")]), link, lambda stick: None)
    assert board.asked[at - 1][1].startswith("drive" if at == 4 else "break")
    assert [request for _, request in board.asked[at:]] == [last] and link.now() - board.asked[at - 1][0] < 1


class Interrupted(Board):
    """Ends m512 in other ways while it waits for the answers to these requests."""

    def __init__(self, link, **ended):
        super().__init__(link)
        self.ended = {word: list(errors) for word, errors in ended.items()}

    def ask(self, request, *limits, **more):
        super().ask(request, *limits, **more)
        if self.ended.get(request.split()[0]):
            raise self.ended[request.split()[0]].pop(0)
        return ""

    def play(self):
        self.ask("play 1")


@pytest.mark.parametrize("error", [KeyboardInterrupt(), SystemExit(143), NoAnswerError("no answer")])
def test_a_drive_that_ends_while_its_start_is_answered_stops_the_robot(error):
    link = Line()
    board = Interrupted(link, play=[error])
    with pytest.raises(type(error)):
        driving.drive(board, Script([]), link, lambda stick: None, begin=board.play)
    assert [request for _, request in board.asked] == ["play 1", "stop"]


def test_a_drive_whose_page_is_refused_stops_nothing():
    link = Line()
    board = Interrupted(link, play=[BoardError("Not while something plays", 4)])
    with pytest.raises(BoardError):
        driving.drive(board, Script([]), link, lambda stick: None, begin=board.play)
    assert [request for _, request in board.asked] == ["play 1"]


def test_a_second_ctrl_c_while_the_stop_of_a_drive_is_answered_stops_at_once():
    link = Line()
    board = Interrupted(link, drive=[KeyboardInterrupt()], stop=[KeyboardInterrupt()])
    with pytest.raises(KeyboardInterrupt):
        driving.drive(board, Script([]), link, lambda stick: None)
    assert [request for _, request in board.asked][-2:] == ["stop", "break"]


def test_a_drive_without_an_answer_tells_the_first_reason():
    link = Line()
    board = Interrupted(link, drive=[NoAnswerError("no answer to @drive")] * 4, stop=[NoAnswerError("no answer to @stop")])
    with pytest.raises(NoAnswerError, match="no answer to @drive"):
        driving.drive(board, Script([]), link, lambda stick: None)


@pytest.fixture
def keyboard(monkeypatch):
    """The writing end of a terminal that is this process's standard input."""
    master, slave = os.openpty()
    tty.setraw(slave)
    monkeypatch.setattr(sys, "stdin", open(slave, encoding="utf-8"))
    monkeypatch.setattr("atexit.register", lambda function: function)  # the console's own, for this descriptor
    yield master
    os.close(master)


def driven_by(keys_of, master, typed):
    """What `drive` asks of the board while these bytes are typed. It fails after ten seconds without an end."""
    link, deadline = Line(), time.monotonic() + 10
    board = Board(link)

    def told(stick):
        assert time.monotonic() < deadline, "the robot walks on"
        time.sleep(0.002)

    with keys_of() as keys:
        os.write(master, typed)
        driving.drive(board, keys, link, told)
    return [request for _, request in board.asked]


@pytest.mark.parametrize("byte", [b"\xf6", b"\xe1", b"\xff"])
def test_a_key_that_is_no_utf8_does_not_end_the_keyboard(keyboard, byte):
    """Terminals that are set to Latin-1 send such bytes, and some send them for Alt with a key."""
    from m512.cli.shape import _keys

    assert driven_by(_keys, keyboard, b"w" + byte + b"x")[-1] == "break"


def test_a_second_ctrl_c_interrupts_whatever_is_awaited(keyboard, monkeypatch):
    import _thread

    from m512.cli.shape import _keys

    came, deadline = [], time.monotonic() + 20
    monkeypatch.setattr(_thread, "interrupt_main", lambda: came.append("interrupt"))
    with _keys() as keys:
        monkeypatch.setattr(keys, "press", came.append)
        os.write(keyboard, b"w\x03\x03\x03!")
        while "!" not in came and time.monotonic() < deadline:
            time.sleep(0.002)
    assert came == ["w", "\x03", "interrupt", "\x03", "interrupt", "\x03", "!"]


def test_a_drive_whose_keyboard_ends_is_stopped(keyboard, monkeypatch, capsys):
    from serial.tools.miniterm import Console

    from m512.cli.shape import _keys

    for end in ("", OSError(5, "Input/output error"), ValueError("I/O operation on closed file")):

        def getkey(_, end=end):
            if isinstance(end, Exception):
                raise end
            return end

        monkeypatch.setattr(Console, "getkey", getkey)
        assert driven_by(_keys, keyboard, b"")[-1] == "stop"
        assert "the keyboard has ended" in capsys.readouterr().err


# What xterm, the Linux console and rxvt send for these keys.
STEERING = {"d": ["\x1b[C", "\x1bOC", "\x1b[1;5C"], "a": ["\x1b[D", "\x1bOD"], "w": ["\x1b[A", "\x1bOA"], "s": ["\x1b[B", "\x1bOB"]}
OTHER = ["\x1b[F", "\x1bOF", "\x1b[4~", "\x1bOS", "\x1b[14~", "\x1bOQ", "\x1b[[B", "\x1b[[D", "\x1b[H", "\x1b[3~", "\x1b[24;2~", "\x1b[7^", "\x1b"]


def after(*presses):
    keys, stick = driving.Keys(), driving.Stick()
    for pressed in presses:
        for char in pressed:
            keys.press(char)
        keys.update(stick, 0.0)
    return stick


@pytest.mark.parametrize("letter", STEERING)
def test_arrows_steer_as_their_letters_do(letter):
    for sequence in STEERING[letter]:
        assert after(sequence) == after(letter), sequence
        assert after(sequence * 2) == after(letter * 2), sequence
        for cut in range(1, len(sequence)):  # a slow line delivers a key in pieces
            assert after(sequence[:cut], sequence[cut:]) == after(letter), sequence


@pytest.mark.parametrize("sequence", OTHER)
def test_other_keys_with_a_sequence_change_nothing(sequence):
    assert after(sequence) == driving.Stick()
    for cut in range(1, len(sequence)):
        assert after(sequence[:cut], sequence[cut:]) == driving.Stick()


@pytest.mark.parametrize("key, done", [(" ", "stop"), ("x", "break"), ("\x03", "break")])
def test_a_stop_counts_behind_any_key(key, done):
    for before in ("\x1b", *OTHER, *sum(STEERING.values(), [])):
        assert after(before + key).done == done and after(before, key).done == done, before


@pytest.mark.parametrize(
    "keys, done, cancelled", [(" x", "break", False), ("x ", "break", False), ("\x03 ", "break", True), ("\x03x", "break", True)]
)
def test_of_two_stops_the_stronger_one_counts(keys, done, cancelled):
    stick = after(keys)
    assert (stick.done, stick.cancelled) == (done, cancelled)


@pytest.mark.parametrize("key, code", [(" ", 0), ("x", 0), ("\x03", 130)])
def test_the_exit_code_tells_ctrl_c(m512, monkeypatch, key, code):
    from contextlib import contextmanager

    from m512.cli import shape

    class Robot(Board):
        motion, shape, play = staticmethod(lambda page: 1), staticmethod(dict), staticmethod(lambda number: None)

    @contextmanager
    def robot(_):
        yield Robot(Line())

    @contextmanager
    def keys():
        yield Script([(0.2, key)])

    monkeypatch.setattr(shape, "robot", robot)
    monkeypatch.setattr(shape, "_keys", keys)
    result = m512("drive", "walk", "-p", "x")
    assert result.exit_code == code, result.stderr


def test_drive_without_a_terminal_says_so(m512, monkeypatch):
    from contextlib import contextmanager

    from m512.cli import shape

    @contextmanager
    def robot(_):
        class Client:
            motion, shape = staticmethod(lambda page: 1), staticmethod(dict)

        yield Client()

    monkeypatch.setattr(shape, "robot", robot)
    result = m512("drive", "walk", "-p", "x")
    assert result.exit_code == 5 and "needs a terminal" in result.stderr
