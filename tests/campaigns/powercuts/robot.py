# SPDX-License-Identifier: MIT
"""What the scenes share: m512's own clients on a simulated board, the permitted memory contents, and the restart."""

import functools
import random
import struct

from cm5sim import Board
from m512.board.link import Link
from m512.files.image import Image
from tests.sim.boot_board import APP_END, BOOT_MODE, BOOT_START, JOURNAL_START, MAP, PROMPT, crc16, say
from tests.sim.made_page import page

MOTIONS = MAP["MEM_MOTION_START"]
PAGE_BYTES, PAGES = 512, 128
SLOT_BYTES = 768
SLOTS = (MOTIONS - JOURNAL_START) // SLOT_BYTES
APPLICATION = 0x11  # EEPROM FFF: the loader starts the application
ERASED, DAMAGED = 90, 91  # motion pages to save over


class SimLink(Link):
    """m512's line to a board without a port. Time passes on the board only while the client waits."""

    def __init__(self, board):
        self.url, self.trace, self.board, self.held = "simulated board", None, board, b""

    def now(self):
        return self.board.now_ms / 1000

    def sleep(self, seconds):
        self.board.run(ms=1000 * seconds)

    def close(self):
        pass

    def set_rate(self, rate):
        self.board.baud(rate)

    def write(self, data, wait=True):
        self.board.send(data, wait=wait)

    def _receive(self, limit, seconds):
        end = self.board.now_ms + 1000 * max(seconds, 0)
        while not (came := self.board.take()) and self.board.now_ms < end:
            self.board.run(ms=0.5)
        self.held = came[limit:]
        return came[:limit]


@functools.cache
def motions(seed=1):
    """Returns all 128 pages, each with its own contents; one is erased, one damaged."""
    chance = random.Random(seed)
    image = Image.empty()
    for number in range(PAGES):
        image[number] = page(
            f"page {number}", [(chance.randrange(20, 200), {j: chance.randrange(1024) for j in range(1, 19)}) for _ in range(1 + number % 7)]
        )
    image[DAMAGED].data[31] ^= 0x04
    data = bytearray(image.to_bytes())
    data[ERASED * PAGE_BYTES : (ERASED + 1) * PAGE_BYTES] = b"\xff" * PAGE_BYTES
    return bytes(data)


def made(number, version):
    """Returns a page to save. Both of its halves differ from those of other versions."""
    chance = random.Random(1000 * number + version)
    return bytes(page(f"{number} v{version}", [(50 + version % 100, {j: chance.randrange(1024) for j in range(1, 19)}) for _ in range(7)]).data)


def new_board(*images, seed=1, kind="cm5", **options):
    """Returns a board with motions. The loader is set to start the application."""
    board = Board(kind=kind, images=images, motions=motions(), seed=seed, **options)
    board.skip_waits()
    board.eeprom[BOOT_MODE] = APPLICATION
    return board


class Memories:
    """The contents of flash and EEPROM, and what may have changed since. Nothing else may change."""

    def __init__(self, board):
        self.board = board
        self.flash, self.eeprom = bytes(board.flash), bytes(board.eeprom)
        self.pages = {}  # motion page -> its permitted contents
        self.free_eeprom = set()  # addresses checked elsewhere
        self.app_is_free = False

    def saving(self, number, new):
        """A save of `new` to a motion page has begun."""
        self.pages[number] = [*self.pages.get(number, [self.page(number)]), bytes(new)]

    def saved(self, number):
        """The save was reported as done: only its contents are permitted now."""
        self.pages[number] = self.pages[number][-1:]

    def page(self, number):
        at = MOTIONS + PAGE_BYTES * number
        return self.flash[at : at + PAGE_BYTES]

    def check(self):
        """Raises AssertionError if something is neither old nor new. Returns {page: index of its present contents}."""
        flash, eeprom = bytes(self.board.flash), bytes(self.board.eeprom)
        found = {}
        for number in range(PAGES):
            at = MOTIONS + PAGE_BYTES * number
            now, allowed = flash[at : at + PAGE_BYTES], self.pages.get(number, [self.page(number)])
            assert now in allowed, f"motion page {number} is neither old nor new, from byte {differs(now, allowed[-1])} on"
            found[number] = allowed.index(now)
        assert self.app_is_free or flash[:APP_END] == self.flash[:APP_END], "the application has changed"
        assert flash[BOOT_START:] == self.flash[BOOT_START:], "the boot section has changed"
        wrong = [at for at in range(len(eeprom)) if eeprom[at] != self.eeprom[at] and at not in self.free_eeprom]
        assert not wrong, f"EEPROM has changed at {wrong[0]:03X} ({len(wrong)} bytes)"
        assert not pending(flash), "the journal still has a page pending"
        return found

    def outcome(self):
        """Returns the result of check() as a word: "old" (all pages), "new" (all pages) or "between"."""
        found = self.check()
        steps = {(found[number], len(self.pages[number]) - 1) for number in self.pages}
        return "old" if all(now == 0 < last for now, last in steps) else "new" if all(now == last for now, last in steps) else "between"


def differs(one, other):
    return next(at for at in range(len(one)) if one[at] != other[at])


def pending(flash):
    """Returns whether the newest record of the journal is pending (firmware/common/journal.h)."""
    newest = None
    for slot in range(SLOTS):
        record = flash[JOURNAL_START + SLOT_BYTES * slot + 512 :][:12]
        magic, sequence, target, layout, _, crc, state = struct.unpack("<2sHBBHHH", record)
        if magic == b"MJ" and layout == 1 and target < PAGES and crc == crc16(record[:8]):
            if newest is None or (sequence - newest[0] & 0xFFFF) < 0x8000:
                newest = sequence, state
    return newest is not None and newest[1] == 0xFFFF


def power_on(board):
    board.flush()
    board.baud(57600)
    board.take()
    board.power_on()


def to_loader(board):
    """Enters the loader's prompt with '#' after the start of the board."""
    board.expect(b"\xff", ms=200)
    board.run(ms=1)
    board.send("#")
    board.expect(PROMPT, ms=1500)


def loader_answers(board, app="good"):
    """Presses MODE and asks the loader for its ID."""
    board.reset()
    board.take()
    to_loader(board)
    answer = say(board, "id")
    assert "ID Motion512 boot" in answer and answer.endswith(f"app={app}"), f"the loader says {answer!r}"


def application_answers(board, name, ms=2500):
    """Waits until the application has started; it must answer as `name`."""
    board.expect({"play": b"] ", "edit": b"\x1b["}[name], ms=ms)
    ask(board, "@ver", f"image={name}")


def quiet(board, ms=60):
    """Runs until nothing has come for `ms`. Returns what came before."""
    came = b""
    while True:
        board.run(ms=ms)
        some = board.take()
        if not some and not board.waiting:
            return came
        came += some


def ask(board, request, wanted="OK", ms=1500):
    """Sends one line of the protocol for programs. Returns its answer."""
    board.send(request + "\r")
    word = request.split()[0]
    if word == request:
        board.expect(f"{word} ", ms=ms)  # skips the echo
    answer = board.expect("\r\n", ms=ms)
    assert wanted in answer, f"{request}: {answer!r}"
    return answer
