# SPDX-License-Identifier: MIT
"""The power is cut at every flash and EEPROM operation of every kind of download, before, during (torn contents) and after
it: the loader always answers afterwards, and what the transfer did not name is untouched."""

import struct

import pytest

from cm5sim import PowerCut
from tests.sim.boot_board import (
    BOOT_MODE,
    BOOT_START,
    EE_WRITE,
    JOURNAL_START,
    PROMPT,
    WRITE,
    begin_load,
    crc16,
    frame,
    noise,
    page_body,
    pending_record,
    prompt_board,
    say,
)

ENTER = b"\x50\x20"


def stk_page(address, data, kind=b"F"):
    return b"\x55" + (address // 2).to_bytes(2, "little") + b"\x20\x64" + len(data).to_bytes(2, "big") + kind + data + b"\x20"


def raw(line, data):
    """A word whose data follow it; the pause lets the loader say that it is ready."""

    def send(board):
        board.send(line)
        if data:
            board.pause(100)
            board.send(data)

    return send


def sum_byte(data):
    return data + bytes([sum(data) & 0xFF])


# Name -> what to send, flash ranges and EEPROM addresses that it names.
LOAD_RECORD = range(0xFF6, 0xFFF)
TRANSFERS = {
    "load, unaligned, three pages": (raw("load e080\r", sum_byte(noise(600, 1))), [(0xE000, 0xE300)], LOAD_RECORD),
    "load of an application": (raw("load 0\r", sum_byte(noise(512, 2))), [(0, 0x200)], LOAD_RECORD),
    "load over a pending journal page": (
        raw("load e200\r", sum_byte(noise(256, 3))),
        [(JOURNAL_START, JOURNAL_START + 0x300), (0xE000, 0xE300)],
        LOAD_RECORD,
    ),
    "eep_dn": (raw("eep_dn 100 6\r", noise(6, 4)), [], range(0x100, 0x106)),
    "clear_eeprom": (raw("clear_eeprom 200 6\r", b""), [], range(0x200, 0x206)),
    "app": (raw("app\r", b""), [], [0xFFF]),
    "STK500 flash": (raw("0 ", ENTER + stk_page(0xE000, noise(256, 5)) + stk_page(0xE100, noise(128, 6))), [(0xE000, 0xE200)], []),
    "STK500 EEPROM": (raw("0 ", ENTER + stk_page(0x300, noise(6, 7), b"E")), [], range(0x300, 0x306)),
    "blocks": (
        raw(frame(1, 1), frame(WRITE, 2, page_body(0xE0, noise(256, 8))) + frame(WRITE, 3, page_body(0xE1, noise(256, 9)))),
        [(0xE000, 0xE200)],
        [],
    ),
    "blocks, EEPROM": (raw(frame(1, 1), frame(EE_WRITE, 2, struct.pack("<HH", 0x400, 6) + noise(6, 10))), [], range(0x400, 0x406)),
}


def make_board(name):
    board = prompt_board()
    board.flash[0x0000:0x0400] = noise(0x400, 20)
    board.flash[0xE000:0xE500] = noise(0x500, 21)
    board.eeprom[0x000:0x800] = noise(0x800, 22)
    if "journal" in name:
        pending_record(board, 0, noise(512, 23))
    return board


def untouched(before, after, ranges):
    last = 0
    for start, end in ranges:
        if before[last:start] != after[last:start]:
            return False
        last = end
    return before[last:] == after[last:]


@pytest.mark.parametrize("name", TRANSFERS)
def test_cut_at_every_operation(name):
    send, ranges, eeprom_addresses = TRANSFERS[name]
    cuts = 0
    for phase in ("before", "during", "after"):
        for operation in range(1, 60):
            board = make_board(name)
            flash, eeprom = bytes(board.flash), bytes(board.eeprom)
            board.cut_power(operation, phase, tear=operation)
            send(board)
            try:
                board.run(ms=1200)
                break
            except PowerCut:
                cuts += 1
            board.flush()
            board.power_on()
            board.take()
            board.run(ms=30)
            board.send("#")
            board.expect(PROMPT, ms=600)
            assert "app=" in say(board, "id")
            assert untouched(flash, bytes(board.flash), ranges)
            after = bytes(board.eeprom)
            assert all(after[i] == eeprom[i] for i in range(0x1000) if i not in eeprom_addresses)
            assert bytes(board.flash[BOOT_START:]) == flash[BOOT_START:]
        else:
            pytest.fail("the transfer never ends")
    print(f"{name}: {cuts} power cuts")
    assert cuts >= 3


def recorded(seed):
    """1 KiB that says of itself what our applications do (firmware/common/app_record.h)."""
    image = b"\x0c\x94\x46\x00" + noise(0x88, seed) + b"M512\x00\x04\x00\x00\xff\xff" + noise(0x36A, seed + 1)
    return image[:0x94] + crc16(image).to_bytes(2, "little") + image[0x96:]


def test_an_application_torn_in_its_first_page_is_not_started():
    """A torn first page has lost its record, and with it what told it from an application that never had one."""
    refused = 0
    for operation in (1, 2):
        for tear in range(12):
            board = prompt_board()
            board.flash[0x0000:0x0400] = recorded(30)
            board.eeprom[BOOT_MODE] = 0x11
            assert say(board, "id").endswith("app=good")
            begin_load(board, 0)
            board.send(sum_byte(recorded(40)[:256]))
            board.cut_power(operation, "during", tear=tear)
            with pytest.raises(PowerCut):
                board.run(ms=500)
            board.flush()
            board.take()
            if bytes(board.flash[:0x400]) == recorded(30):
                continue
            board.power_on()
            board.expect(PROMPT, ms=600)
            assert say(board, "id").rsplit("=", 1)[1] in ("bad", "none")
            refused += 1
    assert refused >= 20
