# SPDX-License-Identifier: MIT
"""Flash and EEPROM of the simulated chip: times, bits, lock bits, wear, power cuts. Sources: BOARD.md, data sheet."""

import pytest

from cm5sim import PowerCut
from tests.sim.boot_board import Blocks, noise, prompt_board
from tests.sim.lab_board import MS_IN_EIGHT_CYCLES, PAGE, Lab

BOOT_PAGE = 0x1FD00  # in the boot section, not used by lab.c
FULL = bytes(range(256))


@pytest.mark.parametrize("letter", ["e", "w"])
def test_page_operations_take_4_5_ms_and_the_boot_section_goes_on(letter):
    time, turns = Lab().do(letter, PAGE)
    assert time / MS_IN_EIGHT_CYCLES == pytest.approx(4.5, abs=0.02)
    assert turns > 3000


@pytest.mark.parametrize("letter", ["e", "w"])
def test_cpu_stands_still_while_its_own_section_is_changed(letter):
    time, turns = Lab().do(letter, BOOT_PAGE)
    assert time / MS_IN_EIGHT_CYCLES == pytest.approx(4.5, abs=0.02)
    assert turns == 0


def test_rww_part_is_busy_until_it_is_enabled():
    lab = Lab()
    lab.do("e", PAGE)
    assert lab.do("q", 0x68)[0] & 0x40, "RWWSB"
    lab.do("r")
    assert lab.do("q", 0x68)[0] == 0
    assert lab.do("g", PAGE)[0] == 0xFF


def test_erase_sets_the_whole_page_that_z_points_into_and_no_other():
    lab = Lab()
    lab.flash[PAGE - 256 : PAGE + 512] = bytes(768)
    lab.do("e", PAGE + 0x37)
    assert lab.flash[PAGE - 256 : PAGE + 512] == bytes(256) + b"\xff" * 256 + bytes(256)


def test_programming_only_clears_bits_and_leaves_unfilled_words():
    lab = Lab()
    lab.allow("flash-unerased")
    lab.flash[PAGE : PAGE + 4] = b"\x0f\x0f\x55\xaa"
    lab.write_page(PAGE, b"\x3c\xf0")
    assert lab.flash[PAGE : PAGE + 4] == b"\x0c\x00\x55\xaa"


def test_page_buffer_is_empty_after_a_write():
    lab = Lab()
    lab.do("e", PAGE)
    lab.write_page(PAGE, b"\x12\x34")
    lab.do("e", PAGE + 256)
    lab.do("w", PAGE + 256)
    assert lab.flash[PAGE + 256 : PAGE + 258] == b"\xff\xff"


@pytest.mark.parametrize("reset", ["MODE", "power"])
def test_page_buffer_is_empty_after_a_reset(reset):
    """Data sheet, filling the temporary buffer: a system reset also erases it."""
    lab = Lab()
    lab.do("e", PAGE)
    lab.do("f", PAGE, 0x3412)
    if reset == "MODE":
        lab.reset()
    else:
        lab.power_off()
        lab.power_on()
    lab.run(ms=100)
    lab.do("w", PAGE)
    assert lab.flash[PAGE : PAGE + 2] == b"\xff\xff"


def test_far_pages_are_reached_and_wear_is_counted():
    lab = Lab()
    for _ in range(3):
        lab.do("e", 0x1DF00)
    assert lab.wear(0x1DF00 // 256) == 3
    assert lab.wear(PAGE // 256) == 0
    assert lab.operations == 3 and lab.operation(3) == ("erase", 0x1DF00)


def test_lock_bits_stop_spm_in_silence_and_are_never_set_back():
    lab = Lab()
    lab.flash[BOOT_PAGE : BOOT_PAGE + 2] = b"\x12\x34"
    assert lab.do("k", 1)[0] == 0xFF
    lab.do("l", 0, 0xEF)  # BLB11: no SPM into the boot section
    assert lab.do("k", 1)[0] == 0xEF
    time, turns = lab.do("e", BOOT_PAGE)
    assert time < 10 and lab.flash[BOOT_PAGE : BOOT_PAGE + 2] == b"\x12\x34"
    lab.do("l", 0, 0xFF)
    assert lab.do("k", 1)[0] == 0xEF
    lab.do("e", PAGE)
    assert lab.wear(PAGE // 256) == 1, "the application section is free"


def test_lock_bits_stop_lpm_across_the_sections():
    lab = Lab()
    lab.flash[PAGE : PAGE + 1] = b"\x42"
    assert lab.do("g", PAGE)[0] == 0x42
    lab.lock(0xF7)  # BLB02: no LPM from the boot section into the application
    assert lab.do("g", PAGE)[0] == 0xFF


def test_fuses_can_be_read():
    assert Lab().do("k", 3)[0] == 0xC0, "high: BOOTSZ 00 and BOOTRST programmed, EESAVE too"


def test_eeprom_byte_takes_8_5_ms():
    lab = Lab()
    time, _ = lab.do("m", 0x123, 0x45)
    assert time / MS_IN_EIGHT_CYCLES == pytest.approx(8.5, abs=0.02)
    assert lab.eeprom[0x123] == 0x45 and lab.do("n", 0x123)[0] == 0x45
    assert lab.eeprom_wear(0x123) == 1 and lab.operation(1) == ("eeprom", 0x123)


def cut(letter, phase, tear=0, seed=1, address=PAGE, value=0):
    """Page PAGE holds FULL; the power is cut during command `letter`. Returns the board without power."""
    lab = Lab(seed=seed)
    lab.flash[PAGE : PAGE + 256] = FULL
    lab.eeprom[0x123] = 0x5A
    if letter == "w":
        lab.flash[PAGE : PAGE + 256] = b"\xff" * 256
        for offset in range(0, 256, 2):
            lab.do("f", PAGE + offset, FULL[offset] | FULL[offset + 1] << 8)
    lab.cut_power(1, phase, tear)
    with pytest.raises(PowerCut):
        lab.do(letter, address, value)
    assert not lab.powered and lab.operations == 1
    return lab


def test_power_cut_before_and_after_an_operation_leaves_old_and_new():
    assert cut("e", "before").flash[PAGE : PAGE + 256] == FULL
    assert cut("e", "after").flash[PAGE : PAGE + 256] == b"\xff" * 256
    assert cut("w", "before").flash[PAGE : PAGE + 256] == b"\xff" * 256
    assert cut("w", "after").flash[PAGE : PAGE + 256] == FULL
    assert cut("m", "before", address=0x123, value=7).eeprom[0x123] == 0x5A
    assert cut("m", "after", address=0x123, value=7).eeprom[0x123] == 7


@pytest.mark.parametrize("tear", range(4))
def test_power_cut_during_an_operation_tears_the_page(tear):
    erased = cut("e", "during", tear + 400).flash[PAGE : PAGE + 256]
    assert erased != FULL and erased != b"\xff" * 256
    assert all(new & old == old for new, old in zip(erased, FULL)), "an erase sets bits"
    written = cut("w", "during", tear + 400).flash[PAGE : PAGE + 256]
    assert written != FULL and written != b"\xff" * 256
    assert all(new & wanted == wanted for new, wanted in zip(written, FULL)), "a write clears no other bits"


def test_torn_operations_wear_too():
    assert cut("e", "during").wear(PAGE // 256) == 1
    assert cut("m", "during", address=0x123, value=7).eeprom_wear(0x123) == 1
    assert cut("e", "before").wear(PAGE // 256) == 0


def test_torn_contents_depend_on_seed_and_tear_only():
    first = cut("e", "during", 1).flash[PAGE : PAGE + 256]
    assert cut("e", "during", 1).flash[PAGE : PAGE + 256] == first
    assert cut("e", "during", 1, seed=2).flash[PAGE : PAGE + 256] != first
    assert cut("e", "during", 2).flash[PAGE : PAGE + 256] != first


def test_torn_eeprom_byte_is_neither_always_old_nor_new():
    torn = {cut("m", "during", tear, address=0x123, value=0x0F).eeprom[0x123] for tear in range(8)}
    assert len(torn) >= 3


def test_board_starts_again_after_a_cut():
    lab = cut("e", "during")
    lab.power_on()
    lab.run(ms=1)
    assert lab.do("c") == (1, 1), "power-on reset"


def test_power_can_be_cut_at_any_time():
    lab = Lab()
    lab.cut_power_at(2.5)
    with pytest.raises(PowerCut):
        lab.do("e", PAGE)
    assert lab.now_ms == pytest.approx(3.5, abs=0.01)


def test_reset_tears_a_page_but_not_an_eeprom_byte():
    lab = Lab()
    lab.flash[PAGE : PAGE + 256] = FULL
    with pytest.raises(AssertionError):
        lab.do("e", PAGE, ms=2)
    lab.reset()
    assert lab.flash[PAGE : PAGE + 256] not in (FULL, b"\xff" * 256)
    lab.run(ms=1)
    with pytest.raises(AssertionError):
        lab.do("m", 0x123, 0x45, ms=3)
    assert lab.eeprom[0x123] == 0xFF
    lab.reset()
    lab.run(ms=9)
    assert lab.eeprom[0x123] == 0x45


def test_names_of_an_application_that_is_replaced_are_not_told():
    """Its functions are named until the loader erases one of them; motion pages have none."""
    board = prompt_board("play-cm5.hex")
    vector = board.function("__vector_18")
    blocks = Blocks(board)
    blocks.update(0xE0, noise(256))
    assert board.function_at(vector) == "__vector_18"
    blocks.update(vector // 256, noise(256))
    assert board.function_at(vector) == "?" and board.function_at(0x1E000) != "?"
    with pytest.raises(KeyError):
        board.function("__vector_18")
