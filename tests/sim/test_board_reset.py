# SPDX-License-Identifier: MIT
"""Resets, watchdog, panel and battery of the simulated board. Sources: data sheet, Reset Sources and Watchdog; BOARD.md."""

import struct

import pytest

from cm5sim import Board, Violation
from tests.sim.lab_board import Lab

POWER_ON, EXTERNAL, BROWN_OUT, WATCHDOG = 1, 2, 4, 8


def test_cause_of_each_reset_is_told_and_noinit_ram_is_kept():
    lab = Lab()
    assert lab.do("c") == (POWER_ON, 1)
    lab.reset()
    lab.run(ms=1)
    assert lab.do("c") == (EXTERNAL, 2)
    lab.brown_out()
    lab.run(ms=1)
    assert lab.do("c") == (BROWN_OUT, 3)
    lab.power_off()
    lab.run(ms=10)
    lab.power_on()
    lab.run(ms=1)
    assert lab.do("c") == (POWER_ON, 1)
    assert lab.resets == 4 and lab.reset_cause == "power-on"


@pytest.mark.parametrize("prescaler, ms", [(0, 14), (3, 112), (5, 448)])
def test_watchdog_bites_in_time_and_is_off_afterwards(prescaler, ms):
    lab = Lab()
    lab.send(b"x\0\0\0" + bytes([prescaler, 0]))
    while lab.waiting:
        lab.run(cycles=100)
    start, resets = lab.now_ms, lab.resets
    while lab.resets == resets:
        lab.run(ms=0.1)
    assert lab.now_ms - start == pytest.approx(ms, rel=0.02, abs=0.5)
    assert lab.reset_cause == "watchdog"
    lab.run(ms=1000)
    assert lab.resets == resets + 1, "off after the reset"
    assert lab.do("c")[0] == WATCHDOG
    assert lab.do("q", 0x41)[0] == 0, "WDTCR"


def test_bootrst_decides_where_a_reset_starts():
    with pytest.raises(Violation, match="erased at cycle 0, pc 0x00000"):
        Lab(bootrst=False)
    assert Lab(bootrst=True).do("c")[0] == POWER_ON


def test_held_in_reset_nothing_runs():
    lab = Lab()
    lab.press("MODE")
    lab.send(b"c\0\0\0\0\0", wait=True)
    lab.run(ms=50)
    assert lab.console == b"" and lab.pin("D5") is None
    lab.release("MODE")
    lab.run(ms=1)
    assert lab.do("c")[0] == EXTERNAL


def test_leds_light_when_their_pin_is_low():
    lab = Lab()
    assert lab.leds == set()
    lab.do("p", 0x35, 0xBF)  # PORTC
    lab.do("p", 0x34, 0x7F)  # DDRC
    assert lab.leds == {"play"}
    lab.do("p", 0x35, 0x7E)
    assert lab.leds == {"power"}


def test_buttons_pull_their_pin_to_ground():
    lab = Lab()
    lab.do("p", 0x23, 0xF0)  # PORTE: pull-ups
    lab.do("p", 0x32, 0x61)  # PORTD
    for button, register, bit in (("UP", 0x21, 4), ("DOWN", 0x21, 5), ("LEFT", 0x21, 6), ("RIGHT", 0x21, 7), ("START", 0x30, 0)):
        assert lab.do("q", register)[0] >> bit & 1
        lab.press(button)
        lab.run(ms=5)
        assert not lab.do("q", register)[0] >> bit & 1
        lab.release(button)
        lab.run(ms=5)


# Pull-up on PD0, then a loop: each change of PIND bit 0 increments r19, which is stored at 0x200.
COUNT_EDGES = [0xE001, 0xBB02, 0xE021, 0xE030, 0xB310, 0x7011, 0x1712, 0xF3E1, 0x2F21, 0x9533, 0x9330, 0x0200, 0xCFF7]


def edges(board, act, ms):
    """Number of contact changes of START within `ms` after `act`."""
    before = board.ram[0x200]
    act("START")
    board.run(ms=ms)
    return board.ram[0x200] - before & 0xFF


def counting_board():
    board = Board()
    board.flash[0 : 2 * len(COUNT_EDGES)] = struct.pack(f"<{len(COUNT_EDGES)}H", *COUNT_EDGES)
    board.ram[0x200] = 0
    board.run(ms=20)
    board.ram[0x200] = 0
    return board


def test_contacts_bounce_for_5_ms():
    board, counts = counting_board(), []
    for act in [board.press, board.release] * 10:
        counts.append(edges(board, act, 5.1))
        assert edges(board, lambda _: None, 20) == 0, "steady behind that"
    assert all(count % 2 and 5 <= count <= 49 for count in counts), counts
    assert len(set(counts)) > 3, "not always the same"


def test_bounce_can_be_switched_off_and_made_short():
    board = counting_board()
    board.bounce(0)
    assert edges(board, board.press, 10) == 1
    board.bounce(0.3)
    assert edges(board, board.release, 0.31) in (1, 3)
    assert edges(board, lambda _: None, 10) == 0


def test_battery_is_read_through_the_divider():
    lab = Lab()
    for volts in (9.6, 11.1):
        lab.battery(volts)
        lab.do("p", 0x27, 0x00)  # ADMUX: AREF (5 V), ADC0
        lab.do("p", 0x26, 0xC7)  # ADCSRA: on, start, clock / 128
        lab.run(ms=1)
        value = lab.do("q", 0x24)[0] | lab.do("q", 0x25)[0] << 8
        assert value * 5 / 1024 / 0.25 == pytest.approx(volts, abs=0.03)
