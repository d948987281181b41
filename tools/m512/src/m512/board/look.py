# SPDX-License-Identifier: MIT
"""Finds out what a Plan would change on a board, without changing anything there."""

from __future__ import annotations

from m512.board.block import STAY
from m512.board.client import Client
from m512.board.download import check_board
from m512.board.loaders import Loader
from m512.board.memory import FLASH_PAGE, MOTIONS, Plan, motion_area, motion_page_of
from m512.errors import BoardError, RefusedError
from m512.files.image import is_erased
from m512.files.page import Page
from m512.files.wording import counted
from m512.pages import difference
from m512.ui import PhaseMaker


def through_loader(loader: Loader, plan: Plan, phase: PhaseMaker) -> list[str]:
    """The result as text lines. The loader is at its prompt afterwards."""
    try:
        check_board(plan, loader)
        with phase("Comparing") as progress:
            todo = loader.different(plan.pages, progress)
    finally:
        loader.leave(STAY)
    here = f"{loader.name}" + (f" on a {loader.board}" if loader.board else "")
    return [f"{here}: {len(todo)} of {counted(len(plan.pages), 'flash page')} would be written" if todo else f"{here}: the board holds this already"]


def emptied(loader: Loader, plan: Plan, todo: list[int], phase: PhaseMaker) -> dict[int, str]:
    """{number: name} of motions on the board that the plan replaces by an empty page. `todo`: the flash pages that differ."""
    numbers = []
    for number in sorted({motion_page_of(page) for page in todo if page * FLASH_PAGE >= MOTIONS[0]}):
        first = motion_area(number)[0] // FLASH_PAGE
        if number and first in plan.pages and _holds_nothing(Page(plan.pages[first] + plan.pages[first + 1])):
            numbers.append(number)
    out = {}
    with phase("Reading") as progress:
        for done, number in enumerate(numbers):
            page = Page(loader.read(*motion_area(number)))
            if not _holds_nothing(page) and not page.fault():
                out[number] = page.title
            progress(done + 1, len(numbers))
    return out


def _holds_nothing(page: Page) -> bool:
    return page.is_empty or is_erased(page)


def through_application(client: Client, plan: Plan, phase: PhaseMaker) -> list[str]:
    """The result as text lines, from a running Play or Edit, which keeps running."""
    version = client.version
    out = [f"{version.get('image', '?')} {version.get('version', '')} runs on a {version.get('board', '?')}"]
    if plan.record and version.get("board") and plan.record.board != version["board"]:
        raise RefusedError(f"the image is {plan.record}, but this board is a {version['board']}. Nothing was written")
    if plan.has_motions:
        out += _motions(client, plan, phase)
    if plan.has_app:
        out.append(f"the application would be replaced by {plan.record or 'one that is not ours'}")
    return out


def _motions(client: Client, plan: Plan, phase: PhaseMaker) -> list[str]:
    first = {motion_page_of(page): page for page in plan.pages if page * FLASH_PAGE >= MOTIONS[0] and page % 2 == 0}
    listed, out = client.list_pages(), []
    with phase("Comparing") as progress:
        for done, (number, page) in enumerate(sorted(first.items())):
            wanted = Page(plan.pages[page] + plan.pages[page + 1])
            if number in listed or number == 0:
                try:
                    found = client.page(number)
                except BoardError:
                    out.append(f"page {number} is damaged on the board and would be replaced")
                    continue
            elif _holds_nothing(wanted):
                continue
            else:
                found = Page()
            out += [str(change) for change in difference.pages(number, found, wanted)]
            progress(done + 1, len(first))
    return out or ["the board holds these motions already"]
