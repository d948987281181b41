# SPDX-License-Identifier: MIT
"""Services of the boot section for applications: the page-write service of the call table, through the application of tests/sim/service,
and the page journal with both kinds of service. Power cuts: tools/prove power."""

import pytest

from cm5sim import Board
from tests.sim.boot_board import BOOT_MODE, BOOT_START, factory_section, new_board, noise

SERVICE = "tests/service.hex"
OURS, FACTORY, MAILBOX = 1, 2, 3
OK, RANGE, VERIFY = 0, 1, 2
CLEAN = 0


def service_board(**options):
    board = new_board(SERVICE, **options)
    board.eeprom[BOOT_MODE] = 0x11
    return board


def hello(board, ms=500):
    """Kind of service, result of the recovery, result of the mailbox."""
    board.expect("R", ms=ms)
    end, got = board.now_ms + 200, b""
    while len(got) < 3 and board.now_ms < end:
        board.run(ms=1)
        got += board.take()
    assert len(got) == 3
    return tuple(got)


@pytest.fixture
def board():
    board = service_board()
    assert hello(board) == (OURS, CLEAN, 0)
    return board


def ask(board, request, answer=1, ms=400):
    board.send(request)
    end, got = board.now_ms + ms, b""
    while len(got) < answer and board.now_ms < end:
        board.run(ms=0.5)
        got += board.take()
    assert len(got) == answer, got
    return got


def at(page):
    return page.to_bytes(2, "little")


@pytest.mark.parametrize("page", [0xC0, 0xDF, 0xE0, 0xFF, 0x100, 0x1DF])
def test_write(board, page):
    data, before = noise(256, page), bytes(board.flash)
    assert ask(board, b"W" + at(page) + data) == bytes([OK])
    after = bytes(board.flash)
    assert after[256 * page : 256 * page + 256] == data
    assert after[: 256 * page] == before[: 256 * page] and after[256 * page + 256 :] == before[256 * page + 256 :]


def test_write_waits_for_the_eeprom(board):
    """SPM during an EEPROM write does nothing on the chip; the board model reports it (spm-eeprom)."""
    data = noise(256)
    assert ask(board, b"V" + at(0xE0) + data) == bytes([OK])
    assert bytes(board.flash[0xE000:0xE100]) == data
    assert board.eeprom[0x321] == 0x5A


@pytest.mark.parametrize("page", [0x1E0, 0x1FF, 0x200, 0xFFFF])
def test_boot_section_is_refused(board, page):
    before = bytes(board.flash)
    assert ask(board, b"W" + at(page) + noise(256)) == bytes([RANGE])
    assert ask(board, b"B" + at(page) + noise(256), 3)[0] == RANGE
    assert bytes(board.flash) == before


def test_write_that_does_not_stick_is_reported(board):
    board.lock(0xFB)
    assert ask(board, b"W" + at(0xE0) + noise(256)) == bytes([VERIFY])


def test_program_only_clears_bits(board):
    board.flash[0xE000:0xE100] = b"\xf0" * 4 + b"\xff" * 252
    assert ask(board, b"P" + at(0xE0) + b"\x04\xf0\x00\x30\xf0") == bytes([OK])
    assert bytes(board.flash[0xE000:0xE008]) == b"\xf0\x00\x30\xf0\xff\xff\xff\xff"
    assert board.wear(0xE0) == 0


def test_stack_ram_flags_and_rampz(board):
    result, stack, intact = ask(board, b"B" + at(0x100) + noise(256), 3)
    print(f"service: {stack} bytes of the caller's stack, boot_call_write's own part included")
    assert result == OK and intact == 1
    assert stack <= 64


def test_ring_loses_no_byte_and_counts_what_does_not_fit(board):
    board.send(b"W" + at(0xE0) + noise(256) + b"E")
    board.run(ms=46.5)
    extra = bytes(0x80 | i & 0x7F for i in range(50))
    board.send(extra)
    board.run(ms=150)
    assert board.take() == bytes([OK]) + extra + b"\0"


def test_time_and_erase_count(board):
    board.send(b"W" + at(0xE0) + noise(256))
    while board.waiting:
        board.run(ms=0.1)
    start = board.now_ms
    while not board.take():
        board.run(ms=0.1)
    print(f"service: {board.now_ms - start:.1f} ms a page")
    assert board.now_ms - start < 11.5
    assert board.wear(0xE0) == 1


def test_journal_save_takes_less_than_60_ms(board):
    board.send(b"J" + bytes([120]) + noise(512))
    board.expect("j")
    start = board.now_ms
    while not board.take():
        board.run(ms=0.1)
    print(f"journal: a page saved in {board.now_ms - start:.1f} ms")
    assert board.now_ms - start <= 60
    assert bytes(board.flash[0x1D000:0x1D200]) == noise(512)


def test_mailbox_of_an_application_on_our_loader(board):
    data = noise(512, 9)
    board.send(b"M" + bytes([7]) + data)
    board.expect("R", ms=8000)
    board.run(ms=20)
    assert board.take() == bytes([OURS, CLEAN, 1])
    assert bytes(board.flash[0xEE00:0xF000]) == data


def test_an_empty_boot_section_offers_nothing():
    board = new_board(SERVICE, bootrst=False)
    board.flash[BOOT_START:0x20000] = b"\xff" * 0x2000
    assert hello(board)[0] == 0
    assert ask(board, b"W" + at(0xE0) + noise(256)) == b"\x03"


def test_an_unknown_loader_means_the_mailbox():
    board = new_board(SERVICE, bootrst=False)
    board.flash[BOOT_START:0x20000] = noise(0x2000)
    assert hello(board)[0] == MAILBOX
    before = bytes(board.flash)
    assert ask(board, b"W" + at(0xE0) + noise(256)) == b"\x03"
    assert bytes(board.flash) == before


# The factory loader's routine, imitated by tests/sim/service/factory.c


@pytest.fixture(scope="module")
def factory():
    return factory_section()


def factory_board(section):
    board = Board(images=[SERVICE], bootrst=True)
    board.flash[BOOT_START:0x20000] = section
    return board


def test_factory_routine_writes_pages_and_leaves_ram_alone(factory):
    board = factory_board(factory)
    assert hello(board) == (FACTORY, CLEAN, 0)
    data = noise(256, 41)
    board.ram[0xC00:0xE00] = noise(512, 42)  # place of its buffer
    assert ask(board, b"W" + at(0x1D0) + data) == bytes([OK])
    assert bytes(board.flash[0x1D000:0x1D100]) == data
    assert bytes(board.ram[0xC00:0xE00]) == noise(512, 42)
    assert ask(board, b"P" + at(0x1D0) + b"\x04" + bytes(4), 1) == bytes([OK])
    assert bytes(board.flash[0x1D000:0x1D100]) == bytes(4) + data[4:]
    assert ask(board, b"W" + at(0x1E0) + data) == bytes([RANGE])


def test_factory_routine_that_fails_is_reported(factory):
    board = factory_board(factory)
    hello(board)
    board.lock(0xFB)
    assert ask(board, b"W" + at(0x1D0) + noise(256)) == bytes([VERIFY])
