# SPDX-License-Identifier: MIT
"""Scenes of the boot loader: downloads of applications and motions by each of its protocols, EEPROM, and the mailbox."""

import functools
import zlib

from cm5sim.board import find_image
from m512.board import block, download, loaders, memory
from tests.campaigns.badlinks.runs import phase
from tests.sim.boot_board import APP_END, BOOT_MODE, MAP, PROMPT, begin_load, end_load, say

from . import robot
from .robot import MOTIONS, PAGE_BYTES, PAGES, Memories
from .saves import MAIL_PAGE, MAIL_STATE, MAILBOX

FLASH_PAGE = 256
LOAD_RECORD = set(range(MAP["MEM_EE_LOAD_RECORD"], BOOT_MODE))
APP_MARK, INCOMPLETE = MAP["MEM_EE_APP_MARK"], 0x50


@functools.cache
def application(name):
    """Returns an image as flash pages."""
    return memory.plan(find_image(name)).pages


def overlaid(area, pages):
    """Returns an area with some of its pages replaced."""
    area = bytearray(area)
    for number, data in pages.items():
        area[FLASH_PAGE * number : FLASH_PAGE * (number + 1)] = data
    return bytes(area)


def new_motions():
    """Returns the board's motions with nine pages changed."""
    data = bytearray(robot.motions())
    for number in (1, 2, 3, 40, 41, robot.ERASED, robot.DAMAGED, 126, 127):
        data[PAGE_BYTES * number : PAGE_BYTES * (number + 1)] = robot.made(number, 5)
    return bytes(data)


def flash_pages(data, start):
    return {(start + at) // FLASH_PAGE: data[at : at + FLASH_PAGE] for at in range(0, len(data), FLASH_PAGE)}


# The protocols. Each brings `pages` (flash page -> bytes) to a board whose loader is at its prompt.


def by_blocks(board, pages, fast=False):
    """m512's own client."""
    loader = loaders.identify(robot.SimLink(board))
    assert isinstance(loader, block.BlockLoader)
    assert not fast or loader.go_faster()
    download.download(loader, memory.Plan(dict(pages)), phase)
    loader.leave()
    board.run(ms=20)
    board.take()


def by_fast_blocks(board, pages):
    by_blocks(board, pages, fast=True)


def by_load(board, pages, too_much=0, answer="Success"):
    """`load`, as the original's tools do it: raw bytes, then their sum."""
    first = min(pages)
    data = b"".join(pages[number] for number in range(first, max(pages) + 1))
    begin_load(board, FLASH_PAGE * first)
    board.send(data + bytes([sum(data) + too_much & 0xFF]))
    assert end_load(board)[0] == answer


def by_wrong_load(board, pages):
    """The same with bytes that were damaged on the way: the sum does not fit."""
    damaged = {number: data[:-1] + b"?" if number % 20 == 7 else data for number, data in pages.items()}
    by_load(board, damaged, 1, "Error")


def by_stk500(board, pages):
    """What avrdude -c arduino says: sync, enter, then address and page, and so on."""

    def ask(request, answer=b"\x14\x10"):
        board.send(request)
        board.expect(answer, ms=1500)

    ask(b"0 ")
    ask(b"P ")
    for number in sorted(pages):
        ask(b"U" + (number * FLASH_PAGE // 2).to_bytes(2, "little") + b" ")
        ask(b"d\x01\x00F" + pages[number] + b" ")
    ask(b"Q ")
    board.expect(PROMPT)


class Download:
    """The application of the board is replaced by another one, Edit by Play."""

    promise = "A download of code that was cut is started only when it is whole; the loader says what is wrong and takes it again"
    what = "app"
    rates, chunks, about = (8, 1, 1), 6, 400
    all_phases_until = 6  # the first pages, with vectors and record, are cut at every phase
    finish_one_in = 6
    kind = "cm5"

    def __init__(self, name, protocol, seed, **options):
        self.name, self.protocol = name, protocol
        self.__dict__.update(options)
        self.board = robot.new_board(f"boot-{self.kind}.hex", f"{self.old_image}-{self.kind}.hex", seed=seed, kind=self.kind)
        self.board.power_on()
        robot.to_loader(self.board)
        self.memories = Memories(self.board)
        self.memories.free_eeprom |= LOAD_RECORD if protocol in (by_load, by_wrong_load) else set()
        self.memories.free_eeprom.add(APP_MARK)
        self.pages, self.start = dict(application(f"{self.new_image}-{self.kind}.hex")), 0
        self.old = self.memories.flash[:APP_END]
        self.new = overlaid(self.old, self.pages)

    old_image, new_image = "edit", "play"

    def act(self):
        self.protocol(self.board, self.pages)

    def now(self):
        return bytes(self.board.flash[self.start : self.start + len(self.old)])

    def restart(self):
        robot.power_on(self.board)
        self.settled()

    def settled(self):
        """Runs until the application answers if it is complete, otherwise until the loader's prompt."""
        state = {self.old: self.old_image, self.new: self.new_image}.get(self.now())
        if state is None:
            self.board.expect(PROMPT, ms=1500)
        else:
            robot.application_answers(self.board, state)

    def verdict(self, cut):
        board, now = self.board, self.now()
        torn = self.neither()
        assert len(torn) <= 1, f"flash pages {torn} are neither old nor new"
        self.memories.app_is_free = True
        self.memories.check()
        assert cut or now == self.new, "nothing was cut, and it is not the new application"
        if now in (self.old, self.new):
            robot.loader_answers(board)
            return "old" if now == self.old else "new"
        answer = say(board, "id")
        assert answer.endswith(("app=bad", "app=none")), f"the loader says {answer!r}"
        if zlib.crc32(now) % self.finish_one_in == 0:
            self.finish()
        return "refused"

    def neither(self):
        """Returns the flash pages whose contents are neither old nor new."""
        now = self.now()
        return [
            at // FLASH_PAGE
            for at in range(0, len(now), FLASH_PAGE)
            if now[at : at + FLASH_PAGE] not in (self.old[at : at + FLASH_PAGE], self.new[at : at + FLASH_PAGE])
        ]

    def finish(self):
        """Repeats the command, as a user would: only missing pages are sent."""
        by_blocks(self.board, self.pages)
        assert self.now() == self.new
        self.board.send("go\r")
        robot.application_answers(self.board, self.new_image)


class Foreign(Download):
    """Both applications are of somebody else, so they have no record by which the loader knows an incomplete one."""

    promise = "A download of code without a record that was cut, or ended in an error, is started only when it is whole"
    rates = (24, 1, 1)

    def __init__(self, name, protocol, seed, **options):
        super().__init__(name, protocol, seed, **options)
        self.old = without_record(self.old)
        self.board.flash[:APP_END] = self.old
        self.pages[0] = without_record(self.pages[0])
        self.new = overlaid(self.old, self.pages)
        self.memories.flash = bytes(self.board.flash)

    def is_marked(self):
        return self.board.eeprom[APP_MARK] == INCOMPLETE

    def settled(self):
        if self.is_marked():
            self.board.expect(PROMPT, ms=1500)
        else:
            super().settled()

    def verdict(self, cut):
        assert len(self.neither()) <= 1 or self.protocol is by_wrong_load
        self.memories.app_is_free = True
        self.memories.check()
        now = self.now()
        state = "none" if now[:2] == b"\xff\xff" else "bad" if self.is_marked() else "plain"
        robot.loader_answers(self.board, state)
        whole = {self.old: "old", self.new: "new"}.get(now)
        assert whole or state != "plain", "an incomplete application would be started"
        assert cut or (whole, state) == ("new", "plain") or self.protocol is by_wrong_load, "nothing was cut, and it is not the new application"
        if state != "plain" and zlib.crc32(now) % self.finish_one_in == 0:
            self.finish()
        return whole if state == "plain" else "refused"


def without_record(data):
    at = MAP["MEM_APP_RECORD"]
    return data[:at] + bytes(4) + data[at + 4 :]


class Motions(Download):
    """Nine pages of the motion area are replaced, under Play."""

    promise = "A download of motions that was cut leaves each flash page old or new but the one under way; Play starts, and takes it again"
    rates, about, all_phases_until = (2, 1, 1), 36, 0
    old_image = new_image = "play"
    chunks, finish_one_in = 2, 4

    def __init__(self, name, protocol, seed, **options):
        super().__init__(name, protocol, seed, **options)
        self.old, self.new, self.start = robot.motions(), new_motions(), MOTIONS
        self.pages = flash_pages(self.new, MOTIONS)

    def settled(self):
        robot.application_answers(self.board, self.new_image)

    def verdict(self, cut):
        torn = self.neither()
        assert len(torn) <= 1, f"flash pages {torn} are neither old nor new"
        now = self.now()
        for number in range(PAGES):
            page = now[PAGE_BYTES * number : PAGE_BYTES * (number + 1)]
            self.memories.pages[number] = [page]
        self.memories.check()
        assert cut or now == self.new, "nothing was cut, and the motions are not the new ones"
        robot.loader_answers(self.board)
        answer = say(self.board, "check", ms=9000)
        valid, bad = sound_pages(now)
        counts = f",{valid:02X},{PAGES - valid - bad:02X},{bad:02X} boot="
        assert counts in answer, f"{valid} valid and {bad} bad pages, but {answer[-90:]!r}"
        if cut and zlib.crc32(now) % self.finish_one_in == 0:
            by_blocks(self.board, self.pages)
            now = self.now()
        return "new" if now == self.new else "old" if now == self.old else "some pages"


def sound_pages(area):
    """Returns (valid, damaged) pages of a motion area. Erased pages and pages without an action are neither."""
    pages = [area[at : at + PAGE_BYTES] for at in range(0, len(area), PAGE_BYTES)]
    whole = [page for page in pages if page != b"\xff" * PAGE_BYTES]
    sound = [page for page in whole if sum(page) & 0xFF == 0xFF]
    return sum(1 for page in sound if page[15] and page[20]), len(whole) - len(sound)


class Words:
    """Everything that writes EEPROM from the loader's prompt, one after the other."""

    name, about, chunks, rates = "words", 60, 1, (2, 1, 1)
    promise = "EEPROM written from the loader: each byte old or new but the one under way; the loader answers"

    def __init__(self, seed):
        self.board = robot.new_board("boot-cm5.hex", "play-cm5.hex", seed=seed)
        self.board.power_on()
        robot.to_loader(self.board)
        self.memories = Memories(self.board)
        self.memories.free_eeprom |= set(range(0x100, 0x140)) | {BOOT_MODE, MAP["MEM_EE_START_WORD"]}
        self.states = [self.memories.eeprom]

    def wrote(self, at, data):
        eeprom = bytearray(self.states[-1])
        eeprom[at : at + len(data)] = data
        self.states.append(bytes(eeprom))

    def act(self):
        board = self.board
        self.wrote(0x100, bytes(range(1, 17)))
        board.send("eep_dn 100 10\r")
        board.expect("Ready")
        board.send(bytes(range(1, 17)))
        board.expect("O.K.")
        board.expect(PROMPT)
        self.wrote(0x104, b"\xff" * 4)
        assert "Clearing" in say(board, "clear_eeprom 104 4")
        for word, at, value in (("sys", BOOT_MODE, 0xFF), ("app", BOOT_MODE, 0x11), ("toss", MAP["MEM_EE_START_WORD"], 0x13)):
            self.wrote(at, bytes([value]))
            say(board, word)
        loader = loaders.identify(robot.SimLink(board))
        self.wrote(0x110, bytes(range(30, 46)))
        loader.write_eeprom({0x110 + i: 30 + i for i in range(16)})
        loader.leave()
        board.run(ms=20)
        self.wrote(0x120, bytes(range(60, 76)))
        board.send(b"0 ")
        board.expect(b"\x14\x10")
        for request in (b"P ", b"U" + (0x120 // 2).to_bytes(2, "little") + b" ", b"d\x00\x10E" + bytes(range(60, 76)) + b" ", b"Q "):
            board.send(request)
            board.expect(b"\x14\x10", ms=1500)
        board.expect(PROMPT)

    def restart(self):
        robot.power_on(self.board)
        if self.board.eeprom[BOOT_MODE] == 0xFF:
            self.board.expect(PROMPT, ms=1500)
        else:
            robot.application_answers(self.board, "play")

    def verdict(self, cut):
        self.memories.check()
        before, after = self.states[-2:]
        now = bytes(self.board.eeprom)
        odd = [at for at in range(len(now)) if now[at] not in (before[at], after[at])]
        assert len(odd) <= 1, f"EEPROM bytes {odd} are neither old nor new"
        robot.loader_answers(self.board)
        return "new" if now == after else "old" if now == before else "some bytes"


class Taken:
    """A page that a factory application left in the mailbox; our loader writes it, and is cut at that, three deep."""

    name, about, chunks, rates = "taken", 5, 3, (1, 3, 40)
    promise = "A page waiting in the mailbox gets into flash, however often the loader is cut at it"

    def __init__(self, seed):
        self.board = robot.new_board("boot-cm5.hex", "play-cm5.hex", seed=seed)
        new = robot.made(9, 1)
        eeprom = self.board.eeprom
        eeprom[MAP["MEM_EE_MAILBOX"] : MAP["MEM_EE_MAILBOX"] + PAGE_BYTES] = new
        eeprom[MAIL_PAGE], eeprom[MAIL_STATE] = 9, 0xAA
        self.memories = Memories(self.board)
        self.memories.free_eeprom |= MAILBOX - {BOOT_MODE}
        self.memories.saving(9, new)

    def act(self):
        self.restart()

    def restart(self):
        robot.power_on(self.board)
        robot.application_answers(self.board, "play", ms=4000)

    def verdict(self, cut):
        outcome = self.memories.outcome()
        assert outcome == "new" and self.board.eeprom[MAIL_STATE] != 0xAA
        robot.loader_answers(self.board)
        return outcome


def download_scene(base, scene_name, protocol, **options):
    """Returns a class of scenes with this name and protocol."""

    def start(self, seed):
        base.__init__(self, scene_name, protocol, seed)

    return type(scene_name, (base,), {"__init__": start, "__doc__": f"{base.__doc__} {protocol.__doc__ or ''}", "name": scene_name, **options})


SCENES = (
    download_scene(Download, "app-blocks", by_blocks),
    download_scene(Download, "app-load", by_load, rates=(24, 1, 1)),
    download_scene(Download, "app-stk500", by_stk500, rates=(24, 1, 1)),
    download_scene(Download, "app-cm2", by_fast_blocks, rates=(48, 1, 1), kind="cm2", old_image="play", new_image="edit"),
    download_scene(Foreign, "foreign-blocks", by_blocks),
    download_scene(Foreign, "foreign-load", by_load),
    download_scene(Foreign, "foreign-error", by_wrong_load),
    download_scene(Foreign, "foreign-stk500", by_stk500),
    download_scene(Motions, "motions-blocks", by_fast_blocks),
    download_scene(Motions, "motions-load", by_load),
    download_scene(Motions, "motions-stk500", by_stk500),
    Words,
    Taken,
)
