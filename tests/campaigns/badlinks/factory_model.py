# SPDX-License-Identifier: MIT
"""A model of a factory-style boot loader in simulated time, according to its description.

Written from boot/ORIGINAL.md (sections 1 to 4, 7a and 8), independently of m512. It has all of its weaknesses: raw data that ends with 111
ms of silence, no bounds check, the wrap at 0x20000, left-over bytes in the page buffer, a ring of 256 bytes that is emptied when it
overflows, a line of 80 characters that crashes it, Ctrl-A, the mailbox.

The loader is a process: a generator that yields what it waits for, ("byte", seconds or None) or ("busy", seconds). A Board runs it on the
two wires of a line.
"""

from __future__ import annotations

from collections import deque

from .wire import BYTE_SECONDS, Wire

FLASH_BYTES, EEPROM_BYTES, PAGE, BOOT = 0x20000, 0x1000, 256, 0x1E000
RECEIVER_ON, WINDOW, LEDS, SILENCE = 0.0038, 0.060, 0.100, 0.111
PAGE_WRITE, EEPROM_WRITE, REPORT_PAUSE = 0.0088, 0.0085, 0.100
RING_BYTES, LINE_BYTES, EEPROM_BUFFER = 255, 80, 2500
MAILBOX, MAIL_STATE, MAIL_PAGE, BOOT_MODE = 0x800, 0xFF4, 0xFF5, 0xFFF
MAIL_FULL, MAIL_DONE = 0xAA, 0x55
PROMPT = b"\r\n - "
BANNER = b"\r\n\n SYSTEM O.K. (CM5 Boot loader V1.31)"
BANNER_AT = 0x1F7E9
SHOWN = bytes(byte if 0x20 <= byte <= 0x7F else 0x2E for byte in range(256))  # beside the hex digits of a dump
FOREVER = float("inf")
SHORT = {
    "flash": "f",
    "eep": "e",
    "eeprom": "e",
    "ram": "r",
    "l": "load",
    "ld": "load",
    "dn": "load",
    "down": "load",
    "v": "verify",
    "g": "go",
    "application": "app",
    "system": "sys",
    "monitor": "mon",
}
MODES = {"play": 0x12, "toss": 0x13, "mon": 0x14, "edit": 0x15, "dump": 0x16}


class Loader:
    """The chip with this loader. `written` lists (time, flash page, "load" or "mailbox"); `downloads` (address, bytes); `crashes` (time,
    reason). dead_pages: flash that does not take the data."""

    def __init__(self, flash: bytes, eeprom: bytes | None = None, banner: bytes = BANNER):
        self.flash, self.banner = bytearray(flash), banner
        self.eeprom = bytearray(eeprom or b"\xff" * (EEPROM_BYTES - 1) + b"\x11")
        self.written: list[tuple[float, int, str]] = []
        self.downloads: list[tuple[int, int]] = []
        self.dead_pages: set[int] = set()
        self.crashes: list[tuple[float, str]] = []
        self.commands: list[bytes] = []
        self.board: Board | None = None
        self.where = "off"

    # The process

    def life(self):
        """Runs from a reset on."""
        board = self.board
        self.buffer, self.ring, self.hears = bytearray(PAGE), deque(), False
        self.line, self.previous, self.dump_at = bytearray(), b"", 0x5A30
        self.where = "start"
        yield "busy", RECEIVER_ON
        self.hears = True
        yield from self.say(b"\xff")
        if self.eeprom[MAIL_STATE] == MAIL_FULL:
            yield from self.mailbox()
        last, until = None, board.now + WINDOW
        while board.now < until:
            byte = yield "byte", until - board.now
            last = last if byte is None else byte
        if last != 0x23 and self.eeprom[BOOT_MODE] != 0xFF:
            yield from self.application()
        yield "busy", LEDS
        yield from self.say(self.banner)
        while True:
            self.where = "prompt"
            yield from self.say(PROMPT)
            yield from self.execute((yield from self.typed()))

    def application(self):
        """Neither sends nor receives: the images have their own tests."""
        self.where, self.hears = "application", False
        while True:
            yield "busy", FOREVER

    def say(self, text: bytes):
        for at in range(0, len(text), 16):
            piece = text[at : at + 16]
            yield "busy", BYTE_SECONDS * len(piece)
            self.board.to_pc.send(self.board.now, piece)

    def crash(self, why: str):
        self.crashes.append((self.board.now, why))
        self.where, self.hears = "crashed", False
        while True:
            yield "busy", FOREVER

    def arrived(self, byte: int):
        """Handles the receive interrupt."""
        if not self.hears:
            return
        if len(self.ring) == RING_BYTES:
            self.ring.clear()
        else:
            self.ring.append(byte)

    def write_page(self, address: int, data: bytes, how: str):
        page = address % FLASH_BYTES // PAGE
        self.written.append((self.board.now, page, how))
        self.hears = page < BOOT // PAGE  # the CPU halts while its own section is written
        yield "busy", PAGE_WRITE
        self.hears = True
        if page not in self.dead_pages:
            self.flash[page * PAGE : (page + 1) * PAGE] = data

    def mailbox(self):
        yield from self.say(b" Writing ")
        base = 0xE000 + 0x200 * self.eeprom[MAIL_PAGE]
        for half in (0, PAGE):
            data = bytes(self.eeprom[MAILBOX + half : MAILBOX + half + PAGE])
            yield from self.write_page(base + half, data, "mailbox")
        yield "busy", EEPROM_WRITE
        self.eeprom[MAIL_STATE] = MAIL_DONE

    # The line

    def typed(self):
        """Returns a typed line without its line end."""
        self.line.clear()
        while True:
            byte = yield "byte", None
            if byte in (0x0D, 0x0A):
                if len(self.line) >= LINE_BYTES:
                    yield from self.crash("80 characters and their end")
                return bytes(self.line)
            if byte == 0x08:
                if self.line:
                    yield from self.rub_out(1)
            elif byte == 0x01:
                yield from self.rub_out(len(self.line))
                self.line[:] = self.previous
                yield from self.say(self.previous)
            elif byte not in (0x00, 0x1B) and len(self.line) < LINE_BYTES:
                self.line.append(byte)
                yield from self.say(bytes([byte]))

    def rub_out(self, count: int):
        for _ in range(count):
            self.line.pop()
            yield from self.say(b"\x08 \x08")

    @staticmethod
    def words(line: bytes) -> list[bytes]:
        """Splits a line. Separators are 0x20..0x2F and TAB. Spaces are merged; every other separator counts by itself."""
        line = line.lstrip(b" ")
        if line[:1] and (line[0] == 9 or 0x20 <= line[0] <= 0x2F):
            return []
        out, word = [], bytearray()
        for at, byte in enumerate(line + b" "):
            if byte == 9 or 0x20 <= byte <= 0x2F:
                if word or byte != 0x20 or not out:
                    out.append(bytes(word))
                word = bytearray()
            else:
                word.append(byte)
        return out if out != [b""] else []

    @staticmethod
    def number(word: bytes) -> int:
        value = 0
        for char in word.upper():
            value = value * 16 + (char - 48 if char < 0x3A else char - 55) & 0xFFFFFFFF
        return value

    def execute(self, line: bytes):
        self.previous = line or self.previous
        words = self.words(line)
        if not words:
            return
        name = words[0].decode("latin-1").lower()
        name = SHORT.get(name, name)
        self.commands.append(line)
        if name in MODES or name in ("app", "sys"):
            yield from self.mode(name)
        elif hasattr(self, "do_" + name) and name.isascii():
            yield from getattr(self, "do_" + name)([self.number(word) for word in words[1:]])
        else:
            yield from self.say(b"\r\n Bad Command.('help' for instructions definition)")

    def mode(self, name: str):
        yield "busy", EEPROM_WRITE
        if name in MODES:
            self.eeprom[0xFF3] = MODES[name]
            yield from self.say(b"\r\n " + name.title().encode() + b" Mode")
        else:
            self.eeprom[BOOT_MODE] = 0x11 if name == "app" else 0xFF
            yield from self.say(b"\r\n Boot to " + (b"Application" if name == "app" else b"System"))

    def do_help(self, _):
        yield from self.say(b"\r\n" + b"help " * 180)

    def dump(self, memory: bytearray, arguments: list[int]):
        at = (arguments[0] if arguments else self.dump_at) % len(memory)
        for _ in range(8):
            row = bytes(memory[at : at + 16] + memory[: max(0, at + 16 - len(memory))])
            yield from self.say(b"\r\n %08X : %b " % (at, row.hex(" ").upper().encode()) + row.translate(SHOWN))
            at = (at + 16) % len(memory)
        self.dump_at = at
        yield from self.say(b"\r\n")

    def do_f(self, arguments):
        yield from self.dump(self.flash, arguments)

    def do_e(self, arguments):
        yield from self.dump(self.eeprom, arguments)

    def do_r(self, arguments):
        yield from self.dump(bytearray(4352), arguments)

    def do_verify(self, _):
        yield "busy", 0.5
        yield from self.say(b"\r\n Program Length : 0x00000000\r\n Verified Checksum : 00-00000000-00000000")

    def do_up(self, _):
        yield from self.say(b"\r\n Push button when ready...")
        self.where = "wants START"
        while True:
            yield "busy", FOREVER

    do_eep_up = do_up

    def do_clear_eeprom(self, arguments):
        if len(arguments) == 2:
            for k in range(arguments[1] % EEPROM_BYTES):
                yield "busy", EEPROM_WRITE
                self.eeprom[(arguments[0] + k) % EEPROM_BYTES] = 0xFF
        elif not arguments:
            yield from self.say(b"\r\n (y/N)")
            if (yield "byte", None) in b"yY":
                yield "busy", 34.8
                self.eeprom[:] = b"\xff" * EEPROM_BYTES

    def do_go(self, arguments):
        word = (arguments or [0])[0]
        yield from self.say(b"\r\n Jump Address : 0x%08X" % word)
        yield "busy", 0.010
        if word & 0xFFFF == 0xF000:
            self.board.reset()
        yield from self.application()

    def do_reset(self, _):
        yield "busy", 0.016
        self.board.reset()
        yield "busy", FOREVER

    # Downloads

    def do_load(self, arguments):
        address = arguments[0] if len(arguments) == 1 else 0
        yield from self.say(b"\r\n Write Address : %08X\r\n Ready.." % address)
        self.where = "ready"
        self.size = size = total = last = 0
        while True:
            byte = yield "byte", (None if size == 0 else SILENCE)
            if byte is None:
                break
            self.where = "loading"
            if size:
                total += last
            self.buffer[size % PAGE], last = byte, byte
            self.size = size = size + 1
            if size % PAGE == 0:
                yield from self.write_page(address + size - 1, bytes(self.buffer), "load")
        self.downloads.append((address, size))
        if size % PAGE:
            yield from self.write_page(address + size - 1, bytes(self.buffer), "load")
        yield "busy", 9 * EEPROM_WRITE
        self.eeprom[0xFF6], self.eeprom[0xFF7:0xFFB] = last, (total & 0xFFFFFFFF).to_bytes(4, "little")
        self.eeprom[0xFFB:0xFFF] = size.to_bytes(4, "little")
        yield from self.say(b"Success" if total & 0xFF == last else b"Error")
        yield "busy", REPORT_PAUSE
        yield from self.say(b"\r\n Rewriting:0X0000\r\n Size:0X%08X  Checksum:%02X-%02X" % (size, total & 0xFF, last))

    def do_eep_dn(self, arguments):
        if len(arguments) != 2:
            yield from self.say(b"\r\n EEP_DN StartAddress, Length")
            return
        address, count = arguments
        yield from self.say(b"\r\n Write Address : %08X\r\n Ready" % address)
        self.where, data = "eep_dn", bytearray()
        while len(data) < count:
            data.append((yield "byte", None))
            if len(data) == EEPROM_BUFFER:
                yield from self.crash("more EEPROM bytes than RAM holds")
            if len(data) % 256 == 0:
                yield from self.say(b".")
        for k, byte in enumerate(data):
            yield "busy", EEPROM_WRITE
            self.eeprom[(address + k) % EEPROM_BYTES] = byte
        yield from self.say(b"\r\n O.K.")


class Board:
    """Runs a Loader on the wires of a line. `now` is the simulated time in seconds."""

    def __init__(self, loader: Loader, to_board: Wire, to_pc: Wire):
        self.now, self.loader, self.to_board, self.to_pc = 0.0, loader, to_board, to_pc
        self.errands: list = []  # (time, action): press MODE, pull the cable
        loader.board = self
        self.reset()

    def reset(self):
        """A reset by MODE, power-on or the watchdog."""
        self.process, self.fresh = self.loader.life(), True
        self.wants, self.wake = ("busy", 0.0), self.now

    def later(self, seconds: float, what):
        self.errands.append((self.now + seconds, what))
        self.errands.sort(key=lambda errand: errand[0])

    def advance_by(self, seconds: float) -> None:
        """Runs for this time, whatever arrives at the PC."""
        until = self.now + seconds
        while self.now < until:
            self.advance(until, stops=False)

    def _step(self, value):
        process = self.process
        wants = next(process) if self.fresh else process.send(value)
        if process is not self.process:  # the process has reset itself
            return
        self.fresh, self.wants = False, wants
        self.wake = FOREVER if wants[1] is None else self.now + wants[1]

    def advance(self, until: float, stops: bool = True) -> None:
        """Runs until that time; with `stops`, only until something arrives at the PC's end."""
        while True:
            ring = getattr(self.loader, "ring", ())
            if self.wants[0] == "byte" and ring:
                self._step(ring.popleft())
                continue
            arrival = self.to_board.next_arrival()
            errand = self.errands[0][0] if self.errands else FOREVER
            when = min(self.wake, arrival, errand)
            if stops and (pc := self.to_pc.next_arrival()) <= min(when, until):
                self.now = max(self.now, pc)
                return
            if when > until:
                self.now = until
                return
            self.now = max(self.now, when)
            if when == errand:
                self.errands.pop(0)[1]()
            elif when == arrival:
                for byte in self.to_board.arrived(self.now):
                    self.loader.arrived(byte)
            else:
                self._step(None)
