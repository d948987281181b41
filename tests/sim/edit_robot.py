# SPDX-License-Identifier: MIT
"""A robot with Edit on the simulated board and a terminal emulator (pyte), for test_edit*.py.

with robot(pages={5: page(...)}) as r:
    r.line("page 5")            types a line and waits until the terminal is quiet
    r.text(2, 76, 4)            the text in row 2 from column 76 on
    r.cell(1, 3)                the cell X1 Y3;  r.cells(5, steps=...)
    r.flash_page(5)             512 bytes
"""

import pyte

from cm5sim import Board
from m512.files.image import Image
from tests.sim.made_page import JOINTS, page  # noqa: F401 (the tests take them from here)

PAGES = 128
MOTION_START = 0xE000
UNUSED = 0x4000


def new_page():
    """The new page of edit/ORIGINAL.md section 1, without checksum."""
    data = bytearray(512)
    data[15], data[22], data[24] = 1, 32, 32
    data[32:64] = bytes([0x55] * 32)
    for step in range(7):
        at = 64 + 64 * step
        data[at : at + 62] = bytes([0x00, 0x40] * 31)
        data[at + 63] = 64
    return data


def seal(data):
    """Sets byte 31 so that the sum of all bytes is 0xFF modulo 256."""
    data = bytearray(data)
    data[31] = 0
    data[31] = (0xFF - sum(data)) & 0xFF
    return bytes(data)


def changed(made, changes):
    """The page's bytes with {address: value} applied, sealed."""
    data = bytearray(made.data)
    for address, value in changes.items():
        data[address] = value
    return seal(data)


def word(data, step, joint):
    at = 64 + 64 * step + 2 * joint
    return data[at] | data[at + 1] << 8


class Terminal:
    """A pyte screen whose answers (cursor reports) go to the board."""

    def __init__(self, rows=36, columns=80):
        self.screen = pyte.Screen(columns, rows)
        self.stream = pyte.ByteStream(self.screen)
        self.answers = []
        self.screen.write_process_input = self.answers.append

    def feed(self, data):
        self.stream.feed(bytes(byte for byte in data if byte not in (0x11, 0x13)))

    def row(self, row):
        """Same as screen.display, which would render all rows."""
        line = self.screen.buffer[row - 1]
        return "".join(line[column].data for column in range(self.screen.columns))


class Robot:
    def __init__(self, pages=None, servos=JOINTS, rows=36, images=("boot-cm5.hex", "edit-cm5.hex"), loader=None, eeprom=b"", **board):
        image = Image.empty()
        for number, made in (pages or {}).items():
            image[number] = made
        motions = board.pop("motions", None) or image.to_bytes()
        self.board = Board(images=list(images), motions=motions, servos=servos, **board)
        if loader is not None:
            self.board.flash[0x1E000:0x20000] = loader
        self.board.eeprom[0 : len(eeprom)] = eeprom
        self.board.eeprom[0xFFF] = 0x11  # the loader starts the application
        self.terminal = Terminal(rows)
        self.page_at = None
        self.settle(ms=700)  # its screen is complete after 1030 ms

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is None:  # the report of a failed test still reads the board
            self.board.close()

    # ---- typing ----

    def pump(self):
        self.terminal.feed(self.board.take())
        while self.terminal.answers:
            self.board.send(self.terminal.answers.pop(0).encode())

    def settle(self, ms=0, quiet=70, limit=20000):
        """Runs at least `ms`, then until the line has been quiet for `quiet` ms."""
        if ms:
            self.board.run(ms=ms)
            self.pump()
        silent, waited = 0, 0
        while silent < quiet:
            self.board.run(ms=10)
            waited += 10
            data = self.board.take()
            self.terminal.feed(data)
            silent = 0 if data or self.terminal.answers or self.board.waiting else silent + 10
            while self.terminal.answers:
                self.board.send(self.terminal.answers.pop(0).encode())
            assert waited < limit, "the terminal does not come to rest:\n" + self.show()

    def keys(self, text, ms=0):
        self.board.send(text if isinstance(text, bytes) else text.encode())
        self.settle(ms)

    def line(self, text, answer=None, ms=0):
        """Types a line. If `answer` is given, presses this key at the question."""
        self.keys(text + "\r", ms)
        if answer is not None:
            assert "[y/N]" in self.command, self.command
            self.keys(answer, ms)
        return self.message

    # ---- reading the screen ----

    @property
    def rows(self):
        return min(self.terminal.screen.lines, 35)

    @property
    def command(self):
        return self.terminal.row(self.rows).rstrip()

    @property
    def message(self):
        return self.command[2:]

    def text(self, row, column, count):
        return self.terminal.row(row)[column - 1 : column - 1 + count]

    @property
    def cursor(self):
        return self.terminal.screen.cursor.y + 1, self.terminal.screen.cursor.x + 1

    def cell(self, x, y):
        row = y + 1
        if x == 9:
            return self.text(row, 77, 3)
        if x == 8:
            return self.text(row, 61, 3)
        column = 20 if x == 0 else 21 + 5 * x
        return self.text(row, column, 4) if y <= 30 else self.text(row, column + 1, 3)

    @property
    def xya(self):
        return self.text(33, 64, 2), self.text(33, 69, 2), self.text(33, 74, 4)

    @property
    def unsaved(self):
        return "unsaved" in self.terminal.row(self.rows - 1)[:19]

    @property
    def fault(self):
        return self.terminal.row(self.rows - 3)[60:].strip()

    def show(self):
        return "\n".join(self.terminal.screen.display)

    # ---- the board ----

    def flash_page(self, number):
        at = MOTION_START + 512 * number
        return bytes(self.board.flash[at : at + 512])

    def page_address(self):
        """Address of the edited page in RAM, found by its bytes right after a page was opened."""
        if self.page_at is None:
            number = int(self.text(2, 76, 4))
            assert not self.unsaved
            self.page_at = bytes(self.board.ram[0x100:0x1100]).find(self.flash_page(number)[:31]) + 0x100
            assert self.page_at >= 0x100
        return self.page_at

    def ram_page(self):
        """The edited page, sealed as by SAVE."""
        at = self.page_address()
        return seal(self.board.ram[at : at + 512])


def robot(**options):
    return Robot(**options)
