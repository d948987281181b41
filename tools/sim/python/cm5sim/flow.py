# SPDX-License-Identifier: MIT
"""Software flow control for what comes from standard input, as a terminal has it. A port's client has its own."""

from __future__ import annotations

from collections.abc import Callable

from .library import CYCLES_PER_MS

XON, XOFF = 0x11, 0x13
BEHIND_XOFF = 16  # bytes on their way; the robot has room for them when it sends XOFF
AT_START = 64  # bytes; our images send XOFF only after their search for servos, and have room for these until then
DEAF_CYCLES = 10_000 * CYCLES_PER_MS  # a program that says nothing, or sends 0x13 and never XON, still gets the rest


class Flow:
    """Holds what the robot has no room for yet."""

    def __init__(self, send: Callable[[bytes], None]) -> None:
        self._send = send
        self._waiting = bytearray()
        self._begin(0, 0)

    def _begin(self, now: int, resets: int) -> None:
        self._resets = resets
        self._stopped_at: int | None = None  # cycle of an XOFF
        self._silent_since: int | None = now  # None: the robot has said something since its start
        self._left = AT_START  # bytes that it gets until then

    def __bool__(self) -> bool:
        return bool(self._waiting)

    def type(self, data: bytes) -> None:
        self._waiting += data

    def hear(self, output: bytes, now: int) -> None:
        """Output of the robot."""
        self._silent_since = None
        for byte in output:
            if byte in (XON, XOFF):
                self._stopped_at = now if byte == XOFF else None

    def feed(self, on_line: int, now: int, resets: int) -> None:
        """Sends what the robot takes. on_line: bytes that have not arrived yet. resets: how often the chip has started."""
        if resets != self._resets:
            self._begin(now, resets)
        if self._stopped_at is not None and now - self._stopped_at <= DEAF_CYCLES:
            return
        room = BEHIND_XOFF - on_line
        if self._silent_since is not None and now - self._silent_since <= DEAF_CYCLES:
            room = min(room, self._left)
        if self._waiting and room > 0:
            some = bytes(self._waiting[:room])
            del self._waiting[:room]
            self._left -= len(some)
            self._send(some)
