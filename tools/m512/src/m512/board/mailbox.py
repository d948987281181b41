# SPDX-License-Identifier: MIT
"""Writes motion pages through the factory loader's mailbox: 512 bytes of EEPROM that the loader copies to flash at its next start.

This takes about 6 s a page and is safe on any line. `eep_dn` takes exactly the announced number of bytes, whenever they arrive. The
EEPROM is read back before the loader is told to copy. The loader itself knows where a motion page lies. A page number of 0x80
or more would overwrite the loader's own section (boot/ORIGINAL.md, 7a), so the number is written on its own and read back before the
mark that starts the copy.
"""

from __future__ import annotations

from m512.board.factory_line import FactoryLine
from m512.errors import BoardError, NoAnswerError, RefusedError
from m512.files.wording import spans

MAILBOX, STATE, NUMBER = 0x800, 0xFF4, 0xFF5
PLEASE, NOTHING = 0xAA, 0xFF
PAGE_BYTES, PAGES = 512, 128
TRIES = 3


def write_motion_page(loader: FactoryLine, number: int, data: bytes) -> None:
    """Writes motion page `number`. The loader restarts and is at its prompt afterwards."""
    if not 0 <= number < PAGES or len(data) != PAGE_BYTES:
        raise RefusedError(f"no motion page {number} for the mailbox")  # a bug in this program
    loader.stay()
    _settle(loader, STATE, NOTHING)
    wanted = dict(enumerate(data, MAILBOX))
    for _ in range(TRIES):
        loader.write_eeprom(different(loader, wanted))
        if not different(loader, wanted):
            break
    else:
        raise BoardError("the EEPROM does not take the page")
    _settle(loader, NUMBER, number)
    _settle(loader, STATE, PLEASE)
    if different(loader, {**wanted, NUMBER: number}):
        _settle(loader, STATE, NOTHING)
        raise BoardError("the EEPROM has changed by itself; nothing was written")
    loader.restart()
    _settle(loader, STATE, NOTHING)


def empty(loader: FactoryLine) -> None:
    """Takes back a page that an interrupted command has left in the mailbox. The loader would copy it at its next start, over whatever has
    been compared or written meanwhile."""
    if loader.read_eeprom(STATE, STATE + 1)[0] == PLEASE:
        _settle(loader, STATE, NOTHING)


def different(loader: FactoryLine, wanted: dict[int, int]) -> dict[int, int]:
    """Returns those of the cells that differ on the board."""
    out = {}
    for first, last in spans(wanted):
        found = loader.read_eeprom(first, last + 1)
        out.update({at: wanted[at] for at in range(first, last + 1) if found[at - first] != wanted[at]})
    return out


def _settle(loader: FactoryLine, cell: int, value: int) -> None:
    """Writes one EEPROM cell if it differs, and reads it back."""
    for _ in range(TRIES):
        if not different(loader, {cell: value}):
            return
        loader.write_eeprom({cell: value})
    if different(loader, {cell: value}):
        raise NoAnswerError(f"EEPROM 0x{cell:03X} does not keep 0x{value:02X}")
