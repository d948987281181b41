# SPDX-License-Identifier: MIT
"""Flash pages through the factory loader's `load`, in a way in which it cannot be hurt.

`load` takes raw bytes without bound, up to a silence of 111 ms, and writes whole pages from a buffer that keeps what was in
it. So whatever a line does to the bytes (pauses, loss, each byte twice, bytes that come after this program has died):

* While a download may be open nothing is sent but the bytes that were announced. Only text that the loader sends behind a
  download proves its end; without it this program gives up and says so.
* A download has at most 256 bytes. Twice as many end in the page behind, which has to be one of those that this command
  writes. The last of them is written by a single byte, with its other 255 as left-overs of the download before, which went
  to the page below: so nothing can come past it but 256 bytes too many out of one.
* Data is cut into segments that do no harm if a pause makes typed text of them (typed.py). The last segment is sent first,
  with NULs in front of it, which the loader drops when they are typed; the segments before it then overwrite the NULs.
* No download starts in the RESERVE below the loader: what this program sends while it cannot know who listens (the knock and
  the '#' of loaders.py, BLIND_MOST bytes, each perhaps doubled) would end below the loader even if a download was open.
  Those pages go through the mailbox (mailbox.py).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from m512.board.factory_line import WRONG_ADDRESS, FactoryLine, Unsure
from m512.board.memory import BOOT, FLASH_PAGE
from m512.board.typed import segments
from m512.errors import BoardError, RefusedError

BLIND_MOST = 2600
RESERVE = 0x1800
LAST_START = BOOT[0] - RESERVE
assert RESERVE >= 2 * (BLIND_MOST + FLASH_PAGE)
TRIES = 5
REPORT_SECONDS = 0.35  # 111 ms of silence, a page and nine EEPROM bytes, 100 ms between the report's halves
REPORT_BYTES = 70
_REPORT = re.compile(
    rb"(?:Success|Error).*Rewriting:0X([0-9A-F]{4}).*"
    rb"Size:0X([0-9A-F]{8})  Checksum:([0-9A-F]{2})-([0-9A-F]{2})",
    re.S,
)
# What can only come when a download is over: the loader is silent while it receives.
_OVER = re.compile(rb"Succ|Erro|Rewr|Size|Checks|\r\n - ")


def in_reserve(page: int) -> bool:
    return page * FLASH_PAGE >= LAST_START


def write_page(loader: FactoryLine, page: int, pages: dict[int, bytes]) -> None:
    """Writes a page. `pages`: what belongs into those that may be endangered; they are to be looked at afterwards."""
    if page + 1 in pages:
        _send(loader, page, page, pages[page], segments(pages[page]))
    elif page - 1 in pages:
        _send(loader, page - 1, page, pages[page], segments(pages[page], 1))
    else:
        raise RefusedError(f"page 0x{page * FLASH_PAGE:05X} alone cannot be written safely")  # our own mistake


def endangered(page: int, pages: dict[int, bytes]) -> set[int]:
    """The pages that may have changed when a page has been written."""
    return {page, page + 1 if page + 1 in pages else page - 1}


def _send(loader: FactoryLine, scratch: int, page: int, data: bytes, pieces: list[tuple[int, int]]) -> None:
    """All pieces but the lowest go to `scratch`, to fill the loader's buffer; the lowest, sent last, to the page.

    After trouble all are sent again: the buffer may hold anything."""
    trouble = ""
    for _ in range(TRIES):
        for start, end in pieces:
            at = page if start == 0 else scratch
            trouble = _download(loader, at * FLASH_PAGE, bytes(start) + data[start:end])
            if trouble:
                break
        else:
            return
        loader.retries += 1
        loader.clean()
    raise BoardError(f"page 0x{page * FLASH_PAGE:05X}: {trouble}, {TRIES} times. {loader.how_it_stands()}")


def _download(loader: FactoryLine, address: int, data: bytes) -> str:
    """One download: what went wrong, or nothing; it is over then. Unsure: it may still be open."""
    if address % FLASH_PAGE or not 0 < len(data) <= FLASH_PAGE or not 0 <= address < LAST_START:
        raise RefusedError(f"a download to 0x{address:X} of {len(data)} bytes would hurt")  # our own mistake
    loader.type_line(f"load {address:x}")
    loader.open_at = address
    loader.link.write(b"\r")
    answer, ready = loader.link.look_for(b"Ready..", loader.patience(80))
    if not ready and _OVER.search(answer):  # a prompt: the line came damaged and was no `load`
        loader.open_at = None
        return "the loader did not understand"
    if not ready:
        raise Unsure(loader.how_it_stands())
    if b"Write Address : %08X" % address not in answer:
        raise Unsure(WRONG_ADDRESS)
    if _OVER.search(loader.link.drain(0)):  # the end of the line came twice: ended before it began
        loader.open_at = None
        return "the line doubles bytes"
    loader.link.write(data)
    report, ended = loader.link.look_for(b"\r\n - ", loader.patience(len(data) + REPORT_BYTES) + REPORT_SECONDS)
    if not _OVER.search(report):
        raise Unsure(loader.how_it_stands())
    loader.open_at = None
    return _judge(report, data) if ended else "its report came damaged"


def _judge(report: bytes, data: bytes) -> str:
    found = _REPORT.search(report)
    if not found:
        return "its report came damaged"
    size, total, last = (int(found.group(k), 16) for k in (2, 3, 4))
    if size != len(data):
        return f"{size} bytes arrived instead of {len(data)}"
    if total != sum(data[:-1]) & 0xFF or last != data[-1]:
        return "the sum does not fit"
    return ""


def units(pages: set[int]) -> Iterator[list[int]]:
    """Neighbouring pages together: the runs within which a download may go wrong. Motion pages are runs of two."""
    run: list[int] = []
    for page in sorted(pages):
        if run and (page != run[-1] + 1 or _motion(page) != _motion(run[-1])):
            yield run
            run = []
        run.append(page)
    if run:
        yield run


def _motion(page: int) -> int:
    """The motion page that a flash page belongs to; -1: none."""
    return page // 2 if page * FLASH_PAGE >= 0xE000 else -1
