# SPDX-License-Identifier: MIT
"""Writes flash pages through the factory loader's `load` without risk to the loader.

`load` takes raw bytes without a limit until the line is silent for 111 ms. It writes whole pages from a buffer that keeps its
old content. The rules below hold whatever a line does to the bytes: pauses, loss, each byte twice, bytes that arrive after this
program has died.

* While a download may be open, only the announced bytes are sent. Only text that the loader sends after a download proves its
  end. Without such text this program gives up and says so.
* A download has at most 256 bytes. If they are doubled, they end in the next page, which must be one that this command writes.
  The last page is written by a download of a single byte. Its other 255 bytes are left in the buffer by the download before,
  which went to the page below. Only a single byte that arrives with 256 extra ones could write past the last page.
* Data is cut into segments that do no harm if a pause turns them into typed text (typed.py), or a line end that arrives twice and
  ends the download before it began. The last segment is sent first, after NULs, which the loader drops when they are typed. The
  segments before it then overwrite the NULs.
* No download starts in the RESERVE below the loader. This program sends up to BLIND_MOST bytes without knowing who listens (the
  knock and the '#' of loaders.py). Even if each is doubled and a download is open, they end below the loader. The pages in the
  RESERVE go through the mailbox (mailbox.py).
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
# Text that is sent only after a download is over: the loader is silent while it receives.
_OVER = re.compile(rb"Succ|Erro|Rewr|Size|Checks|\r\n - ")


def in_reserve(page: int) -> bool:
    return page * FLASH_PAGE >= LAST_START


def write_page(loader: FactoryLine, page: int, pages: dict[int, bytes]) -> None:
    """Writes a page. `pages`: the content of this page and its neighbours. The caller must compare the endangered() ones afterwards."""
    if page + 1 in pages:
        _send(loader, page, page, pages[page], segments(pages[page]))
    elif page - 1 in pages:
        _send(loader, page - 1, page, pages[page], segments(pages[page], 1))
    else:
        raise RefusedError(f"page 0x{page * FLASH_PAGE:05X} alone cannot be written safely")  # a bug in this program


def endangered(page: int, pages: dict[int, bytes]) -> set[int]:
    """The pages that may have changed after `page` was written."""
    return {page, page + 1 if page + 1 in pages else page - 1}


def _send(loader: FactoryLine, scratch: int, page: int, data: bytes, pieces: list[tuple[int, int]]) -> None:
    """Sends all pieces but the lowest to `scratch`, to fill the loader's buffer, then the lowest to the page. After an error it sends
    all again, because the buffer may hold anything."""
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
    """Runs one download. Returns what went wrong, or an empty text; the download is over then. Unsure: it may still be open."""
    if address % FLASH_PAGE or not 0 < len(data) <= FLASH_PAGE or not 0 <= address < LAST_START:
        raise RefusedError(f"a download to 0x{address:X} of {len(data)} bytes would hurt")  # a bug in this program
    loader.type_line(f"load {address:x}")
    loader.open_at = address
    loader.link.write(b"\r")
    answer, ready = loader.link.look_for(b"Ready..", loader.patience(80))
    if not ready and _OVER.search(answer):  # a prompt: the line arrived damaged and was not `load`
        loader.open_at = None
        return "the loader did not understand"
    if not ready:
        raise Unsure(loader.how_it_stands())
    if b"Write Address : %08X" % address not in answer:
        raise Unsure(WRONG_ADDRESS + loader.link.remedy)
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
    """Groups neighbouring pages into runs. A download that goes wrong stays within its run. Motion pages are runs of two."""
    run: list[int] = []
    for page in sorted(pages):
        if run and (page != run[-1] + 1 or _motion(page) != _motion(run[-1])):
            yield run
            run = []
        run.append(page)
    if run:
        yield run


def _motion(page: int) -> int:
    """The motion page that a flash page belongs to, or -1."""
    return page // 2 if page * FLASH_PAGE >= 0xE000 else -1
