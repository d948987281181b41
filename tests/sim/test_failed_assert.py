# SPDX-License-Identifier: MIT
"""A failed ASSERT restarts the board through the loader. The image then reports once where it failed."""

import pytest

from cm5sim import Board

MAGIC = 0x7A9D  # hal/avr/trap.h: an ASSERT has stored its line and its word address


def noted_at(image):
    """Address of trap_record in the image: a HEX file has no symbols."""
    return Board(images=[f"{image}-cm5.elf"], servos=()).variable("trap_record")


def restarted(image, marker):
    """The image's output up to `marker` after a failed ASSERT in line 321."""
    board = Board(images=["boot-cm5.hex", f"{image}-cm5.hex"], servos=(1,))
    board.eeprom[0xFFF] = 0x11  # the loader starts the application
    board.expect(marker, ms=3000)
    at = noted_at(image)
    board.ram[at : at + 6] = b"".join(value.to_bytes(2, "little") for value in (MAGIC, 321, 0x1234))
    board.reset()
    first = board.expect(marker, ms=3000)
    board.reset()
    return first, board.expect(marker, ms=3000)


@pytest.mark.parametrize("image, marker", [("play", "] "), ("edit", "HELP explains"), ("monitor", "[CID:001")])
def test_the_next_start_says_where_it_failed(image, marker):
    first, second = restarted(image, marker)
    assert "Failed: line 321, 0x2468. Report it. " in first
    assert "Failed" not in second
