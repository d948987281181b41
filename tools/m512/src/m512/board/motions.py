# SPDX-License-Identifier: MIT
"""Reads and writes a board's motions as an Image: page by page if Play or Edit answers, else through the boot loader."""

from __future__ import annotations

from collections.abc import Callable

from m512 import ui
from m512.board.client import Client
from m512.board.link import Link
from m512.board.memory import MOTIONS, Plan
from m512.errors import BoardError, NoAnswerError, RefusedError
from m512.files.image import Image, from_bytes
from m512.files.page import EMPTY, PAGE_BYTES, Page
from m512.files.wording import named_pages_text

ERASED = b"\xff" * PAGE_BYTES


def read_motions(url: str, board: str = "") -> Image:
    """Reads all motions. board: the board according to the user (banner.py)."""
    with Link(url, image="edit") as link:
        try:
            client = Client(link)
        except NoAnswerError:
            from m512.board import loaders

            loader = loaders.enter(link, ui.say, board=board)
            try:
                with ui.phase("Reading") as progress:
                    data = loader.read(*MOTIONS, progress)
            finally:
                loader.leave(loaders.STAY)  # the next command finds the loader at its prompt
            return from_bytes(data)
        return _read_pages(client)


def _read_pages(client: Client) -> Image:
    """Reads the pages that the board lists. The others are erased or empty, which means the same to a robot."""
    image, numbers = Image.empty(client.pages), sorted(set(client.list_pages()) | {0})
    with ui.phase("Reading") as progress:
        for done, number in enumerate(numbers):
            image[number] = client.page(number)
            progress(done + 1, len(numbers))
    if bytes(image[0]) == ERASED:
        image[0] = Page()
    return image


def write_motions(url: str, image: Image, board: str = "") -> None:
    """Makes the board's motions equal to `image`: through Edit if it runs there, else through the boot loader. board: as for
    read_motions."""
    with Link(url, image="edit") as link:
        try:
            client = Client(link)
        except NoAnswerError:
            client = None
        if client is not None and client.can_save:
            save_pages(client, image, list(range(image.end)))
            return
        from m512.board import download, loaders

        loader = loaders.enter(link, ui.say, board=board)
        data = image.to_bytes()
        plan = Plan({(MOTIONS[0] + at) // 256: data[at : at + 256] for at in range(0, len(data), 256)}, has_motions=True)
        ui.say(str(download.download(loader, plan, ui.phase)))
        download.start(loader)


def save_pages(client: Client, image: Image, numbers: list[int], confirm: Callable[[str], None] = lambda question: None) -> list[int]:
    """Saves the given pages that differ on the board and returns their numbers. Before anything is written, `confirm` is asked about
    pages with another name or none, and a trim, that would be lost. It raises for a no."""
    if not client.can_save:
        raise BoardError(f"Play does not save pages. Edit does: m512 run {client.file_of('edit')}; or write a whole motion file: m512 flash FILE")
    lost = {number: title for number, title in image.beyond(client.pages).items() if number in numbers}
    if lost:
        raise RefusedError(f"{named_pages_text(lost)}: no room among the {client.pages} pages there; give them lower numbers (NAME:NUMBER)")
    listed, changed, replaced = client.list_pages(), [], []
    for number in [number for number in numbers if number < client.pages]:
        here, new = number in listed or number == 0, image[number]
        if not here and new.is_empty:
            continue
        there = client.page(number) if here else Page()
        if here and there == new:
            continue
        if not number and bytes(there) not in (EMPTY, ERASED):
            replaced.append("the trim (page 0)")
        if number and not there.is_empty and (there.title != new.title or not there.title or not new.steps):
            replaced.append(named_pages_text({number: there.title}))
        changed.append(number)
    if replaced:
        confirm(f"This replaces {' and '.join(replaced)} on the robot. Save?")
    for number in changed:
        client.save_page(number, image[number])
    return changed
