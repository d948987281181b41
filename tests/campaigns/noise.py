# SPDX-License-Identifier: MIT
"""Noise instead of a board's answers, and the conversations of m512 with it. Each ends with a result or an m512 error."""

from hypothesis import strategies as st

from m512.board import link as links
from m512.board.block import BlockLoader, frame
from m512.board.client import Client
from m512.board.factory import FactoryLoader
from m512.errors import M512Error
from m512.files.page import EMPTY


class NoisyLink(links.Link):
    """A line with canned bytes, then silence. Time passes only during silence."""

    def __init__(self, data):
        self.data, self.held, self.trace, self.url = data, b"", None, "noise"
        self.silent_s = 0.0

    def now(self):
        return self.silent_s

    def write(self, data, wait=True):
        pass

    def _receive(self, limit, seconds):
        size = min(limit, 7)
        out, self.data = self.data[:size], self.data[size:]
        self.silent_s += 0 if out else 0.001
        return out

    def look_for(self, end, seconds, limit=1 << 20):
        return super().look_for(end, 0.002, limit)


def pieces():
    """Noise that includes the words the parsers look for."""
    words = [
        b"\r\n - ",
        b"\x1e@ver ",
        b" OK\r\n",
        b" ERR 3 no\r\n",
        b"\x1e@ver image=play can=save OK\r\n",
        b"Ready..",
        b"Success",
        b"Rewriting:0X0000\r\n Size:0X00000100  Checksum:00-00",
        b"\r\n 0000E000 : " + b"FF " * 16,
        b"\x5a\x01\xa0\x01\x00\x00",
        b"\x1e@page 1 " + EMPTY.hex().encode() + b" 0000 OK\r\n",
        b"\x1e@pose 1:5:1 2:?:0 OK\r\n",
        b"\x1e@where state=idle page=x OK\r\n",
        frame(1, 160, b"\0\0").replace(b"\xa5", b"\x5a", 1),
        b"\xff" * 3,
        b"\x1b[2;3f",
    ]
    return st.lists(st.one_of(st.sampled_from(words), st.binary(max_size=12)), max_size=40).map(b"".join)


def survives(action):
    try:
        action()
    except M512Error as error:
        assert str(error)


def machine(data):
    """Sends every request to one of our images."""

    def talk():
        client = Client(NoisyLink(data), (0.002,))
        for ask in (client.list_pages, client.pose, client.where, lambda: client.page(1), lambda: client.find("x")):
            survives(ask)

    survives(talk)


def factory_loader(data):
    def talk():
        loader = FactoryLoader(NoisyLink(data))
        survives(lambda: loader.read(0xE000, 0xE080))
        survives(lambda: loader.write({0xE0: bytes(256)}))

    survives(talk)


def block_loader(data):
    def talk():
        loader = BlockLoader(NoisyLink(data), "", 1, 0.002)
        survives(lambda: loader.read(0, 0x100))
        survives(lambda: loader.different({3: bytes(256)}))

    survives(talk)


TALKS = (machine, factory_loader, block_loader)
