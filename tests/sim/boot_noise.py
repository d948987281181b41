# SPDX-License-Identifier: MIT
"""Noise for the boot loader at the prompt, in STK500 sessions and in block sessions. It must not hang, violate a rule of the board, or
write without a valid command.

    figures = fuzz(make, seed, count)     make: one of MAKERS; raises AssertionError or Violation
"""

import random
from typing import NamedTuple

from tests.sim.boot_board import PROMPT, WRITE, frame, page_body, prompt_board, say

CHUNK = 8192
# The loader prints one of these before it writes. Without one in this chunk or the one before, nothing may change. (Three bytes of noise
# are enough for a valid command: CR l CR.)
LICENCES = (b"Write Address", b" Mode", b"Boot to", b"Clearing", b"Sure?")


def shell_noise(rng, count):
    return rng.randbytes(count)


WORDS = (b"help f flash e eep r ram verify v check id up eep_up clear_eeprom x # 0x 0 1 e000 ffffffff 12345678 zz , / \t - * up0 100").split(b" ")


def shell_words(rng, count):
    """Typed words that write nothing without a confirmation, with noise between them."""
    text = bytearray()
    while len(text) < count:
        kind = rng.random()
        if kind < 0.6:
            text += rng.choice(WORDS) + b" "
        elif kind < 0.9:
            text += rng.choice([b"\r", b"\n", b"\r\n", b"\x1b", b"\x08", b"n"])
        elif kind < 0.95:
            text += rng.randbytes(rng.randrange(1, 30))
        else:
            text += rng.choice([b"#", b"a", b" ", b"0"]) * rng.randrange(1, 300)
    return bytes(text[:count])


def stk_noise(rng, count):
    """Broken STK500 sessions: valid commands with wrong ends and lengths, no ENTER."""
    data = bytearray()
    while len(data) < count:
        data += b"\r0 " if rng.random() < 0.3 else b""
        command = rng.choice(b"\x30\x41\x42\x45\x51\x52\x55\x56\x64\x74\x75" + rng.randbytes(2))
        data += bytes([command]) + rng.randbytes(rng.randrange(6)) + rng.choice([b" ", b"!", b""])
    return bytes(data[:count])


def block_noise(rng, count):
    """Frames, each damaged in one to three bits so that the CRC detects it; some are followed by a valid HELLO."""
    data = bytearray()
    while len(data) < count:
        body = page_body(rng.randrange(0x1E0), rng.randbytes(256)) if rng.random() < 0.3 else rng.randbytes(2 * rng.randrange(8))
        good = bytearray(frame(WRITE if len(body) == 258 else rng.randrange(10), rng.randrange(256), body))
        where = rng.sample(range(1, len(good)), min(3, len(good) - 1))
        for i in where[: rng.randrange(1, 4)]:
            good[i] ^= 1 << rng.randrange(8)
        data += good
        if rng.random() < 0.1:
            data += frame(1, 1)
    return bytes(data[:count])


def bring_back(board):
    """Silence ends every session and transfer; after it the prompt must answer."""
    board.run(ms=17000)
    board.send(b"\x1b")
    board.run(ms=400)
    board.send(b"n\r")
    board.run(ms=3000)
    board.take()
    board.send(b"\x08" * 80 + b"\r")
    board.expect(PROMPT, ms=2000)
    board.run(ms=50)
    board.take()
    assert "app=" in say(board, "id")


MAKERS = (shell_noise, shell_words, stk_noise, block_noise)


class Figures(NamedTuple):
    sent: int
    licensed: int  # chunks that happen to contain a valid writing command
    resets: int
    seconds: float  # simulated
    headroom: int


def fuzz(make, seed, count):
    rng = random.Random(f"{make.__name__} {seed}" if seed else make.__name__)
    board = prompt_board()
    before = b""
    flash, eeprom, licensed, sent = bytes(board.flash), bytes(board.eeprom), 0, 0
    resets = board.resets
    while sent < count:
        data = make(rng, min(CHUNK, count - sent))
        board.send(data)
        while board.waiting:
            board.run(ms=20)
        board.run(ms=150)
        sent += len(data)
        said = board.take()
        if (bytes(board.flash), bytes(board.eeprom)) != (flash, eeprom):
            assert any(licence in before + said for licence in LICENCES), "written without a valid command"
            licensed += 1
            flash, eeprom = bytes(board.flash), bytes(board.eeprom)
        before = said
    bring_back(board)
    assert board.resets == resets or make is not block_noise
    return Figures(sent, licensed, board.resets - resets, board.now_ms / 1000, board.stack_headroom)
