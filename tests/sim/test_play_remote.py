# SPDX-License-Identifier: MIT
"""A held button of the remote: only a press starts a play. The remote repeats its packet every 50 ms."""

import pytest

from tests.sim.play_robot import DOWN, JOINTS, LEFT, STOP, UP, ask, press_start, robot

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


def held_play(mode="latch", buttons=BUTTON_1, before="Playing", **options):
    board = robot(**options)
    ask(board, f"remote {mode}")
    text = ""
    for _ in range(200):
        text += hold(board, buttons, REPEAT_MS)
        if before in text:
            return board
    raise AssertionError(text)


def by_word(word):
    def say(board):
        board.send(word + "\r")

    return say


def by_button_6(board):
    board.rc(BUTTON_1 | STOP)
    board.run(ms=REPEAT_MS)


ENDS = [press_start, by_word("stop"), by_word("break"), by_word("@stop"), by_word("@break"), by_button_6]


@pytest.mark.parametrize("mode", ["latch", "hold", "drive"])
@pytest.mark.parametrize("end", ENDS, ids=["START", "stop", "break", "@stop", "@break", "button 6"])
def test_a_held_button_does_not_start_again_what_was_ended(end, mode):
    board = held_play(mode)
    end(board)
    text = hold(board, BUTTON_1, 4000)
    assert "after page 2 (bow)" in text or "in page 2 (bow)" in text, text
    assert starts(text) == 0, text
    goals = [servo.goal for servo in board.servos]
    hold(board, BUTTON_1, 1000)
    assert [servo.goal for servo in board.servos] == goals


@pytest.mark.parametrize("mode", ["latch", "hold", "drive"])
@pytest.mark.parametrize("between", ["release", "silence", "another code"])
def test_a_press_starts_again(between, mode):
    board = held_play(mode)
    by_word("break")(board)
    assert starts(hold(board, BUTTON_1, 2000)) == 0
    if between == "release":
        hold(board, 0, REPEAT_MS)
    elif between == "silence":
        board.run(ms=510)
    else:
        assert "No page has code 2" in hold(board, 2, 100)
    assert starts(hold(board, BUTTON_1, 1000)) == 1


def test_silence_of_less_than_half_a_second_is_no_release():
    board = held_play()
    by_word("break")(board)
    hold(board, BUTTON_1, 2000)
    board.run(ms=440)
    assert starts(hold(board, BUTTON_1, 1000)) == 0


@pytest.mark.parametrize("mode", ["latch", "hold", "drive"])
def test_a_silent_servo_starts_one_play_a_press(mode):
    """No servo can be driven: the play ends at once, and would restart with each packet."""
    board = robot()
    ask(board, f"remote {mode}")
    for servo in JOINTS:
        board.servos[servo].fault("silent")
    board.run(ms=5000)
    text = hold(board, BUTTON_1, 6000)
    assert text.count("Broken off") + text.count("Ended") + text.count("No servo") <= 1, text


@pytest.mark.parametrize("mode", ["latch", "hold", "drive"])
@pytest.mark.parametrize("start", ["power", "MODE", "reset"])
def test_a_button_held_at_the_start_moves_nothing_until_it_was_up(start, mode):
    board = robot()
    ask(board, f"remote {mode}")
    board.run(ms=1000)
    if start == "power":
        board.power_off()
        board.run(ms=500)
        board.power_on()
    elif start == "MODE":
        board.reset()
    else:
        board.send("@reset\r")
        board.run(ms=100)
    board.clear_trace()
    text = hold(board, BUTTON_1, 4000)
    assert "18 servos" in text and starts(text) == 0, text
    assert not any(servo.torque for servo in board.servos)
    hold(board, 0, REPEAT_MS)
    assert starts(hold(board, BUTTON_1, 4000)) == 1


def test_a_press_half_a_second_after_the_start_counts():
    board = robot()
    board.power_off()
    board.run(ms=500)
    board.power_on()
    board.expect("] ", ms=2000)
    board.run(ms=510)
    assert starts(hold(board, BUTTON_1, 4000)) == 1


def test_start_within_50_ms_of_the_press_is_not_undone_by_the_second_packet():
    """Without an approach the first step begins 20 ms after the packet, so START is a soft stop."""
    board = robot(servos=[11, 12])
    ask(board, "settings approach 0")
    board.rc(UP)
    board.run(ms=5)
    board.press("START")
    board.run(ms=40)
    text = hold(board, UP, 6000)
    assert "Stopped after page 5 (walk stop)" in text and starts(text) == 0, text


def test_arrows_of_the_panel_that_are_let_go_after_a_stop_start_nothing():
    board = robot()
    for button in ("UP", "LEFT"):
        board.press(button)
        board.run(ms=100)
    board.expect("Playing page 4 (walk)", ms=4000)
    board.send("break\r")
    board.expect("Broken off", ms=2000)
    start = len(board.console)
    board.release("LEFT")
    board.run(ms=1000)
    assert starts(board.console[start:].decode("latin-1")) == 0


def test_letting_go_of_a_steering_button_starts_nothing():
    board = held_play("drive", buttons=UP | LEFT, before="No page has code 5")
    assert starts(hold(board, UP, 500)) == 1
    hold(board, UP | LEFT, 1000)
    board.send("break\r")
    assert starts(hold(board, UP | LEFT, 1000) + hold(board, UP, 1000)) == 0


# --- a typed play, while a button is down ---


@pytest.mark.parametrize("after", ["release", "silence"])
def test_letting_go_of_a_button_from_before_does_not_stop_a_typed_play(after):
    board = robot()
    ask(board, "remote hold")
    assert "No page has code 2" in hold(board, DOWN, 200)
    board.send("play 4\r")
    hold(board, DOWN, 5000)
    if after == "release":
        hold(board, 0, 500)
    board.run(ms=5000)
    assert ask(board, "status").startswith("Playing page 4 (walk)")


def test_letting_go_of_a_button_pressed_in_a_typed_play_stops_it():
    board = robot()
    ask(board, "remote hold")
    hold(board, DOWN, 200)
    board.send("play 4\r")
    text = hold(board, DOWN, 5000) + hold(board, DOWN | LEFT, 500) + hold(board, 0, 8000)
    assert "Stopped after page 5 (walk stop)" in text


# --- releasing the buttons of a chord one by one after a stop ---


@pytest.mark.parametrize("mode", ["latch", "hold", "drive"])
def test_fingers_that_leave_a_chord_do_not_call_back_what_button_6_has_stopped(mode):
    board = robot()
    ask(board, f"remote {mode}")
    hold(board, UP, 4000)
    hold(board, UP | LEFT, 200)
    text = hold(board, UP | LEFT | STOP, 2 * REPEAT_MS) + hold(board, UP | LEFT, 2 * REPEAT_MS) + hold(board, UP, 8000)
    assert "Stopped after" in text and ask(board, "status").startswith("Nothing is playing"), text


def test_fingers_that_leave_a_chord_on_the_panel_do_not_call_back_what_start_has_stopped():
    board = robot()
    board.press("UP")
    board.run(ms=3000)
    board.press("LEFT")
    board.run(ms=100)
    press_start(board)
    board.release("LEFT")
    board.expect("Stopped after", ms=6000)
    board.run(ms=1000)
    assert ask(board, "status").startswith("Nothing is playing")


def test_a_button_that_comes_down_behind_a_stop_calls_a_play_back():
    board = held_play(buttons=UP)
    press_start(board)
    hold(board, UP | LEFT, 200)
    hold(board, 0, 3000)
    assert ask(board, "status").startswith("Playing")
