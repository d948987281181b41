# SPDX-License-Identifier: MIT
"""The board's flash: its areas (the same as in linker/memory_map.h), and images to be written there.

plan() makes and checks a Plan before a byte is sent. It refuses what would do harm.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from m512.crc16 import crc16
from m512.errors import FileError, RefusedError, UnknownKindError
from m512.files import conversion, formats, scale12, storage
from m512.files.image import Image, hex_segments, is_erased
from m512.files.page import PAGE_BYTES, Page

Segments = list[tuple[int, bytes]]  # (address, bytes)
FLASH_PAGE = 256
APP = (0x00000, 0x0C000)
JOURNAL = (0x0C000, 0x0E000)
MOTIONS = (0x0E000, 0x1E000)
BOOT = (0x1E000, 0x20000)
EEPROM_BYTES = 4096
ELF = b"\x7fELF"
RECORD_AT, RECORD_BYTES = 0x8C, 16
BOARDS = {1: "cm5", 2: "cm2"}
KINDS = {1: "play", 2: "edit", 255: "other"}


def motion_page_of(flash_page: int) -> int:
    """The motion page that a flash page of the motion area belongs to."""
    return (flash_page * FLASH_PAGE - MOTIONS[0]) // PAGE_BYTES


def motion_area(number: int) -> tuple[int, int]:
    """[start, end) of a motion page in flash."""
    return MOTIONS[0] + number * PAGE_BYTES, MOTIONS[0] + (number + 1) * PAGE_BYTES


@dataclass
class Record:
    """The record in an application image (app_record.h)."""

    length: int
    crc: int
    board: str
    kind: str
    version: str

    @classmethod
    def of(cls, app: bytes) -> Record | None:
        raw = app[RECORD_AT : RECORD_AT + RECORD_BYTES]
        if len(raw) < RECORD_BYTES or raw[:4] != b"M512" or raw[15] != 1:
            return None
        return cls(
            int.from_bytes(raw[4:8], "little"),
            int.from_bytes(raw[8:10], "little"),
            BOARDS.get(raw[10], f"board {raw[10]}"),
            KINDS.get(raw[11], f"kind {raw[11]}"),
            ".".join(str(b) for b in raw[12:15]),
        )

    def fits(self, app: bytes) -> bool:
        """Whether length and CRC match the image."""
        if not RECORD_AT + RECORD_BYTES <= self.length <= min(len(app), APP[1]):
            return False
        body = bytearray(app[: self.length])
        body[RECORD_AT + 8 : RECORD_AT + 10] = b"\xff\xff"
        return crc16(bytes(body)) == self.crc

    def __str__(self) -> str:
        return f"Motion512 {self.kind} {self.version} for {self.board}"


@dataclass
class Plan:
    """Complete flash pages to write: page index -> 256 bytes. `remarks` are for the user."""

    pages: dict[int, bytes] = field(default_factory=dict)
    record: Record | None = None
    remarks: list[str] = field(default_factory=list)

    @property
    def has_app(self) -> bool:
        return any(number * FLASH_PAGE < APP[1] for number in self.pages)

    @property
    def has_motions(self) -> bool:
        return any(number * FLASH_PAGE >= MOTIONS[0] for number in self.pages)


def _refuse_outside(start: int, end: int, what: str) -> None:
    if start < 0:
        raise RefusedError(f"{what}: there is no address {start}")
    if end > BOOT[0]:
        raise RefusedError(
            f"{what} reaches 0x{end - 1:05X}, into the boot loader ({_area(BOOT)}). That area can only be written with an ISP programmer"
        )
    if start < JOURNAL[1] and end > JOURNAL[0]:
        raise RefusedError(f"{what} reaches into {_area(JOURNAL)}, where saved pages are kept in passing. An application has {_area(APP)}")


def _area(area: tuple[int, int]) -> str:
    return f"0x{area[0]:05X}..0x{area[1] - 1:05X}"


def plan(path: Path, address: int | None = None, board: str | None = None, with_trim: bool = False, damaged: str = "ask") -> Plan:
    """The Plan for flashing a file. `board`: cm5 or cm2 if known; code for the other one is refused. `address`: start of a raw binary;
    its part in the motion area is checked like a motion file. `with_trim`: writes page 0 even if it holds no trim."""
    data = storage.read(path)
    out = Plan()
    with formats.naming(path):
        segments = _segments(path, data, address, out, with_trim, damaged)
    for start, piece in segments:
        _refuse_outside(start, start + len(piece), path.name)
        _add(out, start, piece)
    if not out.pages:
        raise FileError(f"{path} holds nothing to flash" + "".join(f": {remark}" for remark in out.remarks))
    if out.has_app:
        _judge_app(out, path, board)
    return out


def _segments(path: Path, data: bytes, address: int | None, out: Plan, with_trim: bool, damaged: str) -> Segments:
    is_hex = data[:200].lstrip(b"\xef\xbb\xbf \r\n").startswith(b":")
    if data.startswith(ELF):
        raise FileError(f"{path} is an ELF file. Flash the Intel HEX that is made of it: avr-objcopy -O ihex IN.elf OUT.hex")
    if address is not None:
        _must_be_raw(path, data)
    elif not is_hex:
        return _motions(path, _motions_of(path, data), out, with_trim, damaged)
    segments = hex_segments(data.decode("ascii", "replace")) if address is None else [(address, data)]
    if segments and segments[0][0] >= 0x20000:
        raise RefusedError(f"{path.name} begins at 0x{segments[0][0]:05X}, beyond this board's flash (a CM-510 image?)")
    for start, piece in segments:
        _refuse_outside(start, start + len(piece), path.name)
    code = [(start, piece[: MOTIONS[0] - start]) for start, piece in segments if start < MOTIONS[0]]
    motions = [(max(start, MOTIONS[0]), piece[max(MOTIONS[0] - start, 0) :]) for start, piece in segments if start + len(piece) > MOTIONS[0]]
    return code + (_placed_motions(path, motions, out, with_trim, damaged) if motions else [])


def _motions_of(path: Path, data: bytes) -> Image:
    try:
        return formats.decode(data, path)
    except UnknownKindError as error:
        raise FileError(f"{error}. A raw binary of code needs --address, such as 0x0") from None


def _must_be_raw(path: Path, data: bytes) -> None:
    try:
        kind = formats.recognise(data, path)
    except FileError:  # not a motion file
        return
    if kind != formats.BINARY:
        raise RefusedError(f"{path.name} is {kind}, which has a place of its own: leave out --address. --address is for raw binaries")


def _placed_motions(path: Path, segments: Segments, out: Plan, with_trim: bool, damaged: str) -> Segments:
    """The motion pages of a file with addresses, checked like any motion file. Pages missing in the file stay as they are on the board."""
    image, given = Image.empty(), set()
    for start, piece in segments:
        if (start - MOTIONS[0]) % PAGE_BYTES or len(piece) % PAGE_BYTES:
            raise FileError(f"{path.name}: 0x{start:05X}..0x{start + len(piece) - 1:05X} is not made of whole 512-byte motion pages")
        for at in range(0, len(piece), PAGE_BYTES):
            number = (start - MOTIONS[0] + at) // PAGE_BYTES
            image[number] = Page(piece[at : at + PAGE_BYTES])
            given.add(number)
    judged = scale12.judged(image, None)
    whole = [
        (address + at, data[at : at + PAGE_BYTES])
        for address, data in _motions(path, judged, out, with_trim or 0 not in given, damaged)
        for at in range(0, len(data), PAGE_BYTES)
    ]
    return [(address, data) for address, data in whole if (address - MOTIONS[0]) // PAGE_BYTES in given]


def _motions(path: Path, image: Image, out: Plan, with_trim: bool, damaged: str) -> Segments:
    image, losses = conversion.for_board(image, path)
    out.remarks += losses
    bad = [(n, page.fault_text()) for n, page in image.items() if page.fault() and not is_erased(page)]
    if bad and damaged == "ask":
        raise RefusedError("damaged pages (--damaged keep flashes them all the same):\n" + "\n".join(f"  page {n}: {why}" for n, why in bad))
    data = image.to_bytes()
    why = "" if with_trim else _no_trim(image[0])
    if why:
        out.remarks.append(why)
        return [(MOTIONS[0] + PAGE_BYTES, data[PAGE_BYTES:])]
    return [(MOTIONS[0], data)]


def _no_trim(page: Page) -> str:
    """Why page 0 of a file must not replace the robot's trim, or an empty text."""
    if page.trim_problem():
        return f"page 0: {page.trim_problem()}. It is left out, and the robot keeps its own (--with-trim writes it)"
    if any(page.trims()):
        return ""
    if is_erased(page) or page.is_empty:
        return "page 0 of the file holds no trim; the robot keeps its own (--with-trim overwrites it)"
    return "page 0 of the file holds steps and no trim. It is left out, and the robot keeps its own (--with-trim writes it)"


def _add(out: Plan, start: int, piece: bytes) -> None:
    """Adds bytes to complete flash pages; the rest of a new page is 0xFF."""
    for at in range(start - start % FLASH_PAGE, start + len(piece), FLASH_PAGE):
        page = bytearray(out.pages.get(at // FLASH_PAGE, b"\xff" * FLASH_PAGE))
        low, high = max(at, start), min(at + FLASH_PAGE, start + len(piece))
        page[low - at : high - at] = piece[low - start : high - start]
        out.pages[at // FLASH_PAGE] = bytes(page)


def app_bytes(pages: dict[int, bytes]) -> bytes:
    """The application area in one piece, from the given pages. Missing pages are 0xFF."""
    last = max((n for n in pages if n * FLASH_PAGE < APP[1]), default=-1)
    return b"".join(pages.get(n, b"\xff" * FLASH_PAGE) for n in range(last + 1))


def _judge_app(out: Plan, path: Path, board: str | None) -> None:
    app = app_bytes(out.pages)
    if 0 not in out.pages or app[:2] == b"\xff\xff":
        raise RefusedError(f"{path.name} has no reset vector at 0: not a program for this board")
    out.record = Record.of(app)
    if out.record is None:
        out.remarks.append(f"{path.name} is not one of our images (no record): it is taken for the right board")
        return
    if board and out.record.board in BOARDS.values() and out.record.board != board:
        raise RefusedError(f"{path.name} is {out.record}, but the board is a {board}")
    if not out.record.fits(app):
        raise RefusedError(f"{path.name} is damaged: its length or CRC does not fit its record")
