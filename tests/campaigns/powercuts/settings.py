# SPDX-License-Identifier: MIT
"""Scenes in which Play and Edit keep settings in EEPROM."""

import re

from m512.board.client import DATA_BYTES, Client
from tests.campaigns import bus_watch
from tests.sim.boot_board import MAP, crc16
from tests.sim.made_page import page

from . import robot
from .robot import Memories

AREA = range(MAP["MEM_EE_SETTINGS"], MAP["MEM_EE_SETTINGS_END"])
COPY_BYTES = 64
COPIES = len(AREA) // COPY_BYTES
FIELDS = ("law", "remote", "approach", "fault", "low", "hot", "neutral", "flow", "fast", "talk")
JOINTS = 31
LAST = ("centre", "drive")  # after the joints' partners
BODY_BYTES = len(FIELDS) + JOINTS + len(LAST)
PLACES = {field: at for at, field in enumerate(FIELDS)} | {field: len(FIELDS) + JOINTS + at for at, field in enumerate(LAST)}


def defaults():
    """Returns the defaults of settings.h (there in brackets)."""
    partners = [joint + 1 if joint % 2 else joint - 1 for joint in range(1, 19)]
    return bytes([0, 0, 60, 0, 90, 70, 0, 1, 0, 1, 0xFF, *partners, *[0xFF] * 12, 1, 10])


def record(body, sequence):
    data = bytes([ord("S"), 1, sequence, BODY_BYTES]) + body
    return data + crc16(data).to_bytes(2, "little")


def kept(eeprom):
    """Returns (body, damaged): the settings that a start must find. They are the newest good copy, otherwise the defaults."""
    good, dirty = None, False
    for copy in range(COPIES):
        data = eeprom[AREA.start + COPY_BYTES * copy :][: BODY_BYTES + 6]
        if data[0] == ord("S") and data[1] == 1 and data[3] == BODY_BYTES and data == record(data[4:-2], data[2]):
            if good is None or 0 < (data[2] - good[1] & 0xFF) < 0x80:
                good = data[4:-2], data[2]
        elif data[0] != 0xFF:
            dirty = True
    return (good[0], False) if good else (defaults(), dirty)


def paired(body, one, other):
    """Returns the settings with two joints made partners (one with itself: none). Their former partners lose theirs."""
    pair = bytearray(body[len(FIELDS) : -len(LAST)])
    for joint in (one, other):
        if pair[joint] < JOINTS:
            pair[pair[joint]] = 0xFF
        pair[joint] = 0xFF
    if one != other:
        pair[one], pair[other] = other, one
    return body[: len(FIELDS)] + bytes(pair) + body[-len(LAST) :]


class Settings:
    """Play: five settings one after the other, from an EEPROM that never held any."""

    name, about, chunks, rates = "settings", 90, 4, (3, 1, 1)
    promise = "Settings set in Play are the old or the new ones (before the first save: the defaults)"
    app = "play"
    copies = (b"", b"")
    changes = (("approach", 90), ("law", 1), ("low", 75), ("hot", 66), ("talk", 0))
    waits = True
    servos = ()

    def __init__(self, seed):
        self.board = robot.new_board("boot-cm5.hex", f"{self.app}-cm5.hex", seed=seed, servos=self.servos)
        for copy, data in enumerate(self.copies):
            at = AREA.start + COPY_BYTES * copy
            self.board.eeprom[at : at + len(data)] = data
        robot.application_answers(self.board, self.app)
        self.memories = Memories(self.board)
        self.memories.free_eeprom |= set(AREA)
        self.allowed = [kept(bytes(self.board.eeprom))[0]]

    def saved(self):
        """Waits until nothing is written any more. The main loop begins to write at most one byte per turn. After that only the last
        settings are permitted."""
        operations = -1
        while operations != self.board.operations:
            operations = self.board.operations
            self.board.run(ms=500)
        self.allowed = self.allowed[-1:]

    def act(self):
        for field, value in self.changes:
            self.set(field, value)

    def set(self, field, value):
        body = bytearray(self.allowed[-1])
        body[PLACES[field]] = value
        self.allowed.append(bytes(body))
        self.board.take()
        self.board.send(f"settings {field} {value}\r")
        self.board.expect(" OK")
        if self.waits or (field, value) == self.changes[-1]:
            self.saved()

    def restart(self):
        robot.power_on(self.board)
        robot.application_answers(self.board, self.app)

    def verdict(self, cut):
        start = self.board.console.rfind(b"Motion512")
        greeting = self.board.console[start:]
        self.memories.check()
        body, damaged = kept(bytes(self.board.eeprom))
        assert body in self.allowed, "the settings are neither old nor new"
        assert cut or body == self.allowed[-1]
        self.shown(body, damaged, greeting)
        robot.loader_answers(self.board)
        return "defaults" if damaged else "new" if body == self.allowed[-1] else "old"

    def shown(self, body, damaged, greeting):
        """The application must see the same settings, and report damage if it took the defaults."""
        assert (b"settings were damaged" in greeting) == damaged, f"damaged {damaged}, but: {greeting!r}"
        self.board.take()
        self.board.send("settings\r")
        text = self.board.expect(" OK", ms=2000)
        values = {field: int(re.search(rf"\b{field} (\d+) ", text)[1]) for field in PLACES}
        assert values == {field: body[at] for field, at in PLACES.items()}, f"kept {body.hex()}, shown {values}"


class PairsAndSave(Settings):
    """Edit: PAIRS, and SAVE of a page while the settings are still being written byte by byte."""

    name, about, app, chunks, rates = "pairs-save", 44, "edit", 2, (2, 24, 200)
    copies = (record(defaults(), 1), b"")
    promise = "Partners and a page saved while settings are being written: both old or new"

    def act(self):
        new = robot.made(5, 1)
        client = Client(robot.SimLink(self.board), (2.0,))
        client.ask("open 5")
        for at in range(0, len(new), DATA_BYTES):
            client.ask(f"data {at} {new[at : at + DATA_BYTES].hex()}")
        self.allowed.append(paired(self.allowed[-1], 1, 3))
        self.memories.saving(5, new)
        self.board.send(f"pairs 1 3\r@save 5 0x{crc16(new):04X}\r")
        self.board.expect("@save OK", ms=3000)
        self.memories.saved(5)
        self.saved()

    def shown(self, body, damaged, greeting):
        """Edit does not report damage. It must show the stored pairs."""
        pair = body[len(FIELDS) :]
        self.board.send("pairs\r", wait=True)
        text = robot.quiet(self.board).decode("latin-1")
        shown = {(int(a), int(b)) for a, b in re.findall(r"\b(\d+)-(\d+) ", text)}
        wanted = {(joint, pair[joint]) for joint in range(JOINTS) if joint < pair[joint] < JOINTS}
        assert shown == wanted, f"kept {sorted(wanted)}, shown {sorted(shown)}"


class SettingsDriven(Settings):
    """Play: a walk is driven at 20 Hz and a second page lies over it, while settings are saved."""

    name, about, chunks, rates = "settings-driven", 46, 2, (4, 1, 1)
    promise = "Settings saved while a walk is driven and a layer plays: the old or the new ones; behind the cut nothing of it goes on by itself"
    changes = (("approach", 90), ("centre", 5), ("drive", 20))
    servos = range(1, 19)
    LOOP, LAYER, OWN = 5, 6, (3, 5)

    def __init__(self, seed):
        super().__init__(seed)
        for number, joints, way in ((self.LOOP, range(1, 19), 40), (self.LAYER, self.OWN, 150)):
            looping = page("loop", [(40, {joint: 512 + way for joint in joints}), (40, {})], joints=joints, next=number)
            at = robot.MOTIONS + robot.PAGE_BYTES * number
            self.board.flash[at : at + robot.PAGE_BYTES] = bytes(looping.data)
        self.memories = Memories(self.board)
        self.memories.free_eeprom |= set(AREA)
        self.say("on", f"play {self.LOOP}")
        self.board.expect("Playing page", ms=5000)
        self.drive(200)
        self.say(f"layer {self.LAYER}")
        self.board.clear_trace()

    def say(self, *lines):
        for line in lines:
            self.board.take()
            self.board.send(line + "\r")
            self.board.expect(" OK", ms=3000)

    def drive(self, ms):
        for _ in range(ms // 50):
            self.board.send("@drive 0 120 100\r")
            self.board.run(ms=50)

    def saved(self):
        operations = -1
        while operations != self.board.operations:
            operations = self.board.operations
            self.drive(500)
        self.allowed = self.allowed[-1:]
        moved = {joint for _, goals in bus_watch.frames_of(self.board.packets) for joint, goal in goals.items() if goal > 560}
        assert moved == set(self.OWN), f"the layer does not play: {moved}"
        self.board.clear_trace()

    def restart(self):
        self.board.clear_trace()
        super().restart()

    def verdict(self, cut):
        if cut:
            self.board.run(ms=1500)
            assert not bus_watch.frames_of(self.board.packets), "the robot moves by itself"
        return super().verdict(cut)


SCENES = (Settings, SettingsDriven, PairsAndSave)
