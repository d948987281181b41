# SPDX-License-Identifier: MIT
"""A board on a pty, run by a thread in real time, for tests of the port itself. Limits here are minutes. The board's clock stops while
this process does not run, so that the PC could have written during a silence of 0.1 s that ends a download."""

import os
import select
import threading
import time
import tty

from peer import Peer

QUANTUM = 0.01


class PtyPeer(Peer):
    """`lock` is held while the board acts."""

    def __init__(self):
        super().__init__()
        self.lock = threading.RLock()
        self.running = True
        self.clock = self.heard_at = 0.0
        self._open()
        self.thread = threading.Thread(target=self._loop, daemon=True)
        self.thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.running = False
        self.thread.join(60)
        self._close()

    def _open(self):
        self.master, self.slave = os.openpty()
        os.set_blocking(self.master, False)
        tty.setraw(self.slave)
        self.path = os.ttyname(self.slave)

    def _close(self):
        for name in ("master", "slave"):
            fd = getattr(self, name)
            setattr(self, name, None)
            if fd is not None:
                os.close(fd)

    def now(self):
        return self.clock

    @property
    def plugged(self):
        return self.master is not None

    def pull(self):
        """Pulls the cable: the PC's end loses the device, the board sees silence."""
        with self.lock:
            self._close()

    def plug(self):
        """Plugs the cable in again, maybe under another name."""
        with self.lock:
            self._close()
            self.cut_after, self.moved = None, 0
            self._open()

    def send(self, data):
        with self.lock:
            super().send(data)

    def _to_pc(self, data):
        """Waits while the buffer to the PC is full, as long as a busy PC needs to read it."""
        while data and self.running:
            try:
                data = data[os.write(self.master, data) :]
            except BlockingIOError:
                time.sleep(QUANTUM)

    def _loop(self):
        while self.running:
            begun = time.monotonic()
            self._wait()
            with self.lock:
                self.clock += min(time.monotonic() - begun, 5 * QUANTUM)
                for byte in self._read():
                    byte = self._count("->", byte)
                    if self.master is None:
                        break
                    if byte is not None:
                        self.heard_at = self.clock
                        self.on_byte(byte)
                self.on_silence(self.clock - self.heard_at)

    def _wait(self):
        """Waits until data may have arrived. Does not hold the lock, so the file descriptor may belong to another file afterwards."""
        try:
            select.select([self.master], [], [], QUANTUM)
        except (OSError, TypeError, ValueError):  # the cable is unplugged
            time.sleep(QUANTUM)

    def _read(self):
        """Returns the data that has arrived. Holds the lock, so that it is from this cable and not from another file with the same
        descriptor."""
        try:
            return os.read(self.master, 4096)
        except (OSError, TypeError):  # no data, or the cable is unplugged
            return b""
