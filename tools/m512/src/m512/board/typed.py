# SPDX-License-Identifier: MIT
"""What raw data would do to the factory loader if it were taken for typed text.

A pause of 111 ms on the line ends a download of that loader (a bridge, a radio link, a busy computer). What comes behind
the pause is typed text for it: a line of 80 characters crashes it at the line's end, Ctrl-A brings `load` and its address
back with the rest of the line behind it, and "l" alone opens a download to 0. All of that needs the end of a line. So
data is sent in segments in which no line end stands behind anything that could do harm: the pause may then come anywhere.
"""

from __future__ import annotations

import re

LINE_ENDS = b"\r\n"
DROPPED = b"\x00\x1b"  # the loader neither keeps nor echoes them
# A line of 80 characters crashes it; half of that, because a line may double bytes.
LINE_BYTES = 40
CTRL_A, BACKSPACE = 0x01, 0x08
# Words that change something or leave the prompt, from anywhere in the text on: the pause decides where the line begins.
_WORDS = re.compile(
    rb"(?:l|ld|load|dn|down|eep_dn|clear_eeprom|up|eep_up|g|go|reset|app|application|sys|system)"
    rb"(?:[\x09\x20-\x2f].*)?\Z",
    re.S | re.I,
)


def is_risky(line: bytes) -> bool:
    """Whether the end of this line, or of any rest of it, could do harm."""
    kept = line.translate(None, DROPPED)
    return len(kept) >= LINE_BYTES or CTRL_A in kept or BACKSPACE in kept or _WORDS.search(kept) is not None


def cuts(data: bytes) -> list[int]:
    """The line ends that must begin a segment of their own."""
    out, start = [], 0
    for at, byte in enumerate(data):
        if byte in LINE_ENDS:
            if is_risky(data[start:at]):
                out.append(at)
            start = at + 1
    return out


def segments(data: bytes, *more: int) -> list[tuple[int, int]]:
    """(start, end) of the pieces of `data` that may be sent in one download each, cut also at `more`; last piece first."""
    bounds = sorted({0, len(data), *cuts(data), *more})
    return list(zip(bounds, bounds[1:]))[::-1]
