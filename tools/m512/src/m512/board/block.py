# SPDX-License-Identifier: MIT
"""The PC's side of our boot loader's block protocol (firmware/boot/BLOCK_PROTOCOL.md).

Frames are 0xA5 command number n body[2 n] CRC-16. Answers have 0x5A, and their body starts with a status. Requests that change nothing
may be repeated freely. A write may be repeated too, because it carries the same page again. Two writes are outstanding at a time, so that
the line is never idle.
"""

from __future__ import annotations

import re
from collections import deque

from m512 import ui
from m512.board.link import BAUD, Link
from m512.board.memory import FLASH_PAGE
from m512.crc16 import crc16
from m512.errors import BoardError, NoAnswerError
from m512.files.page import EMPTY
from m512.ui import Progress, unseen

REQUEST, ANSWER = 0xA5, 0x5A
HELLO, RATE, READ, WRITE, SUMS, EE_WRITE, LEAVE = range(1, 8)
OK, EQUAL, REFUSED, BROKEN, BAD_FRAME, BAD_COMMAND = range(6)
STATUS = {
    REFUSED: "refused (outside of what may be written)",
    BROKEN: "the flash does not take the data. If a second try does not help either, it is worn out",
    BAD_FRAME: "damaged on the line",
    BAD_COMMAND: "not known to this loader",
}
APP_STATES = {0: "none", 1: "unknown kind", 2: "good", 3: "damaged"}
SILENT = "the boot loader does not answer any more. Check the cable, then "
WINDOW = 2  # outstanding writes
TRIES = 4
ANSWER_SECONDS = 1.5
FAST_RATE, FAST_UBRR = 117647, 16
NOT_FAST = "note: the fast rate does not work here; going on at 57,600"
SUMS_MAX = 64
EEPROM_PAGE, EE_WRITE_MAX = 0x8100, 32  # EEPROM is read as flash pages from this number on
BACK_SECONDS = 4.2  # the loader ends a session, and its rate, after 4 s without a byte
# The first HELLO then contains no byte that is a key of an editor, in case an editor listens instead of the loader.
FIRST_NUMBER = 159
STAY, START, RESET = range(3)  # leave(), of the factory loader too: at the prompt, start the application, reset the board
IDENTITY = re.compile(r"ID Motion512 boot (\S+) (\S+) ")


def frame(command: int, number: int, body: bytes) -> bytes:
    inner = bytes([command, number, len(body) // 2]) + body
    return bytes([REQUEST]) + inner + crc16(inner).to_bytes(2, "big")


def page_sum(page: bytes) -> tuple[int, int]:
    """The answer of SUMS for a flash page: its CRC-16 and its plain 16-bit sum."""
    return crc16(page), sum(page) & 0xFFFF


class BlockLoader:
    """A session with our loader. leave() ends it."""

    name = "Motion512 boot loader"
    was_at_prompt = False  # whether it was at its prompt before this program came

    def __init__(self, link: Link, identity: str = "", tries: int = 2, seconds: float = ANSWER_SECONDS):
        self.link, self.number, self.rate = link, FIRST_NUMBER, BAUD
        self.retries = self.detail = 0
        # The loader's identity from its prompt, or empty: "ID Motion512 boot 1.00 CM5 api=1 ..."
        words = IDENTITY.search(identity)
        self.version, self.board = (words.group(1), words.group(2).lower()) if words else ("", "")
        self._ask(HELLO, b"", tries, seconds)

    def app_state(self) -> str:
        """The loader's verdict on the application: none, unknown kind (no record), good, damaged."""
        self._ask(HELLO, b"")
        return APP_STATES.get(self.detail, str(self.detail))

    # Frames

    def _send(self, command: int, body: bytes) -> int:
        self.number = (self.number + 1) & 0xFF
        self.link.write(frame(command, self.number, body))
        return self.number

    def _receive(self, seconds: float) -> tuple[int, int, int, bytes] | None:
        """(command, number, status, data) of the next valid answer, or None if none arrives in time."""
        deadline = self.link.now() + seconds
        while True:
            left = deadline - self.link.now()
            some = self.link.read_some(left, 1) if left > 0 else b""
            if not some:  # silence, or data without an answer in it
                return None
            if some[0] != ANSWER:
                continue
            head = self._piece(3)
            if len(head) < 3:  # the line went silent inside a frame
                continue
            body, end = self._piece(2 * head[2]), self._piece(2)
            if len(end) == 2 and len(body) == 2 * head[2] >= 2 and crc16(head + body) == int.from_bytes(end, "big"):
                self.detail = body[1]
                return head[0], head[1], body[0], body[2:]

    def _piece(self, count: int) -> bytes:
        out = b""
        while len(out) < count:
            some = self.link.read_some(0.2, count - len(out))
            if not some:
                break
            out += some
        return out

    def _ask(self, command: int, body: bytes, tries: int = TRIES, seconds: float = ANSWER_SECONDS, may_go: bool = False) -> bytes:
        """Sends a request and returns the data of its answer. Repeats it when nothing or a damaged frame arrives, and once more at the
        usual rate if the fast one spoils it. NoAnswerError, BoardError. may_go: the loader may have gone when nothing arrives; then there
        is no data."""
        status = None
        for attempt in range(tries):
            self.retries += attempt > 0
            number = self._send(command, body)
            answer = self._receive(seconds)
            while answer and answer[2] != BAD_FRAME and (answer[0], answer[1]) != (command, number):
                answer = self._receive(seconds)  # a late answer to an earlier request
            if answer is None:
                self.link.drain()
                if may_go and self._has_gone():
                    return b""
                continue
            status = answer[2]
            if status in (OK, EQUAL):
                return answer[3]
            if status != BAD_FRAME:
                raise BoardError(f"the loader says: {STATUS.get(status, status)}", status)
        if self._gives_up_fast():
            return self._ask(command, body, tries, seconds, may_go)
        if status is None:
            raise NoAnswerError(SILENT + self.link.remedy)
        raise BoardError(f"the loader says: {STATUS[BAD_FRAME]}, {tries} times. Is the cable good?", status)

    # Rate

    def go_faster(self) -> bool:
        """Tries 117,647 baud; returns to the usual rate if that fails, now or later, and then says so. Returns whether it works now."""
        self._ask(RATE, FAST_UBRR.to_bytes(2, "little"))
        self.link.sleep(0.02)
        try:
            self.link.set_rate(FAST_RATE)
            self._ask(HELLO, b"", tries=2, seconds=0.3)
            self.rate = FAST_RATE
            return True
        except Exception:
            self.link.set_rate(BAUD)
            self.link.sleep(BACK_SECONDS)
            self.link.drain()
            self._ask(HELLO, b"")
            ui.say(NOT_FAST)
            return False

    def _gives_up_fast(self) -> bool:
        """Takes both ends from a fast rate that spoils too much back to the usual one, in a new session. False: it is the usual one
        already, or the loader does not answer at it either."""
        if self.rate == BAUD or self._has_gone():
            return False
        ui.say(NOT_FAST)
        return True

    # Flash and EEPROM

    def read(self, start: int, end: int, progress: Progress = unseen) -> bytes:
        """Memory bytes [start, end). Flash pages with the sums of an empty page are not transferred."""
        first, last = start // FLASH_PAGE, (end - 1) // FLASH_PAGE
        known = self._known(first, last) if last < EEPROM_PAGE and last > first + 4 else {}
        out = bytearray()
        for page in range(first, last + 1):
            out += known.get(page) or self._ask(READ, page.to_bytes(2, "little"))
            progress(page - first + 1, last - first + 1)
        return bytes(out[start - first * FLASH_PAGE : end - first * FLASH_PAGE])

    def _known(self, first: int, last: int) -> dict[int, bytes]:
        """The empty pages among these: erased flash, zeros, or half of an empty motion page."""
        plain = {page_sum(piece): piece for piece in (b"\xff" * FLASH_PAGE, bytes(FLASH_PAGE), EMPTY[:FLASH_PAGE], EMPTY[FLASH_PAGE:])}
        sums = self._sums(first, last - first + 1)
        return {page: plain[found] for page, found in sums.items() if found in plain}

    def _sums(self, first: int, count: int, progress: Progress = unseen) -> dict[int, tuple[int, int]]:
        out: dict[int, tuple[int, int]] = {}
        for at in range(first, first + count, SUMS_MAX):
            some = min(SUMS_MAX, first + count - at)
            data = self._ask(SUMS, at.to_bytes(2, "little") + some.to_bytes(2, "little"), seconds=3)
            if len(data) != 4 * some:
                raise NoAnswerError("the loader's answer to SUMS has the wrong length")
            for k in range(some):
                out[at + k] = (int.from_bytes(data[4 * k : 4 * k + 2], "little"), int.from_bytes(data[4 * k + 2 : 4 * k + 4], "little"))
            progress(at + some - first, count)
        return out

    def different(self, pages: dict[int, bytes], progress: Progress = unseen) -> list[int]:
        """Returns those of these pages that differ on the board."""
        if not pages:
            return []
        sums = self._sums(min(pages), max(pages) - min(pages) + 1, progress)
        return [number for number in sorted(pages) if sums[number] != page_sum(pages[number])]

    def write(self, pages: dict[int, bytes], progress: Progress = unseen) -> None:
        """Writes these pages, in this order; the loader reads each back."""
        waiting = deque(pages)
        under_way: dict[int, int] = {}
        failures: dict[int, int] = {}
        done = 0
        while waiting or under_way:
            while waiting and len(under_way) < WINDOW:
                page = waiting.popleft()
                under_way[self._send(WRITE, page.to_bytes(2, "little") + pages[page])] = page
            answer = self._receive(ANSWER_SECONDS)
            if answer is None or answer[2] == BAD_FRAME or answer[0] != WRITE or answer[1] not in under_way:
                if answer is not None and answer[2] != BAD_FRAME:
                    continue
                # Something was lost: collect the outstanding answers, then repeat the writes without acknowledgement.
                done += self._collect(under_way)
                for page in sorted(under_way.values()):
                    failures[page] = failures.get(page, 0) + 1
                if max(failures.values(), default=0) > TRIES:
                    if self._gives_up_fast():
                        failures.clear()
                    elif answer is None:
                        raise NoAnswerError(SILENT + self.link.remedy)
                    else:
                        raise BoardError("the line damages too much: no page comes through. Is the cable good?")
                self.retries += 1
                waiting.extendleft(sorted(under_way.values(), reverse=True))
                under_way.clear()
                continue
            page = under_way.pop(answer[1])
            if answer[2] not in (OK, EQUAL):
                raise BoardError(f"0x{page * FLASH_PAGE:05X}: {STATUS.get(answer[2], answer[2])}", answer[2])
            done += 1
            progress(done, len(pages))

    def _collect(self, under_way: dict[int, int]) -> int:
        """Takes the writes that are acknowledged now out of `under_way`. Returns how many."""
        before = len(under_way)
        while (answer := self._receive(0.3)) is not None:
            if answer[0] == WRITE and answer[1] in under_way and answer[2] in (OK, EQUAL):
                under_way.pop(answer[1])
        return before - len(under_way)

    def read_eeprom(self, start: int = 0, end: int = 4096, progress: Progress = unseen) -> bytes:
        base = EEPROM_PAGE * FLASH_PAGE
        return self.read(base + start, base + end, progress)

    def write_eeprom(self, cells: dict[int, int], progress: Progress = unseen) -> None:
        """Writes single bytes, by address."""
        done = 0
        for at, data in pieces(cells, EE_WRITE_MAX):
            body = at.to_bytes(2, "little") + len(data).to_bytes(2, "little") + data + bytes(len(data) % 2)
            self._ask(EE_WRITE, body)
            done += len(data)
            progress(done, len(cells))

    # The end

    def leave(self, to: int = STAY) -> None:
        """Ends the session."""
        self._ask(LEAVE, to.to_bytes(2, "little"), may_go=to != STAY)
        self._slow_down()

    def _slow_down(self) -> bool:
        """Sets the usual rate. Returns whether it was another."""
        was_fast = self.rate != BAUD
        if was_fast:
            self.link.set_rate(BAUD)
            self.rate = BAUD
        return was_fast

    def _has_gone(self) -> bool:
        """Whether the loader answers no more. An application may listen by now, so the question is that of the beginning."""
        if self._slow_down():
            self.link.sleep(BACK_SECONDS)
            self.link.drain()  # what the loader has sent at the other rate
        self.number = FIRST_NUMBER
        try:
            self._ask(HELLO, b"", tries=1)
        except NoAnswerError:
            return True
        return False


def pieces(cells: dict[int, int], most: int, alone: bytes = b"") -> list[tuple[int, bytes]]:
    """Runs of neighbouring bytes, at most `most` long. Each byte in `alone` is a run of its own."""
    out: list[tuple[int, bytearray]] = []
    for at, value in sorted(cells.items()):
        start, run = out[-1] if out else (-1, bytearray())
        if run and at == start + len(run) and len(run) < most and value not in alone and run[-1] not in alone:
            run.append(value)
        else:
            out.append((at, bytearray([value])))
    return [(at, bytes(data)) for at, data in out]
