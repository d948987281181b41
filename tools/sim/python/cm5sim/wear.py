# SPDX-License-Identifier: MIT
"""Wear and operations of flash and EEPROM, and power cuts at any operation. Part of class Board."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

from . import library

OPERATIONS = ("erase", "write", "eeprom")


class Wear:
    """Part of class Board, which sets these two."""

    _lib: ctypes.CDLL
    _pointer: int | None

    def wear(self, page: int) -> int:
        """Number of erases of a 256-byte flash page."""
        return int(self._lib.board_flash_wear(self._pointer, page))

    def eeprom_wear(self, address: int) -> int:
        return int(self._lib.board_eeprom_wear(self._pointer, address))

    def age(self, page: int, erases: int) -> None:
        """Sets the number of erases of a flash page."""
        self._lib.board_age_flash(self._pointer, page, erases)

    def age_eeprom(self, address: int, writes: int) -> None:
        self._lib.board_age_eeprom(self._pointer, address, writes)

    @property
    def operations(self) -> int:
        """Number of flash erases, flash writes and EEPROM byte writes so far."""
        return int(self._lib.board_operations(self._pointer))

    def operation(self, number: int) -> tuple[str, int]:
        """("erase" | "write" | "eeprom", address) of operation number (1, 2, ...)."""
        kind, address = ctypes.c_int(), ctypes.c_uint32()
        if not self._lib.board_operation(self._pointer, number, ctypes.byref(kind), ctypes.byref(address)):
            raise IndexError(f"operation {number} is not on record")
        return OPERATIONS[kind.value], address.value

    def cut_power(self, op: int, phase: str = "during", tear: int = 0) -> None:
        """Arms a power cut at the op-th operation from now (1: the next). phase: before, during or after."""
        phases = ("before", "during", "after")
        self._lib.board_cut_power(self._pointer, self.operations + op, phases.index(phase), tear)

    def cut_power_at(self, ms: float) -> None:
        """Arms a power cut after this many milliseconds from now."""
        self._lib.board_cut_power_at(self._pointer, self._lib.board_now(self._pointer) + int(ms * library.CYCLES_PER_MS))

    def on_operation(self, done: Callable[[], object] | None) -> None:
        """Calls done() inside run(), at the end of each operation that is not cut. done() must not raise. None: stops the calls."""
        self._done_before = getattr(self, "_done", None)  # keeps it alive: it may be the present caller
        self._done = library.OPERATION_DONE(lambda *_: done()) if done else library.OPERATION_DONE()
        self._lib.board_on_operation(self._pointer, self._done, None)

    def lock(self, bits: int) -> None:
        self._lib.board_set_lock(self._pointer, bits)
