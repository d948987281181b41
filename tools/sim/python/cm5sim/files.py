# SPDX-License-Identifier: MIT
"""Files of cm5sim: what it loads into the robot, and what it keeps from run to run."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from fcntl import LOCK_EX, LOCK_NB, flock
from functools import partial
from typing import IO, TYPE_CHECKING

from .board import LOADER_ADDRESS, MOTIONS_ADDRESS, Board, find_image
from .options import Options
from .servo import EEPROM_BYTES, MODELS, Servo, Servos

if TYPE_CHECKING:
    from .trace import Trace

MOTION_BYTES, MOTION_PAGE_BYTES = 0x10000, 512  # a file of 65,024 bytes has no page 0
SERVO_FILE_BYTES_MAX = 0x10000
MODEL_NAMES = {int(name[2:]): name for name in MODELS}  # by the number in the register MODEL
MODEL, ID = 0, 3  # registers


def load_image(board: Board, name: str) -> None:
    if not find_image(name).exists():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name)
    board.load(name)


def load_motions(board: Board, path: str) -> None:
    if path.lower().endswith((".hex", ".ihex")):
        board.load(path)
        return
    with open(path, "rb") as file:
        area = file.read(MOTION_BYTES + 1)
    if len(area) not in (MOTION_BYTES, MOTION_BYTES - MOTION_PAGE_BYTES):
        raise OSError(f"{path}: a motion area has 65,536 bytes (or 65,024 without page 0)")
    end = MOTIONS_ADDRESS + MOTION_BYTES
    board.flash[end - len(area) : end] = area


def read_kept(path: str, size: int) -> bytes | None:
    """Reads a file of exactly this size. None: it does not exist yet."""
    try:
        with open(path, "rb") as file:
            data = file.read(size + 1)
    except FileNotFoundError:
        return None
    if len(data) != size:
        raise OSError(f"{path}: not a file of this kind: it must have {size} bytes")
    return data


def beside(path: str) -> str:
    """The new file, which is written first, then replaces the old one, so that a full disk does not destroy a robot's pages."""
    return f"{path}.new"


def is_at(path: str, file: IO[bytes]) -> bool:
    """Whether this open file still has this name: another run may have renamed or removed it."""
    try:
        return os.path.samestat(os.stat(path), os.fstat(file.fileno()))
    except FileNotFoundError:
        return False


@contextmanager
def begun(path: str) -> Iterator[None]:
    """Opens the new file already, so that a path that cannot be written is noticed before there is anything to lose, and locks it. The lock
    ends with the process. A new file that holds something is the user's, or the newest robot of a run that was killed."""
    if os.path.exists(path) and not (os.access(path, os.W_OK) and os.stat(path).st_mode & 0o222):  # root has access to everything
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)
    with open(beside(path), "ab") as new:
        try:
            flock(new, LOCK_EX | LOCK_NB)
        except BlockingIOError:
            raise OSError(f"{path}: in use by another cm5sim: end that first, or name another file") from None
        if not is_at(beside(path), new):
            raise OSError(f"{path}: another cm5sim has just ended: try again")
        if os.fstat(new.fileno()).st_size:
            raise OSError(f"{beside(path)}: holds something, and cm5sim would write over it: move it away, or name another file")
        try:
            yield
        finally:
            if is_at(beside(path), new) and os.fstat(new.fileno()).st_size == 0:  # the run failed before it could write
                os.unlink(beside(path))


@contextmanager
def kept_files(options: Options) -> Iterator[None]:
    """Has the files to keep while the run lasts. OSError: one cannot be written, or another run has it."""
    with ExitStack() as stack:
        for path in options.kept():
            stack.enter_context(begun(path))
        yield


@contextmanager
def naming(path: str) -> Iterator[None]:
    """Gives an OSError of writing the name of the file."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, path) from None


def write_kept(path: str, data: bytes) -> None:
    with naming(beside(path)):
        try:
            with open(beside(path), "wb") as file:
                file.write(data)
        except OSError:
            with suppress(OSError):
                os.truncate(beside(path), 0)  # a part of it is of no use, and would stop the next run
            raise
        if os.path.exists(path):
            shutil.copymode(path, beside(path))
        os.replace(beside(path), path)


def load_memories(board: Board, options: Options, say: Callable[[str], None]) -> None:
    """Loads the kept flash and EEPROM, images over them, and motions if no flash was kept."""
    flash = read_kept(options.flash, len(board.flash)) if options.flash else None
    eeprom = read_kept(options.eeprom, len(board.eeprom)) if options.eeprom else None
    if flash:
        board.flash[:] = flash
        if any(byte != 0xFF for byte in flash[LOADER_ADDRESS:]):
            board.start_in_loader()
    if eeprom:
        board.eeprom[:] = eeprom
    for image in options.images:
        load_image(board, image)
    if options.motions and flash:
        say(f"{options.flash} keeps its motion pages; --motions {options.motions} was not loaded over them")
    elif options.motions:
        load_motions(board, options.motions)


def listed(servos: Iterable[tuple[int, int]]) -> str:
    """Servos by ID and model number, as --servos names them."""
    return ",".join(f"{servo}" if MODEL_NAMES[model] == "ax12" else f"{servo}:{MODEL_NAMES[model]}" for servo, model in servos) or "none"


def restore_servos(servos: list[Servo], path: str) -> None:
    """Gives the servos, just plugged in, what the file keeps of them: the EEPROM area of each, then the ID of each when it was plugged in
    (which may have changed since). Older files have no such IDs. OSError: the file has other servos."""
    try:
        with open(path, "rb") as file:
            data = file.read(SERVO_FILE_BYTES_MAX + 1)
    except FileNotFoundError:
        return
    is_old = len(data) == EEPROM_BYTES * len(servos) or len(data) % (EEPROM_BYTES + 1) != 0
    count = len(data) // (EEPROM_BYTES if is_old else EEPROM_BYTES + 1)
    areas = [data[EEPROM_BYTES * index :][:EEPROM_BYTES] for index in range(count)]
    ids = data[EEPROM_BYTES * count :] or bytes(area[ID] for area in areas)
    if len(ids) != count or any(area[MODEL] not in MODEL_NAMES for area in areas):
        raise OSError(f"{path}: not a file of this kind: it must have {EEPROM_BYTES + 1} bytes for each servo")
    has, given = listed(zip(ids, (area[MODEL] for area in areas))), listed((servo.id, servo.model) for servo in servos)
    if has != given:
        raise OSError(f"{path}: has servos {has}, not {given}: give --servos {has}, or name another file")
    for servo, area in zip(servos, areas):
        servo.restore(area)


def plug_in_servos(servos: Servos, options: Options) -> None:
    for plan in options.servos:
        servos.add(*plan)
    if options.servo_eeprom:
        restore_servos(list(servos), options.servo_eeprom)
    for number, name in options.fault:
        if number not in servos:
            raise OSError("--fault: there is no servo with that ID")
        servos[number].fault(name)


def memories(options: Options, servos: Servos, board: Board | None = None) -> dict[str, bytes]:
    """What is to be kept, by the names of the files."""
    kept = {}
    if options.flash and board:
        kept[options.flash] = bytes(board.flash)
    if options.eeprom and board:
        kept[options.eeprom] = bytes(board.eeprom)
    if options.servo_eeprom:
        plugged_in = zip(options.servos, servos)  # the second servo of the fault "duplicate" follows them
        kept[options.servo_eeprom] = b"".join(servo.table[:EEPROM_BYTES] for _, servo in plugged_in) + bytes(plan.id for plan in options.servos)
    return kept


def keep(kept: dict[str, bytes], trace: Trace | None) -> list[str]:
    """Writes the memories, then closes the trace: each of them, whatever befalls another. Returns why some failed."""
    failures = []
    writes: list[Callable[[], None]] = [partial(write_kept, *file) for file in kept.items()]
    for write in writes + ([trace.close] if trace else []):
        try:
            write()
        except OSError as error:
            failures.append(reason(error))
    return failures


def reason(error: Exception) -> str:
    """Text of an error for the user."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
