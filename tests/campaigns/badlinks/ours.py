# SPDX-License-Identifier: MIT
"""The same schedules for our own loader: the shipped image on the simulated board, on the same lines.

`ShippedBoard` has the interface that a Line needs from factory_model.Board: `now`, advance(until), later() and reset(). The simulated chip
is strict: a violation ends the schedule as a fault.
"""

from __future__ import annotations

import random

from cm5sim import Board, Violation
from m512.board.memory import Plan

from .factory_model import BOOT, PAGE
from .runs import APP_END, DONE, MOTION_START, MOTIONS, Outcome, Schedule, contents
from .wire import conditions, wires

HZ = 16_000_000
SLICE = 0.002  # seconds between two looks at the board's output
SETTLE, WAIT = 6.0, 8.0  # a session ends after 4 s of silence
APPLICATION = b"\xff\xcf" + bytes(0x8E)  # `rjmp .` and no record where our images have one: starts, and does nothing
EEPROM_BYTES, BOOT_MODE = 0x1000, 0xFFF


class ShippedBoard:
    """The board with boot-cm5.hex. `violation` is the chip's objection; after that the board does nothing more."""

    def __init__(self, flash: bytes, eeprom: bytes, to_board, to_pc):
        self.sim = Board(images=["boot-cm5.hex"])
        self.sim.skip_waits()
        self.sim.flash[0:BOOT] = flash[:BOOT]
        self.sim.eeprom[0:EEPROM_BYTES] = eeprom
        self.sim.allow("uart-overrun")  # from an application that does not read
        self.sim.power_on()
        self.to_board, self.to_pc, self.errands, self.violation = to_board, to_pc, [], ""
        self.ahead = 0.0  # time passed since a violation

    @property
    def now(self):
        return self.sim.now_cycles / HZ + self.ahead

    def reset(self):
        """Presses MODE."""
        if not self.violation:
            self.sim.press("MODE")
            self._run(0.001)
            self.sim.release("MODE")

    def later(self, seconds, what):
        self.errands.append((self.now + seconds, what))
        self.errands.sort(key=lambda errand: errand[0])

    def advance_by(self, seconds):
        until = self.now + seconds
        while self.now < until:
            self.advance(until, stops=False)

    def _run(self, seconds):
        cycles = max(1, round(seconds * HZ))
        try:
            if not self.violation:
                self.sim.run(cycles=cycles)
        except Violation as violation:
            self.violation = str(violation)
        if self.violation:
            self.ahead += cycles / HZ
            return
        said = self.sim.take()
        if said:
            self.to_pc.send(self.now, said)

    def advance(self, until, stops=True):
        """Runs until that time; with `stops`, only until something arrives at the PC's end."""
        while self.now < until:
            if stops and self.to_pc.next_arrival() <= self.now:
                return
            for byte in self.to_board.arrived(self.now):
                self.sim.send(bytes([byte]))
            if self.errands and self.errands[0][0] <= self.now:
                self.errands.pop(0)[1]()
                continue
            soon = [until, self.now + SLICE, self.to_board.next_arrival(), self.to_pc.next_arrival() if stops else until]
            soon += [self.errands[0][0]] if self.errands else []
            self._run(max(min(soon) - self.now, 1 / HZ))


def plan(chance: random.Random, flash: bytes) -> Plan:
    """Returns motion pages, or pages of an application that include either page 1 or the last one; some of it is already on the board."""
    pages = {}
    if chance.random() < 0.6:
        for number in {chance.choice((127, 126, chance.randrange(1, MOTIONS))) for _ in range(chance.randrange(1, 3))}:
            first = (MOTION_START + 512 * number) // PAGE
            data = contents(chance, 512)
            pages.update({first: data[:PAGE], first + 1: data[PAGE:]})
    else:
        count = chance.randrange(1, 6)
        start = chance.choice((1, APP_END // PAGE - count))
        pages = {page: contents(chance, PAGE) for page in range(start, start + count)}
    for page in list(pages):
        if chance.random() < 0.25:
            pages[page] = flash[page * PAGE : (page + 1) * PAGE]
    return Plan(pages)


class OurSchedule(Schedule):
    """Names exactly the pages of its plans: this loader writes nothing around them and nothing to EEPROM."""

    def __init__(self, number: int):
        self.number = number
        self.chance = chance = random.Random(f"ours {number}")
        self.conditions = conditions(chance)
        self.before = APPLICATION + chance.randbytes(BOOT - len(APPLICATION))
        self.eeprom = chance.randbytes(EEPROM_BYTES - 13) + b"\xff" * 12 + chance.choice((b"\xff", b"\x11"))
        self.wires = wires(self.conditions, number)
        self.board = ShippedBoard(self.before, self.eeprom, *self.wires)
        self.section = bytes(self.board.sim.flash[BOOT:])
        self.named, self.errors, self.faults = set(), [], []
        self.plan = self.new_plan()

    def new_plan(self):
        return plan(self.chance, self.before)

    def names(self):
        return set(self.plan.pages)

    settle_seconds, wait_seconds = SETTLE, WAIT

    def judge(self, last: str):
        flash, eeprom = bytes(self.board.sim.flash), bytes(self.board.sim.eeprom)
        before = self.before + self.section
        for at in range(0, len(flash), PAGE):
            if at // PAGE not in self.named and flash[at : at + PAGE] != before[at : at + PAGE]:
                self.faults.append(f"0x{at:05X} has changed" + (": THE LOADER" if at >= BOOT else ""))
        odd = [at for at in range(EEPROM_BYTES) if eeprom[at] != self.eeprom[at]]
        if odd:
            self.faults.append(f"EEPROM 0x{odd[0]:03X} has changed ({len(odd)} bytes)")
        if self.board.violation:
            self.faults.append(self.board.violation)
        if last == DONE and any(flash[page * PAGE : (page + 1) * PAGE] != data for page, data in self.plan.pages.items()):
            self.faults.append("m512 says that all is there, and it is not")
        written = sum(self.board.sim.wear(page) for page in range(BOOT // PAGE))
        self.loads, self.mails = written, 0


def play(number: int) -> Outcome:
    """Plays the schedule with this number."""
    return OurSchedule(number).play()
