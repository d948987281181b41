# SPDX-License-Identifier: MIT
"""Changes to an image between two files: damaged pages, and the number of pages of the result.

Used by `m512 convert` and by the page in the browser, which must agree.
"""

from __future__ import annotations

from pathlib import Path

from m512.errors import FileError, RefusedError
from m512.files import formats, scale12
from m512.files.image import BOARD_PAGES, Image, is_erased
from m512.files.page import Page
from m512.files.wording import Findings, named_pages_text

FEW = 3  # up to this many damaged pages are reported with their faults


def damaged_pages(image: Image) -> list[tuple[int, str]]:
    """[(number, fault)] of the damaged pages. Erased flash counts as empty, not as damaged."""
    return [(number, page.fault_text(image.kind)) for number, page in image.items() if page.fault(image.kind) and not is_erased(page)]


def treat_damaged(image: Image, source: Path, how: str, notes: list[str], count: int) -> list[int]:
    """Keeps or drops damaged pages (`how`: keep, drop), in place and with a note. Those from `count` on are not kept, and
    Image.resized() names them. Returns their numbers. RefusedError: damaged pages and `how` is ask. FileError: every page is damaged or
    erased, so the file holds no motions."""
    bad = damaged_pages(image)
    if bad and len(bad) + sum(is_erased(page) for page in image.pages) == len(image.pages):
        raise FileError(
            f"{source}: none of its {len(image.pages)} pages is whole (page {bad[0][0]}: {bad[0][1].partition('; ')[0]}), "
            "so it is no motion file, or ruined. Is it the right one?"
        )
    if bad and how == "ask":
        raise RefusedError(f"{source}: damaged pages (--damaged keep or drop):\n" + "\n".join(f"  page {n}: {why}" for n, why in bad))
    found, few = Findings(), len(bad) <= FEW
    for page, why in bad:
        done = "replaced by an empty page" if how == "drop" else "kept byte for byte"
        if how == "drop" or page < count:
            found.add(page, "", f"damaged, {done}" + ("" if few else " (m512 pages FILE check says what is wrong)"), why if few else "")
        if how == "drop":
            image[page] = Page()
    notes += found.lines()
    return [page for page, _ in bad]


def must_be_10_bits(image: Image, source: Path) -> None:
    """RefusedError: a board takes no positions of 12 bits."""
    if image.bits != 10:
        raise RefusedError(f"{source}: 12-bit positions mean nothing to this board: {scale12.HINT}")


def for_board(image: Image, source: Path) -> tuple[Image, list[str]]:
    """The pages 0..127 that a real or simulated board takes, and the links that are lost with the others. RefusedError: 12 bits, or pages
    beyond 127 that hold something."""
    must_be_10_bits(image, source)
    lost = image.beyond(BOARD_PAGES)
    if lost:
        raise RefusedError(
            f"{source}: {named_pages_text(lost)}: no room among this board's {BOARD_PAGES} pages (m512 convert --only NAME takes some, "
            f"--pages {BOARD_PAGES} leaves these out)"
        )
    return (image, []) if (image.first, image.end) == (0, BOARD_PAGES) else image.resized(BOARD_PAGES)


def fitted(image: Image, count: int | None, target: Path) -> tuple[Image, list[str]]:
    """The image with the number of pages of the result (`count`, or what suits both kinds of file if None), and the losses.
    RefusedError: the user's pages would be lost without a `count`."""
    wanted = count or fitting(image, target)
    if wanted == image.end:
        return image, []
    lost = image.beyond(wanted)
    if lost and not count:
        raise RefusedError(
            f"{named_pages_text(lost)}: no room among the {wanted} pages of this kind of board, nothing was written. "
            f"m512 convert --only NAME takes what you choose with all that it leads to, --pages 256 keeps all (for a board of 256 pages), "
            f"--pages {wanted} leaves {'it' if len(lost) == 1 else 'them'} out"
        )
    return image.resized(wanted)


def fitting(image: Image, target: Path) -> int:
    """The number of pages of the source. A .mtn always has 255: it is written from the existing pages, and read for a board of 128."""
    return BOARD_PAGES if image.form == formats.MTN and formats.BY_SUFFIX.get(target.suffix.lower()) != formats.MTN else image.end
