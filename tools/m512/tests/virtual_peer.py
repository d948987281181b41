# SPDX-License-Identifier: MIT
"""Boards at the end of a line in virtual time, for m512 in this process.

Time passes only while m512 sends, waits or reads. So a test runs the same on a busy machine as on an idle one, and a wait of a
minute costs nothing. A byte takes as long as on the real line.

    with BlockPeer() as board:                    # a VirtualPeer
        m512("flash", image, "-p", board.path)    # the fixture m512 opens peer://... by open_port()
"""

import itertools
import math

from peer import Peer

from m512.board import link as real
from m512.errors import PortError

BYTE_SECONDS = 10 / 57600
QUANTUM = 0.016
_names = itertools.count(1)
_there = {}  # path -> the End that is plugged in


class End(Peer):
    """The board's end of the cable, and its clock. A subclass has now(), pass_time(seconds), put(data) and get(limit, seconds)."""

    plugged = False

    def __init__(self):
        super().__init__()
        self.path = ""
        self.plug()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.pull()

    def pull(self):
        """Pulls the cable: the PC's end loses the device, the board sees silence."""
        _there.pop(self.path, None)
        self.plugged = False

    def plug(self):
        """Plugs the cable in again under another name."""
        self.pull()
        self.cut_after, self.moved, self.path = None, 0, f"peer://{next(_names)}"
        _there[self.path], self.plugged = self, True

    def still_plugged(self):
        if not self.plugged:
            raise OSError("device disconnected")

    def opened(self):
        """Called when a program opens the port. Must drop earlier output."""

    def set_rate(self, rate):
        """Called when the PC's end changes its rate."""


class VirtualPeer(End):
    """The end of a board that is a test class."""

    def __init__(self):
        self.clock = self.heard_at = self.sent_until = 0.0
        self.sent = bytearray()  # on its way to the PC; the last byte arrives at sent_until
        super().__init__()

    def now(self):
        return self.clock

    def pass_time(self, seconds):
        until = self.clock + seconds
        while self.clock < until:
            self.clock = min(self.clock + QUANTUM, until)
            self.on_silence(self.clock - self.heard_at)

    def put(self, data):
        for byte in data:
            self.pass_time(BYTE_SECONDS)
            self.still_plugged()
            byte = self._count("->", byte)
            self.still_plugged()
            if byte is not None:
                self.heard_at = self.clock
                self.on_byte(byte)

    def _to_pc(self, data):
        self.sent_until = max(self.clock, self.sent_until) + len(data) * BYTE_SECONDS
        self.sent += data

    def _under_way(self):
        return min(len(self.sent), max(0, math.ceil((self.sent_until - self.clock) / BYTE_SECONDS - 1e-6)))

    def get(self, limit, seconds):
        """What has arrived. It looks every QUANTUM, the time for which an adapter collects bytes."""
        deadline = self.clock + seconds
        while len(self.sent) == self._under_way():
            self.still_plugged()
            if self.clock >= deadline:
                return b""
            self.pass_time(min(QUANTUM, deadline - self.clock))
        count = min(limit, len(self.sent) - self._under_way())
        out, self.sent = bytes(self.sent[:count]), self.sent[count:]
        return out

    def opened(self):
        self.sent.clear()


class SimulatedBoard(End):
    """A cm5sim.Board with our images."""

    SLICE_MS = 1

    def __init__(self, board):
        self.board = board
        super().__init__()

    def now(self):
        return self.board.now_ms / 1000

    def pass_time(self, seconds):
        self.board.run(ms=seconds * 1000)

    def on_byte(self, byte):
        self.board.send(bytes([byte]))

    def put(self, data):
        self.still_plugged()
        for byte in data:
            byte = self._count("->", byte)
            self.still_plugged()
            if byte is not None:
                self.on_byte(byte)
        while self.board.waiting:
            self.board.run(ms=self.SLICE_MS)

    def _to_pc(self, data):
        self.heard += data

    heard = b""

    def get(self, limit, seconds):
        deadline = self.now() + seconds
        while True:
            self.send(self.board.take())
            self.still_plugged()
            if self.heard or self.now() >= deadline:
                break
            self.board.run(ms=self.SLICE_MS)
        out, self.heard = self.heard[:limit], self.heard[limit:]
        return out

    def opened(self):
        self.board.take()
        self.heard = b""

    def set_rate(self, rate):
        self.board.baud(rate)


class VirtualLink(real.Link):
    """m512's Link to an End."""

    def __init__(self, url):
        self.url, self.held = url, b""
        self.end = _there.get(url)
        if self.end is None:
            raise PortError(real.explain(url, OSError("No such file")))
        self.end.opened()

    def close(self):
        pass

    def now(self):
        return self.end.now()

    def sleep(self, seconds):
        self.end.pass_time(seconds)

    def set_rate(self, rate):
        self.end.set_rate(rate)

    def write(self, data, wait=True):
        try:
            self.end.put(data)
        except OSError as error:
            raise self._lost(error) from None

    def _receive(self, limit, seconds):
        try:
            return self.end.get(limit, max(seconds, 0))
        except OSError as error:
            raise self._lost(error) from None


_RealLink = real.Link


def open_port(url, image="play"):
    """Replaces Link(url): a line in virtual time to a board of this process, or a real port."""
    return (VirtualLink if url.startswith("peer://") else _RealLink)(url)
