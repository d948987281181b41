# SPDX-License-Identifier: MIT
"""Long runs: one board with random cuts in many saves and repairs, and one without cuts to measure wear."""

import random

from cm5sim import PowerCut
from tests.sim.boot_board import JOURNAL_START

from . import robot, saves, settings
from .robot import SLOT_BYTES, SLOTS

SLOT_PAGES = SLOT_BYTES // 256
ENDURANCE = 10_000  # erases per flash page of the ATmega128
PAGES = (0, 5, 6, 40, robot.ERASED, 127)


class Life(saves.Save):
    """m512 saves page after page; most saves are cut anywhere, and so are many repairs."""

    promise = "A robot that is cut again and again, in saves and in repairs: each page old or new, every time"
    steps = 60

    def play(self, seed, number, until=None):
        """Returns [(name, outcome, fault)] of its cuts, up to and including step `until`."""
        chance, results = random.Random(f"{seed} {self.name} {number}"), []
        for step in range(self.steps if until is None else until + 1):
            name = f"{self.name}-{number}:{step}"
            try:
                results += [(name, outcome, None) for outcome in self.step(step, chance)]
            except Exception as error:  # the rest of this life would only repeat it
                return [*results, (name, None, f"{type(error).__name__}: {error}")]
        return results

    def step(self, step, chance):
        """Makes one change that may be cut. Returns its outcome once for each cut."""
        cuts = 0
        try:
            with self.armed(chance, 0.8, self.operations):
                self.change(step, chance)
        except PowerCut:
            cuts = 1
            while not self.starts(chance):
                cuts += 1
        return [self.look()] * cuts

    operations = 12

    def armed(self, chance, likely, operations):
        board = self.board

        class Armed:
            def __enter__(self):
                if chance.random() < likely:
                    board.cut_power(chance.randint(1, operations), chance.choice(("before", "during", "during", "after")), chance.randrange(4096))

            def __exit__(self, *_):
                board.cut_power(0)

        return Armed()

    def starts(self, chance):
        """Switches the power on. Returns false if it was cut again."""
        try:
            with self.armed(chance, 0.4, 5):
                self.restart()
            return True
        except PowerCut:
            return False

    def change(self, step, chance):
        number = chance.choice(PAGES)
        self.memories.saving(number, robot.made(number, 100 + step))
        self.client.save_page(number, self.memories.pages[number][-1])
        self.memories.saved(number)

    def look(self):
        found = self.memories.check()
        outcome = "new"
        for number, contents in self.memories.pages.items():
            if len(contents) > 1:
                outcome = "new" if found[number] else "old"
                self.memories.pages[number] = [contents[found[number]]]
        return outcome

    name = "life"


class SettingsLife(Life, settings.Settings):
    """Play's settings, cut again and again."""

    promise = "Settings cut again and again: those before or those after"
    name, operations = "settings-life", 10

    def __init__(self, seed):
        settings.Settings.__init__(self, seed)

    restart = settings.Settings.restart

    def change(self, step, chance):
        self.set(chance.choice(settings.FIELDS[2:6:3]), chance.randrange(60, 100))

    def look(self):
        self.memories.check()
        body, damaged = settings.kept(bytes(self.board.eeprom))
        assert body in self.allowed, "the settings are neither old nor new"
        outcome = "defaults" if damaged else "new" if body == self.allowed[-1] else "old"
        self.allowed = [body]
        return outcome


class Wear(Life):
    """Saves one page again and again, never cut."""

    name = "wear"
    saves = 250

    def spread(self):
        """Returns (fewest, most) erases of the journal's flash pages, and the erases of the saved page."""
        for turn in range(self.saves):
            new = robot.made(saves.OPENED, turn)
            self.client.save_page(saves.OPENED, new)
        journal = [self.board.wear(JOURNAL_START // 256 + page) for page in range(SLOTS * SLOT_PAGES)]
        target = [self.board.wear((robot.MOTIONS + robot.PAGE_BYTES * saves.OPENED) // 256 + half) for half in range(2)]
        return min(journal), max(journal), max(target)


LIVES = (Life, SettingsLife)
