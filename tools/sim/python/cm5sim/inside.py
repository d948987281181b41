# SPDX-License-Identifier: MIT
"""A test's view into the firmware: functions and variables by name, cycles, interrupts at any place, single steps. Part of class Board."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

# Interrupts of this firmware, by cause.
VECTORS = {"tick": 12, "bus byte": 18, "bus room": 19, "bus sent": 20, "console byte": 30, "console room": 31}


def number_of(vector: int | str) -> int:
    return VECTORS[vector] if isinstance(vector, str) else vector


class Cycles(NamedTuple):
    """Cycles of a probed function: own time (without interrupts) and total time."""

    count: int  # type: ignore[assignment]  # hides tuple.count, which nobody asks of a probe
    max: int
    mean: float
    total_max: int
    total_mean: float
    max_at: int


class Inside:
    """Part of class Board, which sets these two."""

    _lib: ctypes.CDLL
    _pointer: int | None

    def function(self, name: str) -> int:
        address: int = self._lib.board_function(self._pointer, name.encode())
        if address == 0xFFFFFFFF:
            raise KeyError(f"no function {name} in the loaded images")
        return address

    def variable(self, name: str) -> int:
        """Data address of a variable."""
        address: int = self._lib.board_variable(self._pointer, name.encode())
        if address == 0xFFFFFFFF:
            raise KeyError(f"no variable {name} in the loaded images")
        return address

    def function_at(self, address: int) -> str:
        name: bytes = self._lib.board_function_at(self._pointer, address)
        return name.decode()

    @property
    def pc(self) -> int:
        return int(self._lib.board_pc(self._pointer))

    @property
    def stack_headroom(self) -> int:
        """Bytes between the end of the variables and the lowest stack address so far."""
        return int(self._lib.board_stack_headroom(self._pointer))

    def probe(self, *names: str) -> None:
        """Counts the cycles of functions from now on."""
        for name in names:
            if not self._lib.board_probe(self._pointer, name.encode()):
                raise KeyError(f"no function {name} in the loaded images, or too many probes")

    def cycles(self, name: str) -> Cycles:
        """Figures of a probed function."""
        pointer = self._lib.board_probe_result(self._pointer, name.encode())
        if not pointer:
            raise KeyError(f"{name} is not probed")
        r = pointer.contents
        calls = max(r.calls, 1)
        return Cycles(r.calls, r.own_max, r.own_sum / calls, r.total_max, r.total_sum / calls, r.max_at)

    def clear_probes(self) -> None:
        self._lib.board_probe_clear(self._pointer)

    def interrupt(self, vector: int | str, byte: int = 0) -> None:
        """Raises an interrupt now (a number as for board_interrupt() in board_debug.h, or a name from VECTORS)."""
        if not self._lib.board_interrupt(self._pointer, number_of(vector), byte):
            raise ValueError(f"interrupt {vector} cannot be raised")

    def sweep(self, function: str, vector: int | str, byte: int = 0) -> None:
        """Interrupts each call of a function once from now on, one instruction later each time."""
        number = number_of(vector)
        if not self._lib.board_sweep(self._pointer, function.encode(), number, byte):
            raise KeyError(f"no function {function} in the loaded images, or interrupt {vector} cannot be raised")

    def swept(self, function: str) -> Any:
        """Progress of a sweep: place, calls, rounds, taken, last."""
        pointer = self._lib.board_sweep_result(self._pointer, function.encode())
        if not pointer:
            raise KeyError(f"{function} is not swept")
        return pointer.contents

    def end_sweeps(self) -> None:
        self._lib.board_sweep_end(self._pointer)

    def skip_waits(self, on: bool = True) -> None:
        """Counts the rounds of loops that only wait, instead of executing them: the same run, but faster. Probes do not see those
        rounds."""
        self._lib.board_skip_waits(self._pointer, on)

    def step(self) -> int:
        """Runs one instruction or interrupt response and returns its cycles."""
        return int(self._lib.board_step(self._pointer))

    def gdb(self, port: int) -> None:
        """Waits for avr-gdb on this port of 127.0.0.1. From then on the debugger controls the run."""
        if not self._lib.board_gdb(self._pointer, port, True):
            raise OSError(self._lib.board_error(self._pointer).decode())
