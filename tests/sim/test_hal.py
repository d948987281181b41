# SPDX-License-Identifier: MIT
"""The rest of the hal and the shared part of the firmware on the simulated board: time, panel, flash, EEPROM, resets. The
bus is in test_hal_bus.py, the serial line in test_hal_console.py."""

import pytest

from cm5sim import Board
from m512.crc16 import crc16
from tests.sim.hal_board import pattern, walker, word, words

TICK = 125_000


# ---- time ----


def test_tick_is_exact_over_ten_seconds_and_none_is_missed():
    board = walker(servos=range(1, 19))
    board.run_to("__vector_12", ms=20)
    start, ticks = board.now_cycles, word(board, "walker_ticks")
    board.run(cycles=1279 * TICK + TICK // 2)
    board.run_to("__vector_12", ms=20)
    assert board.now_cycles - start == 1280 * TICK
    assert word(board, "walker_ticks") - ticks == 1280
    assert word(board, "walker_missed") == 0
    assert word(board, "walker_late", 1) == 0


# ---- panel ----


def test_buttons_count_after_three_ticks():
    board = walker(servos=[1])
    board.press("UP")
    board.run(ticks=1)
    assert word(board, "walker_buttons", 1) == 0
    board.run(ticks=4)
    assert word(board, "walker_buttons", 1) == 1
    board.press("START")
    board.release("UP")
    board.run(ticks=5)
    assert word(board, "walker_buttons", 1) == 16


def test_pins_are_safe_from_the_start():
    board = walker(servos=[1])
    assert board.leds == {"power"}
    assert board.pin("B5") == 1  # charger off
    assert board.pin("D4") == 1  # ZigBee module not in reset
    assert (board.pin("D5"), board.pin("D6")) == (1, 1)


def test_adc_reads_the_battery_pin():
    board = words()
    board.battery(9.6)
    board.send("v")
    board.expect("adc ")
    assert int(board.expect("\n").split()[0], 16) == pytest.approx(9.6 * 0.25 / 5 * 1024, abs=2)


# ---- flash ----


def test_far_reads_cross_64_kib():
    board = words()
    data = pattern(512)
    board.flash[0x0FF20:0x10120] = data
    backwards = b"".join(data[at : at + 64] for at in range(448, -1, -64))  # one block crosses the border
    board.send("f")
    board.expect(f"flash {crc16(backwards):08X}")


def test_all_pages_are_checked_in_under_200_ms(capsys):
    board = words()
    page = bytearray(512)
    page[22], page[20] = 32, 1
    page[31] = 0xFF - sum(page) & 0xFF
    for number in (0, 15, 16, 127):
        board.flash[0xE000 + 512 * number : 0xE200 + 512 * number] = page
    start = board.now_ms
    board.send("p")
    board.expect(f"pages {4:08X}")
    took = board.now_ms - start
    with capsys.disabled():
        print(f"\nhal: 128 pages checked in {took:.0f} ms")
    assert took < 200


# ---- EEPROM ----


def test_eeprom_is_read_behind_a_write_and_beyond_256():
    board = words()
    board.eeprom[0x7A5:0x7A6] = b"\x11"
    board.eeprom[0x0A5:0x0A6] = b"\x22"
    board.send("e")
    board.expect("eeprom 00000012 00000022", ms=100)
    assert (board.eeprom[0x7A5], board.eeprom[0x0A5]) == (0x12, 0x22)


# ---- resets ----


def test_application_takes_over_from_the_boot_loader():
    """The loader hands over with both UARTs on and receive interrupts enabled (boot/ORIGINAL.md, 5)."""
    board = Board(images=["boot-cm5.hex", "tests/hal_walker_cm5.hex"], servos=range(1, 19))
    board.eeprom[0xFFF:0x1000] = b"\x11"  # start the application
    board.send("typed too early")
    board.expect("walking", ms=3000)
    board.run(ms=500)
    assert word(board, "walker_missed") == 0
    assert word(board, "walker_bytes", 4) == 0
    assert word(board, "walker_faults", 1) == 0


def test_hang_ends_in_a_watchdog_reset_that_is_named():
    board = words()
    board.send("w")
    board.expect("start 00000008", ms=1500)


def test_restart_comes_within_30_ms():
    board = words()
    board.send("r", wait=True)
    start = board.now_ms
    board.expect("start 00000008")
    assert board.now_ms - start < 40


def test_failed_assert_is_told_after_the_restart():
    board = words()
    board.send("a")
    board.expect("start 00000008")
    board.expect("assert ")
    line, address = (int(value, 16) for value in board.expect("\n").split())
    assert 100 < line < 300
    assert board.function_at(address) in ("main", "obey")


def test_reset_causes():
    board = words()
    board.reset()
    board.expect("start 00000002")
    board.brown_out()
    board.expect("start ", ms=2000)
    assert int(board.expect("\n").split()[0], 16) & 4
