# SPDX-License-Identifier: MIT
"""The PC's side of the factory boot loader: chooses how to write each page, and reads back everything by dumps.

Flash is written in factory_flash.py and mailbox.py, which explain why this cannot damage the loader.
"""

from __future__ import annotations

from m512.board import factory_flash, mailbox
from m512.board.factory_line import TRIES, FactoryLine
from m512.board.memory import APP, FLASH_PAGE, MOTIONS, motion_page_of
from m512.errors import BoardError, RefusedError
from m512.files.wording import spans
from m512.ui import Progress, unseen


class FactoryLoader(FactoryLine):
    name = "factory boot loader"
    board = ""  # cm5 or cm2, from its banner (loaders.identify)
    was_at_prompt = False  # whether it was at its prompt before this program came

    def different(self, pages: dict[int, bytes], progress: Progress = unseen) -> list[int]:
        """Returns those of these pages that differ on the board."""
        out, done = [], 0
        for first, last in spans(pages):
            found = self.read(first * FLASH_PAGE, (last + 1) * FLASH_PAGE, _behind(progress, done, len(pages), FLASH_PAGE))
            for page in range(first, last + 1):
                at = (page - first) * FLASH_PAGE
                if found[at : at + FLASH_PAGE] != pages[page]:
                    out.append(page)
            done += last - first + 1
        return out

    # Writing flash

    def write(self, pages: dict[int, bytes], progress: Progress = unseen, around: dict[int, bytes] | None = None) -> None:
        """Writes these pages, in this order, and reads them back. `around`: pages known to be on the board, which may be rewritten."""
        if any(page * FLASH_PAGE < APP[1] for page in pages):
            self.stay()  # a partly written program must not be started
        known, done = {**(around or {}), **pages}, 0
        order = {page: k for k, page in enumerate(pages)}
        for unit in sorted(factory_flash.units(set(known)), key=lambda unit: min(order.get(page, len(order)) for page in unit)):
            todo = {page for page in unit if page in pages}
            if todo:
                whole = self._with_neighbour({page: known[page] for page in unit})
                self._write_unit(whole, todo, _behind(progress, done, len(pages), 1))
                done += len(todo)

    def _with_neighbour(self, unit: dict[int, bytes]) -> dict[int, bytes]:
        """Adds the other half of a motion page, as the board holds it: both halves are written together."""
        if len(unit) > 1:
            return unit
        page = next(iter(unit))
        if page * FLASH_PAGE < MOTIONS[0]:
            raise RefusedError("a program of 256 bytes cannot be written safely through the factory's loader: make it 512 bytes long")
        other = page ^ 1
        return {**unit, other: self.read(other * FLASH_PAGE, (other + 1) * FLASH_PAGE)}

    def _write_unit(self, unit: dict[int, bytes], todo: set[int], progress: Progress) -> None:
        first, count = min(unit), len(todo)
        for _ in range(TRIES):
            look: set[int] = set()
            for number, page in enumerate(sorted(todo)):
                if factory_flash.in_reserve(first):
                    mailbox.write_motion_page(self, motion_page_of(first), unit[first] + unit[first + 1])
                    look = set(unit)
                    break
                factory_flash.write_page(self, page, unit)
                look |= factory_flash.endangered(page, unit)
                progress(min(number, count), count)
            todo = set(self.different({page: unit[page] for page in look}))
            if not todo:
                return
        raise BoardError(
            "read back wrong at "
            + ", ".join(f"0x{n * FLASH_PAGE:05X}" for n in sorted(todo)[:8])
            + f", {TRIES} times. If a second try does not help either, the flash is worn out"
        )


def _behind(progress: Progress, done: int, total: int, page: int) -> Progress:
    """Turns progress in units of which a page has `page` into progress in pages, added to the `done` ones."""
    return lambda count, _: progress(done + count // page, total)
