# SPDX-License-Identifier: MIT
"""Writes a Plan to a board through either loader: compares, writes what differs, reads back.

Only pages that differ are sent, so repeating an interrupted download continues where it stopped.
"""

from __future__ import annotations

from dataclasses import dataclass

from m512.board.block import START, STAY, BlockLoader
from m512.board.factory import FactoryLoader
from m512.board.factory_line import BOOT_MODE, Unsure
from m512.board.link import REPEAT
from m512.board.loaders import Loader
from m512.board.memory import FLASH_PAGE, Plan, Record, app_bytes
from m512.errors import BoardError, CancelledError, NoAnswerError, PortError, RefusedError
from m512.files.wording import counted
from m512.ui import PhaseMaker, Progress

BOOT_APPLICATION = 0x11
APP_MARK, INCOMPLETE, COMPLETE = 0xFF0, 0x50, 0xFF  # EEPROM: our loader does not start an incomplete application (boot/memory.h)
UNFIT = ("none", "damaged")  # states of an application that our loader does not start
FLASH_ONE = "flash one: m512 run play-cm5.hex"


@dataclass
class Report:
    pages: int
    written: int
    seconds: float
    retries: int

    def as_dict(self) -> dict[str, float]:
        return {"pages": self.pages, "written": self.written, "seconds": round(self.seconds, 2), "retries": self.retries}

    def __str__(self) -> str:
        if not self.written:
            return f"all {self.pages} flash pages were there already" if self.pages != 1 else "the flash page was there already"
        again = f", {counted(self.retries, 'repetition')} on the line" if self.retries else ""
        how = f"{self.written * FLASH_PAGE:,} bytes in {self.seconds:.1f} s{again}"
        return f"{self.written} of {counted(self.pages, 'flash page')} written and read back ({how})"


def check_board(plan: Plan, loader: Loader) -> None:
    """RefusedError if the code is for another board. Checked as soon as the board is known, before anything is written."""
    if plan.record and loader.board and plan.record.board != loader.board:
        raise RefusedError(f"the image is {plan.record}, but this board is a {loader.board}. Nothing was written")


def download(loader: Loader, plan: Plan, phase: PhaseMaker, todo: list[int] | None = None) -> Report:
    """Writes the plan, in its order, and reads it back. `todo`: the pages that differ, if known."""
    check_board(plan, loader)
    begun = loader.link.now()
    if todo is None:
        with phase("Comparing") as progress:
            todo = loader.different(plan.pages, progress)
    if todo:
        differ = set(todo)
        pages = {number: data for number, data in plan.pages.items() if number in differ}
        with phase("Writing") as progress:
            if isinstance(loader, FactoryLoader):
                _to_factory(loader, pages, progress, plan.pages)  # reads back page by page
                return Report(len(plan.pages), len(todo), loader.link.now() - begun, loader.retries)
            _to_ours(loader, pages, progress, plan)
        with phase("Verifying") as progress:
            wrong = loader.different(pages, progress)
        if wrong:
            raise BoardError(
                "read back wrong at "
                + ", ".join(f"0x{n * FLASH_PAGE:05X}" for n in wrong[:8])
                + ". If a second try does not help either, the flash is worn out"
            )
    if isinstance(loader, BlockLoader) and _lacks_record(plan) and loader.read_eeprom(APP_MARK, APP_MARK + 1)[0] == INCOMPLETE:
        loader.write_eeprom({APP_MARK: COMPLETE})
    return Report(len(plan.pages), len(todo), loader.link.now() - begun, loader.retries)


def _lacks_record(plan: Plan) -> bool:
    """Whether an application is written that has no record, by which the loader knows an incomplete one."""
    return 0 in plan.pages and Record.of(app_bytes(plan.pages)) is None


def _to_ours(loader: BlockLoader, pages: dict[int, bytes], progress: Progress, plan: Plan) -> None:
    try:
        if _lacks_record(plan):
            loader.write_eeprom({APP_MARK: INCOMPLETE})
        loader.write(pages, progress)
    except KeyboardInterrupt:
        if loader.link.remedy != REPEAT:
            raise
        raise CancelledError("stopped while it wrote. Repeat the command: it goes on where it stopped") from None
    except PortError as error:
        if loader.link.remedy != REPEAT:
            raise
        raise PortError(f"{error}: it goes on where it stopped") from None


def _to_factory(loader: FactoryLoader, pages: dict[int, bytes], progress: Progress, around: dict[int, bytes]) -> None:
    """Writes. If something ends it early, the error says what state the board is in and what is safe to do."""
    try:
        loader.write(pages, progress, around)
    except KeyboardInterrupt:
        raise CancelledError("stopped. " + loader.how_it_stands()) from None
    except PortError as error:
        raise PortError(f"{error}. {loader.how_it_stands(str(error))}") from None
    except Unsure:  # says itself what to do
        raise
    except (BoardError, NoAnswerError) as error:
        if loader.how_it_stands() in str(error):
            raise
        raise type(error)(f"{error}. {loader.how_it_stands()}") from None


def start(loader: Loader) -> None:
    """Starts the application, now and at every later power-on. BoardError: our loader finds none, or a damaged one."""
    if not isinstance(loader, FactoryLoader) and loader.read_eeprom(BOOT_MODE, BOOT_MODE + 1) == b"\xff":
        loader.write_eeprom({BOOT_MODE: BOOT_APPLICATION})
    try:
        loader.leave(START)
    except BoardError:
        state = loader.app_state() if isinstance(loader, BlockLoader) else ""
        if state not in UNFIT:
            raise
        loader.leave(STAY)
        raise BoardError(f"application: {state}, which cannot start: {FLASH_ONE}") from None
