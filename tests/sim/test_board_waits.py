# SPDX-License-Identifier: MIT
"""skip_waits(): a board that skips the rounds of waiting loops behaves to the cycle like one that executes them."""

import random

import pytest

from cm5sim import Board


def state(board):
    return board.now_cycles, board.pc, board.resets, bytes(board.ram[0:0x1100])


class Pair:
    """Two boards with the same inputs; the second one skips waits."""

    def __init__(self, *images, **options):
        self.boards = [Board(images=images, **options) for _ in range(2)]
        self.boards[1].skip_waits()

    def both(self, act):
        for board in self.boards:
            act(board)

    def run(self, cycles):
        self.both(lambda board: board.run(cycles=cycles))
        assert state(self.boards[0]) == state(self.boards[1])

    def same_memories(self):
        one, other = self.boards
        assert one.console == other.console and one.packets == other.packets
        assert bytes(one.flash[0:0x20000]) == bytes(other.flash[0:0x20000])
        assert bytes(one.eeprom[0:0x1000]) == bytes(other.eeprom[0:0x1000])


@pytest.mark.parametrize("seed", range(2))
def test_loader_with_bytes_buttons_and_frames_by_chance(seed):
    chance, pair = random.Random(seed), Pair("boot-cm5.hex")
    words = [
        b"id\r",
        b"flash 0\r",
        b"#",
        b"app\r",
        b"sys\r",
        b"load 2000\r" + bytes(range(200)),
        b"eep_dn 10 3\rabc",
        b"\x08\r",
        b"load e000\r",
        bytes(300),
        b"\xa5\x01\x01\x00\xc8\x9d",
        b"l 1dfff\r",
        b"reset\r",
    ]
    for _ in range(100):
        what = chance.randrange(8)
        if what < 5:
            data = chance.choice(words) if what < 4 else chance.randbytes(chance.randrange(1, 20))
            pair.both(lambda board, data=data: board.send(data))
        elif what < 7:
            button = chance.choice(("START", "MODE", "UP"))
            pair.both(lambda board, press=what == 5, button=button: (board.press if press else board.release)(button))
        pair.run(round(10 ** chance.uniform(0, 6.2)))
    pair.same_memories()


@pytest.mark.parametrize("image", ["play-cm5.hex", "edit-cm5.hex"])
def test_applications_behind_the_loader(image):
    pair = Pair("boot-cm5.hex", image, servos=range(1, 19))
    pair.both(lambda board: board.eeprom.__setitem__(0xFFF, 0x11))
    for ms in (3, 80, 400, 700):
        pair.run(16000 * ms + 7)
    pair.both(lambda board: board.send("help\r"))
    pair.run(16000 * 500)
    pair.same_memories()
