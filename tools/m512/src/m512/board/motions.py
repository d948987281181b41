# SPDX-License-Identifier: MIT
"""Reads and writes a board's motions as an Image: page by page if Play or Edit answers, else through the boot loader."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack

from m512 import ui
from m512.board.block import STAY
from m512.board.client import Client
from m512.board.kept import kept
from m512.board.link import Link
from m512.board.memory import FLASH_PAGE, MOTIONS, Plan, motion_area, motion_page_of
from m512.errors import BoardError, CancelledError, NoAnswerError, PortError, RefusedError
from m512.files.image import Image, from_bytes, is_erased
from m512.files.page import EMPTY, PAGE_BYTES, Page
from m512.files.wording import named_pages_text, pages_text


def read_motions(url: str, board: str = "", goes_on: bool = False) -> Image:
    """Reads all motions. board: the board according to the user (banner.py). The board is left as it was found. goes_on: it stays in a
    boot loader, because the caller may write there, and nobody shall press MODE twice."""
    with Link(url, image="edit") as link:
        try:
            client = Client(link)
        except NoAnswerError:
            from m512.board import loaders

            loader = loaders.enter(link, ui.say, board=board)
            with loaders.as_found(loader), ui.phase("Reading") as progress:
                data = loader.read(*MOTIONS, progress)
            if loader.was_at_prompt:
                loader.leave(STAY)
            elif goes_on:
                loader.leave(STAY)
                ui.say(loaders.WAITS)
            else:
                ui.say(loaders.restart(loader))
            return from_bytes(data)
        return _read_pages(client)


def _read_pages(client: Client) -> Image:
    """Reads the pages that the board lists. The others are erased or empty, which means the same to a robot."""
    image, numbers = Image.empty(client.pages), sorted(set(client.list_pages()) | {0})
    with ui.phase("Reading") as progress:
        for done, number in enumerate(numbers):
            image[number] = client.page(number)
            progress(done + 1, len(numbers))
    if is_erased(image[0]):
        image[0] = Page()
    return image


def write_motions(url: str, found: Image, image: Image, board: str = "") -> None:
    """Writes the pages of `image` that differ from `found`, the result of read_motions: through Edit if it runs there, else through the boot
    loader. board: as for read_motions. RefusedError: one of these pages has changed on the board since then."""
    numbers = [number for number, page in image.items() if page != found[number]]
    numbers.sort(key=lambda number: image[number].is_empty)  # a page that moves is written before its old place is emptied
    with Link(url, image="edit") as link:
        try:
            client = Client(link)
        except NoAnswerError:
            client = None
        if client is not None and client.can_save:
            _save(link, client, numbers, found, image, board)
            return
        from m512.board import download, loaders

        loader = loaders.enter(link, ui.say, board=board)
        with ExitStack() as keeping:
            with loaders.as_found(loader):
                with ui.phase("Comparing") as progress:
                    other = loader.different(_flash_pages(numbers, found), progress)
                _must_be_as_found(sorted({motion_page_of(page) for page in other}), found, lambda number: Page(loader.read(*motion_area(number))))
                keeping.enter_context(kept(link, found, numbers, board))
            report = download.download(loader, Plan(_flash_pages(numbers, image)), ui.phase)
        ui.say(str(report))
        ui.say(loaders.give_back(loader))


def _save(link: Link, client: Client, numbers: list[int], found: Image, image: Image, board: str) -> None:
    """Writes these pages, through Edit."""
    _must_be_as_found(numbers[1:] + numbers[:1], found, client.page)  # the page that is written first is looked at last
    client.open_page(numbers[0], image[numbers[0]])  # if Edit refuses, because of edits that are not saved, nothing is to be put back
    with kept(link, found, numbers, board) as keep:
        for done, number in enumerate(numbers):
            before = f". Only {pages_text(numbers[:done])} had been written by then" if done else ""
            try:
                if done:
                    _must_be_as_found([number], found, client.page, before)
                client.save_page(number, image[number])
            except RefusedError:  # somebody else's page, which is not to be put back
                keep(numbers[:done])
                raise
            except (BoardError, NoAnswerError, PortError) as error:
                raise type(error)(f"{error}{before}") from None


def _must_be_as_found(numbers: list[int], found: Image, read: Callable[[int], Page], before: str = "") -> None:
    """RefusedError if the board no longer holds what was found on these pages, for example because a person saved one meanwhile.
    `read` reads a page of the board. `before`: says which pages were written before."""
    changed = {}
    for number in numbers:
        there = read(number)
        if there != found[number] and not all(_is_nothing(number, page) for page in (there, found[number])):
            changed[number] = there.title
    if changed:
        raise RefusedError(
            f"{named_pages_text(changed)}: changed on the board after m512 had read it, and stays as it is there"
            + (before or ". Nothing was written. Repeat the command: it reads the board again")
        )


def _is_nothing(number: int, page: Page) -> bool:
    """Whether a page of a board is erased or empty. An empty page 0 may hold the trim."""
    return is_erased(page) or (bytes(page) == EMPTY if number == 0 else page.is_empty)


def _flash_pages(numbers: list[int], image: Image) -> dict[int, bytes]:
    """These motion pages as flash pages: index -> bytes."""
    return {
        (motion_area(number)[0] + at) // FLASH_PAGE: bytes(image[number])[at : at + FLASH_PAGE]
        for number in numbers
        for at in range(0, PAGE_BYTES, FLASH_PAGE)
    }


def save_pages(client: Client, image: Image, numbers: list[int], confirm: Callable[[str], None] = lambda question: None) -> list[int]:
    """Saves the given pages that differ on the board and returns their numbers. Before anything is written, `confirm` is asked about
    pages with another name or none, damaged pages, and a trim, that would be lost. It raises for a no."""
    if not client.can_save:
        raise BoardError(f"Play does not save pages. Edit does: m512 run {client.file_of('edit')}; or write a whole motion file: m512 flash FILE")
    lost = {number: title for number, title in image.beyond(client.pages).items() if number in numbers}
    if lost:
        raise RefusedError(f"{named_pages_text(lost)}: no room among the {client.pages} pages there; give them lower numbers (NAME:NUMBER)")
    listed, changed, replaced = client.listed(), [], []
    for number in [number for number in numbers if number < client.pages]:
        here, new = number in listed or number == 0, image[number]
        if not here and new.is_empty:
            continue
        there = client.page(number) if here else Page()
        if here and there == new:
            continue
        damaged = there.fault() and not is_erased(there)
        if not number and not _is_nothing(0, there):
            replaced.append("the trim (page 0)")
        elif number and (damaged or not there.is_empty and (there.title != new.title or not there.title or not new.steps)):
            replaced.append(("the damaged " if damaged else "") + named_pages_text({number: there.title}))
        changed.append(number)
    if replaced:
        confirm(f"This replaces {' and '.join(replaced)} on the robot. Save?")
    for done, number in enumerate(changed):
        before = f", after {pages_text(changed[:done])} had been saved" if done else ""
        try:
            client.save_page(number, image[number])
        except KeyboardInterrupt:
            raise CancelledError(f"stopped at page {number}{before}. Repeat the command: it saves the others") from None
        except (BoardError, NoAnswerError, PortError) as error:
            raise type(error)(f"page {number}{before}: {error}") from None
    return changed
