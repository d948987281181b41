# SPDX-License-Identifier: MIT
"""The block protocol of firmware/boot/BLOCK_PROTOCOL.md: every command, damage, speed."""

import random
import struct

import pytest

from cm5sim import PowerCut
from tests.sim.boot_board import (
    BAD_FRAME,
    BOOT_MODE,
    EE_WRITE,
    EQUAL,
    HELLO,
    LEAVE,
    OK,
    PLAIN_APP,
    PROMPT,
    RATE,
    READ,
    REFUSED,
    SUMS,
    WRITE,
    Blocks,
    crc16,
    frame,
    noise,
    page_body,
    prompt_board,
    say,
)

LINE_RATE = 2_000_000 / 35 / 10


@pytest.fixture
def board():
    return prompt_board()


@pytest.fixture
def blocks(board):
    return Blocks(board)


def test_frames_of_the_manual(board):
    board.flash[0 : len(PLAIN_APP)] = PLAIN_APP
    board.send(bytes.fromhex("A5010100C89D"))
    board.run(ms=20)
    assert board.take() == bytes.fromhex("5A0101010001EAF8")


def test_hello_says_whether_there_is_an_application(board, blocks):
    assert blocks.ask(HELLO) == (OK, 0, b"")
    board.flash[0 : len(PLAIN_APP)] = PLAIN_APP
    assert blocks.ask(HELLO) == (OK, 1, b"")


def test_read_flash(board, blocks):
    board.flash[0x0000:0x0100] = noise(256)
    for page in (0, 0xDF, 0x1E0, 0x1FF):
        assert blocks.ask(READ, page_body(page)) == (OK, 0, bytes(board.flash[256 * page : 256 * page + 256])), page


def test_read_eeprom_and_call_table(board, blocks):
    board.eeprom[0x300:0x400] = noise(256)
    assert blocks.ask(READ, page_body(0x8103))[2] == bytes(board.eeprom[0x300:0x400])
    table = blocks.ask(READ, page_body(0x1FF))[2][0xE0:]
    assert table[:10] == b"M5BL\x01\x01\x7f\x00\x00\x01"
    assert table[12:14] == b"\x0c\x94", "JMP"


def test_read_the_last_page_of_ram(board, blocks):
    status, _, data = blocks.ask(READ, page_body(0x8010))
    assert status == OK and data[:64] == bytes(board.ram[0x1000:0x1040])


def test_write_and_its_status(board, blocks):
    data = noise(256)
    before = bytes(board.flash)
    assert blocks.ask(WRITE, page_body(0x70, data))[0] == OK
    assert blocks.ask(WRITE, page_body(0x70, data))[0] == EQUAL
    assert board.wear(0x70) == 1
    after = bytes(board.flash)
    assert after[0x7000:0x7100] == data and after[:0x7000] == before[:0x7000] and after[0x7100:] == before[0x7100:]


def test_boot_section_and_beyond_are_refused(board, blocks):
    before = bytes(board.flash)
    for page in (0x1E0, 0x1FF, 0x200, 0x8000, 0xFFFF):
        assert blocks.ask(WRITE, page_body(page, noise(256)))[0] == REFUSED, page
    assert bytes(board.flash) == before


def test_write_that_does_not_stick_is_reported(board, blocks):
    board.lock(0xFB)
    assert blocks.ask(WRITE, page_body(0x70, noise(256)))[0] == 3


def test_sums(board, blocks):
    data = noise(64 * 256)
    board.flash[0xE000 : 0xE000 + len(data)] = data
    for i, (crc, total) in enumerate(blocks.sums(0xE0, 64)):
        page = data[256 * i : 256 * i + 256]
        assert (crc, total) == (crc16(page), sum(page) & 0xFFFF)


@pytest.mark.parametrize(
    "command, body",
    [
        (SUMS, struct.pack("<HH", 0, 65)),
        (EE_WRITE, struct.pack("<HH", 0, 33) + bytes(34)),
        (EE_WRITE, struct.pack("<HH", 0x1000, 4) + noise(4)),
        (EE_WRITE, struct.pack("<HH", 0xFFE, 3) + noise(4)),
        (EE_WRITE, struct.pack("<HH", 0xFE1, 32) + noise(32)),
        (EE_WRITE, struct.pack("<HH", 0x8000, 1) + noise(2)),
        (EE_WRITE, struct.pack("<HH", 0xFFFF, 2) + noise(2)),
        (EE_WRITE, struct.pack("<HH", 0xFFF0, 32) + noise(32)),
        (RATE, page_body(8)),
        (RATE, page_body(0)),
        (WRITE, page_body(0x70, bytes(254))),
        (READ, page_body(0x8011)),
        (READ, page_body(0x80FF)),
        (99, b""),
        (0, b""),
    ],
)
def test_bad_requests_are_refused(board, blocks, command, body):
    before = bytes(board.flash), bytes(board.eeprom)
    assert blocks.ask(command, body)[0] == REFUSED
    assert (bytes(board.flash), bytes(board.eeprom)) == before


def test_sums_and_pages_past_the_end_begin_again(board, blocks):
    board.flash[0:256] = noise(256, 4)
    assert blocks.sums(0x1FF, 2)[1] == (crc16(noise(256, 4)), sum(noise(256, 4)) & 0xFFFF)
    assert blocks.ask(READ, page_body(0x200))[2] == noise(256, 4)
    assert blocks.sums(0xFFFF, 1)


def test_eeprom_write(board, blocks):
    data = noise(32)
    assert blocks.ask(EE_WRITE, struct.pack("<HH", 0x123, 32) + data)[0] == OK
    assert bytes(board.eeprom[0x123:0x143]) == data
    assert blocks.ask(EE_WRITE, struct.pack("<HH", BOOT_MODE, 1) + b"\x11\x00")[0] == OK
    assert board.eeprom[BOOT_MODE] == 0x11
    wear = board.eeprom_wear(0x123)
    blocks.ask(EE_WRITE, struct.pack("<HH", 0x123, 32) + data)
    assert board.eeprom_wear(0x123) == wear


def test_eeprom_is_written_up_to_its_last_byte(board, blocks):
    assert blocks.ask(EE_WRITE, struct.pack("<HH", 0xFE0, 32) + noise(32))[0] == OK
    assert bytes(board.eeprom[0xFE0:]) == noise(32)
    before = bytes(board.eeprom)
    assert blocks.ask(EE_WRITE, struct.pack("<HH", 0x1000, 0))[0] == OK
    assert bytes(board.eeprom) == before


def test_read_of_the_registers_tells_which_button_is_down(board, blocks):
    pine = 0x21
    assert blocks.ask(READ, page_body(0x8000))[2][pine] & 0xF0 == 0xF0
    board.press("DOWN")
    board.run(ms=20)
    assert blocks.ask(READ, page_body(0x8000))[2][pine] & 0xF0 == 0xD0


def test_leave_to_the_prompt(board, blocks):
    assert blocks.ask(LEAVE, page_body(0))[0] == OK
    board.run(ms=20)
    assert blocks.heard + board.take() == PROMPT.encode()
    assert say(board, "app").endswith("Application")


def test_leave_to_the_application(board, blocks):
    board.flash[0 : len(PLAIN_APP)] = PLAIN_APP
    assert blocks.ask(LEAVE, page_body(1))[0] == OK
    board.run(ms=100)
    assert board.pc < 0x100


def test_leave_by_reset(board, blocks):
    assert blocks.ask(LEAVE, page_body(2))[0] == OK
    board.expect("SYSTEM O.K.", ms=500)
    assert board.reset_cause == "watchdog"


def test_four_seconds_of_silence_leave(board, blocks):
    blocks.ask(HELLO)
    board.run(ms=3900)
    assert board.take() == b""
    board.expect(PROMPT, ms=300)


def test_someone_typing_leaves(board, blocks):
    blocks.ask(HELLO)
    board.send("x" * 1200)
    board.expect(PROMPT, ms=1000)


@pytest.mark.parametrize("spoil", [1, 2, 3, 100, 262, 263])
def test_a_damaged_frame_writes_nothing_and_the_next_one_works(board, blocks, spoil):
    blocks.ask(HELLO)
    before = bytes(board.flash)
    damaged = bytearray(frame(WRITE, 9, page_body(0x70, b"\x11" * 256)))
    damaged[spoil] ^= 0x40
    board.send(damaged)
    board.run(ms=400)
    assert bytes(board.flash) == before
    blocks.heard = b""
    said = board.take()
    assert said[:1] == b"\x5a" and said[4] == BAD_FRAME
    assert blocks.ask(HELLO)[0] == OK


def test_a_count_above_the_largest_is_bad_at_once(board, blocks):
    blocks.ask(HELLO)
    for words in (130, 255):
        board.send(bytes([0xA5, WRITE, 1, words]))
        board.run(ms=20)
        assert board.take()[4] == BAD_FRAME, words


def test_a_lost_byte_costs_the_frame_that_it_swallows(board, blocks):
    """And the one behind it, whose answer comes as if nothing had been."""
    blocks.ask(HELLO)
    board.send(frame(WRITE, 9, page_body(0x70, bytes(256)))[:-1] + frame(HELLO, 10) + frame(HELLO, 11))
    board.run(ms=200)
    heard = board.take()
    assert heard[4] == BAD_FRAME and heard[-7:-5] == bytes([HELLO, 11])


def test_a_first_frame_that_is_bad_is_silent(board):
    damaged = bytearray(frame(HELLO, 9))
    damaged[-1] ^= 1
    board.send(damaged)
    board.run(ms=200)
    assert board.take() == PROMPT.encode()


def test_a_frame_cut_short_is_bad_after_100_ms(board, blocks):
    blocks.ask(HELLO)
    board.send(frame(WRITE, 9, page_body(0x70, bytes(256)))[:100])
    board.run(ms=300)
    assert board.take()[4] == BAD_FRAME
    assert blocks.ask(HELLO)[0] == OK


def test_rate_and_back(board, blocks):
    assert blocks.ask(RATE, page_body(16))[0] == OK
    board.run(ms=2)
    board.baud(117647)
    assert blocks.ask(HELLO)[0] == OK
    assert blocks.ask(RATE, page_body(34))[0] == OK
    board.run(ms=2)
    board.baud(57600)
    assert blocks.ask(HELLO)[0] == OK


def test_rate_that_nobody_follows_falls_back(board, blocks):
    blocks.ask(RATE, page_body(16))
    board.run(ms=4500)
    board.take()
    assert blocks.ask(HELLO)[0] == OK


def test_noise_on_the_line_costs_time_but_no_page(board, blocks):
    """One byte in 2,000 is damaged: pages without an answer are resent until all are written."""
    rng = random.Random(5)
    data = noise(16 * 256, 3)
    todo = set(range(16))
    for _ in range(20):
        for page in sorted(todo):
            raw = bytearray(frame(WRITE, page, page_body(0xE0 + page, data[256 * page : 256 * page + 256])))
            for i in range(len(raw)):
                if rng.random() < 1 / 2000:
                    raw[i] ^= 1 << rng.randrange(8)
            board.send(raw)
        board.run(ms=1200)
        heard = board.take()
        todo -= {page for page in todo if any(frame_found in heard for frame_found in answers(page))}
        if not todo:
            break
    assert not todo
    assert bytes(board.flash[0xE000 : 0xE000 + len(data)]) == data


def answers(page):
    for status in (0, 1):
        content = bytes([WRITE, page, 1, status, 0])
        yield b"\x5a" + content + crc16(content).to_bytes(2, "big")


@pytest.mark.parametrize("operation", [7])
def test_a_transfer_is_resumed_after_a_power_cut(operation):
    board = prompt_board()
    data = noise(16 * 256, 13)
    board.cut_power(operation, "during", tear=operation)
    with pytest.raises(PowerCut):
        Blocks(board).update(0xE0, data)
    board.flush()
    board.power_on()
    board.expect(PROMPT, ms=600)
    written = Blocks(board).update(0xE0, data)
    assert bytes(board.flash[0xE000 : 0xE000 + len(data)]) == data
    assert written <= 16 - (operation - 1) // 2
    assert all(board.wear(0xE0 + i) == 1 for i in range((operation - 1) // 2)), "what was done is not done again"


def transfer(board, data, rate):
    blocks = Blocks(board)
    blocks.ask(HELLO)
    if rate != 57600:
        blocks.ask(RATE, page_body(16))
        board.run(ms=2)
        board.baud(rate)
    start = board.now_ms
    written = blocks.update(0xE0, data)
    seconds = (board.now_ms - start) / 1000
    assert bytes(board.flash[0xE000 : 0xE000 + len(data)]) == data
    return seconds, written


def test_speed():
    """16 KiB of motions: within 5 % of the line rate; at the faster rate; an unchanged image in less than a tenth."""
    data = noise(16384, 11)
    line = len(data) / LINE_RATE
    board = prompt_board()
    fresh, written = transfer(board, data, 57600)
    same, unwritten = transfer(board, data, 57600)
    fast, _ = transfer(prompt_board(), data, 117647)
    print(
        f"16 KiB: {fresh:.2f} s at 57,600 ({fresh / line - 1:+.1%} of the line's {line:.2f} s), unchanged {same:.2f} s "
        f"({same / fresh:.1%}), {fast:.2f} s at 117,647"
    )
    assert (written, unwritten) == (64, 0)
    assert fresh < line * 1.05
    assert same < fresh * 0.10
    assert fast < fresh * 0.6
    assert board.uart(1).overruns == 0


def test_text_in_damaged_frames_is_never_typed():
    """On a line that damages every frame, the contents stay data, no matter how many frames come."""
    board = prompt_board()
    blocks = Blocks(board)
    blocks.ask(HELLO)
    eeprom = bytes(board.eeprom[0:0x1000])
    text = (b"\rclear_eeprom\ry\rload 0\r" * 12)[:256]
    for _ in range(12):
        spoilt = bytearray(frame(WRITE, 9, page_body(0x100, text)))
        spoilt[100] ^= 1
        board.send(bytes(spoilt), wait=True)
    board.run(ms=300)
    assert b"Command" not in board.take() and bytes(board.eeprom[0:0x1000]) == eeprom
    assert Blocks(board).ask(HELLO)[0] == OK
