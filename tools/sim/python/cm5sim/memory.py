# SPDX-License-Identifier: MIT
"""A memory of the simulated board, used like a bytearray: b.flash[0xE000:0xE200], b.eeprom[5] = 1."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, overload

if TYPE_CHECKING:
    from .board import Board


class Memory:
    """Reads and writes the chip's memory directly, like a programmer: no time passes, no wear."""

    def __init__(self, board: Board, size: int, read: Callable[..., Any], write: Callable[..., Any]) -> None:
        self._board, self._size, self._read, self._write = board, size, read, write

    def __len__(self) -> int:
        return self._size

    def _get(self, start: int, count: int) -> bytes:
        buffer = ctypes.create_string_buffer(max(count, 1))
        done = self._read(self._board._pointer, start, buffer, count)
        return buffer.raw[:done]

    @overload
    def __getitem__(self, where: int) -> int: ...
    @overload
    def __getitem__(self, where: slice) -> bytes: ...
    def __getitem__(self, where: int | slice) -> int | bytes:
        if isinstance(where, slice):
            start, stop, step = where.indices(self._size)
            return self._get(start, max(stop - start, 0))[::step] if step > 0 else bytes(self)[where]
        return self._get(range(self._size)[where], 1)[0]

    @overload
    def __setitem__(self, where: int, value: int) -> None: ...
    @overload
    def __setitem__(self, where: slice, value: Iterable[int]) -> None: ...
    def __setitem__(self, where: int | slice, value: int | Iterable[int]) -> None:
        if isinstance(where, slice):
            start, stop, step = where.indices(self._size)
            data = bytes(value)
            if step != 1 or len(data) != max(stop - start, 0):
                raise ValueError("a slice of a memory takes as many bytes as it has, in steps of 1")
        else:
            start, data = range(self._size)[where], bytes([value])  # type: ignore[list-item]
        if data and self._write(self._board._pointer, start, data, len(data)) != len(data):
            raise IndexError(f"0x{start:X} cannot be written")

    def __bytes__(self) -> bytes:
        return self._get(0, self._size)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (bytes, bytearray, Memory)) and bytes(self) == bytes(other)
