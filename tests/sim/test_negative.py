# SPDX-License-Identifier: MIT
"""Each check of the board detects its wrong program and accepts the right variant (sources: negative/)."""

import pathlib

import pytest

from cm5sim import Board, Violation
from cm5sim.library import build_folder

PAGE = 0x4000 // 256

# program: (violation, function in which it happens)
EXPECTED = {
    "spm_place": ("spm-place", "erase_from_here"),
    "spm_sequence_boot": ("spm-sequence", "late_erase"),
    "spm_busy_boot": ("spm-busy", "fill_while_busy"),
    "spm_eeprom_boot": ("spm-eeprom", "start_while_eeprom_writes"),
    "spm_eeprom_fill_boot": ("spm-eeprom", "start_while_eeprom_writes"),
    "eeprom_spm_boot": ("spm-eeprom", None),  # in avr-libc's eeprom_write_byte
    "rww_fetch_boot": ("rww-fetch", None),
    "rww_vector_boot": ("rww-fetch", None),
    "rww_read_boot": ("rww-read", "read_application"),
    "rww_elpm_boot": ("rww-read", "read_at_the_edge"),
    "flash_unerased_boot": ("flash-unerased", "write_word"),
    "flash_unerased_high_boot": ("flash-unerased", "write_word"),
    "flash_refill_boot": ("flash-refill", "fill_twice"),
    "flash_align_boot": ("flash-align", "write_unaligned"),
    "flash_worn_boot": ("flash-worn", "erase_once_more"),
    "eeprom_read_busy": ("eeprom-busy", "read_too_early"),
    "eeprom_write_busy": ("eeprom-busy", "write_two"),
    "eeprom_sequence": ("eeprom-sequence", "write_late"),
    "eeprom_worn": ("eeprom-worn", None),
    "uart_overrun": ("uart-overrun", "wait_for"),
    "uart_tx_full": ("uart-tx-lost", "send_three"),
    "uart_tx_moving": ("uart-tx-lost", "send_two"),
    "uart_tx_off": ("uart-tx-lost", "send_one"),
    "uart_format": ("uart-format", "set_format"),
    "uart_setup": ("uart-setup", "change_rate"),
    "uart_speed": ("uart-setup", "change_speed"),
    "bus_undriven": ("bus-undriven", "send"),
    "bus_both": ("bus-both", "turn_round"),
    "bus_released": ("bus-released", "send_packet"),
    "bus_overrun": ("bus-overrun", "ping"),
    "pullup": ("pullup", "read_buttons"),
    "charger": ("charger", "set_charger"),
    "pin_fight": ("pin-fight", "set_pins"),
    "stack": ("stack", "dig"),
    "stack_unset": ("stack-unset", None),
    "erased": ("erased", None),
    "illegal": ("illegal", "do_it"),
    "break": ("illegal", "stop_here"),
    "address": ("address", "store"),
    "interrupt_registers": ("interrupt-registers", "work"),
    "interrupt_flags": ("interrupt-registers", "work"),
    "sleep": ("sleep", "doze"),
    "sleep_mode": ("unmodelled", "doze"),
    "xdiv": ("unmodelled", "set_clock"),
    "watchdog_sequence": ("timed-sequence", "stop_watchdog"),
    "ivsel_sequence": ("timed-sequence", "move_vectors"),
    "watchdog_bite": ("unexpected-reset", "work"),
}


def start(name):
    """The program on a board prepared for it."""
    board = Board(images=[build_folder() / "firmware" / "negative" / f"{name}.hex"], servos=[1], seed=3)
    board.flash[0x100:0x102] = b"\x08\x95" if "rww_fetch" in name else board.flash[0x100:0x102]  # RET
    board.age(PAGE, 10000 if "worn" in name else 0)
    board.age(PAGE + 1, 9999)
    board.age_eeprom(0x123, 100000 if "worn" in name else 0)
    board.age_eeprom(0x124, 99999)
    board.forbid("unexpected-reset", "bus-overrun")
    return board


def run(board, name):
    if "uart_overrun" in name:
        board.expect("send\n", ms=50)
        board.send(b"four")
    return board.expect("right\n", ms=500)


@pytest.mark.parametrize("name", EXPECTED)
def test_wrong_program_is_stopped(name):
    kind, function = EXPECTED[name]
    with pytest.raises(Violation) as caught:
        run(start(f"wrong-{name}"), name)
    assert caught.value.kind == kind
    assert function in (None, caught.value.function), f"happened in {caught.value.function}"
    assert caught.value.text and 0 < caught.value.pc < 0x20000


@pytest.mark.parametrize("name", EXPECTED)
def test_right_program_passes(name):
    run(start(f"right-{name}"), name)


def test_every_wrong_program_is_listed():
    here = pathlib.Path(__file__).parent / "negative"
    assert {path.stem for path in here.glob("*.c")} == set(EXPECTED)
