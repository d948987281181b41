# SPDX-License-Identifier: MIT
"""Backups: a folder with motions.bin, eeprom.bin, app.bin and manifest.json (date, board, sizes, CRCs)."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any, Callable

from m512.board.factory import FactoryLoader
from m512.board.loaders import Loader
from m512.board.memory import APP, EEPROM_BYTES, FLASH_PAGE, MOTIONS, Record
from m512.crc16 import crc16
from m512.errors import BoardError, CancelledError, FileError, NoAnswerError, PortError
from m512.files import storage
from m512.files.page import PAGE_BYTES, Fault, Page
from m512.ui import PhaseMaker, Progress

AREAS = {"motions": MOTIONS, "app": APP, "eeprom": (0, EEPROM_BYTES)}
MANIFEST, FORMAT = storage.BACKUP_MANIFEST, storage.BACKUP_FORMAT
VERSION = 1
# Transient state of the loaders, which must not be restored: a page waiting in the mailbox would be written at the next start.
MAILBOX_CELLS = range(0xFF4, 0xFF6)
EEPROM_TRIES = 3
READ_TRIES = 4
THE_REST = "it writes what still differs"


@dataclass
class Backup:
    folder: Path
    manifest: dict[str, Any]
    data: dict[str, bytes]


def take(loader: Loader, folder: Path, areas: list[str], phase: PhaseMaker, numbered: bool = False) -> Backup:
    """Reads the areas of the board and writes the folder, the manifest last. `numbered`: as storage.write_folder()."""
    data = {}
    for area in areas:
        with phase(f"Reading {area}") as progress:
            read = loader.read_eeprom if area == "eeprom" else loader.read
            data[area] = read(*AREAS[area], progress)
        if isinstance(loader, FactoryLoader):
            data[area] = _certain(read, area, data[area], phase)
    record = Record.of(data.get("app", b""))
    manifest = {
        "format": FORMAT,
        "version": VERSION,
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "board": loader.board or None,
        "loader": loader.name,
        "application": str(record) if record else None,
        "files": {
            area: {
                "file": f"{area}.bin",
                "address": AREAS[area][0],
                "bytes": len(data[area]),
                "crc16": f"{crc16(data[area]):04X}",
                "sha256": hashlib.sha256(data[area]).hexdigest(),
            }
            for area in areas
        },
    }
    files = {f"{area}.bin": data[area] for area in areas}
    folder = storage.write_folder(folder, {**files, MANIFEST: (json.dumps(manifest, indent=2) + "\n").encode()}, numbered)
    return Backup(folder, manifest, data)


def _certain(read: Callable[..., bytes], area: str, data: bytes, phase: PhaseMaker) -> bytes:
    """The area, after each part without a valid checksum was read until two readings in a row agree: a dump of the factory loader protects
    printable characters only. NoAnswerError: the readings never agree."""
    out, base = bytearray(data), AREAS[area][0]
    for start, end in _doubtful(area, data):
        with phase(f"Reading {area} again") as progress:
            again = read(base + start, base + end, progress)
        for at in range(start, end, FLASH_PAGE):
            first, second = data[at : at + FLASH_PAGE], again[at - start : at - start + FLASH_PAGE]
            for _ in range(READ_TRIES):
                if first == second:
                    break
                first, second = second, read(base + at, base + at + FLASH_PAGE)
            else:
                raise NoAnswerError(f"{area} at 0x{base + at:X} is read differently each time, so no backup was made. Is the cable good?")
            out[at : at + FLASH_PAGE] = second
    return bytes(out)


def _doubtful(area: str, data: bytes) -> list[tuple[int, int]]:
    """Parts [start, end) of an area that no valid checksum covers, in flash pages. Erased flash is not among them."""
    if area == "eeprom":
        return [(0, len(data))]
    if area == "motions":
        pages = [(at, at + PAGE_BYTES) for at in range(0, len(data), PAGE_BYTES) if Page(data[at : at + PAGE_BYTES]).fault() is Fault.CHECKSUM]
    else:
        record = Record.of(data)
        covered = record.length if record and record.fits(data) else 0
        pages = [(at, at + FLASH_PAGE) for at in range(covered // FLASH_PAGE * FLASH_PAGE, len(data), FLASH_PAGE)]
    out: list[tuple[int, int]] = []
    for start, end in pages:
        if set(data[start:end]) == {0xFF}:
            continue
        if out and out[-1][1] == start:
            start = out.pop()[0]
        out.append((start, end))
    return out


def load(folder: Path, areas: list[str] | None = None) -> Backup:
    """Reads these areas (default: all) of a backup from its folder, as far as it has them, and checks them against its manifest. The files
    of other areas do not matter. FileError: missing or damaged."""
    if folder.exists() and not (folder / MANIFEST).exists():
        raise FileError(f"{folder} is no backup's folder: there is no {MANIFEST} in it")
    text = storage.read(folder / MANIFEST)
    try:
        manifest = json.loads(text)
        if manifest["format"] != FORMAT or manifest["version"] != VERSION:
            raise FileError(f"{folder}: a backup of a kind that this program does not know")
        if not all(isinstance(entry["file"], str) for entry in manifest["files"].values()):
            raise ValueError
        files = {
            area: (entry["file"], int(entry["address"]), int(entry["bytes"]), int(entry["crc16"], 16), entry["sha256"])
            for area, entry in manifest["files"].items()
            if area in AREAS
        }
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise FileError(f"{folder / MANIFEST} is damaged") from None
    data, wrong = {}, []
    for area in [area for area in files if areas is None or area in areas]:
        try:
            data[area] = _area(folder, area, *files[area])
        except FileError as error:
            wrong.append(str(error))
    if wrong and data:
        wrong.append(f"The rest is good: m512 restore {folder} --what {','.join(data)}")
    if wrong:
        raise FileError(". ".join(wrong))
    return Backup(folder, manifest, data)


def _area(folder: Path, area: str, name: str, address: int, size: int, crc: int, sha: str) -> bytes:
    """The contents of an area, after a check against its entry in the manifest."""
    if Path(name).name != name:
        raise FileError(f"{folder / MANIFEST}: {name} is not beside it")
    low, high = AREAS[area]
    if address != low:
        raise FileError(f"{folder / MANIFEST}: the address of {area} is 0x{address:05X} and not 0x{low:05X}. Is this the backup of another board?")
    found = storage.read(folder / name)
    if (len(found), crc16(found), hashlib.sha256(found).hexdigest()) != (size, crc, sha):
        raise FileError(f"{folder / name} is not what the manifest says: damaged or changed")
    if size != high - low:
        raise FileError(f"{folder / name} has {size} bytes and not {high - low}")
    return found


def flash_pages(backup: Backup, areas: list[str]) -> dict[int, bytes]:
    """The flash areas as page index -> bytes."""
    return {
        (AREAS[area][0] + at) // FLASH_PAGE: backup.data[area][at : at + FLASH_PAGE]
        for area in areas
        if area != "eeprom"
        for at in range(0, len(backup.data[area]), FLASH_PAGE)
    }


def eeprom_changes(wanted: bytes, found: bytes) -> dict[int, int]:
    """The EEPROM cells to write: address -> value."""
    return {at: value for at, value in enumerate(wanted) if found[at] != value and at not in MAILBOX_CELLS}


def write_eeprom(loader: Loader, cells: dict[int, int], progress: Progress) -> None:
    """Writes EEPROM cells and reads them back. BoardError: some stay wrong; all others are written."""
    try:
        _write_eeprom(loader, cells, progress)
    except KeyboardInterrupt:
        raise CancelledError(f"stopped while it wrote the EEPROM. Repeat the command: {THE_REST}") from None
    except PortError as error:
        waits = ". Until then the boot loader may take all that comes for EEPROM bytes: run no other command, type nothing"
        raise PortError(f"{error}: {THE_REST}{waits if isinstance(loader, FactoryLoader) else ''}") from None


def _write_eeprom(loader: Loader, cells: dict[int, int], progress: Progress) -> None:
    wrong = cells
    for _ in range(EEPROM_TRIES):
        loader.write_eeprom(wrong, progress)
        first = min(wrong)
        found = loader.read_eeprom(first, max(wrong) + 1)
        wrong = {at: value for at, value in wrong.items() if found[at - first] != value}
        if not wrong:
            return
    state = loader.how_it_stands() if isinstance(loader, FactoryLoader) else f"Repeat the command: {THE_REST}"
    raise BoardError(f"EEPROM reads back wrong at {', '.join(f'0x{at:03X}' for at in list(wrong)[:8])}, {EEPROM_TRIES} times. {state}")


def board_of(backup: Backup) -> str | None:
    return backup.manifest.get("board")
