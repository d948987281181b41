# SPDX-License-Identifier: MIT
"""cm5sim --bus-pty: servos without a board, on a serial port, in real time. For any PC program that speaks Dynamixel protocol 1.0."""

from __future__ import annotations

import select
import sys
import time
from collections.abc import Callable

from . import library
from .board import CYCLES_PER_TICK
from .files import keep, memories, plug_in_servos
from .library import CYCLES_PER_MS
from .options import EXIT_FILE, EXIT_GOOD, Options
from .serial_port import SerialPort
from .servo import Servos
from .trace import Trace

# A USB adapter sends a packet in one piece, but the kernel may deliver it in several. An incomplete packet gets this long to become
# complete, then goes on the wire as it is.
GATHER_CYCLES = 3 * CYCLES_PER_MS
GATHERED_MAX = 4096
LOOK_CYCLES = 200 * CYCLES_PER_MS  # longest sleep, because of signals and --time
CYCLES_PER_S = 1000 * CYCLES_PER_MS
FACTORY_BPS = 1_000_000


def ends_whole(data: bytes) -> bool:
    """Whether the bytes end with a complete packet: FF FF ID length, then `length` bytes."""
    at = data.find(b"\xff\xff")
    while 0 <= at <= len(data) - 4:
        if data[at + 2] == 0xFF:  # not an ID: the header begins later
            at += 1
            continue
        end = at + 4 + data[at + 3]
        if end == len(data):
            return True
        at = data.find(b"\xff\xff", end)
    return False


class Bus:
    """The servos and their port, in step with the wall clock."""

    def __init__(self, options: Options) -> None:
        """OSError: a file or port cannot be used."""
        self._lib, self._options = library.load(), options
        self._bus = self._lib.servo_bus_new()
        self._now = 0  # cycle of the servos
        self.servos = Servos(self._lib, self._bus, lambda: self._now)
        plug_in_servos(self.servos, options)
        self._trace = Trace(self.servos, options.trace, options.plot) if options.trace or options.plot else None
        self.port = SerialPort(options.bus_pty or "", FACTORY_BPS)
        self._heard = library.BYTE_HEARD(self._hear)  # keeps the callback alive
        self._lib.servo_api_listen(self._bus, self._heard)
        self._answer = bytearray()
        self._gathered, self._gathered_at = b"", 0
        self._line_free = 0  # end of the PC's last byte
        self._next_tick = 0
        self._rate = FACTORY_BPS
        self._start = time.monotonic_ns()

    def _clock(self) -> int:
        return (time.monotonic_ns() - self._start) * 16 // 1000

    def _hear(self, _context: int, _now: int, byte: int, _rate: int, bad: bool) -> None:
        """Takes a byte of a servo. It replies at the rate of the request. A collision changes a bit, so that no checksum fits."""
        self._answer.append(byte ^ 0x80 if bad else byte)

    def _advance(self, now: int) -> None:
        self._now = now
        self._lib.servo_bus_advance(self._bus, now)

    def _trace_up_to(self, now: int) -> None:
        """Writes the rows of all ticks up to this cycle. Call it before anything happens on the wire at that cycle, because servos cannot
        go back in time."""
        while self._trace and self._next_tick <= now:
            self._advance(self._next_tick)
            self._trace.row(self._next_tick // CYCLES_PER_TICK, self._next_tick)
            self._next_tick += CYCLES_PER_TICK

    def _put_on_wire(self, now: int) -> None:
        """Puts the gathered bytes on the wire, back to back. Servo time may run ahead of the clock by the length of the packet, then waits
        for the clock."""
        at = max(now, self._line_free)
        for byte in self._gathered:
            at += 160_000_000 // self._rate
            self._trace_up_to(at)
            self._now = at
            self._lib.servo_bus_host_byte(self._bus, at, byte, self._rate)
        self._line_free, self._gathered = at, b""

    def _wait(self) -> bool:
        """Sleeps until bytes arrive or something else is due. Returns True if there are bytes."""
        now = self._clock()
        wake = min(now + LOOK_CYCLES, self._lib.servo_api_next_cycles(self._bus), self._options.time)
        if self._gathered:
            wake = min(wake, now + CYCLES_PER_MS)
        if self._trace:
            wake = min(wake, self._next_tick)
        return bool(select.select([self.port.master], [], [], max(wake - now, 0) / CYCLES_PER_S)[0])

    def step(self) -> None:
        if self._wait():
            self._gathered += self.port.read()
            self._gathered_at = self._clock()
            self._rate = self.port.rate if 1200 <= self.port.rate <= 4_000_000 else FACTORY_BPS
        now = self._clock()
        late = now - self._gathered_at > GATHER_CYCLES or len(self._gathered) >= GATHERED_MAX
        if self._gathered and (late or ends_whole(self._gathered)):
            self._put_on_wire(now)
        if now > self._line_free:
            self._trace_up_to(now)
            self._advance(now)
        if self._answer:
            self.port.write(bytes(self._answer))
            self._answer.clear()

    def run(self, interrupted: Callable[[], bool]) -> None:
        """Runs until a signal or the end of --time."""
        while not interrupted() and self._clock() < self._options.time:
            self.step()
        self._trace_up_to(self._clock())

    def close(self) -> list[str]:
        """Returns why files could not be written."""
        self.port.close()
        failures = keep(memories(self._options, self.servos), self._trace)
        self._lib.servo_bus_free(self._bus)
        return failures


def main(options: Options, interrupted: Callable[[], bool]) -> int:
    """Returns the exit code. OSError: a file or port cannot be used."""
    bus = Bus(options)
    print(f"cm5sim: servo bus: {bus.port.path}", file=sys.stderr, flush=True)
    try:
        bus.run(interrupted)
    finally:
        failures = bus.close()
        for failure in failures:
            print(f"cm5sim: {failure}", file=sys.stderr)
    return EXIT_FILE if failures else EXIT_GOOD
