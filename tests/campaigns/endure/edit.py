# SPDX-License-Identifier: MIT
"""An editor in permanent use: cells, undo, plays and many saves. The expected contents of the flash are always known.

There is no terminal emulator. Edit's output is read and discarded, as by a fast terminal.
"""

import random

from cm5sim import Board
from m512.files.image import Image
from tests.sim.made_page import JOINTS, page

from .walk import Bus

FIRST, LAST = 1, 24
STEPS = 4
MOTION_START, PAGE_BYTES = 0xE000, 512


class Editor:
    """The robot and the person who edits its pages."""

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.pages = Image.empty()
        for number in range(FIRST, LAST + 1):
            self.pages[number] = page(f"page {number}", [(32, {joint: 480 + number for joint in JOINTS})] * STEPS)
        self.board = Board(images=["boot-cm5.hex", "edit-cm5.hex"], motions=self.pages.to_bytes(), servos=JOINTS, seed=seed)
        self.board.eeprom[0xFFF] = 0x11  # the loader starts the application
        self.board.run(ms=2500)
        self.board.run_to("__vector_12")
        self.bus = Bus(self.board.now_cycles)
        self.board.clear_trace()
        self.resets = self.board.resets
        self.open = None
        self.done = dict.fromkeys(("saves", "edits", "undone", "plays", "breaks", "program saves"), 0)
        self.complaints = []

    # ---- the line ----

    def settle(self, ms=30, most_ms=3000):
        """Runs until Edit has been quiet for `ms`."""
        quiet = 0
        while quiet < ms and most_ms > 0:
            self.board.run(ms=10)
            quiet = 0 if self.board.take() or self.board.waiting else quiet + 10
            most_ms -= 10
        self.bus.take(self.board.packets)
        self.board.clear_trace()

    def line(self, text, ms=30):
        self.board.send(text + "\r")
        self.settle(ms)

    def program(self, text):
        """Sends a line of a program. Returns its answer."""
        self.board.take()
        self.board.send(text + "\r")
        self.board.expect(text.split()[0], ms=2000)
        answer = self.board.expect("\r\n", ms=2000)
        if not answer.rstrip().endswith("OK"):
            self.complaints.append(f"{text[:30]}: {answer.strip()}")
        return answer

    # ---- what is done ----

    def open_page(self):
        self.open = self.chance.randrange(FIRST, LAST + 1)
        self.line(f"page {self.open}")

    def edit(self):
        """Edits some cells and undoes some of these edits."""
        for _ in range(self.chance.randrange(1, 4)):
            step, joint = self.chance.randrange(STEPS), self.chance.choice(list(JOINTS))
            old, new = self.pages[self.open].word(step, joint), self.chance.randrange(300, 700)
            self.line(f"goto {step + 1} {joint}")
            self.line(f"set {new}")
            self.done["edits"] += 1
            if self.chance.random() < 0.2 and old != new:
                self.line("undo")
                self.done["undone"] += 1
            else:
                self.pages[self.open].set_word(step, joint, new)

    def save(self):
        self.pages[self.open].seal()
        self.line("save", 80)
        self.done["saves"] += 1
        self.check(self.open)

    def save_by_program(self):
        """Lets a PC program change a page and save it."""
        number = self.chance.randrange(FIRST, LAST + 1)
        step, joint, pos = self.chance.randrange(STEPS), self.chance.choice(list(JOINTS)), self.chance.randrange(300, 700)
        self.pages[number].set_word(step, joint, pos)
        self.pages[number].seal()
        data = bytes(self.pages[number])
        self.program(f"@open {number}")
        for at in range(0, PAGE_BYTES, 32):
            self.program(f"@data {at} {data[at : at + 32].hex()}")
        crc = self.program("@crc").split()[0]
        self.program(f"@save {number} {crc}")
        self.done["program saves"] += 1
        self.open = number
        self.check(number)
        self.line("re")

    def play(self):
        self.board.send(f"play {self.open}\r")  # the screen is never quiet during a play
        self.board.run(ms=self.chance.randrange(200, 2500))
        if self.chance.random() < 0.5:
            self.board.send("\x03")  # not a space: it would change a cell if the play has just ended
            self.board.run(ms=1500)  # until the robot stands; earlier input is not taken as a line
            self.settle()
            self.done["breaks"] += 1
        else:
            self.board.run(ms=3500)
            self.settle()
        self.done["plays"] += 1

    def check(self, number):
        at = MOTION_START + PAGE_BYTES * number
        if bytes(self.board.flash[at : at + PAGE_BYTES]) != bytes(self.pages[number]):
            self.complaints.append(f"page {number} is not as it was saved, save {self.saves}")

    @property
    def saves(self):
        return self.done["saves"] + self.done["program saves"]

    def episode(self):
        """Edits one page, from opening to saving."""
        self.open_page()
        self.edit()
        what = self.chance.random()
        if what < 0.04:
            self.play()
        self.save()
        if what > 0.93:
            self.save_by_program()

    def check_all(self):
        for number in range(FIRST, LAST + 1):
            self.check(number)
