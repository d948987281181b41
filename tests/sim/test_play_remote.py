# SPDX-License-Identifier: MIT
"""A held button of the remote: only a press starts a play. The remote repeats its packet every 50 ms. All cases, also of the panel and of
chords, are in tests/unit/test_inputs.c; these have the performer and the shipped image behind it."""

import pytest

from tests.sim.play_robot import STOP, UP, ask, press_start, robot

BUTTON_1 = 16  # bow
REPEAT_MS = 50


def hold(board, buttons, ms):
    """The board's output while the buttons are held."""
    start = len(board.console)
    for _ in range(ms // REPEAT_MS):
        board.rc(buttons)
        board.run(ms=REPEAT_MS)
    return board.console[start:].decode("latin-1")


def starts(text):
    """Number of plays started, counted by their first pages."""
    return text.count("Playing page 2 (bow) step 1") + text.count("Playing page 3 (walk start) step 1")


def held_play(mode="latch"):
    board = robot()
    ask(board, f"remote {mode}")
    text = ""
    for _ in range(200):
        text += hold(board, BUTTON_1, REPEAT_MS)
        if "Playing" in text:
            return board
    raise AssertionError(text)


def by_word(word):
    def say(board):
        board.send(word + "\r")

    return say


def by_button_6(board):
    board.rc(BUTTON_1 | STOP)
    board.run(ms=REPEAT_MS)


ENDS = {"START": (press_start, "drive"), "break": (by_word("break"), "latch"), "button 6": (by_button_6, "hold")}


@pytest.mark.parametrize("end, mode", ENDS.values(), ids=ENDS)
def test_a_held_button_does_not_start_again_what_was_ended(end, mode):
    board = held_play(mode)
    end(board)
    text = hold(board, BUTTON_1, 4000)
    assert "after page 2 (bow)" in text or "in page 2 (bow)" in text, text
    assert starts(text) == 0, text
    goals = [servo.goal for servo in board.servos]
    hold(board, BUTTON_1, 1000)
    assert [servo.goal for servo in board.servos] == goals


def test_a_press_starts_again():
    board = held_play()
    by_word("break")(board)
    assert starts(hold(board, BUTTON_1, 2000)) == 0
    hold(board, 0, 2 * REPEAT_MS)
    assert starts(hold(board, BUTTON_1, 1000)) == 1


@pytest.mark.parametrize("start", ["power", "MODE"])
def test_a_button_held_at_the_start_moves_nothing_until_it_was_up(start):
    board = robot()
    if start == "power":
        board.power_off()
        board.run(ms=500)
        board.power_on()
    else:
        board.reset()
    board.clear_trace()
    text = hold(board, BUTTON_1, 4000)
    assert "18 servos" in text and starts(text) == 0, text
    assert not any(servo.torque for servo in board.servos)
    hold(board, 0, 2 * REPEAT_MS)
    assert starts(hold(board, BUTTON_1, 4000)) == 1


@pytest.mark.parametrize("mode, packets", [("latch", 1), ("hold", 6)])
def test_a_thumb_on_one_remote_does_not_undo_the_stop_of_another(mode, packets):
    """Their packets, on one channel, look like those of one remote."""
    board = robot()
    ask(board, f"remote {mode}")
    assert "Page 4 step 2" in hold(board, UP, 5000)
    start = len(board.console)
    for _ in range(packets):
        for buttons in (STOP, UP):
            board.rc(buttons)
            board.run(ms=REPEAT_MS // 2)
    board.rc(0)
    board.run(ms=REPEAT_MS // 2)
    hold(board, UP, 6000)
    text = board.console[start:].decode("latin-1")
    assert "Stopped after page 5 (walk stop)" in text and "Broken" not in text and starts(text) == 0, text
    assert ask(board, "status").startswith("Nothing is playing")
    hold(board, 0, 2 * REPEAT_MS)
    assert starts(hold(board, UP, 2000)) == 1
