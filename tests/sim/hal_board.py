# SPDX-License-Identifier: MIT
"""The programs of hal/ on the simulated board, for test_hal*.py: hal_walker.c (31 joints forever) and hal_words.c (one-byte commands)."""

import struct

from cm5sim import Board

LINE_BYTES_PER_S = 2_000_000 / 35 / 10


def pattern(count, seed=1):
    """Bytes of all values, the same each time."""
    out = bytearray()
    for _ in range(count):
        seed = (seed * 1103515245 + 12345) & 0x7FFFFFFF
        out.append(seed >> 16 & 0xFF)
    return bytes(out)


def word(board, name, count=2):
    address = board.variable(name)
    return int.from_bytes(bytes(board.ram[address : address + count]), "little")


def bus_counts(board):
    """bus_counts_t as a dict."""
    names = ("packets", "answers", "timeouts", "checksums", "framing", "overruns", "wrong_ids", "lengths", "rejected", "retries", "strays")
    address = board.variable("walker_bus")
    return dict(zip(names, struct.unpack("<IIHHHHHHHHH", bytes(board.ram[address : address + 26]))))


def walker(kind="cm5", servos=range(31), deaf=(), table=()):
    """A walking robot. deaf: IDs of DX-117, which ignore SYNC WRITE; table: (address, value) written to all servos."""
    board = Board(kind=kind, images=[f"tests/hal_walker_{kind}.hex"], servos=servos)
    for number in deaf:
        board.servos.add(number, model="dx117", rate=1_000_000)
    for address, value in table:
        for servo in board.servos:
            servo.write(address, [value])
    board.expect("walking", ms=3000)
    board.run(ms=100)
    return board


def words():
    board = Board(images=["tests/hal_words.hex"])
    board.expect("start 00000001")
    return board
