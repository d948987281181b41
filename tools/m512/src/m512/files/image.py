# SPDX-License-Identifier: MIT
"""Motion areas: raw images and Intel HEX.

| bytes   | pages  | origin                                        |
| 65,536  | 0..127 | CM-2, CM-5, Motion512                         |
| 65,024  | 1..127 | the same without page 0                       |
| 131,072 | 0..255 | CM-510, DARwIn-OP and later (OP3: 12-bit)     |

The length tells which kind a file is. It does not tell whether positions have 12 bits; the caller must say so.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from io import StringIO
from pathlib import Path

from m512.errors import FileError
from m512.files import selection
from m512.files.page import EMPTY, PAGE_BYTES, Fault, Kind, Page
from m512.files.wording import Findings, counted, field_text, named_pages_text

SIZES = {65536: (0, 128), 65024: (1, 128), 131072: (0, 256)}
BOARD_PAGES = 128
HEX_BASE = {128: 0x0E000, 256: 0x1E000}
TWELVE_BIT_MAX = 4095


@dataclass
class Image:
    """All pages of a motion area, `first` (0 or 1) to `end` - 1. `notes` lists the assumptions made by the reader."""

    pages: list[Page]
    first: int = 0
    bits: int = 10
    notes: list[str] = field(default_factory=list)
    joints: dict[int, str] = field(default_factory=dict)  # names, if the file has some
    form: str = ""  # the kind of file it was read from (formats.TEXT, BINARY, ...)
    given: set[int] | None = None  # the pages that an Intel HEX file contains, if not all
    text: str = ""  # the text that it was read from, if it was one
    included: list[Path] = field(default_factory=list)  # other texts that it was read from

    @classmethod
    def empty(cls, count: int = 128) -> Image:
        return cls([Page() for _ in range(count)])

    @property
    def end(self) -> int:
        return self.first + len(self.pages)

    @property
    def kind(self) -> Kind:
        return Kind(self.end, 1023 if self.bits == 10 else TWELVE_BIT_MAX)

    def __getitem__(self, number: int) -> Page:
        if not self.first <= number < self.end:
            raise FileError(f"page {number} is not in this image (pages {self.first}..{self.end - 1})")
        return self.pages[number - self.first]

    def __setitem__(self, number: int, page: Page) -> None:
        self[number].data[:] = page.data

    def items(self) -> Iterator[tuple[int, Page]]:
        return enumerate(self.pages, self.first)

    def copy(self) -> Image:
        """A copy with pages of its own."""
        return replace(self, pages=[page.copy() for page in self.pages])

    def to_bytes(self) -> bytes:
        return b"".join(bytes(page) for page in self.pages)

    def names(self) -> dict[bytes, list[int]]:
        """Page numbers by name, without page 0 and nameless pages."""
        found: dict[bytes, list[int]] = {}
        for number, page in self.items():
            if page.name and number:
                found.setdefault(page.name, []).append(number)
        return found

    def find(self, word: str) -> int:
        """The page number for a number or name (exact, else unambiguous regardless of case). FileError: no such page."""
        number = selection.page_number(word)
        if number is None:
            return selection.find(word, self._words(), FileError)
        self[number]
        return number

    def is_named(self, word: str) -> bool:
        return word in self._words().values()

    def used(self) -> list[int]:
        """Pages that hold something, including damaged ones and page 0 if it holds a trim, however many steps it says."""
        return [number for number, page in self.items() if not is_erased(page) and (not page.is_empty or number == 0 and any(page.trims()))]

    def _words(self) -> dict[int, str]:
        """The names as a user types them."""
        return {number: name.decode("utf-8", "replace") for name, numbers in self.names().items() for number in numbers}

    def beyond(self, count: int) -> dict[int, str]:
        """{number: title} of the used pages beyond 0..count-1."""
        return {number: page.title for number, page in self.items() if number >= count and not page.is_empty and len(set(page.data)) > 1}

    def resized(self, count: int) -> tuple[Image, list[str]]:
        """A copy with pages 0..count-1, and a list of losses. Links to pages that are left out become empty."""
        losses = []
        out = Image([Page() for _ in range(count)], 0, self.bits, list(self.notes), dict(self.joints), self.form, self.given)
        lost = self.beyond(count)
        if lost:
            losses.append(f"{named_pages_text(lost)}: no room among {count} pages, left out")
        cut = Findings()
        for number, page in self.items():
            if number < count:
                out[number] = page
                if self.end > count:
                    _cut_links(out[number], number, self.kind, count, cut)
        return out, losses + cut.lines()


def _cut_links(page: Page, number: int, kind: Kind, count: int, cut: Findings) -> None:
    """Empties the links of an undamaged page that lead beyond the last page."""
    if page.fault(kind) is Fault.OK:
        for link in page.LINKS:
            if getattr(page, link) >= count:
                cut.add(number, page.title, "links to pages that are left out are now empty", f"{field_text(link)} {getattr(page, link)}")
                setattr(page, link, 0)
        page.seal()


def from_bytes(data: bytes, bits: int = 10) -> Image:
    if len(data) not in SIZES:
        raise FileError(f"{counted(len(data), 'byte')} is not the size of a motion image (65,536, 65,024 or 131,072)")
    first, _ = SIZES[len(data)]
    return Image([Page(data[at : at + PAGE_BYTES]) for at in range(0, len(data), PAGE_BYTES)], first, bits)


def hex_segments(text: str) -> list[tuple[int, bytes]]:
    """Intel HEX text as [(address, bytes)], ascending, adjacent pieces joined. FileError: not a valid or complete file."""
    from intelhex import IntelHex, IntelHexError

    end = re.search(r"^:00[0-9A-Fa-f]{4}01.*", text, re.M)
    if not end:
        raise FileError("not a whole Intel HEX file: its end record is missing, so its end may be")
    if re.search(r"^\s*:", text[end.end() :], re.M):
        line = text.count("\n", 0, end.end()) + 1
        raise FileError(
            f"not one Intel HEX file: more follows its end record in line {line}. Are these two files? Separate them; "
            "`m512 pages A.hex merge B.hex all` joins the motions of two"
        )
    hexfile = IntelHex()
    try:
        hexfile.loadhex(StringIO(text))
    except (IntelHexError, ValueError, UnicodeError) as error:
        raise FileError(f"not a good Intel HEX file: {error}") from None
    return [(start, hexfile.tobinstr(start=start, end=end - 1)) for start, end in hexfile.segments()]


def from_hex(text: str, bits: int = 10) -> Image:
    """The motion area in an Intel HEX file. Missing pages are empty. FileError: another area, or incomplete pages."""
    segments = hex_segments(text)
    if not segments:
        raise FileError("the Intel HEX file holds no data")
    low, high = segments[0][0], segments[-1][0] + len(segments[-1][1])
    if 0x0E000 <= low and high <= 0x1E000:
        count = 128
    elif 0x1E000 <= low and high <= 0x3E000:
        count = 256
    else:
        raise FileError(f"addresses 0x{low:05X}..0x{high - 1:05X} are no motion area (0x0E000..0x1DFFF of a CM-2/CM-5, 0x1E000..0x3DFFF of a CM-510)")
    base, image = HEX_BASE[count], Image.empty(count)
    image.bits = bits
    for start, data in segments:
        if (start - base) % PAGE_BYTES or len(data) % PAGE_BYTES:
            raise FileError(f"0x{start:05X}..0x{start + len(data) - 1:05X} is not made of whole 512-byte pages")
        for at in range(0, len(data), PAGE_BYTES):
            image[(start - base + at) // PAGE_BYTES] = Page(data[at : at + PAGE_BYTES])
    given = {(start - base + at) // PAGE_BYTES for start, data in segments for at in range(0, len(data), PAGE_BYTES)}
    if len(given) < count:
        image.given = given
        image.notes.append(f"the file holds {len(given)} of {count} pages; the others are taken as empty")
    return image


def to_hex(image: Image) -> str:
    """The Intel HEX text of an image. What came from a HEX file of some pages has these pages and those that were filled since: flashing
    it replaces no others."""
    from intelhex import IntelHex

    hexfile = IntelHex()
    for number, page in image.items():
        if image.given is None or number in image.given or bytes(page) != EMPTY:
            hexfile.frombytes(bytes(page), offset=HEX_BASE[image.end] + PAGE_BYTES * number)
    out = StringIO()
    hexfile.write_hex_file(out)
    return out.getvalue()


def is_erased(page: Page) -> bool:
    """All 0xFF: flash that was never written."""
    return page.data == b"\xff" * PAGE_BYTES
