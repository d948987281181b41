# SPDX-License-Identifier: MIT
"""Shared by the boot loader tests: a board that waits at the prompt, typed lines, downloads in the original's format, and a client of the
block protocol written from firmware/boot/BLOCK_PROTOCOL.md."""

import binascii
import collections
import itertools
import pathlib
import random
import re
import struct

from intelhex import IntelHex

from cm5sim import Board, library
from m512.crc16 import crc16

PROMPT = "\r\n - "
PLAIN_APP = b"\xff\xcf" + bytes(0x8E)  # `rjmp .`, without a record (app_record.h)
MEMORY_MAP = pathlib.Path(__file__).parents[2] / "linker" / "memory_map.h"
MAP = {name: int(value, 0) for name, value in re.findall(r"#define (MEM_\w+) (\w+)", MEMORY_MAP.read_text())}
APP_END, JOURNAL_START = MAP["MEM_APP_END"], MAP["MEM_JOURNAL_START"]
BOOT_START = 0x1E000
BOOT_MODE = 0xFFF


def new_board(*images, kind="cm5", **options):
    board = Board(kind=kind, images=[f"boot-{kind}.hex", *images], **options)
    board.skip_waits()
    return board


def prompt_board(*images, **options):
    """A board with the loader at its first prompt (an erased EEPROM means "system")."""
    board = new_board(*images, **options)
    board.expect(PROMPT, ms=400)
    return board


def noise(count, seed=1):
    return random.Random(seed).randbytes(count)


def say(board, line, ms=3000):
    """Types a line. Returns the output up to the next prompt, without echo and prompt."""
    board.send(line + "\r")
    text = board.expect(PROMPT, ms=ms)
    return text[len(line) : -len(PROMPT)]


def load(board, address, data, sum_byte=None, ms=30000):
    """Downloads data as the original's tools do. Returns the fields of the answer."""
    begin_load(board, address)
    board.send(bytes(data) + bytes([sum(data) & 0xFF if sum_byte is None else sum_byte]))
    return end_load(board, ms)


def begin_load(board, address):
    board.send(f"load {address:x}\r")
    board.expect(f"\r\n Write Address : {address:08X}\r\n Ready..")


def end_load(board, ms=30000):
    text = board.expect(PROMPT, ms=ms)
    match = re.fullmatch(
        r"(Success|Error)\r\n Rewriting:0X([0-9A-F]{4})\r\n Size:0X([0-9A-F]{8})  Checksum:"
        r"([0-9A-F]{2})-([0-9A-F]{2})\r\n - ",
        text,
    )
    assert match, text
    return match[1], int(match[2], 16), int(match[3], 16), int(match[4], 16), int(match[5], 16)


def pending_record(board, page, data):
    """Writes a journal slot as a power cut right after its record leaves it (firmware/common/journal.h)."""
    record = struct.pack("<2sHBBH", b"MJ", 5, page, 1, crc16(data))
    record += crc16(record).to_bytes(2, "little") + b"\xff\xff"
    board.flash[JOURNAL_START : JOURNAL_START + 512] = data
    board.flash[JOURNAL_START + 512 : JOURNAL_START + 512 + len(record)] = record


FACTORY_USED, FACTORY_SUM, FACTORY_CRC = 0x1B90, 0x000B2F60, 0x7406


def factory_section():
    """8 KiB with the imitated routine. The free bytes are filled so that sum and CRC identify the factory loader. For
    Board(images=[application], bootrst=True).flash[0x1E000:0x20000]."""
    code = IntelHex(str(library.build_folder() / "firmware" / "tests" / "factory.hex"))
    section = bytearray(code.tobinarray(start=BOOT_START, size=0x2000))
    free = [i for i in range(FACTORY_USED) if BOOT_START + i not in set(code.addresses())]
    left = FACTORY_SUM - sum(section[i] for i in range(FACTORY_USED) if i not in set(free))
    for place, i in enumerate(free):
        section[i] = left // (len(free) - place)
        left -= section[i]
    head = binascii.crc_hqx(bytes(section[: FACTORY_USED - 6]), 0xFFFF)
    tail = bytes(section[FACTORY_USED - 6 : FACTORY_USED])
    for x, y, z in itertools.product(range(-40, 41), repeat=3):
        changed = bytes(byte + step for byte, step in zip(tail, (x, -x, y, -y, z, -z)))
        if binascii.crc_hqx(changed, head) == FACTORY_CRC:
            section[FACTORY_USED - 6 : FACTORY_USED] = changed
            return bytes(section)
    raise AssertionError("no filling found")


HELLO, RATE, READ, WRITE, SUMS, EE_WRITE, LEAVE = range(1, 8)
OK, EQUAL, REFUSED, BROKEN, BAD_FRAME = range(5)


def frame(command, number, body=b""):
    content = bytes([command, number, len(body) // 2]) + body
    return b"\xa5" + content + crc16(content).to_bytes(2, "big")


def page_body(page, data=b""):
    return struct.pack("<H", page) + data


class Blocks:
    """The PC's side of the block protocol on a simulated board."""

    def __init__(self, board):
        self.board, self.number, self.heard = board, 0, b""

    def send(self, command, body=b""):
        self.number = (self.number + 1) & 0xFF
        self.board.send(frame(command, self.number, body))
        return self.number

    def answer(self, ms=1000):
        """(command, number, status, detail, data) of the next answer."""
        end = self.board.now_ms + ms
        while self.board.now_ms < end:
            self.heard += self.board.take()
            start = self.heard.find(b"\x5a")
            if start >= 0 and len(self.heard) >= start + 4:
                size = 4 + 2 * self.heard[start + 3] + 2
                if len(self.heard) >= start + size:
                    whole, self.heard = self.heard[start + 1 : start + size], self.heard[start + size :]
                    assert crc16(whole) == 0, whole.hex()
                    return whole[0], whole[1], whole[3], whole[4], whole[5:-2]
            self.board.run(ms=0.5)
        raise AssertionError(f"no answer; heard {self.heard.hex()}")

    def ask(self, command, body=b"", ms=1000):
        """(status, detail, data) of the answer to one request."""
        number = self.send(command, body)
        got = self.answer(ms)
        assert got[:2] == (command, number), got
        return got[2:]

    def sums(self, first, count):
        status, _, data = self.ask(SUMS, struct.pack("<HH", first, count), ms=3000)
        assert status == OK
        return [struct.unpack_from("<HH", data, 4 * i) for i in range(count)]

    def update(self, first, data, window=2, pages_a_sum=4):
        """Writes `data` to flash from page `first` on, but only pages that differ. Requests the sums of the next pages between the WRITEs,
        so that the line is never idle. Returns the number of pages written."""
        pages = [data[i : i + 256] for i in range(0, len(data), 256)]
        chunks = collections.deque(range(0, len(pages), pages_a_sum))

        def next_sums():
            if chunks:
                start = chunks.popleft()
                yield SUMS, start, struct.pack("<HH", first + start, min(pages_a_sum, len(pages) - start))

        queue = collections.deque(next_sums())
        flying, written = collections.deque(), 0
        while queue or flying:
            while queue and [command for command, _, _ in flying].count(WRITE) < window:
                flying.append(queue.popleft())
                self.send(flying[-1][0], flying[-1][2])
            command, start, body = flying.popleft()
            got, _, status, _, answer = self.answer(3000)
            assert got == command and status == OK
            if command == WRITE:
                written += 1
                continue
            queue.extend(next_sums())
            for i in range(len(answer) // 4):
                page = pages[start + i]
                if struct.unpack_from("<HH", answer, 4 * i) != (crc16(page), sum(page) & 0xFFFF):
                    queue.append((WRITE, start + i, page_body(first + start + i, page)))
        return written
