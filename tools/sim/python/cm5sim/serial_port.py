# SPDX-License-Identifier: MIT
"""A pseudo-terminal that serves other programs as a serial port."""

from __future__ import annotations

import errno
import os
import struct
from fcntl import LOCK_EX, LOCK_NB, LOCK_SH, ioctl, lockf

# struct termios2 of Linux allows any rate; <termios.h> has only some.
_TCGETS2, _TCSETS2 = 0x802C542A, 0x402C542B
_TERMIOS2 = struct.Struct("4I20s2I")
_CS8, _CREAD, _CLOCAL, _BOTHER = 0o60, 0o200, 0o4000, 0o10000


def read_link(link: str) -> str:
    """What the link leads to. "": no link is there."""
    try:
        return os.readlink(link)
    except OSError:
        return ""


def is_served(path: str) -> bool:
    """Whether a program like this one serves this pty. It holds a record lock, which dies with it; clients that lock their port use flock.
    The number of a dead program's pty may be that of somebody's terminal now."""
    try:
        pty = os.open(path, os.O_RDONLY | os.O_NOCTTY | os.O_NONBLOCK)
    except OSError as error:
        return error.errno == errno.EBUSY  # a client has it for itself
    try:
        lockf(pty, LOCK_SH | LOCK_NB)
        return False
    except OSError:
        return True
    finally:
        os.close(pty)


def remove_old_link(link: str) -> None:
    """Removes a link left over from an earlier run. Anything but a link to a pty is not ours. OSError: the link is in use."""
    path = read_link(link)
    if not path.startswith("/dev/pts/"):
        return
    if is_served(path):
        raise OSError(f"{link}: in use by another program: end that first, or name another link")
    os.unlink(link)


class SerialPort:
    """A raw port at this rate. `link`, if not empty, becomes a symbolic link to it. It replaces the link of a dead program, but nothing else."""

    def __init__(self, link: str, rate: int) -> None:
        """OSError: the port or the link cannot be made."""
        if link:
            remove_old_link(link)  # before this program has a pty: it may get the number of the old one
        self.master, self._slave = os.openpty()  # an open slave lets clients come and go
        lockf(self._slave, LOCK_EX)  # for is_served
        self._link = ""
        os.set_blocking(self.master, False)
        control = _TERMIOS2.unpack(ioctl(self._slave, _TCGETS2, bytes(_TERMIOS2.size)))[4]
        ioctl(self._slave, _TCSETS2, _TERMIOS2.pack(0, 0, _CS8 | _CREAD | _CLOCAL | _BOTHER, 0, control, rate, rate))
        self.path = os.ttyname(self._slave)
        if link:
            try:
                os.symlink(self.path, link)
            except OSError as error:
                raise OSError(error.errno, error.strerror, link) from None
            self._link = link

    def close(self) -> None:
        if self._link and read_link(self._link) == self.path:
            os.unlink(self._link)
        os.close(self._slave)
        os.close(self.master)

    @property
    def rate(self) -> int:
        """The rate set by the client, in bps."""
        return int(_TERMIOS2.unpack(ioctl(self._slave, _TCGETS2, bytes(_TERMIOS2.size)))[-1])

    def read(self) -> bytes:
        try:
            return os.read(self.master, 4096)
        except OSError:
            return b""

    def write(self, data: bytes) -> None:
        """Writes data. Without a reader it is lost, as on a cable."""
        try:
            os.write(self.master, data)
        except OSError:
            pass
