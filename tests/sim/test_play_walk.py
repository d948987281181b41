# SPDX-License-Identifier: MIT
"""A quarter of a minute of walking, with remote packets and typed commands filling the serial line: no loss, no missed tick, no late frame.
M512_WALK_MINUTES sets the duration; before a release an hour: `M512_WALK_MINUTES=60 tools/test sim.play_walk`."""

import os

from tests.sim.play_robot import LEFT, RIGHT, UP, ask, robot

MINUTES = float(os.environ.get("M512_WALK_MINUTES", "0.25"))
SLICE_MS = 10
BYTES_A_SLICE = 58  # capacity of the line in that time, so it is never idle
XON, XOFF = 0x11, 0x13
COMMANDS = [
    "status",
    "servos",
    "@where",
    "faults",
    "list",
    "@pose",
    "law",
    "help",
    "@list",
    "remote",
    "nonsense",
    "play 200",
    "settings",
    "@page 4",
    "code 3000",
    "version",
]
TICK_CYCLES = 125_000


class Typist:
    """A PC that types without pauses but obeys XOFF."""

    def __init__(self, board):
        self.board, self.allowed, self.rest, self.lines = board, True, b"", 0

    def listen(self, heard):
        for byte in heard:
            if byte in (XON, XOFF):
                self.allowed = byte == XON

    def type(self):
        while len(self.rest) < BYTES_A_SLICE:
            self.rest += COMMANDS[self.lines % len(COMMANDS)].encode() + b"\r"
            self.lines += 1
        if self.allowed:
            count = max(0, BYTES_A_SLICE - self.board.waiting)
            self.board.send(self.rest[:count])
            self.rest = self.rest[count:]


def frames_are_in_time(board, last_tick, phase):
    """Checks that every tick has exactly one frame, sent within it. Returns the tick of the last frame."""
    for frame in board.trace:
        if len(frame.goals) > 1:
            tick = (frame.cycle - phase) // TICK_CYCLES
            assert last_tick is None or tick == last_tick + 1, f"no frame in tick {last_tick + 1}"
            last_tick = tick
    board.clear_trace()
    return last_tick


def test_walking_with_a_full_line():
    board = robot()
    ask(board, "settings talk 0")
    ask(board, "play 4")
    board.run(ms=3000)
    board.run_to("__vector_12")
    phase, last_tick, sent = board.now_cycles, None, 0
    board.clear_trace()
    board.take()
    typist, before = Typist(board), len(board.console)
    for number in range(int(MINUTES * 60_000 / SLICE_MS)):
        if number % 10 == 0:  # ten packets a second: now and then a turn or a release
            board.rc((LEFT, 0, RIGHT, UP)[number // 300 % 4])
            sent += 1
        typist.type()
        board.run(ms=SLICE_MS)
        typist.listen(board.take())
        if number % 500 == 499:
            last_tick = frames_are_in_time(board, last_tick, phase)
    board.send("", wait=True)
    board.run(ms=2000)
    board.take()
    board.send("\r", wait=True)
    board.run(ms=1000)  # the half-typed line may be `help`
    text = ask(board, "faults")
    heard = board.console[before:].translate(None, bytes((XON, XOFF)))  # XON and XOFF come between any two characters
    answers = heard.count(b"\n] ")
    print(f"\n{MINUTES:g} minutes, {sent} packets, {typist.lines} commands, {answers} prompts\n{text}")
    assert "Serial: overruns 0 framing 0 lost 0 " in text
    assert f"remote packets {sent} remote noise 0" in text
    assert "Ticks: missed 0 goals late 0" in text
    assert board.uart(1).overruns == 0
    assert typist.lines > 100 * MINUTES and answers >= typist.lines - 10
    assert "Playing page" in ask(board, "status")
