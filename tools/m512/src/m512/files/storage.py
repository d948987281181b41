# SPDX-License-Identifier: MIT
"""Reads and writes files, completely or not at all, and pipes ("-" is standard input or output).

All that m512 writes to a disk it writes here. What may be replaced is judged when a file gets its name: what another program has made
since an earlier look stays. The earlier look (must_be_free) saves the user the work that would be in vain.
"""

from __future__ import annotations

import errno
import json
import os
import re
import stat
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import BinaryIO

from m512.errors import FileError, RefusedError
from m512.signals import settle
from m512.streams import end_results

MOST_BYTES = 4 << 20  # larger than any motion file, firmware or backup; stops /dev/zero. Readers take time in proportion to the size
BACKUP_MANIFEST, BACKUP_FORMAT = "manifest.json", "m512-backup"  # in the folder of a backup (board/backup.py)

_read_already: object = None  # the sys.stdin that has been read


def _descriptor(path: Path) -> int | None:
    """The number of an inherited descriptor: 1 for "-" and /dev/stdout. It may be a file opened for appending, so it is written to and
    not replaced."""
    names = {"-": 1, "/dev/stdin": 0, "/dev/stdout": 1, "/dev/stderr": 2}
    found = re.fullmatch(r"/(?:dev|proc/self)/fd/([0-9]{1,9})", str(path))
    return int(found.group(1)) if found else names.get(str(path))


def is_stream(path: Path) -> bool:
    """Whether the path is a stream and not a regular file: "-", a pipe, a terminal."""
    if _descriptor(path) is not None:
        return True
    try:
        return not (stat.S_ISREG(path.stat().st_mode) or path.is_dir())
    except OSError:
        return False


def folder(path: Path) -> Path:
    """The folder that names in a file are relative to: for a stream the current one."""
    return Path(".") if is_stream(path) else path.parent


def is_untraceable(path: Path) -> bool:
    """Whether it cannot be told which file the bytes read from this path come from: a pipe, a terminal, a deleted file (`<<<` in shells)."""
    status = _source_status(path)
    return not (stat.S_ISREG(status.st_mode) and status.st_nlink)


def is_source(path: Path, target: Path) -> bool:
    """Whether what was read from `path` is this file, also behind an inherited descriptor: `< file`."""
    return os.path.samestat(_source_status(path), target.stat())


def _source_status(path: Path) -> os.stat_result:
    descriptor = 0 if str(path) == "-" else _descriptor(path)
    return path.stat() if descriptor is None else os.fstat(descriptor)


def exists(path: Path) -> bool:
    """Whether writing would overwrite something, such as a link that leads to itself."""
    try:
        return os.path.lexists(os.path.realpath(path)) and not is_stream(path)
    except OSError:  # the current folder is gone
        return False


def must_be_free(path: Path, force: bool) -> None:
    """RefusedError: the file exists and is not to be replaced, or belongs to a backup. FileError: the path is a folder."""
    if path.is_dir():
        raise FileError(f"{path} is a folder; name a file in it")
    if exists(path) and not force:
        raise RefusedError(f"{path} is there already (--force overwrites it)")
    keep_backup(path)


def keep_backup(path: Path) -> None:
    """RefusedError if the path is a file of a backup: with other contents it would no longer be what its manifest says."""
    if is_stream(path):
        return
    try:
        real = Path(os.path.realpath(path))
        manifest = json.loads((real.parent / BACKUP_MANIFEST).read_bytes())
        names = [entry["file"] for entry in manifest["files"].values()] if manifest["format"] == BACKUP_FORMAT else []
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return  # no backup, or one that is unreadable already
    if real.name in (*names, BACKUP_MANIFEST) and names:
        raise RefusedError(
            f"{path} belongs to the backup {real.parent if path.is_symlink() else path.parent}, which stays as it was read from the board. "
            "Name another file for the result (of `m512 pages`: -o new.bin); `m512 flash new.bin` writes it to the board"
        )


def must_take_files(folder: Path, numbered: bool = False) -> None:
    """FileError if write_folder() can make no such folder."""
    try:
        if folder.exists() and any(folder.iterdir()) and not numbered:
            raise FileError(f"{folder} is there already and not empty")
    except OSError as error:
        raise FileError(f"cannot make {folder}: {error.strerror}") from None
    there = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not there.is_dir() or not os.access(there, os.W_OK):
        raise FileError(f"cannot make {folder}: nothing can be written in {there}")


def read(path: Path) -> bytes:
    """All bytes of a file or pipe. FileError: also when standard input is read a second time."""
    global _read_already
    try:
        if path.is_dir():
            raise FileError(f"{path} is a folder; name a file in it")
        if _descriptor(path) == 0 or str(path) == "-":
            if sys.stdin is None:
                raise FileError("cannot read -: standard input is closed")
            if sys.stdin is _read_already:
                raise FileError("standard input gives one file, and here it is asked for two: put one of them into a file")
            _read_already = sys.stdin
            data = sys.stdin.buffer.read(MOST_BYTES + 1)
        else:
            with open(path, "rb") as file:
                data = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise FileError(f"cannot read {path}: {error.strerror}") from None
    must_fit(len(data), path)
    return data


def must_fit(size: int, path: Path) -> None:
    """FileError: too large for a file of this program."""
    if size > MOST_BYTES:
        raise FileError(f"cannot read {path}: more than {MOST_BYTES >> 20} MiB, which is no file for this program")


def write(path: Path, data: bytes, replace: bool = False) -> list[str]:
    """Writes a file in one step: after a crash or on a full disk an old one remains. Returns what could not be kept of the old one besides
    its contents. RefusedError: it exists, and `replace` is false; or it belongs to a backup."""
    try:
        descriptor = _descriptor(path)
        if descriptor == 1:
            if sys.stdout is None:
                raise FileError(f"cannot write {path}: standard output is closed")
            try:
                sys.stdout.buffer.write(data)
                sys.stdout.buffer.flush()
            except OSError:
                end_results()
                raise
        elif descriptor is not None:
            with os.fdopen(os.dup(descriptor), "wb") as stream:
                stream.write(data)
        elif is_stream(path):
            with open(path, "wb") as stream:
                stream.write(data)
        else:
            return _put(Path(os.path.realpath(path)), path, data, replace)
    except BrokenPipeError:  # its reader has gone (cli/__init__.py)
        raise
    except FileExistsError:
        raise RefusedError(f"{path} is there already (--force overwrites it)") from None
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror}") from None
    return []


def begin(path: Path, replace: bool = False) -> tuple[BinaryIO, list[str]]:
    """Opens a file that grows, such as a log. An old one becomes empty first. Otherwise as write()."""
    lost = [] if is_stream(path) else write(path, b"", replace)
    descriptor = _descriptor(path)
    try:
        return (open(path, "wb" if is_stream(path) else "ab") if descriptor is None else os.fdopen(os.dup(descriptor), "wb")), lost
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror}") from None


def write_numbered(path: Path, data: bytes) -> Path:
    """Writes a new file under this name or, if that is taken, under one with a number behind it. Returns the name."""
    for name in _numbered(path):
        if not exists(name):
            with suppress(RefusedError):  # it is there by now
                write(name, data)
                break
    return name


def write_folder(folder: Path, files: Mapping[str, bytes], numbered: bool = False) -> Path:
    """Writes files into a folder that is new or empty, or nothing at all. `numbered`: into a new one, with a number behind its name if that
    is taken. Returns its name. FileError: something else is there, or nothing can be written."""
    made: list[Path] = []
    written: list[Path] = []
    try:
        folder = _make_folder(folder, numbered, made)
        for name, data in files.items():
            try:
                write(folder / name, data)
            except RefusedError:  # another program writes into this folder, too
                raise FileError(f"{folder} is there already and not empty") from None
            written.append(folder / name)
    except BaseException:
        with suppress(OSError):
            for path in written:
                path.unlink()
            for path in reversed(made):
                path.rmdir()
        raise
    return folder


def _make_folder(folder: Path, numbered: bool, made: list[Path]) -> Path:
    """Makes the folder, and those that it is in. Adds what it made to `made`."""
    try:
        for place in reversed(folder.parents):
            if not place.exists():
                place.mkdir(exist_ok=True)
                made.append(place)
        for name in _numbered(folder):
            try:
                name.mkdir()
                made.append(name)
                return name
            except FileExistsError:
                if not numbered:
                    must_take_files(folder)
                    return folder
    except OSError as error:
        raise FileError(f"cannot make {folder}: {error.strerror}") from None
    raise AssertionError


def _numbered(path: Path) -> Iterator[Path]:
    """name.hex, name-2.hex, name-3.hex ..."""
    yield path
    for number in count(2):
        yield path.with_name(f"{path.stem}-{number}{path.suffix}")


def _put(path: Path, called: Path, data: bytes, replace: bool) -> list[str]:
    """Makes the file at `path`, or replaces it. `called`: how the user names it. Returns what of the old file could not be kept."""
    old = path.stat() if replace and path.exists() else None
    if old and not (os.access(path, os.W_OK) and old.st_mode & 0o222):  # root has access to everything
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    try:
        # Of a long name the first 60 characters, at most 240 bytes: with what is added it is still a legal name.
        handle, name = tempfile.mkstemp(prefix=f".{path.name[:60]}.", dir=path.parent)
    except OSError as error:
        raise FileError(f"cannot write {called}: no new file can be made in the folder {path.parent}: {error.strerror}") from None
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        lost = _keep_owner(name, old, called) if old else []
        os.chmod(name, old.st_mode & 0o7777 if old else 0o666 & ~_umask())
        keep_backup(called)
        settle()
        (os.replace if replace else _name_new)(name, path)
    except BaseException:
        with suppress(FileNotFoundError):  # a signal during the replacement: the file has its new name already
            os.unlink(name)
        raise
    if old and old.st_nlink > 1:
        lost.append(f"{called} had other names (hard links): they keep the old contents")
    return lost


def _name_new(name: str, path: Path) -> None:
    """Gives a file a name that nothing has. FileExistsError: something has it."""
    try:
        os.link(name, path)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links, such as FAT: an empty file takes the name first
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        try:
            os.replace(name, path)
        except BaseException:
            os.unlink(path)
            raise
    else:
        os.unlink(name)


def _keep_owner(name: str, old: os.stat_result, called: Path) -> list[str]:
    """Gives a new file the owner and group of the old one. Only root can give away a file, and others only to groups of their own."""
    new = os.stat(name)
    for uid, gid in ((old.st_uid, old.st_gid), (-1, old.st_gid)):
        if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
            with suppress(OSError):
                os.chown(name, uid, gid)
            new = os.stat(name)
    kept = {"owner": new.st_uid == old.st_uid, "group": new.st_gid == old.st_gid}
    lost = " and ".join(what for what, is_kept in kept.items() if not is_kept)
    return [f"{called}: its {lost} could not be kept"] if lost else []


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
