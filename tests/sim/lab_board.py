# SPDX-License-Identifier: MIT
"""A board with the program lab/lab.c, which performs single operations on the chip on request."""

import struct

from cm5sim import Board
from cm5sim.library import build_folder

PAGE = 0x4000
MS_IN_EIGHT_CYCLES = 2000


class Lab(Board):
    def __init__(self, **options):
        super().__init__(images=[build_folder() / "firmware" / "lab" / "lab.hex"], **options)
        self.run(ms=1)  # until its UART is on

    def do(self, letter, address=0, value=0, ms=3000):
        """Runs one command of lab.c. Returns the two numbers of its answer."""
        self.take()
        self.send(letter.encode() + struct.pack("<I", address)[:3] + struct.pack("<H", value))
        return self.answer(ms)

    def answer(self, ms=3000):
        data, end = b"", self.now_ms + ms
        while len(data) < 4 and self.now_ms < end:
            self.run(ms=0.25)
            data += self.take()
        assert len(data) == 4, f"no answer, but {data!r}"
        return struct.unpack("<HH", data)

    def write_page(self, address, data):
        """Fills and writes the words of `data` at the start of a page, without an erase."""
        for offset in range(0, len(data), 2):
            self.do("f", address + offset, data[offset] | data[offset + 1] << 8)
        return self.do("w", address)
