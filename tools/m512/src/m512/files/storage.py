# SPDX-License-Identifier: MIT
"""Reads and writes files, completely or not at all, and pipes ("-" is standard input or output)."""

from __future__ import annotations

import errno
import os
import re
import stat
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from m512.errors import FileError, RefusedError
from m512.streams import end_results

MOST_BYTES = 4 << 20  # larger than any motion file, firmware or backup; stops /dev/zero. Readers take time in proportion to the size


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
    """Whether writing would overwrite something."""
    return path.exists() and not is_stream(path)


def must_be_free(path: Path, force: bool) -> None:
    """RefusedError: the file exists. FileError: the path is a folder."""
    if path.is_dir():
        raise FileError(f"{path} is a folder; name a file in it")
    if exists(path) and not force:
        raise RefusedError(f"{path} is there already (--force overwrites it)")


def read(path: Path) -> bytes:
    """All bytes of a file or pipe. FileError: also when standard input is read a second time."""
    global _read_already
    if path.is_dir():
        raise FileError(f"{path} is a folder; name a file in it")
    try:
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


def write(path: Path, data: bytes) -> list[str]:
    """Replaces a file in one step: after a crash or on a full disk the old one remains. Returns what could not be kept of the old one
    besides its contents."""
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
            return _replace(Path(os.path.realpath(path)), path, data)
    except BrokenPipeError:  # its reader has gone (cli/__init__.py)
        raise
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror}") from None
    return []


def _replace(path: Path, called: Path, data: bytes) -> list[str]:
    """Replaces the file at `path`, or makes it. `called`: how the user names it. Returns what of the old file could not be kept."""
    old = path.stat() if path.exists() else None
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
        os.replace(name, path)
    except BaseException:
        with suppress(FileNotFoundError):  # a signal during the replacement: the file has its new name already
            os.unlink(name)
        raise
    if old and old.st_nlink > 1:
        lost.append(f"{called} had other names (hard links): they keep the old contents")
    return lost


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
