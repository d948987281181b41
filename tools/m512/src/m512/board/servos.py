# SPDX-License-Identifier: MIT
"""Dynamixel protocol 1.0 on an adapter, as far as the doctor needs it: who answers at which rate, what its registers hold, two registers
mended on request. Nothing here plays or moves anything; that is the programs' (bus.py)."""

from __future__ import annotations

import time
from typing import Any, NamedTuple

from m512.board import bus
from m512.board.link import explain
from m512.errors import PortError

PING, READ, WRITE, SYNC_WRITE = 1, 2, 3, 0x83
EVERYBODY = 254
FIRST_SECONDS = 0.08  # for an answer through a driver that holds bytes back for 16 ms
LEAST_SECONDS = 0.03  # a busy computer looks that late
BEGUN_SECONDS = 0.02  # for the rest of an answer that has begun
TRIES = 3

# Bits of an answer's error byte, with what to do.
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
    """An adapter at one rate at a time. Use as a context."""

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
        self.noise = b""  # what came to the last question without being its answer

    def __enter__(self) -> Bus:
        return self

    def __exit__(self, *_exc: object) -> None:
        self.port.close()

    def _make_fast(self) -> bool:
        """Asks the driver to pass bytes on at once; whether it grants it."""
        try:
            self.port.set_low_latency_mode(True)
            return True
        except Exception:  # ptys, other systems: each refuses in its own way
            return "ttyACM" in self.device

    def set_rate(self, rate: int) -> None:
        try:
            self.port.baudrate = rate
        except Exception as error:
            raise PortError(f"{self.device} cannot do {rate} baud: {error}") from None
        self.rate = rate
        self.port.reset_input_buffer()

    def find_echo(self) -> bool:
        """Sends a packet that nobody answers and nobody obeys: a SYNC WRITE to none."""
        probe = packet(EVERYBODY, SYNC_WRITE, 25, 1)
        self.echoes = False
        self.echoes = any(probe in self._exchange(probe) for _ in range(TRIES))
        return self.echoes

    def _exchange(self, question: bytes) -> bytes:
        """Sends it; what comes back within the time limit, without the echo."""
        limit = max(LEAST_SECONDS, 2 * self.longest) if self.longest else FIRST_SECONDS
        try:
            self.port.reset_input_buffer()
            self.port.write(question)
            self.port.flush()
            begun, heard = time.monotonic(), b""
            until = begun + limit + 10 * len(question) / self.rate
            self.asked = [*self.asked[-3:], question]
            while True:
                left = until - time.monotonic()
                self.port.timeout = max(left, 0)  # this process may look late: what has come by then counts
                some = self.port.read(1)
                some += self.port.read(self.port.in_waiting) if some else b""
                heard += some
                if some and (whole := self._answer(self._without_echo(heard))):
                    self.longest = max(self.longest, min(time.monotonic() - begun, 0.1))
                    until = min(until, time.monotonic() + (BEGUN_SECONDS if whole.id == question[2] else left))
                if left <= 0 and not some:
                    break
        except Exception as error:
            raise PortError(f"{self.device}: {error}. Is the adapter still plugged in?") from None
        return self._without_echo(heard)

    def _without_echo(self, heard: bytes) -> bytes:
        """The echo of a packet before the last one may still be on its way."""
        for question in self.asked if self.echoes else ():
            heard = heard.replace(question, b"", 1)
        return heard

    @staticmethod
    def _answer(heard: bytes) -> Answer | None:
        """The first status packet with a good checksum."""
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
        """The answer of this servo; None: none. `noise` then has what came instead."""
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
        """Whether anything answers a PING to all: several servos at once make noise, which is an answer, too."""
        return any(self._exchange(packet(EVERYBODY, PING)) for _ in range(2))

    def scan(self, ids: range) -> list[int]:
        """The IDs that answer, or make noise."""
        return [id_ for id_ in ids if self.ask(id_, PING, tries=2) or self.noise]
