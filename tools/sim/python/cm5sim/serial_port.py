# SPDX-License-Identifier: MIT
"""A pseudo-terminal that serves other programs as a serial port."""

from __future__ import annotations

import os
import struct
from fcntl import ioctl

# struct termios2 of Linux allows any rate; <termios.h> has only some.
_TCGETS2, _TCSETS2 = 0x802C542A, 0x402C542B
_TERMIOS2 = struct.Struct("4I20s2I")
_CS8, _CREAD, _CLOCAL, _BOTHER = 0o60, 0o200, 0o4000, 0o10000


class SerialPort:
    """A raw port at this rate. `link`, if not empty, becomes a symbolic link to it. It replaces an older link, but nothing else."""

    def __init__(self, link: str, rate: int) -> None:
        """OSError: the port or the link cannot be made."""
        self.master, self._slave = os.openpty()  # an open slave lets clients come and go
        self._link = ""
        os.set_blocking(self.master, False)
        control = _TERMIOS2.unpack(ioctl(self._slave, _TCGETS2, bytes(_TERMIOS2.size)))[4]
        ioctl(self._slave, _TCSETS2, _TERMIOS2.pack(0, 0, _CS8 | _CREAD | _CLOCAL | _BOTHER, 0, control, rate, rate))
        self.path = os.ttyname(self._slave)
        if link:
            if os.path.islink(link):
                os.unlink(link)
            os.symlink(self.path, link)
            self._link = link

    def close(self) -> None:
        if self._link:
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
