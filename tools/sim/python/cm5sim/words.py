# SPDX-License-Identifier: MIT
"""Words of the command line and of scripts: times, numbers, remote keys, quoted text."""

from __future__ import annotations

import re
from typing import NamedTuple

_UNITS = {"cycles": 1.0, "us": 16.0, "ms": 16e3, "s": 16e6, "min": 960e6, "tick": 125e3, "ticks": 125e3}
_KEYS = "UDLR123456"
_ESCAPES = {b"r": b"\r", b"n": b"\n", b"t": b"\t", b"e": b"\x1b", b"0": b"\0", b"\\": b"\\", b'"': b'"'}
_WORD = re.compile(rb'"((?:[^"\\]|\\.)*)"|(")|([^\s#]+)', re.S)
_BLANK = re.compile(rb"\s*(?:#.*)?", re.S)


class Word(NamedTuple):
    """A word of a line. Quoted text may contain any bytes."""

    text: bytes
    quoted: bool


def duration(text: str) -> int | None:
    """ "500ms", "2s", "1.5s", "20us", "3ticks" (128 per second), "2min", "100cycles" in cycles of 16 MHz. A bare 0 is also a time."""
    found = re.fullmatch(r"(\d+\.?\d*|\.\d+)([a-z]*)", text)
    value = float(found[1]) if found else -1.0
    if not found or value > 1e9:
        return None
    if found[2] in _UNITS:
        return int(value * _UNITS[found[2]] + 0.5)
    return 0 if not found[2] and value == 0 else None


def number(text: str, low: int, high: int) -> int | None:
    """Parses a decimal or 0x integer in this range; None: it is not one."""
    found = re.fullmatch(r"[+-]?\d+|0[xX][0-9a-fA-F]+", text)
    value = int(text, 16 if text[1:2] in "xX" and len(text) > 2 else 10) if found else None
    return value if value is not None and low <= value <= high else None


def rc_keys(text: str) -> int | None:
    """Converts remote keys joined by "+" (U D L R 1..6), or 0 for none, to the word that the remote sends. None: wrong keys."""
    if text == "0":
        return 0
    keys = text.upper().split("+")
    return sum({1 << _KEYS.index(key) for key in keys}) if all(len(key) == 1 and key in _KEYS for key in keys) else None


def _unescape(found: re.Match[bytes]) -> bytes:
    if found[1] in _ESCAPES:
        return _ESCAPES[found[1]]
    if len(found[1]) == 3:
        return bytes([int(found[1][1:], 16)])
    raise ValueError('unknown escape behind \\ (known: \\r \\n \\t \\e \\0 \\\\ \\" \\xHH)')


def split(line: bytes) -> list[Word]:
    """Splits a line into words; "#" begins a comment. ValueError: what is wrong."""
    words: list[Word] = []
    at = _BLANK.match(line).end()  # type: ignore[union-attr]
    while at < len(line):
        found = _WORD.match(line, at)
        assert found
        if found[2]:
            raise ValueError('a closing " is missing')
        if found[3] is None:
            words.append(Word(re.sub(rb"\\(x[0-9a-fA-F]{2}|.)", _unescape, found[1], flags=re.S), True))
        else:
            words.append(Word(found[3], False))
        at = _BLANK.match(line, found.end()).end()  # type: ignore[union-attr]
    return words
