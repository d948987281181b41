# SPDX-License-Identifier: MIT
"""The simulated board.

    from cm5sim import Board
    b = Board(images=["play-cm5.hex"], servos=range(1, 19), seed=1)
    b.send(b"version\\r")
    print(b.expect("OK", ms=1000))
    b.run(ms=100)

Time passes only inside run() and expect(). The first violation ends the run with the exception Violation, an armed power cut with PowerCut.
A run is deterministic for a given seed.
"""

from __future__ import annotations

import ctypes
import pathlib
from collections.abc import Iterable
from typing import Any, NamedTuple

from . import library
from .inside import Inside
from .library import CYCLES_PER_MS
from .memory import Memory
from .servo import Servos
from .wear import Wear

CYCLES_PER_TICK = 125000
MOTIONS_ADDRESS = 0xE000
LOADER_ADDRESS = 0x1E000
BUTTONS = ("UP", "DOWN", "LEFT", "RIGHT", "START", "MODE")
LEDS = ("power", "txd", "rxd", "aux", "manage", "program", "play")
RESET_CAUSES = {1: "power-on", 2: "external", 4: "brown-out", 8: "watchdog"}
_TIME, _VIOLATION, _POWER_CUT, _TEXT, _ADDRESS, _REQUEST = range(6)


class Violation(Exception):
    """The firmware did something that fails on the real chip: kind, cycle, pc, function, text."""

    def __init__(self, kind: str, cycle: int, pc: int, function: str, text: str) -> None:
        super().__init__(f"{kind} at cycle {cycle}, pc 0x{pc:05X} in {function}: {text}")
        self.kind, self.cycle, self.pc, self.function, self.text = kind, cycle, pc, function, text

    def __reduce__(self) -> tuple[Any, ...]:
        """Supports pickling, for a campaign's worker that sends it to another process. By default an exception is rebuilt from its message
        alone."""
        return type(self), (self.kind, self.cycle, self.pc, self.function, self.text)


class PowerCut(Exception):
    """The armed power cut has happened. power_on() starts the board again."""


class Frame(NamedTuple):
    """One SYNC WRITE with goal positions. tick counts from the first frame of the trace."""

    cycle: int
    tick: int
    goals: dict[int, int]


def find_image(name: str | pathlib.Path) -> pathlib.Path:
    """Returns the path if it exists, else the path of that name below build/firmware."""
    path = pathlib.Path(name)
    return path if path.exists() else library.build_folder() / "firmware" / name


class Board(Inside, Wear):
    """One controller board; see the module docstring."""

    def __init__(
        self,
        kind: str = "cm5",
        images: str | pathlib.Path | Iterable[str | pathlib.Path] = (),
        motions: bytes | None = None,
        servos: Iterable[int] = (),
        seed: int = 1,
        bootrst: bool | None = None,
        keep_packets: bool = True,
    ) -> None:
        """keep_packets: record packets for `packets` and `trace`. In a run of hours they would fill the memory."""
        self._lib = library.load()
        self._pointer = self._lib.board_new({"cm5": 0, "cm2": 1}[kind], seed)
        if not self._pointer:
            raise MemoryError("no simulated ATmega128")
        self.flash = self._memory(0x20000, "flash")
        self.eeprom = self._memory(0x1000, "eeprom")
        self.ram = self._memory(0x1100, "ram")
        self._taken = 0
        self._started = False
        for image in [images] if isinstance(images, (str, pathlib.Path)) else images:
            self.load(image)
        if motions is not None:
            self.flash[MOTIONS_ADDRESS : MOTIONS_ADDRESS + len(motions)] = motions
        if bootrst is not None:
            self._lib.board_set_bootrst(self._pointer, bootrst)
        self.servos = Servos(self._lib, self._lib.board_servo_bus(self._pointer), lambda: self.now_cycles)
        for number in servos:
            self.servos.add(number)
        if keep_packets:
            self.clear_trace()

    def _memory(self, size: int, name: str) -> Memory:
        return Memory(self, size, getattr(self._lib, f"board_{name}_read"), getattr(self._lib, f"board_{name}_write"))

    def close(self) -> None:
        """Frees the board; it cannot be used afterwards."""
        if self._pointer:
            self._lib.board_free(self._pointer)
            self._pointer = None

    def __del__(self) -> None:
        if getattr(self, "_pointer", None):
            self.close()

    def __enter__(self) -> Board:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # Images and power

    def start_in_loader(self) -> None:
        """Programs the fuse BOOTRST: a reset starts the boot loader, which something else than load() has put into the flash."""
        self._lib.board_set_bootrst(self._pointer, True)

    def load(self, image: str | pathlib.Path, address: int = 0) -> None:
        """Loads a HEX, ELF or binary file (a path, or a name below build/firmware) with its symbols."""
        path = find_image(image)
        with open(path, "rb"):  # the system's own words if it cannot be read: a folder, no permission
            pass
        if not self._lib.board_load(self._pointer, str(path).encode(), address):
            raise FileNotFoundError(self._lib.board_error(self._pointer).decode())

    def power_on(self) -> None:
        self._started = True
        self._lib.board_power_on(self._pointer)

    def power_off(self) -> None:
        self._started = True
        self._lib.board_power_off(self._pointer)

    def brown_out(self) -> None:
        self._lib.board_brown_out(self._pointer)

    def reset(self, ms: float = 1) -> None:
        """Holds MODE, the reset pin, for this time."""
        self.press("MODE")
        self.run(ms=ms)
        self.release("MODE")

    @property
    def powered(self) -> bool:
        return bool(self._lib.board_is_powered(self._pointer))

    @property
    def resets(self) -> int:
        return int(self._lib.board_resets(self._pointer))

    @property
    def reset_cause(self) -> str:
        return RESET_CAUSES[self._lib.board_reset_cause(self._pointer)]

    # Time

    def run(self, ms: float = 0, cycles: int = 0, ticks: float = 0) -> bool:
        """Runs for this time. Returns False if an armed stop ended the run earlier."""
        total = int(ms * CYCLES_PER_MS) + int(cycles) + int(ticks * CYCLES_PER_TICK)
        return self._run(total) == _TIME

    def _run(self, cycles: int) -> int:
        if not self._started:
            self.power_on()
        why = int(self._lib.board_run(self._pointer, cycles))
        if why == _VIOLATION:
            raise self.violation or AssertionError("a violation that is not on record")
        if why == _POWER_CUT:
            raise PowerCut(f"at cycle {self.now_cycles}, operation {self.operations}")
        return why

    def stop(self) -> None:
        """Ends a run. May be called from another thread, even while the run waits for GDB."""
        self._lib.board_stop(self._pointer)

    def run_to(self, function: int | str, ms: float = 1000) -> None:
        """Runs to the first instruction of a function (a name or a flash byte address)."""
        address = function if isinstance(function, int) else self.function(function)
        self._lib.board_stop_at(self._pointer, address)
        why = self._run(int(ms * CYCLES_PER_MS))
        self._lib.board_stop_at(self._pointer, 0xFFFFFFFF)
        if why != _ADDRESS:
            raise AssertionError(f"{function} was not reached within {ms} ms")

    @property
    def now_cycles(self) -> int:
        return int(self._lib.board_now(self._pointer))

    @property
    def now_ms(self) -> float:
        return self.now_cycles / CYCLES_PER_MS

    @property
    def busy_cycles(self) -> int:
        """Cycles in which the CPU executed instructions."""
        return int(self._lib.board_busy_cycles(self._pointer))

    # Violations

    @property
    def violation(self) -> Violation | None:
        """The violation on record, or None."""
        record = self._lib.board_violation(self._pointer).contents
        if record.kind == 0:
            return None
        name = self._lib.violation_name(record.kind).decode()
        return Violation(name, record.cycle, record.pc, record.function.decode(), record.text.decode())

    def clear_violation(self) -> None:
        self._lib.board_clear_violation(self._pointer)

    def _kind(self, name: str) -> int:
        kind = int(self._lib.violation_find(name.encode()))
        if kind == 0:
            raise ValueError(f"no violation is called {name}")
        return kind

    def allow(self, *names: str) -> None:
        """Allows kinds of violation. They are only counted."""
        for name in names:
            self._lib.board_allow(self._pointer, self._kind(name), True)

    def forbid(self, *names: str) -> None:
        for name in names:
            self._lib.board_allow(self._pointer, self._kind(name), False)

    def violations(self, name: str) -> int:
        """Number of violations of a kind, allowed or not."""
        return int(self._lib.board_violations(self._pointer, self._kind(name)))

    # Console and remote

    def send(self, data: str | bytes, wait: bool = False) -> None:
        """Queues bytes on the PC's serial line; wait=True runs until the last one has passed."""
        data = data.encode() if isinstance(data, str) else bytes(data)
        self._lib.board_console_send(self._pointer, 0, data, len(data))
        while wait and self.waiting:
            self.run(ms=1)

    def pause(self, ms: float) -> None:
        """Queues a pause after the bytes sent so far."""
        self._lib.board_console_pause(self._pointer, int(ms * CYCLES_PER_MS))

    @property
    def waiting(self) -> int:
        """Number of bytes still queued or on the line."""
        return int(self._lib.board_console_waiting(self._pointer))

    def flush(self) -> None:
        self._lib.board_console_flush(self._pointer)

    def baud(self, rate: int) -> None:
        """Sets the rate of the PC and the remote, in bps."""
        self._lib.board_console_rate(self._pointer, rate)

    def rc(self, value: int) -> None:
        """Sends one packet of a remote."""
        self.remote(rc_packet(value))

    def remote(self, data: bytes) -> None:
        """Queues raw bytes from the remote."""
        self._lib.board_console_send(self._pointer, 1, bytes(data), len(data))

    def _heard(self, start: int) -> bytes:
        count = ctypes.c_size_t()
        pointer = self._lib.board_console_output(self._pointer, ctypes.byref(count))
        return ctypes.string_at(pointer + start, count.value - start) if count.value > start else b""

    @property
    def console(self) -> bytes:
        """Everything the PC has received so far."""
        return self._heard(0)

    def take(self) -> bytes:
        """Returns what the PC has received since the last take() or expect()."""
        data = self._heard(self._taken)
        self._taken += len(data)
        return data

    def expect(self, text: str | bytes, ms: float = 1000) -> str:
        """Runs until text arrives. Returns everything since the last take() or expect(), up to the end of text."""
        wanted = text.encode() if isinstance(text, str) else bytes(text)
        end = self.now_cycles + int(ms * CYCLES_PER_MS)
        while wanted not in self._heard(self._taken):
            if self.now_cycles >= end:
                tail = self._heard(self._taken)[-500:].decode("latin-1")
                raise AssertionError(f"{text!r} did not come within {ms} ms; the console says {tail!r}")
            self._lib.board_stop_on_text(self._pointer, wanted if b"\0" not in wanted else None)
            self._run(min(end - self.now_cycles, CYCLES_PER_MS * 20))
        self._lib.board_stop_on_text(self._pointer, None)
        seen = self._heard(self._taken)
        seen = seen[: seen.index(wanted) + len(wanted)]
        self._taken += len(seen)
        return seen.decode("latin-1")

    def attach(self, body: Any) -> None:
        """Connects the servo shafts to a body (body.physics.Physics), in lock step with the board. None: each servo turns its own rotor
        again. After moving the body by hand, attach it again to show the servos its position at once."""
        self._body = body  # kept alive
        if body is None:
            self._lib.board_body(self._pointer, None)
            return
        seam = self._lib.servo_mujoco_body(ctypes.addressof(body.seam))
        self._lib.board_body(self._pointer, seam)

    def uart(self, number: int) -> library.UartCounts:
        """The counters of UART 0 (bus) or 1 (console): sent, received, overruns, framing, deaf."""
        counts = library.UartCounts()
        self._lib.board_uart_counts(self._pointer, number, ctypes.byref(counts))
        return counts

    # Servo bus

    def bus_turn_us(self, forget: bool = False) -> float:
        """The longest time, in us, from our last stop bit until the board listens, since the start or a call with forget."""
        return int(self._lib.board_bus_turn(self._pointer, forget)) / 16

    def bus_pause_us(self, forget: bool = False) -> float:
        """The longest pause, in us, between two characters of a packet of the board, since the start or a call with forget."""
        return int(self._lib.board_bus_pause(self._pointer, forget)) / 16

    @property
    def packets(self) -> list[tuple[int, bytes]]:
        """[(cycle, bytes)] of each good instruction packet since the start or clear_trace()."""
        count = ctypes.c_size_t()
        items = self._lib.board_trace(self._pointer, ctypes.byref(count))
        return [(items[i].cycle, bytes(items[i].bytes[: items[i].count])) for i in range(count.value)]

    @property
    def trace(self) -> list[Frame]:
        """Frames of goal positions: SYNC WRITE packets that include address 30."""
        frames: list[Frame] = []
        first = None
        for cycle, packet in self.packets:
            goals = sync_goals(packet)
            if goals:
                first = cycle if first is None else first
                frames.append(Frame(cycle, round((cycle - first) / CYCLES_PER_TICK), goals))
        return frames

    def clear_trace(self) -> None:
        self._lib.board_trace_start(self._pointer)

    # Panel

    def press(self, button: str) -> None:
        self._lib.board_press(self._pointer, BUTTONS.index(button.upper()), True)

    def release(self, button: str) -> None:
        self._lib.board_press(self._pointer, BUTTONS.index(button.upper()), False)

    def bounce(self, ms: float) -> None:
        """Sets how long contacts bounce after a press or release (5 ms at first)."""
        self._lib.board_set_bounce(self._pointer, int(ms * CYCLES_PER_MS))

    @property
    def leds(self) -> set[str]:
        """Names of the lit LEDs."""
        bits = self._lib.board_leds(self._pointer)
        return {name for bit, name in enumerate(LEDS) if bits >> bit & 1}

    def pin(self, name: str) -> int | None:
        """A port pin such as "E2": 0, 1, or None if the board does not drive it."""
        level: int = self._lib.board_pin(self._pointer, name[0].encode(), int(name[1]))
        return None if level < 0 else level

    def battery(self, volts: float) -> None:
        self._lib.board_battery(self._pointer, volts)


def rc_packet(value: int) -> bytes:
    """A packet of the remote RC-100: FF 55 low ~low high ~high."""
    low, high = value & 0xFF, value >> 8 & 0xFF
    return bytes([0xFF, 0x55, low, low ^ 0xFF, high, high ^ 0xFF])


def sync_goals(packet: bytes) -> dict[int, int]:
    """{id: goal} of a SYNC WRITE that includes the goal position (address 30), else {}."""
    if len(packet) < 8 or packet[4] != 0x83:
        return {}
    address, length, data = packet[5], packet[6], packet[7:-1]
    if not address <= 30 <= address + length - 2:
        return {}
    at = 1 + 30 - address
    blocks = [data[i : i + length + 1] for i in range(0, len(data), length + 1)]
    return {block[0]: block[at] | block[at + 1] << 8 for block in blocks}
