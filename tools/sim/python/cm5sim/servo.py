# SPDX-License-Identifier: MIT
"""The servos of a simulated robot (servo_api.h), as Board.servos.

    b.servos[3].goal, .present, .torque, .moving, .load, .voltage, .temperature, .led, .alarms, .table
    b.servos[3].fault("silent")            # until cleared; times=2: the next two replies only
    b.servos[3].clear()
    b.servos[3].push_to(400)               # a hand turns the horn
    b.servos[3].write(28, [64, 64])        # like a packet; returns error bits
    b.servos.ids, b.servos.present         # all IDs; {ID: present position}

Python stores nothing: every reading shows the board's present state.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable, Iterator
from typing import Any

TABLE_BYTES, EEPROM_BYTES = 50, 24
ALWAYS = 0xFFFFFFFF
MODELS = ("ax12", "ax18", "dx117")
FAULTS = (
    "silent",
    "dead",
    "duplicate",
    "checksum",
    "noise",
    "late",
    "short",
    "two-talkers",
    "overload",
    "overheating",
    "low-voltage",
    "angle-limit",
    "mishears",
    "blocked",
)
COUNTED_FAULTS = ("silent", "checksum", "noise", "late", "short", "two-talkers", "mishears")  # for some times; the rest: on or off
ERROR_NAMES = {1: "voltage", 2: "angle-limit", 4: "overheating", 8: "range", 16: "checksum", 32: "overload", 64: "instruction"}
COUNTERS = ("packets", "answers", "checksum_errors", "framing_errors", "gaps", "oversize", "deaf")
_STATES = ("position", "velocity", "output", "outside_load", "ambient", "celsius", "held", "late_us", "torque_nm", "powered")
_SETTABLE = _STATES[3:8]
_REGISTERS = {  # name: (address, bytes)
    "model": (0, 2),
    "id": (3, 1),
    "return_delay": (5, 1),
    "goal": (30, 2),
    "speed": (32, 2),
    "torque_limit": (34, 2),
    "present": (36, 2),
    "present_speed": (38, 2),
    "present_load": (40, 2),
    "voltage_tenths": (42, 1),
    "temperature": (43, 1),
    "registered": (44, 1),
    "cw_slope": (28, 1),
    "ccw_slope": (29, 1),
}


class Servo:
    """One servo on the bus; see the module docstring."""

    _servos: Servos
    _pointer: int

    def __init__(self, servos: Servos, pointer: int) -> None:
        object.__setattr__(self, "_servos", servos)
        object.__setattr__(self, "_pointer", pointer)

    def register(self, address: int, count: int) -> int:
        """Reads one or two bytes of the control table."""
        return int(self._servos.lib.servo_api_get(self._pointer, self._servos.now(), address, count))

    def __getattr__(self, name: str) -> Any:  # register or counter: int; state: float
        servos = self._servos
        if name in _REGISTERS:
            return self.register(*_REGISTERS[name])
        if name in _STATES:
            return servos.lib.servo_api_state(self._pointer, servos.now(), _STATES.index(name))
        if name in COUNTERS:
            return servos.lib.servo_api_counter(self._pointer, COUNTERS.index(name))
        raise AttributeError(f"a servo has no {name!r}")

    def __setattr__(self, name: str, value: float) -> None:
        if name not in _SETTABLE:
            raise AttributeError(f"{name!r} of a servo cannot be set from outside; write() writes registers")
        self._servos.lib.servo_api_set_state(self._pointer, self._servos.now(), _STATES.index(name), float(value))

    @property
    def torque(self) -> bool:
        return bool(self.register(24, 1)) and self.register(34, 2) > 0

    @property
    def led(self) -> bool:
        return bool(self.register(25, 1))

    @property
    def moving(self) -> bool:
        return bool(self.register(46, 1))

    @property
    def voltage(self) -> float:
        return self.register(42, 1) / 10

    @property
    def rate(self) -> int:
        return 2_000_000 // (self.register(4, 1) + 1)

    @property
    def load(self) -> float:
        """Present load as a signed fraction of full output; positive if it pushes towards larger positions."""
        value: int = self.present_load
        return (value & 1023) / 1023 * (-1 if value & 1024 else 1)

    @property
    def alarm_bits(self) -> int:
        return int(self._servos.lib.servo_api_alarms(self._pointer, self._servos.now()))

    @property
    def alarms(self) -> set[str]:
        """Names of the alarms in its replies."""
        return {name for bit, name in ERROR_NAMES.items() if self.alarm_bits & bit}

    @property
    def table(self) -> bytes:
        return bytes(self.register(address, 1) for address in range(TABLE_BYTES))

    def write(self, address: int, values: Iterable[int]) -> int:
        data = bytes(values)
        return int(self._servos.lib.servo_api_write(self._pointer, self._servos.now(), address, data, len(data)))

    def restore(self, eeprom: bytes) -> None:
        """Restores its EEPROM area (EEPROM_BYTES)."""
        self._servos.lib.servo_api_restore(self._pointer, eeprom)

    def push_to(self, position: float) -> None:
        self._servos.lib.servo_push_to(self._pointer, self._servos.now(), float(position))

    def fault(self, name: str, times: int | None = None) -> None:
        answers = ALWAYS if times is None else times
        servos = self._servos
        if not servos.lib.servo_api_fault(servos.bus, servos.now(), self._pointer, name.encode(), answers):
            raise ValueError(f"no such fault: {name!r}; known: {', '.join(FAULTS)}")

    def clear(self, name: str | None = None) -> None:
        servos = self._servos
        if name is None:
            servos.lib.servo_api_clear(servos.bus, servos.now(), self._pointer)
        else:
            self.fault(name, 0)

    def __repr__(self) -> str:
        return f"<servo {self.id}: goal {self.goal}, present {self.present}, torque {'on' if self.torque else 'off'}>"


class Servos:
    """All servos of a bus by their present ID; iterates in the order of add()."""

    def __init__(self, lib: ctypes.CDLL, bus: int, now: Callable[[], int]) -> None:
        """bus: servo_bus_t pointer; now: returns the board's cycle."""
        self.lib, self.bus, self.now = lib, bus, now

    def add(self, servo_id: int, model: str = "ax12", rate: int | None = None) -> Servo:
        number = self.lib.servo_api_model(model.encode())
        if number < 0:
            raise ValueError(f"no servo model {model!r}; known: {', '.join(MODELS)}")
        pointer = self.lib.servo_bus_add(self.bus, servo_id, number, rate or (57142 if model == "dx117" else 1_000_000))
        if not pointer:
            raise MemoryError("no memory for a servo")
        return Servo(self, pointer)

    def __len__(self) -> int:
        return int(self.lib.servo_api_count(self.bus))

    def __iter__(self) -> Iterator[Servo]:
        for index in range(len(self)):
            yield Servo(self, self.lib.servo_api_at(self.bus, index))

    def __getitem__(self, servo_id: int) -> Servo:
        pointer = self.lib.servo_bus_find(self.bus, servo_id)
        if not pointer:
            raise KeyError(f"no servo with ID {servo_id}; there are {self.ids}")
        return Servo(self, pointer)

    def __contains__(self, servo_id: int) -> bool:
        return bool(self.lib.servo_bus_find(self.bus, servo_id))

    @property
    def ids(self) -> list[int]:
        return [servo.id for servo in self]

    @property
    def present(self) -> dict[int, int]:
        return {servo.id: servo.present for servo in self}

    @property
    def goals(self) -> dict[int, int]:
        return {servo.id: servo.goal for servo in self}

    def row(self, count: int) -> Iterator[tuple[float, float]]:
        """(goal, position) of the first `count` servos, with fractions. The goal of a limp servo is -1."""
        row = (ctypes.c_double * (2 * count))()
        self.lib.servo_api_row(self.bus, self.now(), count, row)
        return zip(row[::2], row[1::2])

    def noise(self, data: bytes, rate: int = 1_000_000) -> None:
        """Puts stray bytes on the wire from now on."""
        self.lib.servo_bus_noise(self.bus, self.now(), bytes(data), len(data), rate)
