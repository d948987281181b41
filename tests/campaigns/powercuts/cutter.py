# SPDX-License-Identifier: MIT
"""Cuts the power of a simulated board at every operation of a scene, without running the scene again for each.

    scene.act()       the scene to cut: it runs to its end in this process
       | an operation is about to begin
       +--> a copy of the process (fork) for each phase: cut there --> restart --> verdict
                                                                          | operations of the restart itself
                                                                          +--> copies of the copy: nested cuts

A state is named scene:operation:phase; nested cuts follow a slash. save:7:half/2:after is a SAVE cut in the middle of its 7th operation,
whose repair at the next start was cut directly after its 2nd operation.
"""

import json
import os
import random
import zlib
from typing import NamedTuple

from cm5sim import PowerCut

# How much of an operation is done at the cut. Flash: one, few, half, most, or all but one of the bits have changed, or the first or last
# bytes of the page. EEPROM byte: between old, erased and new.
TORN = ("one", "few", "half", "most", "rest", "head", "tail")
PHASES = ("before", *TORN, "after")
ORIGINAL, COPY, DONE, EMPTY = range(4)


class Cut(NamedTuple):
    operation: int
    phase: str

    def __str__(self):
        return f"{self.operation}:{self.phase}"


def path_text(scene, path):
    return f"{scene}:" + "/".join(map(str, path)) if path else scene


def path_of(text):
    """Returns (scene, [Cut]) from the name of a state."""
    scene, _, rest = text.partition(":")
    cuts = [part.split(":") for part in rest.split("/")] if rest else []
    if any(len(cut) != 2 or not cut[0].isdigit() or cut[1] not in PHASES for cut in cuts):
        raise ValueError(f"{text} is no state: scene:operation:phase[/operation:phase], phases are {', '.join(PHASES)}")
    return scene, [Cut(int(operation), phase) for operation, phase in cuts]


def torn_flash(old, new, phase, chance):
    """Returns a flash page between two contents: some of the bits that differ have changed."""
    changing = [(at, 1 << bit) for at in range(len(old)) for bit in range(8) if (old[at] ^ new[at]) >> bit & 1]
    if phase in ("head", "tail"):
        edge = chance.randrange(1, len(old))
        return new[:edge] + old[edge:] if phase == "head" else old[:edge] + new[edge:]
    count = {"one": 1, "few": len(changing) // 8, "half": len(changing) // 2, "most": len(changing) * 7 // 8, "rest": len(changing) - 1}[phase]
    page = bytearray(old)
    for at, bit in chance.sample(changing, max(0, min(count, len(changing)))):
        page[at] ^= bit
    return bytes(page)


def torn_byte(old, new, phase, chance):
    """Returns an EEPROM byte that was being erased, then programmed."""
    bits = chance.randrange(256)
    one = 1 << chance.randrange(8)
    return {"one": old | one, "few": old | bits, "half": 0xFF, "most": new | bits, "rest": new | one, "head": old & bits, "tail": bits}[phase]


class Cutter:
    """Plays one scene. `wanted(path, operation)` gives the phases to cut at. `only` is a single path instead."""

    def __init__(self, scene, wanted, only=None, seed=1):
        self.scene, self.board, self.wanted, self.only, self.seed = scene, scene.board, wanted, only, seed
        self.path, self.results, self.pipe = (), [], None
        self.operations = 0

    def play(self):
        """Returns [(state, outcome or None, fault or None)] of all states. The uncut scene is one of them."""
        self._go(self.scene.act)
        return self.results

    # Every process that returns from _watched ends by itself: copies report and exit.

    def _go(self, act):
        try:
            if self._uncut(act):
                if self.only is not None and len(self.path) < len(self.only):
                    raise LookupError("there is no such operation")
                if not self.path:
                    self.board.power_off()
                    self.scene.restart()
                self._add(self.scene.verdict(cut=bool(self.path)), None)
        except Exception as error:  # the error belongs to this state and is reported with its name
            self._add(None, f"{type(error).__name__}: {error}")
        finally:
            if self.pipe is not None:
                os.write(self.pipe, json.dumps(self.results).encode())
                os.close(self.pipe)
                os._exit(0)

    def _uncut(self, act):
        """Runs with cuts. Returns false in a copy that ended without reaching its cut, or whose cut needs no verdict."""
        depth = len(self.path)
        try:
            self._watched(act)
        except PowerCut:
            pass
        if len(self.path) == depth:
            if depth == 0:
                self.operations = self.board.operations - self.first
            return True
        if self.board.powered:  # the operation did not come
            return False
        if not self._tear():
            self._add("same", None)
            return False
        return self._uncut(self.scene.restart)

    def _add(self, outcome, fault):
        self.results.append((path_text(self.scene.name, self.path), outcome, fault))

    def _watched(self, act):
        board, path = self.board, self.path
        self.first = first = board.operations

        def about_to_begin():
            operation = board.operations - first + 1
            for phase in self._phases(path, operation):
                copy = ORIGINAL if self.only is not None else self._fork()
                if copy == EMPTY:
                    return
                if copy != DONE:
                    board.on_operation(None)
                    self.path = (*path, Cut(operation, phase))
                    self.old = bytes(board.flash), bytes(board.eeprom)
                    board.cut_power(1, "before" if phase == "before" else "after")
                    return

        board.on_operation(about_to_begin)
        about_to_begin()
        try:
            act()
        finally:
            board.on_operation(None)

    def _phases(self, path, operation):
        if self.only is None:
            return self.wanted(path, operation)
        cuts = self.only[len(path) :]
        return [cuts[0].phase] if cuts and cuts[0].operation == operation else []

    def _fork(self):
        """Forks. Returns COPY in the copy. The original waits for its results and returns DONE, or EMPTY if the copy did not reach its
        operation."""
        out, into = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(out)
            if self.pipe is not None:
                os.close(self.pipe)
            self.pipe, self.results = into, []
            return COPY
        os.close(into)
        with os.fdopen(out, "rb") as stream:
            data = stream.read()
        _, status = os.waitpid(child, 0)
        if status != 0 or not data:
            self._add(None, f"a copy of the process died (status {status})")
            return DONE
        results = list(map(tuple, json.loads(data)))
        self.results += results
        return DONE if results else EMPTY

    def _tear(self):
        """Sets the contents for the phase. Returns false if they equal those before or after the operation."""
        board, phase = self.board, self.path[-1].phase
        if phase not in TORN:
            return True
        kind, address = board.operation(board.operations)
        chance = random.Random(zlib.crc32(f"{self.seed} {path_text(self.scene.name, self.path)}".encode()))
        if kind == "eeprom":
            old, new = self.old[1][address], board.eeprom[address]
            torn = torn_byte(old, new, phase, chance)
            board.eeprom[address] = torn
        else:
            old, new = self.old[0][address : address + 256], bytes(board.flash[address : address + 256])
            torn = torn_flash(old, new, phase, chance)
            board.flash[address : address + 256] = torn
        return torn not in (old, new)
