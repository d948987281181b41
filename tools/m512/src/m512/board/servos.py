# SPDX-License-Identifier: MIT
"""Dynamixel protocol 1.0 on an adapter, for the doctor: finds servos and their rates, reads registers, and repairs two registers on
request. It moves nothing; Play and Edit do that (bus.py)."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

from m512.board import bus
from m512.board.link import explain
from m512.errors import PortError
from m512.ui import Progress

PING, READ, WRITE, SYNC_WRITE = 1, 2, 3, 0x83
EVERYBODY = 254
FIRST_SECONDS = 0.08  # limit for the first answer: a driver may hold bytes back for 16 ms
LEAST_SECONDS = 0.03  # shortest limit: a busy computer may look this late
BEGUN_SECONDS = 0.02  # limit for the rest of an answer that has begun
TRIES = 3

# Bits of the error byte of an answer, with advice.
ERRORS = (
    (0x01, "voltage", "outside its limits: charge the battery, or use another supply"),
    (0x02, "angle limit", "a goal was outside its angle limits"),
    (0x04, "overheating", "let it cool down, then switch its power off and on"),
    (0x08, "range", "an instruction had a value that it does not take"),
    (0x10, "checksum", "an instruction came damaged: cable, or two programs on the bus"),
    (0x20, "overload", "it carried too much: free it, then switch its power off and on"),
    (0x40, "instruction", "it does not know an instruction"),
)


class Answer(NamedTuple):
    id: int
    error: int
    data: bytes


def packet(id_: int, instruction: int, *params: int) -> bytes:
    body = bytes([id_, len(params) + 2, instruction, *params])
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


class Bus:
    """An adapter, at one rate at a time. Use as a context manager."""

    def __init__(self, word: str):
        import serial

        self.device, self.rate = bus.parts(word)
        try:
            self.port: Any = serial.Serial(self.device, self.rate, timeout=0, exclusive=True)
        except (serial.SerialException, OSError, ValueError) as error:
            raise PortError(explain(self.device, error)) from None
        self.is_fast = self._make_fast()
        self.longest, self.echoes = 0.0, False
        self.asked: list[bytes] = []
        self.noise = b""  # what the last question brought besides its answer

    def __enter__(self) -> Bus:
        return self

    def __exit__(self, *_exc: object) -> None:
        self.port.close()

    def _make_fast(self) -> bool:
        """Asks the driver to pass bytes on at once. Returns whether it does."""
        try:
            self.port.set_low_latency_mode(True)
            return True
        except Exception:  # ptys and other systems raise different exceptions
            return "ttyACM" in self.device

    def set_rate(self, rate: int) -> None:
        try:
            self.port.baudrate = rate
        except Exception as error:
            raise PortError(f"{self.device} cannot do {rate} baud: {error}") from None
        self.rate = rate
        self.port.reset_input_buffer()

    def find_echo(self) -> bool:
        """Returns whether the adapter echoes. Sends a packet that no servo answers or obeys: a SYNC WRITE without servos."""
        probe = packet(EVERYBODY, SYNC_WRITE, 25, 1)
        self.echoes = False
        self.echoes = any(probe in self._exchange(probe) for _ in range(TRIES))
        return self.echoes

    def _exchange(self, question: bytes) -> bytes:
        """Sends a packet. Returns what arrives within the time limit, without the echo."""
        limit = max(LEAST_SECONDS, 2 * self.longest) if self.longest else FIRST_SECONDS
        try:
            self.port.reset_input_buffer()
            self.port.write(question)
            self.port.flush()
            begun, heard, whole = time.monotonic(), b"", None
            until = begun + limit + 10 * len(question) / self.rate
            self.asked = [*self.asked[-3:], question]
            while True:
                left = until - time.monotonic()
                self.port.timeout = max(left, 0)  # this process may run late; read what has arrived by then
                some = self.port.read(1)
                some += self.port.read(self.port.in_waiting) if some else b""
                heard += some
                if some and not whole and (whole := self._answer(self._without_echo(heard))):
                    self.longest = max(self.longest, min(time.monotonic() - begun, 0.1))
                    until = min(until, time.monotonic() + (BEGUN_SECONDS if whole.id == question[2] else left))
                if left <= 0 and not some:
                    break
        except Exception as error:
            raise PortError(f"{self.device}: {error}. Is the adapter still plugged in?") from None
        return self._without_echo(heard)

    def _without_echo(self, heard: bytes) -> bytes:
        """Removes echoes. The echo of an earlier packet may still arrive."""
        for question in self.asked if self.echoes else ():
            heard = heard.replace(question, b"", 1)
        return heard

    @staticmethod
    def _answer(heard: bytes) -> Answer | None:
        """The first status packet with a valid checksum."""
        at = heard.find(b"\xff\xff")
        while at >= 0:
            found = heard[at:]
            if len(found) >= 6 and found[3] >= 2 and len(found) >= found[3] + 4:
                body = found[2 : found[3] + 4]
                if sum(body) & 0xFF == 0xFF:
                    return Answer(body[0], body[2], body[3:-1])
            at = heard.find(b"\xff\xff", at + 1)
        return None

    def ask(self, id_: int, instruction: int, *params: int, tries: int = TRIES) -> Answer | None:
        """The answer of this servo, or None. `noise` is then what arrived instead."""
        question = packet(id_, instruction, *params)
        for _ in range(tries):
            heard = self._exchange(question)
            found = self._answer(heard)
            if found and found.id == id_:
                self.noise = heard.replace(packet(found.id, found.error, *found.data), b"", 1)
                return found
            self.noise = heard
        return None

    def read(self, id_: int, at: int, count: int) -> bytes | None:
        found = self.ask(id_, READ, at, count)
        return found.data if found and len(found.data) == count else None

    def write(self, id_: int, at: int, value: int) -> bool:
        return self.ask(id_, WRITE, at, value) is not None

    def is_somebody_there(self) -> bool:
        """Whether anything answers a broadcast PING. Several servos at once produce noise, which counts as an answer."""
        return any(self._exchange(packet(EVERYBODY, PING)) for _ in range(2))

    def scan(self, ids: range, progress: Progress) -> list[int]:
        """The IDs that answer or produce noise."""
        found = []
        for done, id_ in enumerate(ids, 1):
            if self.ask(id_, PING, tries=2) or self.noise:
                found.append(id_)
            progress(done, len(ids))
        return found
