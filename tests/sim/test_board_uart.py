# SPDX-License-Identifier: MIT
"""UARTs of the simulated chip: times, flags, overrun, wrong rates, gates. Sources: data sheet, USART; BOARD.md."""

import struct

import pytest

from cm5sim import Board
from cm5sim.library import build_folder
from tests.sim.lab_board import Lab

RXC, FE, DOR = 0x80, 0x10, 0x08


@pytest.mark.parametrize("count", [1, 2, 7, 100])
def test_characters_of_ten_bits_leave_back_to_back_and_txc_comes_once(count):
    """1 Mbit/s with U2X set after UBRR: 160 cycles a character, plus interrupt response and loop exit."""
    time, interrupts = Lab().do("u", 0, count)
    assert time - 160 * count in range(0, 90)
    assert interrupts == 1


def test_transmitter_works_after_txen_was_toggled():
    lab = Lab()
    assert lab.do("u", 0, 3)[1] == 1
    assert lab.do("u", 0, 3)[1] == 1


def test_console_rate_is_57143_and_a_byte_is_heard_when_its_stop_bit_has_passed():
    lab = Lab()
    lab.send(b"c\0\0\0\0\0")
    lab.run_to("put", ms=10)
    start = lab.now_cycles
    counts = []
    for _ in range(4 * 2800 // 20 + 20):
        lab.run(cycles=20)
        counts.append(len(lab.console))
    first = start + 20 * (counts.index(1) + 1)
    last = start + 20 * (counts.index(4) + 1)
    assert first - start == pytest.approx(2800, abs=60), "10 bits of 280 cycles"
    assert last - first == pytest.approx(3 * 2800, abs=40)


def test_line_brings_characters_at_the_rate_of_the_pc():
    lab = Lab()
    start = lab.now_cycles
    lab.send(b"x" * 5)
    while lab.waiting:
        lab.run(cycles=16)
    assert lab.now_cycles - start == pytest.approx(5 * 10 * 16_000_000 / 57_600, abs=40)


def received(rate, data, lab=None):
    """(UCSR1A, UDR1) of two characters sent at `rate`, while command i waits for them."""
    lab = lab or Lab()
    lab.send(b"i" + struct.pack("<I", 0)[:3] + b"\0\0", wait=True)
    lab.run(ms=1)
    lab.baud(rate)
    lab.send(data, wait=True)
    lab.baud(57_600)
    first, second = lab.answer()
    return [(value & 0xFF, value >> 8) for value in (first, second)]


@pytest.mark.parametrize("rate", [57_143, 57_600, 56_000, 58_500])
def test_rates_within_three_percent_are_understood(rate):
    flags = received(rate, b"U\x00")
    assert [byte for _, byte in flags] == [0x55, 0x00]
    assert all(status & (FE | DOR) == 0 and status & RXC for status, _ in flags)


@pytest.mark.parametrize("rate", [38_400, 54_000, 55_200, 59_100, 61_000, 115_200])
def test_other_rates_give_framing_errors(rate):
    lab = Lab()
    flags = received(rate, b"\x00\xff\x00\xff" if rate > 100_000 else b"\x00\xff", lab)
    assert flags[0][0] & FE
    assert lab.uart(1).framing > 0


def test_half_rate_shows_each_bit_twice():
    """0xFE at 28,571: start and bit 0 are low for four receiver bits, which read as start, 0, 0, 0, then ones."""
    assert received(28_571, b"\xfe\xfe")[0][1] == 0b11111000


def test_overrun_keeps_the_two_oldest_and_the_newest():
    """While an EEPROM byte is written (8.5 ms) the receiver is not read. Of five characters, those that are left form the start of command
    "n": read EEPROM 0x0234."""
    lab = Lab()
    lab.allow("uart-overrun")
    lab.eeprom[0x0234] = 0x77
    lab.send(b"m" + struct.pack("<I", 0x10)[:3] + b"\x01\x00" + b"n\x34\x98\x99\x02", wait=True)
    assert lab.answer()[0] > 0, "of m"
    lab.send(b"\0\0\0")
    assert lab.answer()[0] == 0x77
    assert lab.uart(1).overruns == lab.violations("uart-overrun") == 2


@pytest.mark.parametrize("begins, lost", [(-1000, 1), (+400, 0)])
def test_third_character_is_lost_at_the_start_bit_of_the_fourth(begins, lost):
    """Three characters wait while an EEPROM byte is written. The second byte of the answer arrives when the first of them is read. A fourth
    character that has begun by then costs one, even if it ends later."""

    def lab_with_three():
        lab = Lab()
        lab.allow("uart-overrun")
        lab.send(b"m" + struct.pack("<I", 0x10)[:3] + b"\x01\x00" + b"abc")
        return lab

    lab = lab_with_three()
    lab.run(ms=8)
    while len(lab.console) < 2:
        lab.run(cycles=10)
    read_at = lab.now_cycles
    lab = lab_with_three()
    while lab.waiting:
        lab.run(cycles=10)
    lab.run(cycles=read_at + begins - lab.now_cycles)
    lab.send(b"d", wait=True)
    assert lab.uart(1).overruns == lost


def test_character_that_has_begun_before_the_receiver_is_on_is_not_heard():
    board = Board(images=[build_folder() / "firmware" / "lab" / "lab.hex"])
    board.run_to("main", ms=10)
    while not board.pin("D5"):  # the gate is open; the receiver is on three writes later
        board.run(cycles=1)
    board.send(b"c" + bytes(6), wait=True)
    assert (board.uart(1).deaf, board.uart(1).received) == (1, 6)


def test_gates_let_pc_and_remote_in():
    lab = Lab()
    assert lab.do("c")[0] == 1
    lab.do("p", 0x32, 0x40)  # PORTD: PD6 alone, the remote
    before = lab.uart(1).deaf
    lab.send(b"c" * 6, wait=True)
    assert lab.uart(1).deaf == before + 6
    lab.remote(b"c\0\0\0\0\0")
    assert lab.answer()[0] == 1


def test_cm2_has_no_gates():
    lab = Lab(kind="cm2")
    lab.do("p", 0x32, 0x00)
    assert lab.do("c")[0] == 1


NOISE = b"\x01\x02\x03\x04\x05\x06"


def noise_heard(kind, port_e):
    """How many of six bytes on the servo bus reach UART0 at these levels of port E."""
    lab = Lab(kind=kind, servos=[1])
    lab.do("u", 0, 2)  # sets UART0 up
    lab.do("p", 0x2A, 0x10)
    lab.do("p", 0x23, port_e)
    lab.servos.noise(NOISE)
    lab.run(ms=1)
    return lab.uart(0).received


@pytest.mark.parametrize("kind, port_e, heard", [("cm5", 0x08, 6), ("cm5", 0x00, 0), ("cm2", 0x00, 6), ("cm2", 0x04, 0)])
def test_direction_pins_decide_what_is_heard(kind, port_e, heard):
    assert noise_heard(kind, port_e) == heard


def test_byte_that_began_before_the_board_listened_is_garbage():
    """Noise and UART0 at 57,143 bit/s; the command that raises PE3 takes effect in the middle of the first byte."""
    lab = Lab(servos=[1])
    lab.do("u", 0, 2)
    lab.do("p", 0x29, 34)  # UBRR0L
    lab.do("p", 0x2A, 0x10)
    lab.send(b"p\x23\0\0\x08\0")
    while lab.waiting > 1:
        lab.run(cycles=10)
    lab.run(cycles=1500)
    lab.servos.noise(NOISE, rate=57_143)
    lab.run(ms=3)
    counts = lab.uart(0)
    assert (counts.received, counts.framing) == (6, 1)
