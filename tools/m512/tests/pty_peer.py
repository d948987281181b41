# SPDX-License-Identifier: MIT
"""A board on a pty, played by a thread: bytes in, bytes out, silence, and a cable that can be pulled.

A peer subclasses Peer and has on_byte() and on_silence(); its state (flash, EEPROM) outlives the cable.
"""
import os
import select
import threading
import time
import tty

QUANTUM = 0.01


class Peer:
    def __init__(self):
        self.lock = threading.RLock()
        self.cut_after = None          # bytes, both ways together, until the cable is pulled
        self.garble = None             # function(direction, index, byte) -> byte or None (lost)
        self.moved = 0
        self.running = True
        self.path = ""
        self.heard_at = time.monotonic()
        self._open()
        self.thread = threading.Thread(target=self._loop, daemon=True)
        self.thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.running = False
        self.thread.join(5)
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

    def pull(self):
        """The cable comes off: the PC's end sees the device go, the board hears silence."""
        with self.lock:
            self._close()

    def plug(self):
        """Back again, maybe under another name."""
        with self.lock:
            self._close()
            self.cut_after, self.moved = None, 0
            self._open()

    def _count(self, direction, byte):
        """A byte passes the cable: what comes out at the other end, or None."""
        index, self.moved = self.moved, self.moved + 1
        if self.cut_after is not None and index >= self.cut_after:
            self.pull()
            return None
        return self.garble(direction, index, byte) if self.garble else byte

    def send(self, data):
        with self.lock:
            if self.master is not None and self.cut_after is None and self.garble is None:
                self.moved += len(data)
                self._write(data)
                return
            for byte in data:
                if self.master is None:
                    return
                byte = self._count("<-", byte)
                if byte is not None and self.master is not None:
                    self._write(bytes([byte]))

    def _write(self, data):
        """Waits while the PC's end is full, as long as it takes a busy PC to read it."""
        while data and self.running:
            try:
                data = data[os.write(self.master, data):]
            except BlockingIOError:
                time.sleep(QUANTUM)

    def _loop(self):
        while self.running:
            self._wait()
            with self.lock:
                for byte in self._read():
                    byte = self._count("->", byte)
                    if self.master is None:
                        break
                    if byte is not None:
                        self.heard_at = time.monotonic()
                        self.on_byte(byte)
                self.on_silence(time.monotonic() - self.heard_at)

    def _wait(self):
        """Until something may have come. Without the lock, so that the file number may belong to another file by now."""
        try:
            select.select([self.master], [], [], QUANTUM)
        except (OSError, TypeError, ValueError):     # the cable is off
            time.sleep(QUANTUM)

    def _read(self):
        """What has come; under the lock, so that it comes from this cable and not from a file that has its number now."""
        try:
            return os.read(self.master, 4096)
        except (OSError, TypeError):                 # nothing, or the cable is off
            return b""

    def on_byte(self, byte):
        raise NotImplementedError

    def on_silence(self, seconds):
        pass
