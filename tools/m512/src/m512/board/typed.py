# SPDX-License-Identifier: MIT
"""Finds raw data that would do harm if the factory loader took it for typed text.

A pause of 111 ms on the line (a bridge, a radio link, a busy computer) ends a download of that loader. The loader takes what
follows as typed text. A line of 80 characters crashes it at the line's end, Ctrl-A recalls `load` and its address with the
rest of the line after it, and "l" alone opens a download to 0. All of these need a line end. So data is sent in segments in
which no line end follows anything harmful. The pause may then come anywhere.
"""

from __future__ import annotations

import re

LINE_ENDS = b"\r\n"
DROPPED = b"\x00\x1b"  # the loader neither stores nor echoes these
# A line of 80 characters crashes the loader. The limit is half of that because a line may double bytes.
LINE_BYTES = 40
CTRL_A, BACKSPACE = 0x01, 0x08
# Words that change something or leave the prompt. They match anywhere in the text, because the pause decides where the line begins.
_WORDS = re.compile(
    rb"(?:l|ld|load|dn|down|eep_dn|clear_eeprom|up|eep_up|g|go|reset|app|application|sys|system)"
    rb"(?:[\x09\x20-\x2f].*)?\Z",
    re.S | re.I,
)


def is_risky(line: bytes) -> bool:
    """Whether executing this line, or any tail of it, could do harm."""
    kept = line.translate(None, DROPPED)
    return len(kept) >= LINE_BYTES or CTRL_A in kept or BACKSPACE in kept or _WORDS.search(kept) is not None


def cuts(data: bytes) -> list[int]:
    """The positions of the line ends that must begin a new segment."""
    out, start = [], 0
    for at, byte in enumerate(data):
        if byte in LINE_ENDS:
            if is_risky(data[start:at]):
                out.append(at)
            start = at + 1
    return out


def segments(data: bytes, *more: int) -> list[tuple[int, int]]:
    """(start, end) of the pieces of `data`, each safe to send in one download. Also cuts at `more`. The last piece comes first."""
    bounds = sorted({0, len(data), *cuts(data), *more})
    return list(zip(bounds, bounds[1:]))[::-1]
