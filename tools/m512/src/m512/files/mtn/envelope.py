# SPDX-License-Identifier: MIT
"""The envelope of a .mtn: byte-order mark, line ends and the two checksum bytes after the last line.

Editors and version control change these unnoticed: a line end after the checksum, a byte-order mark removed although the sum includes
it, CR LF, a missing or outdated checksum. The text itself remains valid. So every complete text is accepted, and the findings are
reported.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction

from m512.errors import FileError
from m512.files.wording import counted

BOM = b"\xef\xbb\xbf"
LAST = b"page_end"
BLANK = b" \t\r\n\0\x1a"
LONGEST_TAIL = 16  # the most that an editor can make of two bytes; anything longer is text


def file_checksum(body: bytes) -> bytes:
    """The trailer: the complement of the 16-bit sum of all bytes before it, high byte first."""
    return (~sum(body) & 0xFFFF).to_bytes(2, "big")


def unwrap(data: bytes, where: str) -> tuple[str, list[str]]:
    """The text with LF line ends, and remarks. Bytes that are not UTF-8 become surrogate escapes. FileError: the text is incomplete."""
    at = data.rfind(LAST)
    if at < 0:
        raise FileError(f'{where}: no page ends in it (no line "page_end"): the file is not a whole .mtn')
    end = at + len(LAST)
    _must_end_here(data, end, where)
    text = data[:end].replace(b"\r\n", b"\n").replace(b"\r", b"\n") + b"\n"
    text = re.sub(rb"\A(?:\xef\xbb\xbf)+", b"", text)  # one BOM or several
    return text.decode("utf-8", "surrogateescape"), _judge(data, end)


def first_change(data: bytes, again: bytes) -> str:
    """The first line of a .mtn that says something else when the file is written again; empty if none does. How numbers are written does
    not count, nor the version, nor empty pages at the end."""
    text = unwrap(data, "")[0]
    for (number, said), (_, says) in zip(_said(text), _said(unwrap(again, "")[0])):
        if said != says:
            return f"line {number} ({text.split(chr(10))[number - 1].partition('=')[0]}) would change"
    return ""


def _said(text: str) -> Iterator[tuple[int, object]]:
    """(line number, what the line says)."""
    for number, line in enumerate(text.split("\n"), 1):
        key, _, value = line.partition("=")
        if key == "name":
            yield number, line
        elif line.strip() and key != "version" and (key != "motor_type" or value.strip(" 0")):
            words = value.replace(",", ".").split()
            if key == "play_param":
                del words[3:4]  # the rate: a note says what it becomes, as in RoboPlus
            yield number, (key.strip(), [Fraction(word) if word[-1:].isdigit() else word for word in words])


def _must_end_here(data: bytes, end: int, where: str) -> None:
    tail = data[end:].strip(BLANK)
    if tail.startswith(b"page_begin") or len(tail) > LONGEST_TAIL:
        line = data[:end].count(b"\n") + 2
        page = data[:end].count(LAST) + 1
        raise FileError(f"{where}:{line}: page {page} has no end: the file breaks off, or something else stands behind page {page - 1}")


def _judge(data: bytes, end: int) -> list[str]:
    """The result of the checksum in one sentence; empty if the sum is that of the file's own bytes."""
    if data[:-2].endswith((LAST + b"\n", LAST + b"\r\n")) and file_checksum(data[:-2]) == data[-2:]:
        return []
    for changes, body, trailer in _as_it_was(data, end):
        if file_checksum(body) == trailer:
            return [f"the file was changed on its way ({', '.join(changes)}), but its checksum shows that the text is as it was written"]
    found = _trailer(data[end:])
    pages = counted(data.count(LAST), "page")
    if found is None:
        return [f"the file has no checksum, so only you can tell whether it is complete: {pages} {'was' if pages == '1 page' else 'were'} read"]
    return [
        f"the file's checksum is {found.hex(' ')} and should be {file_checksum(data[:end] + _line_end(data[end:])).hex(' ')}: "
        f"it was edited by hand, or damaged. {pages} could be read; look at them before a robot plays them"
    ]


def _line_end(tail: bytes) -> bytes:
    return b"\r\n" if tail.startswith(b"\r\n") else b"\n"


def _trailer(tail: bytes) -> bytes | None:
    """The bytes in the checksum's place, or None."""
    return tail.strip(BLANK)[:2] or None


def _tails(tail: bytes) -> Iterator[tuple[list[str], bytes]]:
    """Possible checksums: after a line end or without one, before white space, re-encoded as UTF-8."""
    for line_end in (b"\n", b"\r\n", b"\r", b""):
        rest = tail[len(line_end) :]
        if not tail.startswith(line_end) or len(rest) < 2:
            continue
        if not rest[2:].strip(BLANK):
            yield ["something blank added at its end"] if rest[2:] else [], rest[:2]
        for encoding in ("latin-1", "cp1252"):
            try:
                again = rest.decode("utf-8").encode(encoding)
            except UnicodeError:
                continue
            if len(again) > 1 and not again[2:].strip(BLANK):
                yield ["the checksum saved as text"], again[:2]


def _as_it_was(data: bytes, end: int) -> Iterator[tuple[list[str], bytes, bytes]]:
    """(changes, body, trailer): what the body may have been when the sum was computed, and what has changed since."""
    text = data[:end]
    bare = text[len(BOM) :] if text.startswith(BOM) else text
    marks = [(["byte-order mark added"] if bare != text else [], bare), (["byte-order mark removed"] if bare == text else [], BOM + bare)]
    for mark, marked in marks:
        unix = marked.replace(b"\r\n", b"\n")
        for ends, body in (
            (["line ends now CR LF"] if unix != marked else [], unix + b"\n"),
            (["line ends mixed"], marked + b"\r\n"),
            (["line ends now LF"], unix.replace(b"\n", b"\r\n") + b"\r\n"),
            (["a line end added"], unix),
        ):
            for changes, trailer in _tails(data[end:]):
                yield mark + ends + changes, body, trailer
