# SPDX-License-Identifier: MIT
"""Scenes in which Edit saves motion pages: through our loader, the factory kind of routine, and a loader's mailbox."""

import struct

from cm5sim.board import find_image
from m512.board import memory
from m512.board.client import Client
from tests.sim.boot_board import APP_END, BOOT_MODE, BOOT_START, JOURNAL_START, MAP, crc16, factory_section
from tests.sim.edit_robot import seal

from . import robot
from .robot import ERASED, MOTIONS, PAGE_BYTES, SLOTS, Memories

OPENED = 5
MAIL_STATE, MAIL_PAGE = MAP["MEM_EE_MAILBOX_STATE"], MAP["MEM_EE_MAILBOX_PAGE"]
MAILBOX = set(range(MAP["MEM_EE_MAILBOX"], MAP["MEM_EE_MAILBOX_END"])) | {MAIL_STATE, MAIL_PAGE, BOOT_MODE}


class Save:
    """Edit with our loader; SAVE of a page of which both halves have changed."""

    name = "save"
    promise = "SAVE in Edit leaves the old page or the new one"
    rates = (1, 24, 200)  # one in so many of the cuts at this depth is made
    chunks = 1
    about = 11  # approximate number of operations: the cuts of a sample are spread over it
    kind = "cm5"
    servos = ()

    def __init__(self, seed):
        self.board = self.make(seed)
        self.prepare()
        robot.application_answers(self.board, "edit")
        robot.quiet(self.board)
        self.client = Client(robot.SimLink(self.board), (2.0,))
        self.memories = Memories(self.board)

    def make(self, seed):
        return robot.new_board(f"boot-{self.kind}.hex", f"edit-{self.kind}.hex", seed=seed, kind=self.kind, servos=self.servos)

    def prepare(self):
        """Changes the memories before the first start."""

    # Edit's keyboard

    def type(self, *lines):
        for line in lines:
            self.board.send(line + "\r")
            robot.quiet(self.board)

    def save(self, number, new, line="save", sure=False):
        """Types the line. Answers yes if `sure`."""
        self.memories.saving(number, new)
        self.board.send(line + "\r")
        if sure:
            self.board.expect("[y/N]", ms=1000)
            self.board.run(ms=300)  # input before the question is no answer
            self.board.send("y")
        self.board.expect("OK", ms=1000)
        self.memories.saved(number)
        robot.quiet(self.board)

    def edited(self, number):
        """Opens a page and changes a cell in each half. Returns the resulting page."""
        data = bytearray(self.memories.page(number))
        self.type(f"page {number}", "goto 1 3", "set 700", "goto 7 31", "set 9")
        data[64 + 6 : 64 + 8] = struct.pack("<H", 700)
        data[64 + 64 * 6 + 62] = 9
        return seal(data)

    # The scene

    def act(self):
        new = self.edited(OPENED)
        self.save(OPENED, new)

    def restart(self):
        """Half of the states enter the loader first."""
        robot.power_on(self.board)
        if crc16(self.board.flash[JOURNAL_START : MOTIONS + 0x2000]) % 2:
            robot.to_loader(self.board)
            self.board.send("go\r")
        robot.application_answers(self.board, "edit")

    def verdict(self, cut):
        outcome = self.memories.outcome()
        assert cut or outcome == "new", f"nothing was cut, and the pages are {outcome}"
        self.save_again()
        self.loader_answers()
        return outcome

    def save_again(self):
        """The next save must work as usual."""
        new = robot.made(OPENED, 77)
        self.memories.saving(OPENED, new)
        self.client.save_page(OPENED, new)
        self.memories.saved(OPENED)
        self.memories.check()

    def loader_answers(self):
        robot.loader_answers(self.board)


class SaveCm2(Save):
    """The CM-2's images."""

    name, kind = "save-cm2", "cm2"
    promise = "The same on the CM-2"


class Saves(Save):
    """m512 saves one page after the other, more than the journal has slots: `@save`."""

    name = "saves"
    promise = f"Saves in a row, more than the journal has slots ({SLOTS}): old or new, and what was told saved stays"
    about, chunks = 11 * (SLOTS + 2), 4
    rates = (2, 24, 200)

    def act(self):
        for turn in range(SLOTS + 2):
            number = (OPENED, 6, ERASED, OPENED, 127, 1)[turn % 6]
            new = robot.made(number, turn)
            self.memories.saving(number, new)
            self.client.save_page(number, new)
            self.memories.saved(number)


class Repair(Save):
    """A save, and the repairs after it: cut, and cut again, three deep."""

    name, about, chunks = "repair", 11, 6
    promise = "The journal's repair at the start may itself be cut, and the repair after it: old or new"
    rates = (1, 3, 80)

    def act(self):
        new = robot.made(OPENED, 1)
        self.memories.saving(OPENED, new)
        self.client.save_page(OPENED, new)
        self.memories.saved(OPENED)

    def restart(self):
        robot.power_on(self.board)
        robot.application_answers(self.board, "edit")


class SaveFactory(Save):
    """Edit on a loader with the factory's page-write routine, which knows no journal: Edit repairs at its start."""

    name, about = "save-factory", 12
    promise = "SAVE through the factory kind of routine: old or new"

    def make(self, seed):
        board = robot.new_board("edit-cm5.hex", seed=seed, bootrst=True)
        board.flash[BOOT_START : BOOT_START + 0x2000] = factory_section()
        return board

    def restart(self):
        robot.power_on(self.board)
        robot.application_answers(self.board, "edit")

    def loader_answers(self):
        """The imitation of the factory loader has no prompt."""


class RepairFactory(SaveFactory):
    """The same with the repair cut, three deep."""

    name, chunks = "repair-factory", 4
    promise = "Edit's own repair at its start may be cut as well, three deep"
    rates = (2, 4, 80)


class SavePlay(SaveFactory):
    """The same, and Play comes into the flash before Edit starts again: it says that a save waits, and writes nothing."""

    name = "save-play"
    promise = "Play on a loader without a journal says when a save was cut off; Edit completes it"

    def restart(self):
        board = self.board
        for number, data in memory.plan(find_image("play-cm5.hex")).pages.items():
            board.flash[256 * number : 256 * (number + 1)] = data
        waits, before = robot.pending(bytes(board.flash)), bytes(board.flash)
        robot.power_on(board)
        said = "A save was cut off" in board.expect("] ", ms=2500)
        assert said == waits and bytes(board.flash) == before
        board.power_off()
        board.flash[:APP_END] = self.memories.flash[:APP_END]
        super().restart()


class Mailbox(Save):
    """SAVE on an unknown loader: Edit leaves the page in EEPROM and restarts; the loader (ours without its call table)
    writes it."""

    name, about, chunks = "mailbox", 250, 6
    promise = "SAVE by the EEPROM mailbox, and the loader that takes it: old or new"
    rates = (5, 24, 200)

    def prepare(self):
        """Erases the call table. Leaves an older version of the same page in the mailbox."""
        self.board.flash[MAP["MEM_BOOT_API"] : MAP["MEM_BOOT_END"]] = b"\xff" * 32
        self.board.eeprom[MAP["MEM_EE_MAILBOX"] : MAP["MEM_EE_MAILBOX"] + PAGE_BYTES] = robot.made(OPENED, 3)
        self.board.eeprom[MAIL_PAGE] = OPENED

    def act(self):
        new = self.edited(OPENED)
        self.memories.free_eeprom |= MAILBOX
        self.memories.saving(OPENED, new)
        self.board.send("save\r")
        self.board.expect("[y/N]", ms=1000)
        self.board.run(ms=300)
        self.board.send("y")
        self.board.expect(b"\xff", ms=8000)
        robot.application_answers(self.board, "edit")
        self.memories.saved(OPENED)

    def verdict(self, cut):
        outcome = self.memories.outcome()
        assert self.board.eeprom[BOOT_MODE] == robot.APPLICATION
        assert self.board.eeprom[MAIL_STATE] != 0xAA, "the mailbox is still waiting"
        assert cut or outcome == "new"
        self.loader_answers()
        return outcome


SCENES = (Save, SaveCm2, Saves, Repair, SaveFactory, RepairFactory, SavePlay, Mailbox)
