# SPDX-License-Identifier: MIT
"""A line between a PC and a board in simulated time: slow, delayed, lumpy, with gaps, and with lost, doubled and changed bytes.

A Wire is one direction. It knows no protocol and has no clock: the caller passes the time. Bytes stay in order, as on every serial bridge.
Sent bytes arrive even if the sender has died: the buffers of the operating system and the bridge outlive a program.

    to_board, to_pc = wires(conditions(random.Random(seed)), seed)
    to_board.send(now, b"load e000\\r")
    board.hear(to_board.arrived(now))        # whenever time has passed
"""

from __future__ import annotations

import dataclasses
import random
from collections import deque

BYTE_SECONDS = 10 / 57143  # at the board's UART (UBRR 34 at 16 MHz); bytes are never closer than this
OUTAGE_MOST = 3.0  # seconds; the longest gap that conditions() makes


@dataclasses.dataclass(frozen=True)
class Conditions:
    """The faults of a line. Probabilities are per byte, times in seconds."""

    kind: str = "good"
    speed: float = 1.0  # relative to the line rate: 0.05..1
    late: float = 0.001  # delay of each byte
    lump: float = 0.0  # bytes are collected for this time, then delivered together
    hole_every: float = 0.0  # mean time between two gaps in which nothing passes; 0: no gaps
    hole: float = 0.0  # the longest gap; bytes sent during a gap arrive after it
    lose: float = 0.0
    double: float = 0.0
    change: float = 0.0  # one bit of a byte is inverted
    packet_double: float = 0.0  # a bridge repeats a packet of up to 64 bytes
    hiccup: float = 0.0  # a bridge pauses for 0.12 to 0.6 s somewhere in a packet

    def __str__(self):
        shown = [
            f"{field.name}={getattr(self, field.name):.4g}" for field in dataclasses.fields(self)[1:] if getattr(self, field.name) != field.default
        ]
        return " ".join([self.kind, *shown])


def conditions(chance: random.Random) -> Conditions:
    """Draws a line: one kind of fault, two kinds combined, or most of them at once."""
    slow = dict(speed=chance.uniform(0.05, 0.9))
    late = dict(late=chance.choice((0.016, 0.05, 0.2, 0.6)) * chance.uniform(0.5, 1.0))
    lumpy = dict(lump=chance.choice((0.004, 0.016, 0.1, 0.4)))
    holes = dict(hole_every=10 ** chance.uniform(-1, 1), hole=chance.choice((0.09, 0.2, 0.6, OUTAGE_MOST)))
    lossy = dict(lose=10 ** chance.uniform(-5, -2))
    doubling = dict(double=chance.choice((10 ** chance.uniform(-5, -1), 10 ** chance.uniform(-5, -1), 1.0)))
    packets = dict(packet_double=10 ** chance.uniform(-3, -0.5))
    hiccups = dict(hiccup=10 ** chance.uniform(-2, -0.5))
    changing = dict(change=10 ** chance.uniform(-5, -2.5))
    kinds = {
        "good": {},
        "slow": slow,
        "late": late,
        "lumpy": lumpy,
        "holes": holes,
        "lossy": lossy,
        "doubling": doubling,
        "packets": packets,
        "changing": changing,
        "hiccups": hiccups,
        "hiccups and doubling": {**hiccups, **doubling},
        "slow and late": {**slow, **late},
        "slow with holes": {**slow, **holes},
        "late and lossy": {**late, **lossy},
        "holes and doubling": {**holes, **doubling},
        "holes and loss": {**holes, **lossy},
        "everything": {**slow, **late, **lumpy, **holes, **lossy, **changing, "double": 10 ** chance.uniform(-4, -1.5)},
    }
    kind = chance.choice(list(kinds))
    return Conditions(kind, **kinds[kind])


class Wire:
    """One direction of a line."""

    PACKET = 64

    def __init__(self, conditions: Conditions, seed: int):
        self.conditions, self.chance = conditions, random.Random(seed)
        self.waiting: deque[tuple[float, int]] = deque()  # (arrival time, byte) in transit
        self.sent_until = self.arrived_until = float("-inf")
        self.hole = (float("inf"), float("inf"))
        self.first = True
        self.broken = False

    def cut(self):
        """Pulls the cable: bytes in transit and later ones are lost."""
        self.waiting.clear()
        self.broken = True

    def send(self, now: float, data: bytes) -> None:
        """Sends bytes that the operating system received at `now`."""
        if self.broken:
            return
        if self.first:
            self.first = False
            self._next_hole(now)
        for at in range(0, len(data), self.PACKET):
            packet = data[at : at + self.PACKET]
            again = self.conditions.packet_double and self.chance.random() < self.conditions.packet_double
            packet += packet if again else b""
            pause = self.chance.randrange(len(packet)) if self.conditions.hiccup and self.chance.random() < self.conditions.hiccup else -1
            for k, byte in enumerate(packet):
                self._send(now, byte, self.chance.uniform(0.12, 0.6) if k == pause else 0.0)

    def _send(self, now: float, byte: int, pause: float) -> None:
        conditions, chance = self.conditions, self.chance
        self.sent_until = max(now, self.sent_until) + pause + BYTE_SECONDS / conditions.speed
        if conditions.lose and chance.random() < conditions.lose:
            return
        if conditions.change and chance.random() < conditions.change:
            byte ^= 1 << chance.randrange(8)
        when = self._through_holes(self.sent_until + conditions.late)
        if conditions.lump:
            when = (when // conditions.lump + 1) * conditions.lump
        for _ in range(2 if conditions.double and chance.random() < conditions.double else 1):
            self.arrived_until = max(when, self.arrived_until + BYTE_SECONDS)
            self.waiting.append((self.arrived_until, byte))

    def _through_holes(self, when: float) -> float:
        while when >= self.hole[1]:
            self._next_hole(self.hole[1])
        return self.hole[1] if when >= self.hole[0] else when

    def _next_hole(self, now: float) -> None:
        self.hole = (float("inf"), float("inf"))
        if self.conditions.hole_every:
            start = now + self.chance.expovariate(1 / self.conditions.hole_every)
            self.hole = (start, start + self.conditions.hole * self.chance.random())

    def next_arrival(self) -> float:
        """Returns when the next byte arrives; infinity if none is in transit."""
        return self.waiting[0][0] if self.waiting else float("inf")

    def arrived(self, now: float, limit: int = 1 << 30) -> bytes:
        """Returns the bytes that have arrived by `now`, each once."""
        out = bytearray()
        while self.waiting and self.waiting[0][0] <= now and len(out) < limit:
            out.append(self.waiting.popleft()[1])
        return bytes(out)


def wires(conditions: Conditions, seed: int) -> tuple[Wire, Wire]:
    """Returns both directions of a line: (to the board, to the PC)."""
    return Wire(conditions, 2 * seed), Wire(conditions, 2 * seed + 1)
