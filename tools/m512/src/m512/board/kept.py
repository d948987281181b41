# SPDX-License-Identifier: MIT
"""Keeps the pages that a command changes on a board in a file until all are written.

Such a command cannot simply be repeated after it broke off: a move that is half done is another move. So the file stays then, and the
error says how to put its pages back. A crash of this computer leaves the file, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import Callable

from m512 import ui
from m512.board import bus
from m512.board.link import Link
from m512.errors import CancelledError, FileError, M512Error
from m512.files import storage
from m512.files.image import Image, is_erased, to_hex
from m512.files.wording import pages_text

WRITTEN = "go on: all pages are written"


@contextmanager
def kept(link: Link, found: Image, numbers: Sequence[int], board: str = "") -> Iterator[Callable[[Sequence[int]], None]]:
    """Keeps these pages as `found`, in an Intel HEX file of the current folder, while the block writes them. The block may call the function
    that it gets with fewer pages, if it leaves the others as they are. board: the board according to the user (banner.py). FileError: the
    file cannot be written; the block does not run."""
    port = re.sub("[^A-Za-z0-9]+", "-", Path(link.url).name)[-40:]
    path = Path(f"pages-before-{port}-{datetime.now():%Y%m%d-%H%M%S}.hex")

    def keep(some: Sequence[int], is_new: bool = False) -> None:
        nonlocal path
        image = Image.empty(found.end)
        for number in some:
            image[number] = found[number]
        image.given = set(some)
        data = to_hex(image).encode()
        if is_new:
            path = storage.write_numbered(path, data)
        else:
            storage.write(path, data, replace=True)
        link.remedy = _how_to_put_back(link.url, path, image, board)

    try:
        keep(numbers, is_new=True)
    except FileError as error:
        raise FileError(f"{error}. It would keep the pages that change until all are written, so nothing was written") from None
    try:
        yield keep
    except M512Error as error:
        if link.remedy not in str(error):
            error.args = (f"{error}. {link.remedy}",)
        raise
    except KeyboardInterrupt:
        raise CancelledError(f"stopped. {link.remedy}") from None
    except BaseException:  # SIGTERM
        ui.say(f"m512: ended. {link.remedy}")
        raise
    path.unlink(missing_ok=True)
    link.remedy = WRITTEN


def _how_to_put_back(url: str, path: Path, image: Image, board: str) -> str:
    numbers = sorted(image.given or ())
    if bus.is_bus(url):  # nothing can be flashed there, and `put` takes no empty pages
        filled = [number for number in numbers if not number or not image[number].is_empty]
        emptied = [number for number in numbers if number not in filled]
        put = f"`m512 put {path} {_words(filled)} -p {url} --yes` puts back what {pages_text(filled)} held" if filled else ""
        delete = f"{pages_text(emptied)} held nothing: `m512 pages {url} delete {_words(emptied)} --yes`" if emptied else ""
        return "; ".join(part for part in (put, delete) if part)
    options = " --with-trim" if 0 in numbers else ""
    options += " --damaged keep" if any(image[number].fault() and not is_erased(image[number]) for number in numbers) else ""
    options += f" --board {board}" if board else ""
    return f"`m512 flash {path} -p {url} --yes{options}` puts back what {pages_text(numbers)} held"


def _words(numbers: Sequence[int]) -> str:
    return " ".join(map(str, numbers))
