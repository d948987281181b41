# SPDX-License-Identifier: MIT
"""No image executes a line of which bytes were lost, except `stop` and `break` in Play: the sender ignores XOFF, or a character has no
stop bit (for example, from a wrong baud rate). The image reports the loss."""

import pytest

from tests.sim.edit_robot import robot as edit
from tests.sim.monitor_robot import robot as monitor
from tests.sim.play_robot import ask, robot

LOST = "Bytes of this line were lost: nothing was done"
TOO_LONG = "ERR 15 The line is too long: nothing was done"


def garble(board, before, behind):
    """One character between these two arrives without a stop bit."""
    board.send(before, wait=True)
    board.run(ms=2)
    board.baud(38_400)
    board.send(b"\0", wait=True)
    board.run(ms=2)
    board.baud(57_143)
    board.send(behind, wait=True)
    board.run(ms=400)


def test_play_refuses_the_line():
    board = robot()
    board.take()
    garble(board, "settings ta", "lk 0\r")
    text = board.take().decode("latin-1")
    assert LOST in text and " OK" not in text
    assert " OK" in ask(board, "settings talk 0")  # the next line is complete


def test_play_refuses_a_program_line_and_ctrl_u_begins_anew():
    board = robot()
    board.take()
    garble(board, "@", "where 1\r")
    assert f"\n@where ERR 15 {LOST}\r\n" in board.take().decode("latin-1")
    garble(board, "@rc -1", "\x15@where\r")
    text = board.take().decode("latin-1")
    assert LOST not in text and "@where state=idle" in text


@pytest.mark.parametrize("word", ["stop", "BREAK"])
def test_play_obeys_stop_and_break_all_the_same(word):
    """The loss may be noise of long ago, before the line began; a robot that walks on because of it is worse than one that stops."""
    board = robot()
    ask(board, "play 4")
    board.run(ms=3000)
    board.take()
    garble(board, "", "")
    board.run(ms=3000)
    board.send(word + "\r")
    board.run(ms=6000)
    text = board.take().decode("latin-1")
    assert LOST not in text and " OK" in text
    assert "Nothing is playing" in ask(board, "stop")


@pytest.mark.parametrize(
    "before, behind, refusal, ends",
    [
        ("ser", "vstop\r", LOST, "Stopped after"),
        ("@ser", "vstop\r", "@servstop ERR 15 " + LOST, "Stopped after"),
        ("\x1e@sto", "stop\r", "ERR 15 " + LOST, "Stopped after"),
        ("ser", "vBREAK\r", LOST, "Broken off in"),
    ],
)
def test_play_stops_behind_a_piece_of_a_torn_line(before, behind, refusal, ends):
    board = robot()
    ask(board, "play 4")
    board.run(ms=3000)
    board.take()
    if before[0] == "\x1e":
        board.send(before + behind)
    else:
        garble(board, before, behind)
    assert refusal + "\r\nStopping all the same\r\n" in board.expect(ends, ms=6000)


@pytest.mark.parametrize("line", ["play 2\xffstop", "play 2?stop", "play stop"])
def test_play_stops_at_a_refused_line_that_ends_in_stop(line):
    board = robot()
    ask(board, "play 4")
    board.run(ms=3000)
    board.take()
    board.send(line.encode("latin-1") + b"\r")
    assert "Stopping all the same\r\n" in board.expect("Stopped after", ms=6000)
    board.run(ms=1000)
    assert "Stopping" not in ask(board, line)  # nothing moves


def test_play_goes_on_at_an_accepted_line_that_ends_in_stop():
    board = robot()
    ask(board, "play 4")
    board.run(ms=3000)
    assert ask(board, "help stop").startswith("stop  ")
    board.run(ms=3000)
    assert ask(board, "status").startswith("Playing page 4")


def test_play_does_not_make_one_line_of_two():
    """The sender ignores XOFF while a long list is printed. None of its lines restarts the robot, but two merged into `@reset` would."""
    board = robot()
    starts = len(board.console)
    for _ in range(30):
        board.send("@page 1\r" + "@where\r" * 9 + "@rc -100\rreset\r")
    board.send("", wait=True)
    board.run(ms=4000)
    text = board.console[starts:].decode("latin-1")
    assert LOST in text
    assert "Motion512" not in text, "it has restarted"
    assert "lost 0" not in ask(board, "faults")


@pytest.mark.parametrize("before, behind", [("se", "t 700\r"), ("", "set 700\r")])
def test_edit_refuses_the_line(before, behind):
    with edit() as r:
        r.line("goto 0 3")
        garble(r.board, before, behind)
        r.settle(300)
        assert LOST in r.message and r.board.servos[3].goal == 512
        r.line("set 700")
        r.settle(1000)
        assert r.board.servos[3].goal == 700


def test_edit_refuses_a_program_line():
    with edit() as r:
        r.board.send("@where\r", wait=True)
        r.board.run(ms=300)
        start = len(r.board.console)
        garble(r.board, "@mo", "ve 60 3 258\r")
        text = r.board.console[start:].decode("latin-1")
        assert f"@move ERR 15 {LOST}\r\n" in text and r.board.servos[3].goal == 512


def test_a_program_hears_that_its_line_is_too_long():
    board = robot()
    assert f"@data {TOO_LONG}" in ask(board, "@data 0 " + "0" * 120)
    with edit() as r:
        start = len(r.board.console)
        r.board.send("@data 0 " + "0" * 120 + "\r", wait=True)
        r.board.run(ms=300)
        assert f"@data {TOO_LONG}\r\n" in r.board.console[start:].decode("latin-1")


def test_monitor_refuses_the_line_and_says_when_it_is_too_long():
    board = monitor(servos=(1,))
    garble(board, "go 2", "00\r")
    assert LOST in board.take().decode("latin-1") and board.servos[1].goal == 512
    board.send("write 24" + " 1" * 60 + "\r", wait=True)
    board.run(ms=300)
    assert "too long: nothing was done" in board.take().decode("latin-1")
