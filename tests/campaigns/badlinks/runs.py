# SPDX-License-Identifier: MIT
"""Schedules: m512 flashes a board that has a factory-style loader over a bad line. It may be stopped at any moment, and is called again.
A schedule's number determines everything in it."""

from __future__ import annotations

import contextlib
import dataclasses
import random
import re

from m512.board import download, loaders
from m512.board.memory import Plan
from m512.errors import M512Error
from m512.ui import unseen

from .factory_model import BANNER, BANNER_AT, BOOT, PAGE, Board, Loader
from .line import BROKEN, CANCELLED, KILLED, Killed, Line
from .wire import Conditions, conditions, wires

APP_END, MOTION_START, MOTIONS = 0xC000, 0xE000, 128
WAIT = 20.0  # how long m512 waits for the button
SETTLE = 60  # what a loader still does after the last call is over by then
DONE, GAVE_UP = "done", "gave up"
# Text that would do harm if the loader took it for typed text.
NASTY = (
    b"\rl\r",
    b"\rload 1e000\r",
    b"\x01\r",
    b"\x01 1e000\r",
    b"\ndn\n",
    b"\rclear_eeprom\ry",
    b"\reep_dn 0 100\r",
    b"\x08\x08l\r",
    b"x" * 90 + b"\r",
    b"\r",
    b"\n",
    b"l 1dfff\r",
    b"\x00l\x00\r",
    b"\rg f000\r",
    b"Ready..",
    b"\r\n - ",
    b"Success",
)


@dataclasses.dataclass
class Outcome:
    number: int
    kind: str  # of the line's conditions
    ends: list  # how each process ended
    faults: list  # broken promises
    errors: list  # m512's messages when it gave up
    seconds: float  # simulated
    loads: int  # flash pages written by downloads
    mails: int  # flash pages written through the mailbox


def contents(chance: random.Random, count: int) -> bytes:
    """Returns bytes for a page: random bytes, harmful text, or one repeated value."""
    style = chance.randrange(4)
    if style == 0:
        return chance.randbytes(count)
    if style == 1:
        return bytes([chance.randrange(256)]) * count
    out = b""
    while len(out) < count:
        out += chance.choice(NASTY) if chance.random() < (0.5 if style == 2 else 0.1) else chance.randbytes(chance.randrange(1, 60))
    return out[:count]


def plan(chance: random.Random, flash: bytes) -> Plan:
    """Returns motion pages or an application; some of it is already on the board."""
    pages = {}
    if chance.random() < 0.65:
        numbers = {chance.choice((127, 126, 117, 116, 115, 114, chance.randrange(1, MOTIONS))) for _ in range(chance.randrange(1, 4))}
        for number in numbers:
            first = (MOTION_START + 512 * number) // PAGE
            data = contents(chance, 512)
            pages.update({first: data[:PAGE], first + 1: data[PAGE:]})
    else:
        last = APP_END // PAGE
        count = chance.randrange(2, 9)
        start = 0 if chance.random() < 0.5 else last - count
        pages = {page: contents(chance, PAGE) for page in range(start, start + count)}
    for page in list(pages):
        if chance.random() < 0.25:
            pages[page] = flash[page * PAGE : (page + 1) * PAGE]
    return Plan(pages)


def phase(_title):
    return contextlib.nullcontext(unseen)


class Schedule:
    def __init__(self, number: int):
        self.number = number
        self.chance = chance = random.Random(number)
        self.conditions = conditions(chance)
        self.before = chance.randbytes(0x20000)
        if chance.random() < 0.7:  # as in the known version; other versions restart to print their banner
            self.before = self.before[:BANNER_AT] + BANNER + self.before[BANNER_AT + len(BANNER) :]
        eeprom = bytearray(chance.randbytes(0x1000))
        eeprom[0xFF4], eeprom[0xFFF] = 0xFF, chance.choice((0xFF, 0x11))
        self.loader = Loader(self.before, eeprom)
        self.wires = wires(self.conditions, number)
        self.board = Board(self.loader, *self.wires)
        self.named: set = set()
        self.errors: list = []
        self.plan = plan(chance, self.before)
        self.faults: list = []

    def play(self) -> Outcome:
        chance = self.chance
        self.board.advance_by(chance.choice((0.0, 1.0)))
        if chance.random() < 0.2:  # a user presses MODE at any time
            self.board.later(10 ** chance.uniform(-1, 1.7), self.board.reset)
        ends = []
        for _ in range(chance.choice((1, 2, 2, 3))):
            if ends and chance.random() < 0.2:  # a different command
                self.plan = plan(chance, self.before)
            ends.append(self.process())
            self.board.advance_by(chance.choice((0.0, 0.05, 0.3, 2.0)))
            if chance.random() < 0.3:
                self.wires[0].conditions = self.wires[1].conditions = Conditions()
        self.board.advance_by(SETTLE)
        self.judge(ends[-1])
        return Outcome(self.number, self.conditions.kind, ends, self.faults, self.errors, self.board.now, self.loads, self.mails)

    def names(self) -> set:
        """Returns the pages that a call names; for motions always both halves."""
        return {half for page in self.plan.pages for half in ((page, page ^ 1) if page * PAGE >= MOTION_START else (page,))}

    def process(self) -> str:
        """Runs one call of m512 flash. Returns how it ended."""
        chance = self.chance
        ends = (10 ** chance.uniform(-1, 1.5), chance.choice((KILLED, CANCELLED, BROKEN))) if chance.random() < 0.6 else None
        line = Line(self.board, *self.wires, ends, seed=chance.randrange(1 << 30))
        self.wires[0].broken = self.wires[1].broken = False
        self.wires[1].waiting.clear()  # opening a port discards earlier input
        self.named |= self.names()
        try:
            loader = loaders.enter(line, self.told, WAIT)
            download.download(loader, self.plan, phase)
            loader.leave(chance.choice((0, 1)))
            return DONE
        except Killed:
            return KILLED
        except KeyboardInterrupt:
            return CANCELLED
        except M512Error as error:
            self.errors.append(str(error))
            if "press MODE before anything else" in str(error):
                self.board.reset()
            return CANCELLED if line.ended == CANCELLED else BROKEN if line.ended == BROKEN else GAVE_UP
        except Exception as error:  # whatever arrives over the line, m512 must report an error of its own
            self.faults.append(f"m512 crashed: {error!r}")
            return GAVE_UP

    def told(self, text: str):
        if re.search("MODE", text):
            self.board.later(self.chance.uniform(0.2, 3.0), self.board.reset)

    def judge(self, last: str):
        flash = bytes(self.loader.flash)
        for page in range(len(flash) // PAGE):
            at = page * PAGE
            if page not in self.named and flash[at : at + PAGE] != self.before[at : at + PAGE]:
                self.faults.append(f"0x{at:05X} has changed" + (": THE LOADER" if at >= BOOT else ""))
        touched = {page for _, page, _ in self.loader.written} - self.named
        if touched and not self.faults:
            self.faults.append("written, and right again: " + " ".join(f"0x{page * PAGE:05X}" for page in sorted(touched)))
        self.faults += [f"crashed: {why}" for _, why in self.loader.crashes]
        if last == DONE and any(flash[page * PAGE : (page + 1) * PAGE] != data for page, data in self.plan.pages.items()):
            self.faults.append("m512 says that all is there, and it is not")
        how = [how for _, _, how in self.loader.written]
        self.loads, self.mails = how.count("load"), how.count("mailbox")


def play(number: int) -> Outcome:
    """Plays the schedule with this number."""
    return Schedule(number).play()
