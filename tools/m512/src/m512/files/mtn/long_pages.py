# SPDX-License-Identifier: MIT
"""Splits pages of a .mtn with more than seven steps (newer tools write them) into linked pages of seven.

The chain plays like the long page. The next link of each part is the following part; the last part has the links of the page. A stop
takes effect at the end of the long page, so the exit links of the other parts lead to that end. Parts cannot be repeated together, so
repetitions are written out, and a stop ends them. Parts go to empty pages that no link leads to, preferably those that a board of 128
pages has.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Callable

from m512.errors import FileError
from m512.files.image import Image
from m512.files.page import NAME_BYTES, STEPS, Page
from m512.files.wording import pages_text


def place_long_pages(image: Image, blocks: Sequence[Any], fill: Callable[[Page, list[Any]], None], where: str) -> None:
    """Spreads the blocks of more than seven steps over free pages of the image, with a note. image: holds the first seven steps of every
    block at its own number. FileError: not enough room."""
    targets = {link for block in blocks for link in (block.page.next, block.page.exit)}
    free = [number for number, page in image.items() if number and page.is_empty and number not in targets]
    for number, block in enumerate(blocks, 1):
        if len(block.steps) > STEPS:
            _spread(image, number, block, free, fill, where)


def _spread(image: Image, number: int, block: Any, free: list[int], fill: Callable[[Page, list[Any]], None], where: str) -> None:
    parts = [block.steps[at : at + STEPS] for at in range(0, len(block.steps), STEPS)]
    rounds = max(block.page.repeat, 1)
    title = f"page {number}" + (f' "{block.page.title}"' if block.page.name else "")
    has = f"{title} has {len(block.steps)} steps" + (f" and is played {rounds} times" if rounds > 1 else "")
    needed = len(parts) * rounds - 1
    if needed > len(free):
        raise FileError(
            f"{where}: {has}. A page holds {STEPS}; as linked pages it needs {needed} more, and {len(free)} are free. "
            "Shorten it or lower its repetitions"
        )
    taken = [free.pop(0) for _ in range(needed)]
    chain = [number] + taken
    for place, (here, part) in enumerate(zip(chain, parts * rounds)):
        page = block.page.copy()
        if place:
            page.name = _part_name(block.page.name, number, place + 1)
        if block.page.repeat:  # a page with repeat 0 is never played; the player skips it along its own links
            page.repeat = 1
            if place < needed:
                page.next = chain[place + 1]
            if (place + 1) % len(parts):
                page.exit = chain[place + 1]
        fill(page, part)
        image[here] = page
    image.notes.append(
        f"{has}, a page holds {STEPS}: "
        + ("continued in" if block.page.repeat else "it is never played (repeat 0); the rest stands in")
        + f" {pages_text(taken)}"
    )


def _part_name(name: bytes, number: int, part: int) -> bytes:
    """The page's name with the part's number appended, so that names stay unique."""
    behind = f"/{part}".encode()
    base = name or str(number).encode()
    return base[: NAME_BYTES - 1 - len(behind)].decode("utf-8", "ignore").encode("utf-8") + behind
