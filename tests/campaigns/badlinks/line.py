# SPDX-License-Identifier: MIT
"""m512's Link over simulated wires, in a process that may die or be cancelled at any moment.

A Line takes a board (an object with `now` and advance(until), such as factory_model.Board) and the wires to and from it. It does not use
real time, so thousands of schedules run in seconds.
"""

from __future__ import annotations

import random

from m512.board.link import Link
from m512.errors import PortError

KILLED, CANCELLED, BROKEN = "killed", "Ctrl-C", "line broken"


class Killed(BaseException):
    """kill -9: the program stops at once."""


class Line(Link):
    """`ends`: (seconds from now, KILLED, CANCELLED or BROKEN). Data written before that still arrives, except after BROKEN."""

    def __init__(self, board, to_board, to_pc, ends=None, seed=0):
        self.url, self.trace, self.held = "simulated line", None, b""
        self.board, self.to_board, self.to_pc = board, to_board, to_pc
        self.chance, self.ended = random.Random(seed), ""
        self.end_at, self.end_kind = (board.now + ends[0], ends[1]) if ends else (float("inf"), "")
        self.sent = 0

    def now(self):
        return self.board.now

    def sleep(self, seconds):
        self._run(self.board.now + seconds, stop_at_bytes=False)

    def close(self):
        pass

    def set_rate(self, rate):
        raise PortError("a simulated line has one rate")

    def _end(self):
        """Raises the exception for the end: after a kill on every call, otherwise once."""
        if self.ended != CANCELLED:
            self.ended = self.end_kind
        self.end_at = float("inf")
        if self.ended == KILLED:
            raise Killed
        if self.ended == CANCELLED:
            raise KeyboardInterrupt
        self.to_board.cut()
        self.to_pc.cut()
        raise PortError("the line broke")

    def _check(self):
        if self.ended == KILLED or self.board.now >= self.end_at:
            self._end()
        if self.ended == BROKEN:
            raise PortError("the line is broken")

    def write(self, data, wait=True):
        due = self.board.now + 0.002 >= self.end_at
        if due:  # in the middle of the write: the operating system has taken a part
            data = data[: self.chance.randrange(len(data) + 1)] if data else data
        self._check()
        self.to_board.send(self.board.now, data)
        self.sent += len(data)
        if due:
            self._end()

    def _run(self, until, stop_at_bytes=True):
        while self.board.now < until:
            if stop_at_bytes and self.to_pc.next_arrival() <= self.board.now:
                return
            self.board.advance(min(until, self.end_at))
            if self.board.now >= self.end_at:
                self._end()
            if not stop_at_bytes:
                self.held += self.to_pc.arrived(self.board.now)

    def _receive(self, limit, seconds):
        self._check()
        self._run(self.board.now + max(seconds, 0))
        return self.to_pc.arrived(self.board.now, limit)
