# SPDX-License-Identifier: MIT
"""The factory boot loader, the PC's side, by the safe way: whole pages, no checksum byte, everything read back by dumps.

It has no acknowledges and no guard of its own section, so this side takes care: never an unaligned start, never past
0x1E000, one argument for `load`, CR alone, no pause in a download.
"""
from __future__ import annotations

import re
from typing import Callable, Dict, List, Optional, Tuple

from m512.board.link import Link
from m512.board.memory import BOOT, FLASH_PAGE, Plan
from m512.errors import BoardError, NoAnswerError, RefusedError

PROMPT = b"\r\n - "
DUMP_BYTES = 128
DUMP_AHEAD = 4           # dumps asked for in advance; 2 bytes each of the loader's 255
TRIES = 3
GAP_PAGES = 6            # equal pages written along rather than starting another download (0.5 s)
CHUNK = 1024
EEPROM_PIECE = 64
_DUMP_LINE = re.compile(rb"\r\n ([0-9A-F]{8}) : ((?:[0-9A-F]{2} ){16})")
_REPORT = re.compile(rb"(Success|Error).*Rewriting:0X([0-9A-F]{4}).*Size:0X([0-9A-F]{8})  Checksum:([0-9A-F]{2})-([0-9A-F]{2})",
                     re.S)

Progress = Callable[[int, int], None]


class FactoryLoader:
    name = "factory boot loader"
    board = ""            # it does not say

    def __init__(self, link: Link):
        self.link = link
        self.retries = 0
        self.to_prompt()

    def to_prompt(self) -> None:
        """A clean line: backspace (keeps a line of 80 characters from crashing it), CR, prompt."""
        for _ in range(TRIES):
            self.link.drain()
            self.link.write(b"\x08\r")
            if self.link.look_for(PROMPT, 1.0)[1]:
                self.link.drain(0.02)
                return
        raise NoAnswerError("the boot loader does not answer any more. Press MODE and repeat the command; "
                            "it goes on where it stopped")

    def command(self, line: str, seconds: float = 2.0) -> bytes:
        """A line's answer, up to the prompt."""
        self.link.write(line.encode() + b"\r")
        return self.link.read_until(PROMPT, seconds, f"`{line}` to the boot loader")

    # Reading

    def _dump(self, word: str, start: int, end: int, modulo: int, progress: Optional[Progress]) -> bytes:
        """Memory by dumps of 128 bytes, a few asked for ahead."""
        first = start - start % DUMP_BYTES
        out, tries = bytearray(), 0
        while first + len(out) < end:
            at = first + len(out)
            count = (end - at + DUMP_BYTES - 1) // DUMP_BYTES
            try:
                for piece in self._dumps(word, at, count, modulo):
                    out += piece
                    tries = 0
                    if progress:
                        progress(min(first + len(out), end) - start, end - start)
            except NoAnswerError:
                tries += 1
                self.retries += 1
                if tries == TRIES:
                    raise
                self.to_prompt()
        return bytes(out[start - first:end - first])

    def _dumps(self, word: str, at: int, count: int, modulo: int):
        asked = 0
        for done in range(count):
            while asked < min(count, done + DUMP_AHEAD):
                self.link.write((f"{word} {at:x}" if asked == 0 else word).encode() + b"\r")
                asked += 1
            text = self.link.read_until(PROMPT, 2.0, f"a dump of 0x{at:X}")
            lines = _DUMP_LINE.findall(text)
            wanted = [(at + done * DUMP_BYTES + 16 * k) % modulo for k in range(DUMP_BYTES // 16)]
            if [int(address, 16) for address, _ in lines] != wanted:
                self.link.drain(0.2, 3)
                raise NoAnswerError(f"the dump of 0x{at + done * DUMP_BYTES:X} came damaged")
            yield b"".join(bytes.fromhex(data.decode()) for _, data in lines)

    def read(self, start: int, end: int, progress: Optional[Progress] = None) -> bytes:
        return self._dump("f", start, end, 0x20000, progress)

    def read_eeprom(self, start: int = 0, end: int = 4096, progress: Optional[Progress] = None) -> bytes:
        return self._dump("e", start, end, 0x1000, progress)

    def different(self, pages: Dict[int, bytes], progress: Optional[Progress] = None) -> List[int]:
        """Which of these pages the board holds otherwise."""
        out, done = [], 0
        for address, data in Plan(pages).runs(list(pages)):
            before = done
            found = self.read(address, address + len(data),
                              progress and (lambda n, _: progress(before + n // FLASH_PAGE, len(pages))))
            for at in range(0, len(data), FLASH_PAGE):
                if found[at:at + FLASH_PAGE] != data[at:at + FLASH_PAGE]:
                    out.append((address + at) // FLASH_PAGE)
            done += len(data) // FLASH_PAGE
        return out

    # Writing

    def write(self, pages: Dict[int, bytes], progress: Optional[Progress] = None,
              around: Optional[Dict[int, bytes]] = None) -> int:
        """Writes these pages. `around`: pages known to be there already, which may be written along."""
        plan = Plan({**(around or {}), **pages})
        runs = plan.runs(list(pages), GAP_PAGES)
        total, done = sum(len(data) for _, data in runs), 0
        for address, data in runs:
            before = done
            self._load(address, data, progress and (lambda n: progress((before + n) // FLASH_PAGE, total // FLASH_PAGE)))
            done += len(data)
        return 0

    def _load(self, address: int, data: bytes, progress: Optional[Callable[[int], None]]) -> None:
        if address % FLASH_PAGE or len(data) % FLASH_PAGE or address + len(data) > BOOT[0] or not data:
            raise RefusedError(f"a download to 0x{address:X} of {len(data)} bytes would hurt")    # our own mistake
        trouble = ""
        for _ in range(TRIES):
            trouble = self._load_once(address, data, progress)
            if not trouble:
                return
            self.retries += 1
            self.to_prompt()
        raise BoardError(f"download to 0x{address:05X}: {trouble}, {TRIES} times")

    def _load_once(self, address: int, data: bytes, progress: Optional[Callable[[int], None]]) -> str:
        """One download; what went wrong, or nothing."""
        self.link.write(f"load {address:x}\r".encode())
        ready = self.link.read_until(b"Ready..", 2.0, "`load` to the boot loader")
        if f"Write Address : {address:08X}".encode() not in ready:
            # Nothing was sent yet. Only silence or a reset leaves `Ready..` here.
            raise BoardError("the boot loader took another address than it was given. Press MODE and repeat the command")
        for at in range(0, len(data), CHUNK):
            self.link.write(data[at:at + CHUNK], wait=False)
            if progress:
                progress(at)
        self.link.write(b"")
        text, ended = self.link.look_for(PROMPT, 3.0 + len(data) / 4000)
        report = _REPORT.search(text)
        if not ended or not report:
            return "no report came after it"
        size, total, last = int(report.group(3), 16), int(report.group(4), 16), int(report.group(5), 16)
        if size != len(data):
            return f"{len(data) - size} of {len(data)} bytes were lost on the line"
        if total != sum(data[:-1]) & 0xFF or last != data[-1]:
            return "the sum does not fit"
        return ""

    def write_eeprom(self, cells: Dict[int, int], progress: Optional[Progress] = None) -> None:
        done = 0
        for at, data in _runs(cells):
            self.link.write(f"eep_dn {at:x} {len(data):x}\r".encode())
            self.link.read_until(b"Ready", 2.0, "`eep_dn` to the boot loader")
            self.link.write(data)
            self.link.read_until(PROMPT, 2.0 + 0.02 * len(data), "the end of an EEPROM write")
            done += len(data)
            if progress:
                progress(done, len(cells))

    # The end

    def leave(self, to: int = 0) -> None:
        """0 stay at the prompt, 1 start the application (and at every start from now on), 2 reset."""
        if to == 1:
            self.command("app")
            self.link.write(b"go\r")
            self.link.read_until(b"Jump Address", 2.0, "`go` to the boot loader")
        elif to == 2:
            self.link.write(b"reset\r")


def _runs(cells: Dict[int, int]) -> List[Tuple[int, bytes]]:
    out: List[Tuple[int, bytearray]] = []
    for at in sorted(cells):
        if out and at == out[-1][0] + len(out[-1][1]) and len(out[-1][1]) < EEPROM_PIECE:
            out[-1][1].append(cells[at])
        else:
            out.append((at, bytearray([cells[at]])))
    return [(at, bytes(data)) for at, data in out]
