# SPDX-License-Identifier: MIT
"""The factory boot loader's command line: prompt, dumps, EEPROM, staying in the loader and leaving it. Nothing here writes flash.

The loader acknowledges nothing, checks nothing, and takes late data for typed text. So each line is typed and its echo compared before
it is ended. Commands are long words, so that a single wrong bit never gives another command.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

from m512.board.block import RESET, START, STAY, pieces
from m512.board.link import REPEAT, Link
from m512.errors import BoardError, M512Error, NoAnswerError
from m512.ui import Progress, unseen

PROMPT = b"\r\n - "
# Empties the loader's input line and asks for a prompt. The line holds 80 characters; some bytes may be lost.
KNOCK = b"\x08" * 100 + b"\r"
DUMP_BYTES = 128
DUMP_CHARACTERS = 660
DUMP_AHEAD = 4  # dumps requested in advance; each takes a few of the loader's 255 bytes of input buffer
TRIES = 4
DUMP_TRIES = 8
EEPROM_PIECE = 32
EEPROM_SECONDS = 0.0085
START_SECONDS = 0.4
ECHO_QUIET = 0.02  # silence after an echo, long enough to detect a line that doubles bytes
PATIENCE = 4.0  # longest silence before giving up, on a line that answers at once
BOOT_MODE = 0xFFF  # EEPROM cell: 0xFF when the controller stays in the loader
_DUMP_LINE = re.compile(rb"\r\n ([0-9A-F]{8}) : ((?:[0-9A-F]{2} ){16})([\x20-\x7f]{16})")

WRONG_ADDRESS = (
    "the boot loader took another address than it was given. It has written nothing and waits for data: press MODE before anything else, then "
)


class Unsure(BoardError):
    """A download may be open, so nothing more may be sent."""


class FactoryLine:
    def __init__(self, link: Link):
        self.link = link
        self.retries = 0
        self.pace = 1 / 5714  # seconds per byte, round trip; measured from echoes
        self.open_at: int | None = None
        self.mode_before: int | None = None
        self.stays = False
        self.clean()

    # The line

    def patience(self, count: int) -> float:
        """How long an answer of `count` bytes may take, based on the measured pace of this line."""
        return PATIENCE + 3 * self.pace * count

    def clean(self) -> None:
        """Brings the loader to its prompt with an empty line. Not allowed while a download may be open."""
        for _ in range(TRIES):
            self.link.drain(0.05, 5.0)
            self.link.write(KNOCK)
            if self.link.look_for(PROMPT, self.patience(4 * len(KNOCK)))[1]:
                self.link.drain(0.02)
                return
        raise NoAnswerError("the boot loader does not answer any more. " + self.how_it_stands())

    def how_it_stands(self, told: str = "") -> str:
        """The board's state after an error, and what is safe to do. `told`: what the error says already."""
        state = ""
        if self.open_at is not None:
            state = (
                f"The board may still wait for the rest of a download to 0x{self.open_at:05X}; only pages that this command "
                "writes can change by it. Type nothing into a terminal now. "
            )
        again = "Wait a second and repeat the command: it goes on where it stopped. "
        if self.link.remedy != REPEAT:
            again = "" if self.link.remedy in told else f"Wait a second, then {self.link.remedy}. "
        stays = "; until that has worked the controller stays in it at every start" if self.stays else "; MODE may be pressed as well"
        return state + again + "Its boot loader is unharmed" + stays

    def type_line(self, line: str) -> None:
        """Types a line without its end until the echo shows that it arrived unchanged. NoAnswerError: it never does."""
        for _ in range(TRIES):
            begun = self.link.now()
            self.link.write(line.encode())
            echo = b""
            while len(echo) < len(line):
                some = self.link.read_some(self.patience(2 * len(line)), len(line) - len(echo))
                if not some:
                    break
                echo += some
            if echo == line.encode() and not self.link.drain(ECHO_QUIET, 0.1):  # not doubled
                self.pace = max(1 / 5714, (self.link.now() - begun - ECHO_QUIET) / (2 * len(line)))
                return
            self.retries += 1
            self.clean()
        raise NoAnswerError(f"what is typed arrives damaged (`{line}` came back as {echo!r}). Is the cable good?")

    def enter(self, line: str) -> None:
        self.type_line(line)
        self.link.write(b"\r")

    def command(self, line: str, count: int = 60) -> bytes:
        """Executes a line. Returns its answer of about `count` bytes, up to the prompt."""
        self.enter(line)
        return self.link.read_until(PROMPT, self.patience(count), f"`{line}` to the boot loader")

    # Reading

    def _dump(self, word: str, start: int, end: int, modulo: int, progress: Progress) -> bytes:
        """Reads memory by dumps of 128 bytes. Requests a few in advance until one is damaged."""
        first = start - start % DUMP_BYTES
        out, tries, ahead = bytearray(), 0, DUMP_AHEAD
        while first + len(out) < end:
            at = first + len(out)
            count = (end - at + DUMP_BYTES - 1) // DUMP_BYTES
            try:
                for piece in self._dumps(word, at, count, modulo, ahead):
                    out += piece
                    tries = 0
                    progress(min(first + len(out), end) - start, end - start)
            except NoAnswerError:
                tries, ahead = tries + 1, 1
                self.retries += 1
                if tries == DUMP_TRIES:
                    raise
                self.clean()
        return bytes(out[start - first : end - first])

    def _dumps(self, word: str, at: int, count: int, modulo: int, ahead: int) -> Iterator[bytes]:
        asked = 0
        for done in range(count):
            while asked < min(count, done + ahead):
                self.link.write((f"{word} {at:x}" if asked == 0 else word).encode() + b"\r")
                asked += 1
            here = at + done * DUMP_BYTES
            text = self.link.read_until(PROMPT, self.patience(DUMP_CHARACTERS), f"a dump of 0x{here:X}")
            rows = _DUMP_LINE.findall(text)
            wanted = [(here + 16 * k) % modulo for k in range(DUMP_BYTES // 16)]
            data = [bytes.fromhex(digits.decode()) for _, digits, _ in rows]
            if [int(address, 16) for address, _, _ in rows] != wanted or any(_as_text(piece) != shown for piece, (_, _, shown) in zip(data, rows)):
                self.link.drain(0.2, 3)
                raise NoAnswerError(f"the dump of 0x{here:X} came damaged")
            yield b"".join(data)

    def read(self, start: int, end: int, progress: Progress = unseen) -> bytes:
        return self._dump("flash", start, end, 0x20000, progress)

    def read_eeprom(self, start: int = 0, end: int = 4096, progress: Progress = unseen) -> bytes:
        return self._dump("eeprom", start, end, 0x1000, progress)

    # Writing EEPROM

    def write_eeprom(self, cells: dict[int, int], progress: Progress = unseen) -> None:
        """Writes single bytes, by address. Does not read them back. After Ctrl-C or a signal it writes the piece under way once more before it
        ends: the loader would wait for the rest of its bytes without a time limit, and take those of the next command for them."""
        done = 0
        for at, data in pieces(cells, EEPROM_PIECE, b"\r\n"):  # a surplus byte would be typed text, so a line end is a piece of its own
            try:
                self._write_piece(at, data)
            except (KeyboardInterrupt, SystemExit):
                with suppress(M512Error):
                    self.clean()
                    self._write_piece(at, data)
                raise
            done += len(data)
            progress(done, len(cells))

    def _write_piece(self, at: int, data: bytes) -> None:
        for _ in range(TRIES):
            if self._eeprom_piece(at, data):
                return
            self.retries += 1
            self.clean()
        raise NoAnswerError("EEPROM bytes do not arrive. " + self.how_it_stands())

    def _eeprom_piece(self, at: int, data: bytes) -> bool:
        """Returns whether it worked. If not, the loader may wait for the rest of the bytes; what clean() types is enough for that."""
        self.enter(f"eep_dn {at:x} {len(data):x}")
        answer, ready = self.link.look_for(b"Ready", self.patience(80))
        if not ready:
            return False
        if b"Write Address : %08X" % at not in answer:
            raise Unsure(WRONG_ADDRESS + self.link.remedy)
        self.link.write(data)
        return self.link.look_for(PROMPT, self.patience(len(data) + 20) + EEPROM_SECONDS * len(data))[1]

    # Starting and staying

    def stay(self) -> None:
        """Makes the controller stay in this loader at every start until leave()."""
        if self.stays:
            return
        self.mode_before = self.read_eeprom(BOOT_MODE, BOOT_MODE + 1)[0]
        self._mode("sys")
        self.stays = True

    def _mode(self, word: str) -> None:
        for _ in range(TRIES):
            self.command(word)
            found = self.read_eeprom(BOOT_MODE, BOOT_MODE + 1)[0]
            if (found == 0xFF) == (word == "sys"):
                return
        raise BoardError(f"`{word}` does not change the boot mode")

    def restart(self) -> None:
        """Resets the controller. The loader is at its prompt afterwards (see stay())."""
        self.enter("reset")
        self.link.look_for(PROMPT, START_SECONDS + self.patience(100))
        self.clean()

    def leave(self, to: int = STAY) -> None:
        """START: now and at every later start."""
        if to == START or (self.stays and self.mode_before != 0xFF):
            self._mode("app")
        self.stays = False
        if to == START:
            self._start()
        elif to == RESET:
            self.enter("reset")

    def _start(self) -> None:
        """Starts the application. When the loader says nothing of it and answers no more, it has gone, and what it said was lost."""
        for _ in range(TRIES):
            self.enter("go")
            if self.link.look_for(b"Jump Address", self.patience(60))[1]:
                return
            try:
                self.clean()
            except NoAnswerError:
                return
        raise NoAnswerError("the boot loader does not start the application. " + self.how_it_stands())


def _as_text(data: bytes) -> bytes:
    return bytes(byte if 0x20 <= byte <= 0x7F else 0x2E for byte in data)
