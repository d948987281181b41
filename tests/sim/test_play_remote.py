# SPDX-License-Identifier: MIT
"""A held button of the remote: only a press starts a play. The remote repeats its packet every 50 ms.

Each case here is one of tests/unit/test_inputs.c, with the performer and the shipped image behind it."""

import pytest

from tests.sim.play_robot import JOINTS, LEFT, STOP, UP, ask, press_start, robot

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


ENDS = {
    "START": (press_start, "drive"),
    "stop": (by_word("stop"), "latch"),
    "break": (by_word("break"), "hold"),
    "@stop": (by_word("@stop"), "drive"),
    "@break": (by_word("@break"), "latch"),
    "button 6": (by_button_6, "hold"),
}


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


@pytest.mark.parametrize("mode, between", [("latch", "release"), ("hold", "silence"), ("drive", "another code")])
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


def test_a_silent_servo_starts_one_play_a_press():
    """No servo can be driven: the play ends at once, and would restart with each packet."""
    board = robot()
    ask(board, "remote drive")
    for servo in JOINTS:
        board.servos[servo].fault("silent")
    board.run(ms=5000)
    text = hold(board, BUTTON_1, 6000)
    assert text.count("Broken off") + text.count("Ended") + text.count("No servo") <= 1, text


@pytest.mark.parametrize("mode, start", [("latch", "power"), ("hold", "MODE"), ("drive", "reset")])
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


# --- releasing the buttons of a chord one by one after a stop ---


def test_fingers_that_leave_a_chord_do_not_call_back_what_button_6_has_stopped():
    board = robot()
    ask(board, "remote drive")
    hold(board, UP, 4000)
    hold(board, UP | LEFT, 200)
    text = hold(board, UP | LEFT | STOP, 2 * REPEAT_MS) + hold(board, UP | LEFT, 2 * REPEAT_MS) + hold(board, UP, 8000)
    assert "Stopped after" in text and ask(board, "status").startswith("Nothing is playing"), text


def test_a_button_that_comes_down_behind_a_stop_calls_a_play_back():
    board = held_play(buttons=UP)
    press_start(board)
    hold(board, UP | LEFT, 200)
    hold(board, 0, 3000)
    assert ask(board, "status").startswith("Playing")


# --- every stop, with thumbs on the remote or on the panel, whatever moves ---

CHORD = ("UP", "LEFT")  # no page has their code; with LEFT up, UP starts the walk
MOVES = {"nothing moves": [], "aim": ["aim 1 600"], "swing": ["swing 1 512 50 2000"], "play and aim": ["play 8", "aim 2 600"]}


class Thumb:
    """A hand on the remote or on the panel, while the board runs."""

    def __init__(self, board, device):
        self.board, self.device, self.held = board, device, ()

    def hold(self, buttons, ms):
        for button in set(self.held) - set(buttons):
            self._change(button, self.board.release)
        for button in set(buttons) - set(self.held):
            self._change(button, self.board.press)
        self.held = buttons
        return hold(self.board, self._packet(), ms) if self.device == "remote" else self._run(ms)

    def _change(self, button, panel):
        if self.device == "panel":
            panel(button)

    def _packet(self):
        return sum({"UP": UP, "LEFT": LEFT}[button] for button in self.held)

    def _run(self, ms):
        start = len(self.board.console)
        self.board.run(ms=ms)
        return self.board.console[start:].decode("latin-1")


def stop_by_button_6(board, packet):
    hold(board, packet | STOP, 2 * REPEAT_MS)
    hold(board, packet, REPEAT_MS)


STOPS = {word: lambda board, packet, word=word: board.send(word + "\r") for word in ("stop", "break", "@stop", "@break", "code 255", "off")}
STOPS |= {"button 6": stop_by_button_6, "START": lambda board, packet: press_start(board)}


@pytest.mark.parametrize("device", ["remote", "panel"])
@pytest.mark.parametrize("stop", STOPS)
def test_a_button_that_is_let_go_after_a_stop_starts_nothing(device, stop):
    board = robot(servos=[1, 2])
    thumb = Thumb(board, device)
    for name, words in MOVES.items():
        for word in words:
            assert ask(board, word) == " OK"
            board.run(ms=1500)
        thumb.hold(CHORD, 200)
        STOPS[stop](board, thumb._packet() if device == "remote" else 0)
        thumb.hold(CHORD, 2500)
        assert ask(board, "on") == " OK"
        text = thumb.hold(CHORD[:1], 1000)
        assert "Going" not in text and "Playing" not in text, (name, text)
        thumb.hold((), 200)
    text = thumb.hold(CHORD[:1], 1000)
    assert "page 3 (walk start)" in text, text
