# SPDX-License-Identifier: MIT
"""Noise for Edit's console: words of its grammar, answers, keys, program requests, broken pieces of all of these, and random bytes.

    figures = fuzz(seed, count)     raises AssertionError or Violation if Edit fails

Checks after every piece of 2 to 4 KB:
  * Edit returns to its table by keys that work from anywhere, and answers: it does not hang
  * only EXIT, @reset and SAVE by mailbox (board_restart) restart the controller; there is no other watchdog reset
  * no violation of the strict board (it raises by itself)
  * flash holds what was saved: at each entry of cmd_page_save the 512 bytes are recorded, and the motion area must equal the
    records; program and loader stay unchanged, and only saves change the journal area
  * seeds divisible by 3 never save: the flash must not change at all; seeds 2 modulo 3 run on the factory loader

The typist obeys XOFF, so every command is executed: some hundred bytes a second. With loud=True it does not, and most input is lost: thirty
times as much in the same time, in other mixtures, never on the factory loader.
"""

import random
import re
from typing import NamedTuple

from cm5sim import Board, Violation
from cm5sim.board import _ADDRESS, CYCLES_PER_MS
from m512.files.image import Image
from tests.sim.boot_board import factory_section
from tests.sim.channel import request as framed
from tests.sim.made_page import page

MOTION, MOTION_END, JOURNAL = 0xE000, 0x1E000, 0xC000
XON, XOFF = 0x11, 0x13
BYTES_A_BOARD = 60000  # then a new robot, with fresh settings, servo IDs and rates
LINE_BUFFER = 24  # bytes that still arrive after an XOFF, as from a USB adapter
HOME_TRIES = 10
RESTARTS = ("system_restart", "board_restart")  # the linker may merge these two functions

WORDS = (
    "page next before copy new name step go write insert delete move mirror set goto on off play time speed re hex dec undo "
    "redo list take paste swap pairs help mon monitor rows p n b s g w i d m u ?"
).split()
NUMBERS = (
    "0 1 2 3 4 5 6 7 9 10 30 31 32 36 49 50 64 100 127 128 254 255 256 512 1000 1023 1024 65535 65536 0x1f 0X3FF 1f -1 x "
    "yes no base 99999999 0x page1"
).split()
REQUESTS = (
    "@ver",
    "@list",
    "@list 1 3",
    "@page 1",
    "@dense 1",
    "@page 300",
    "@pose",
    "@torque on",
    "@torque off 3",
    "@torque on 1 2 3",
    "@play 1",
    "@play 2 30",
    "@stop",
    "@break",
    "@pause",
    "@resume",
    "@where",
    "@crc",
    "@open 2",
    "@open 5",
    "@move 90 1 200200---",
    "@",
    "@ @",
    "@data",
    "@data 511 00",
    "@data 512 00",
    "@data 0 zz",
    "@frobnicate 1 2 3",
    "@move 1 1 fff",
    "@open 999",
    "@save 1",
)
KEYS = (
    b"\x1b[A",
    b"\x1b[B",
    b"\x1b[C",
    b"\x1b[D",
    b"\x1bOA",
    b"\x1b[",
    b"\x1b",
    b"\x1b[24;80R",
    b"\x1b[40;80R",
    b"\x1b[999;9R",
    b"\x1b[5~",
    b"]",
    b"[",
    b"}",
    b"{",
    b" ",
    b"\x01",
    b"\x15",
    b"\x03",
    b"\x7f",
    b"\b",
    b"\r",
    b"\n",
    b"\0",
    b"\x11",
    b"\x13",
    b"y",
    b"n",
    b"q",
)


class Figures(NamedTuple):
    seed: int
    sent: int
    saves: int
    restarts: int
    seconds: float
    headroom: int


class Grammar:
    def __init__(self, rng, saves):
        self.rng, self.saves, self.crc = rng, saves, 0

    def arguments(self):
        count = self.rng.choice((0, 0, 1, 1, 1, 2, 2, 3, 9))
        return "".join(self.rng.choice((" ", " ", " ", ",", ":", "  ")) + self.rng.choice(NUMBERS) for _ in range(count))

    def end(self):
        return self.rng.choice(("\r", "\r", "\r", "\n", "\r\n", "\r\r"))

    def command(self):
        word = self.rng.choice(WORDS)
        if self.rng.random() < 0.1:
            word = word.upper()
        text = word + self.arguments() + self.end() + self.rng.choice(("", "", "", "y", "yy", "n", " ", "q", "\x1b"))
        return text.encode()

    def save(self):
        return (
            self.rng.choice(("save", "SAV", "save", f"save {self.rng.randrange(130)}")).encode()
            + b"\r"
            + self.rng.choice((b"", b"y", b"y", b"yy", b"n"))
        )

    def edits(self):
        """Steps that result in a page worth saving."""
        rng = self.rng
        lines = (
            f"page {rng.randrange(8)}",
            f"goto {rng.randrange(10)} {rng.randrange(33)}",
            f"set {rng.randrange(1100)}",
            f"step {rng.randrange(8)}",
            f"copy {rng.randrange(4)}",
            "new",
            f"write {rng.randrange(7)}",
            "undo",
            "redo",
        )
        return "".join(rng.choice(lines) + "\r" + rng.choice(("", "y")) for _ in range(rng.randrange(1, 5))).encode()

    def request(self):
        """A request, typed or through the programs' channel."""
        line = self.request_by_hand()
        return line if self.rng.random() < 0.5 else b"".join(framed(part.decode()) for part in line.split(b"\r")[:-1])

    def request_by_hand(self):
        rng = self.rng
        kind = rng.randrange(6)
        if kind == 0:
            offset, count = rng.randrange(0, 530), rng.randrange(0, 40)
            return f"@data {offset} {rng.randbytes(count).hex()}\r".encode()
        if kind == 1 and self.saves:  # the sum that Edit last reported
            return f"@crc\r@save {rng.randrange(130)} 0x{self.crc:04X}\r".encode()
        return rng.choice(REQUESTS).encode() + b"\r"

    def keys(self):
        return b"".join(self.rng.choice(KEYS) for _ in range(self.rng.randrange(1, 12)))

    def broken(self):
        """A valid phrase with a byte lost, doubled or changed."""
        text = bytearray(self.rng.choice((self.command, self.request, self.edits))())
        for _ in range(self.rng.randrange(1, 4)):
            at = self.rng.randrange(len(text))
            text[at : at + 1] = self.rng.choice((b"", bytes(text[at : at + 1]) * 2, self.rng.randbytes(1)))
            if not text:
                return b"\r"
        return bytes(text)

    def leave(self):
        return self.rng.choice((b"exit\ry", b"@reset\r", b"exit\rn"))

    def phrase(self):
        made = self.rng.choices(
            (
                self.command,
                self.save if self.saves else self.command,
                self.edits,
                self.request,
                self.keys,
                self.broken,
                self.leave,
                lambda: self.rng.randbytes(self.rng.randrange(1, 60)),
                lambda: b"x" * self.rng.randrange(70, 300) + b"\r",
            ),
            (40, 9, 15, 12, 15, 10, 0.3, 6, 2),
        )[0]()
        if not self.saves:
            made = made.replace(b"sa", b"se").replace(b"SA", b"SE").replace(b"sA", b"sE").replace(b"Sa", b"Se")
        return made


class Noise:
    """One robot that receives noise."""

    def __init__(self, seed, number, loud=False):
        self.seed, self.rng = seed, random.Random(f"{seed} {number}")
        self.factory, self.loud = seed % 3 == 2 and not loud, loud
        self.grammar = Grammar(self.rng, seed % 3 != 0)
        self.saves = self.restarts = 0
        self.heard = bytearray()
        self.may_send = True
        image = Image.empty()
        for n, made in {
            1: page("one", [(40, {1: 480}), (30, {2: 400}, 5)], exit=2),
            2: page("two", [(30, {})], next=2),
            3: page("full", [(20 + k, {k: 300 + k}) for k in range(7)], joints=range(31)),
        }.items():
            image[n] = made
        torn = page("torn", [(30, {})])
        torn.data[100] ^= 1
        image[4] = torn
        images = ["edit-cm5.hex"] if self.factory else ["boot-cm5.hex", "edit-cm5.hex"]
        board = self.board = Board(
            images=images, motions=image.to_bytes(), servos=range(1, 19), seed=seed, **({"bootrst": True} if self.factory else {})
        )
        if self.factory:
            board.flash[0x1E000:0x20000] = factory_section()
        board.eeprom[0xFFF] = 0x11
        board.forbid("unexpected-reset")
        if self.factory:  # its routine receives nothing for 9 ms, and a USB adapter reacts to XOFF later than that
            board.allow("uart-overrun")
        self.save_entry, self.pending = board.function("cmd_page_save"), None
        self.watch()
        self.model = bytearray(board.flash[:])
        self.run(2500)
        self.page_at = 0x100 + bytes(board.ram[0x100:0x1100]).find(image[1].data[:31])  # page 1 is open after the start
        assert self.page_at >= 0x100

    # ---- time; watches saves and restarts ----

    def watch(self):
        self.board._lib.board_stop_at(self.board._pointer, self.save_entry)

    def run(self, ms):
        board = self.board
        end = board.now_cycles + int(ms * CYCLES_PER_MS)
        while board.now_cycles < end:
            try:
                if board._run(end - board.now_cycles) == _ADDRESS:
                    self.save_begins()
                    board.step()
                    self.watch()
            except Violation as bite:
                if bite.kind not in ("unexpected-reset", "uart-overrun") or bite.function.split(".")[0] not in RESTARTS:
                    raise
                board.clear_violation()  # an overrun: input during a restart is not read
                board.flush()
                if bite.kind == "unexpected-reset":
                    self.restarts += 1
                    board.reset()
                    self.watch()
        new = board.take()
        for byte in new:
            if byte in (XON, XOFF):
                self.may_send = byte == XON
        self.heard += new

    def save_begins(self):
        """cmd_page_save(page), typed or by @save: r24 has the page number, RAM the edited bytes."""
        page_number = self.board.ram[24]
        data = bytearray(self.board.ram[self.page_at : self.page_at + 512])
        data[31] = 0
        data[31] = (0xFF - sum(data)) & 0xFF
        self.check_flash()
        assert self.grammar.saves, "nobody typed SAVE"
        assert page_number < 128
        self.model[MOTION + 512 * page_number : MOTION + 512 * (page_number + 1)] = data
        self.saves += 1

    def check_flash(self):
        flash = bytes(self.board.flash[:])
        start = JOURNAL if self.saves else MOTION
        assert flash[MOTION:MOTION_END] == self.model[MOTION:MOTION_END], "a page in flash is not what was saved"
        assert flash[:start] == self.model[:start] and flash[MOTION_END:] == self.model[MOTION_END:], "program or loader changed"

    # ---- typing ----

    def type(self, data):
        """Types at line rate with flow control, as a terminal does. Only our loader buffers input during a flash write, so others need flow
        control."""
        sent = 0
        if self.loud:
            self.board.send(data)
            sent = len(data)
        while sent < len(data) or self.board.waiting:
            if self.may_send and self.board.waiting < LINE_BUFFER and sent < len(data):
                self.board.send(data[sent : sent + LINE_BUFFER])
                sent += LINE_BUFFER
            self.run(20 if self.loud else 2)

    def come_home(self):
        """Returns to the table from wherever the noise has led, and waits for an answer there."""
        for attempt in range(HOME_TRIES):
            self.type(b"\x1b\x1b\x1b")
            self.run(80)
            self.type(b"\x03\x03")
            self.run(20)
            self.heard.clear()
            self.type(b"\x15zz%d\r" % attempt)  # the attempt number identifies its answer
            for _ in range(100):
                self.run(15)
                answer = re.search(rb"zz%d(\r\n)? Bad Command" % attempt, self.heard)
                if answer:
                    break
            self.run(20)
            if answer:
                return
        raise AssertionError(f"Edit does not answer any more; the console says {bytes(self.heard[-300:])!r}")

    def piece(self, limit):
        """Types up to `limit` bytes of noise, returns to the table and checks the flash. Returns the bytes sent."""
        text, phrases = bytearray(), []
        while len(text) < limit:
            phrases.append(self.grammar.phrase())
            text += phrases[-1]
        text = bytes(text[:limit])
        try:
            self.type(text)
            told = self.heard.rfind(b"@crc ")
            if told >= 0 and told + 9 <= len(self.heard):
                try:
                    self.grammar.crc = int(self.heard[told + 5 : told + 9], 16)
                except ValueError:
                    pass
            self.come_home()
            self.check_flash()
        except (AssertionError, Violation) as fault:
            raise AssertionError(f"seed {self.seed}: {fault}\nafter {text!r}") from fault
        self.board.clear_trace()
        return text


def fuzz(seed, count, report=None, loud=False):
    sent = saves = restarts = number = 0
    seconds, headroom = 0.0, 4096
    while sent < count:
        noise = Noise(seed, number, loud)
        number += 1
        end = min(count, sent + BYTES_A_BOARD * (2 if loud else 1))
        with noise.board as board:
            while sent < end:
                text = noise.piece(min(noise.rng.randrange(2000, 4000) * (4 if loud else 1), end - sent))
                sent += len(text)
            seconds += board.now_ms / 1000
            headroom = min(headroom, board.stack_headroom)
        saves += noise.saves
        restarts += noise.restarts
        if report:
            report(f"seed {seed}: {sent} bytes, {saves} saves, {restarts} restarts, headroom {headroom}")
    return Figures(seed, sent, saves, restarts, seconds, headroom)
