# SPDX-License-Identifier: MIT
"""A board's motions as an Image, in and out, by whoever answers: Play or Edit page by page, else the boot loader."""
from __future__ import annotations

from typing import List

from m512 import ui
from m512.errors import BoardError, NoAnswerError
from m512.image import Image, from_bytes
from m512.link import Link
from m512.machine import Machine
from m512.memory import MOTIONS, Plan
from m512.page import PAGE_BYTES, Page

ERASED = b"\xff" * PAGE_BYTES


def read_motions(url: str) -> Image:
    with Link(url) as link:
        try:
            machine = Machine(link)
        except NoAnswerError:
            from m512 import loaders

            loader = loaders.enter(link, ui.say)
            with ui.phase("Reading") as progress:
                return from_bytes(loader.read(*MOTIONS, progress))
        return _read_pages(machine)


def _read_pages(machine: Machine) -> Image:
    """Pages that the board lists; those it leaves out are erased or empty, which is the same to a robot."""
    image, numbers = Image.empty(), sorted(set(machine.list_pages()) | {0})
    with ui.phase("Reading") as progress:
        for done, number in enumerate(numbers):
            image[number] = machine.page(number)
            progress(done + 1, len(numbers))
    if bytes(image[0]) == ERASED:
        image[0] = Page()
    return image


def write_motions(url: str, image: Image) -> None:
    """Brings the board's motions to `image`: through Edit when it runs there, else through the boot loader."""
    with Link(url) as link:
        try:
            machine = Machine(link)
        except NoAnswerError:
            machine = None
        if machine is not None and machine.can_save:
            save_pages(machine, image, list(range(128)))
            return
        from m512 import download, loaders

        loader = loaders.enter(link, ui.say)
        data = image.to_bytes()
        plan = Plan({(MOTIONS[0] + at) // 256: data[at:at + 256] for at in range(0, len(data), 256)}, has_motions=True)
        ui.say(str(download.download(loader, plan, ui.phase)))
        download.start(loader)


def save_pages(machine: Machine, image: Image, numbers: List[int]) -> List[int]:
    """Saves those of the pages that the board holds otherwise; returns their numbers."""
    if not machine.can_save:
        raise BoardError(f"{machine.version.get('image', 'this image')} cannot save pages: use Edit, or m512 flash")
    listed, changed = machine.list_pages(), []
    for number in numbers:
        here = number in listed or number == 0
        if image[number].is_empty and not here:
            continue
        if here and machine.page(number) == image[number]:
            continue
        machine.save_page(number, image[number])
        changed.append(number)
    return changed
