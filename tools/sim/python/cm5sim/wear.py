# SPDX-License-Identifier: MIT
"""Erases and writes of flash and EEPROM: how often, where, and the power cut at any of them. A part of class Board."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

from . import library

OPERATIONS = ("erase", "write", "eeprom")


class Wear:
    """Of class Board, which sets these two."""

    _lib: ctypes.CDLL
    _pointer: int | None

    def wear(self, page: int) -> int:
        """Erases of a 256-byte flash page."""
        return int(self._lib.board_flash_wear(self._pointer, page))

    def eeprom_wear(self, address: int) -> int:
        return int(self._lib.board_eeprom_wear(self._pointer, address))

    def age(self, page: int, erases: int) -> None:
        """Sets how often a flash page has been erased."""
        self._lib.board_age_flash(self._pointer, page, erases)

    def age_eeprom(self, address: int, writes: int) -> None:
        self._lib.board_age_eeprom(self._pointer, address, writes)

    @property
    def operations(self) -> int:
        """Flash erases, flash writes and EEPROM byte writes so far."""
        return int(self._lib.board_operations(self._pointer))

    def operation(self, number: int) -> tuple[str, int]:
        """("erase" | "write" | "eeprom", address) of operation number (1, 2, ...)."""
        kind, address = ctypes.c_int(), ctypes.c_uint32()
        if not self._lib.board_operation(self._pointer, number, ctypes.byref(kind), ctypes.byref(address)):
            raise IndexError(f"operation {number} is not on record")
        return OPERATIONS[kind.value], address.value

    def cut_power(self, op: int, phase: str = "during", tear: int = 0) -> None:
        """Arms a power cut at the op-th operation from now on (1 = the next), in phase before, during or after."""
        phases = ("before", "during", "after")
        self._lib.board_cut_power(self._pointer, self.operations + op, phases.index(phase), tear)

    def cut_power_at(self, ms: float) -> None:
        """Arms a power cut so many milliseconds from now."""
        self._lib.board_cut_power_at(self._pointer, self._lib.board_now(self._pointer) + int(ms * library.CYCLES_PER_MS))

    def on_operation(self, done: Callable[[], object] | None) -> None:
        """Calls done() at the end of each operation that is not cut, in the middle of run(); it must not raise. None:
        no more."""
        self._done_before = getattr(self, "_done", None)  # may be the one that is just calling
        self._done = library.OPERATION_DONE(lambda *_: done()) if done else library.OPERATION_DONE()
        self._lib.board_on_operation(self._pointer, self._done, None)

    def lock(self, bits: int) -> None:
        self._lib.board_set_lock(self._pointer, bits)
