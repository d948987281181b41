# SPDX-License-Identifier: MIT
"""A board's motions as an Image, in and out, by whoever answers: Play or Edit page by page, else the boot loader."""

from __future__ import annotations

from m512 import ui
from m512.board.client import Client
from m512.board.link import Link
from m512.board.memory import MOTIONS, Plan
from m512.errors import BoardError, NoAnswerError, RefusedError
from m512.files.image import Image, from_bytes
from m512.files.page import PAGE_BYTES, Page
from m512.files.wording import named_pages_text

ERASED = b"\xff" * PAGE_BYTES


def read_motions(url: str, board: str = "") -> Image:
    """board: what the user says that it is (banner.py)."""
    with Link(url, image="edit") as link:
        try:
            client = Client(link)
        except NoAnswerError:
            from m512.board import loaders

            loader = loaders.enter(link, ui.say, board=board)
            with ui.phase("Reading") as progress:
                return from_bytes(loader.read(*MOTIONS, progress))
        return _read_pages(client)


def _read_pages(client: Client) -> Image:
    """Pages that the board lists; those it leaves out are erased or empty, which is the same to a robot."""
    image, numbers = Image.empty(client.pages), sorted(set(client.list_pages()) | {0})
    with ui.phase("Reading") as progress:
        for done, number in enumerate(numbers):
            image[number] = client.page(number)
            progress(done + 1, len(numbers))
    if bytes(image[0]) == ERASED:
        image[0] = Page()
    return image


def write_motions(url: str, image: Image, board: str = "") -> None:
    """Brings the board's motions to `image`: through Edit when it runs there, else through the boot loader. board: as for read_motions."""
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


def save_pages(client: Client, image: Image, numbers: list[int]) -> list[int]:
    """Saves those of the pages that the board holds otherwise; returns their numbers."""
    if not client.can_save:
        raise BoardError(f"Play does not save pages. Edit does: m512 run {client.file_of('edit')}; or write a whole motion file: m512 flash FILE")
    lost = {number: title for number, title in image.beyond(client.pages).items() if number in numbers}
    if lost:
        raise RefusedError(f"{named_pages_text(lost)}: no room among the {client.pages} pages there; give them lower numbers (NAME:NUMBER)")
    numbers = [number for number in numbers if number < client.pages]
    listed, changed = client.list_pages(), []
    for number in numbers:
        here = number in listed or number == 0
        if image[number].is_empty and not here:
            continue
        if here and client.page(number) == image[number]:
            continue
        replaced = listed.get(number, (0, ""))[1]
        if replaced and replaced != image[number].title:
            ui.say(f'note: page {number} there was "{replaced}"')
        client.save_page(number, image[number])
        changed.append(number)
    return changed
