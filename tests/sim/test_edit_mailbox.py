# SPDX-License-Identifier: MIT
"""SAVE with an unknown loader: the page goes through the EEPROM mailbox of boot/ORIGINAL.md section 7a. service/mailbox.c imitates such a
loader; service/factory.c, if not recognised, is a loader without mailbox."""

import pytest

from tests.sim.edit_robot import MOTION_START, page, robot, seal

OLD = page("old", [(40, {1: 480}), (50, {3: 300})])
OTHER = page("other", [(11, {1: 900})])
STATE, NUMBER, BOOT_MODE, DATA = 0xFF4, 0xFF5, 0xFFF, 0x800
RESTART_MS = 6500  # at most: 520 EEPROM bytes of 8.5 ms each, and a start
IMAGES = {"images": ("tests/mailbox.hex", "edit-cm5.hex"), "bootrst": True}


def new_bytes():
    data = bytearray(OLD.data)
    data[64 + 6], data[64 + 7] = 700 & 0xFF, 700 >> 8
    return seal(data)


def mailbox_robot(fresh=False, **options):
    """`fresh`: nothing was ever saved. Otherwise the mailbox still holds page 1, so that only differences are written."""
    r = robot(pages={1: OLD, 2: OTHER}, **{**IMAGES, **options})
    if not fresh:
        r.board.eeprom[DATA : DATA + 512] = bytes(OLD.data)
        r.board.eeprom[STATE : STATE + 2] = b"\xff\x01"
    return r


def edit(r):
    r.line("goto 1 3")
    r.line("set 700")


def test_start_and_save_say_that_the_controller_restarts():
    with mailbox_robot() as r:
        assert "SAVE will restart" in r.command
        edit(r)
        operations = r.board.operations
        assert r.line("save", "n") == "save SAVE restarts (5 s). Are you sure?[y/N] no"
        assert r.board.operations == operations and r.unsaved and r.cell(1, 3) == "0700" and r.board.resets == 1


@pytest.mark.parametrize("fresh", [True, False])
def test_page_goes_through_the_mailbox(fresh):
    with mailbox_robot(fresh) as r:
        others = bytes(r.board.flash[MOTION_START + 1024 :])
        edit(r)
        r.line("save")
        start = r.board.now_ms
        r.keys("y", ms=RESTART_MS)
        assert r.board.resets == 2 and r.board.reset_cause == "watchdog"
        assert r.flash_page(1) == new_bytes() and bytes(r.board.flash[MOTION_START + 1024 :]) == others
        assert bytes(r.board.eeprom[DATA : DATA + 512]) == new_bytes()
        assert r.board.eeprom[STATE] == 0xFF and r.board.eeprom[NUMBER] == 1 and r.board.eeprom[BOOT_MODE] == 0x11
        assert r.command.endswith("Saved") and r.cell(1, 3) == "0700" and not r.unsaved
        assert r.board.stack_headroom >= 384
        print(f"mailbox: {'all bytes' if fresh else 'what differs'}; restarted within {r.board.now_ms - start:.0f} ms")


def test_save_as_another_page():
    with mailbox_robot() as r:
        r.line("save 9")
        r.keys("y", ms=RESTART_MS)
        assert r.flash_page(9) == bytes(OLD.data) and r.flash_page(1) == bytes(OLD.data)
        r.line("save 2", "y")
        assert "SAVE restarts" in r.command
        r.keys("y", ms=RESTART_MS)
        assert r.flash_page(2) == bytes(OLD.data)


def test_a_loader_that_knows_no_mailbox_is_told_of():
    with mailbox_robot(images=("tests/factory.hex", "edit-cm5.hex")) as r:
        before = bytes(r.board.flash)
        edit(r)
        r.line("save")
        r.keys("y", ms=RESTART_MS)
        assert r.command.endswith("Not saved") and r.board.eeprom[STATE] == 0xFF
        assert bytes(r.board.flash) == before
        r.board.reset()
        r.settle(ms=1500)
        assert "SAVE will restart" in r.command
