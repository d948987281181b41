# SPDX-License-Identifier: MIT
"""The loader after a reset: stay or start, the state at the start of the application, the mailbox, the application's record."""

import pathlib
import struct
import subprocess
import sys

import pytest

from cm5sim import Board
from m512.board.memory import plan
from tests.sim.boot_board import (
    APP_END,
    BOOT_MODE,
    HELLO,
    JOURNAL_START,
    LEAVE,
    OK,
    PROMPT,
    REFUSED,
    Blocks,
    crc16,
    load,
    new_board,
    noise,
    page_body,
    pending_record,
    prompt_board,
    say,
)

APPLICATION = 0x11


SHIPPED_BYTES = 46 * 1024  # size of Edit and Play: their CRC takes longer than the loader's window


def application(length=SHIPPED_BYTES, record=True, good=True):
    """A program that stores SREG, UCSR0A and UCSR1A at 0x200 and ends in a loop; with one of our records if requested."""
    image = bytearray(length)
    image[0:4] = b"\x0c\x94\x60\x00"  # jmp 0xC0
    program = (
        "0fb7 0093 0002"  # in r16, SREG; sts 0x200, r16
        "0bb1 0093 0102"  # in r16, UCSR0A; sts 0x201, r16
        "0091 9b00 0093 0202"  # lds r16, UCSR1A; sts 0x202, r16
        "ffcf"
    )  # rjmp to itself
    program = bytes.fromhex(program.replace(" ", ""))
    image[0xC0 : 0xC0 + len(program)] = program
    image[0x100:] = noise(length - 0x100, 3)
    if record:
        image[0x8C:0x9C] = struct.pack("<4sIHBB3sB", b"M512", length, 0xFFFF, 1, 255, b"\1\0\0", 1)
        image[0x94:0x96] = struct.pack("<H", crc16(image) ^ (0 if good else 1))
    return bytes(image)


def board_with(image=None, mode=APPLICATION, **options):
    board = new_board(**options)
    if image:
        board.flash[0 : len(image)] = image
    board.eeprom[BOOT_MODE] = mode
    return board


def started(board):
    return board.pc < 0x1E000


def run_to_application(board, ms=400):
    end = board.now_ms + ms
    board.run(ms=5)
    while board.now_ms < end and not started(board):
        board.run(ms=0.25)
    return started(board)


@pytest.mark.parametrize("length, earliest_ms, latest_ms", [(0x400, 58, 66), (SHIPPED_BYTES, 140, 165)])
def test_application_starts_after_the_window_of_60_ms_and_its_crc(length, earliest_ms, latest_ms):
    board = board_with(application(length))
    board.power_on()
    board.run(ms=1)
    first = board.now_ms
    while not board.console:
        board.run(ms=0.1)
    assert run_to_application(board)
    assert earliest_ms <= board.now_ms - first <= latest_ms
    assert board.take() == b"\xff"


@pytest.mark.parametrize("typed, stays", [(b"#", True), (b"x#", True), (b"#x", False), (b"####", True), (b"x", False)])
def test_the_last_byte_of_the_window_counts(typed, stays):
    board = board_with(application())
    board.run(ms=20)
    board.send(typed)
    board.run(ms=300)
    assert started(board) != stays
    if stays:
        assert board.take().endswith(PROMPT.encode())


@pytest.mark.parametrize("sent", [b"#", b"x#", b"0 ", b"x0 ", b"0 0 ", b"0 x#", b"@reset\r#", b"\xff\x55\x01\xfe\x00\xff#"])
@pytest.mark.parametrize("length, delay", [(SHIPPED_BYTES, 2), (0x400, 10), (SHIPPED_BYTES, 40)])
def test_whatever_came_before_it_in_the_window(length, sent, delay):
    """avrdude and m512 send more than one byte, and a PC that communicated with the application may be in the middle of a line."""
    board = board_with(application(length))
    board.power_on()
    while not board.console:
        board.run(ms=0.1)
    board.run(ms=delay)
    board.take()
    board.send(sent)
    board.run(ms=400)
    assert not started(board)
    assert board.take().startswith(b"\x14\x10" if sent.endswith(b"0 ") else b"\r\n\n SYSTEM O.K.")


@pytest.mark.parametrize("delay, stays", [(50, True), (75, False)])
def test_the_window_is_60_ms(delay, stays):
    board = board_with(application(0x400))
    board.power_on()
    while not board.console:
        board.run(ms=0.1)
    board.run(ms=delay)
    board.send(b"#")
    board.run(ms=300)
    assert started(board) != stays


@pytest.mark.parametrize("mode, stays", [(0xFF, True), (0x11, False), (0x00, False), (0x55, False)])
def test_boot_mode(mode, stays):
    board = board_with(application(), mode)
    board.run(ms=300)
    assert started(board) != stays


def test_start_held_stays_and_its_release_does_nothing():
    """However the contact bounces on release."""
    board = board_with(application())
    board.press("MODE")
    board.press("START")
    board.run(ms=10)
    board.release("MODE")
    board.run(ms=500)
    assert not started(board)
    for _ in range(10):
        board.bounce(0)
        board.press("START")
        board.run(ms=20)
        board.take()
        board.reset()
        board.expect(PROMPT)
        board.bounce(5)
        board.release("START")
        board.run(ms=200)
        assert not started(board)
        board.run(ms=0.7)  # shifts the bounces each time
    board.press("START")
    board.run(ms=200)
    assert started(board)


@pytest.mark.parametrize("length, held_ms", [(0x400, 20), (SHIPPED_BYTES, 60), (0x400, 100), (SHIPPED_BYTES, 150)])
def test_start_held_for_a_tenth_of_a_second_or_less_stays(length, held_ms):
    board = board_with(application(length))
    board.press("START")
    board.press("MODE")
    board.run(ms=10)
    board.release("MODE")
    board.run(ms=held_ms)
    board.release("START")
    board.run(ms=400)
    assert not started(board)


@pytest.mark.parametrize("length", [0x400, SHIPPED_BYTES])
def test_start_pressed_late_does_not_stay(length):
    board = board_with(application(length))
    board.run(ms=40)
    board.press("START")
    board.run(ms=200)
    assert started(board)


@pytest.mark.parametrize(
    "image, stays, word",
    [
        (None, True, "none"),
        (application(record=False), False, "plain"),
        (application(), False, "good"),
        (application(good=False), True, "bad"),
        (application(APP_END), False, "good"),
        (application(APP_END + 2), True, "bad"),
    ],
)
def test_validity_of_the_application(image, stays, word):
    board = board_with(image)
    board.run(ms=600)
    assert started(board) != stays
    board.eeprom[BOOT_MODE] = 0xFF
    board.take()
    board.reset()
    board.expect(PROMPT, ms=600)
    assert say(board, "id").endswith(f"app={word}")


@pytest.mark.parametrize("address", [0x00, 0x8C, 0x8C + 4, 0x8C + 15, 0x3FF])
def test_one_changed_bit_keeps_the_application_from_starting(address):
    """At 0x8C it is a bit that a half erased magic has too much."""
    image = bytearray(application())
    image[address] ^= 0x10
    board = board_with(bytes(image))
    board.run(ms=400)
    assert not started(board)


DAMAGED = "\r\n Jump Address : 0x00000000\r\n Damaged: FORCE starts it."


def test_a_damaged_application_is_started_by_force_only():
    board = board_with(application(good=False))
    board.expect(PROMPT, ms=600)
    for line in ("go", "g", "go 0"):
        assert say(board, line) == DAMAGED
    board.press("START")
    board.run(ms=200)
    board.release("START")
    board.run(ms=200)
    assert board.take().decode("latin-1") == "GO" + DAMAGED + PROMPT
    assert not started(board)
    board.send("force\r")
    board.run(ms=300)
    assert started(board)


def test_force_does_not_start_what_is_not_there():
    board = board_with(mode=0xFF)
    board.expect(PROMPT, ms=600)
    assert say(board, "force") == "\r\n Jump Address : 0x00000000\r\n No application."


def test_the_block_protocol_refuses_a_damaged_application():
    board = board_with(application(good=False))
    board.expect(PROMPT, ms=600)
    blocks = Blocks(board)
    assert blocks.ask(LEAVE, page_body(1))[0] == REFUSED
    assert blocks.ask(HELLO)[:2] == (OK, 3)  # the session continues
    assert blocks.ask(LEAVE, page_body(3))[0] == OK
    board.run(ms=50)
    assert started(board)


def test_our_own_images_have_a_record_that_fits():
    build = pathlib.Path(__file__).parents[2] / "build" / "firmware"
    images = sorted(build.glob("play-*.elf")) + sorted(build.glob("edit-*.elf"))
    assert images, f"no application image in {build}: tools/dev/build makes them"
    for image in images:
        record = plan(image.with_suffix(".hex")).record  # refuses one that does not fit
        assert str(record).endswith(f" for {image.stem[-3:]}"), image


def test_a_combined_image_starts(tmp_path):
    root = pathlib.Path(__file__).parents[2]
    firmware = root / "build" / "firmware"
    motions, whole = tmp_path / "motions.bin", tmp_path / "first.hex"
    motions.write_bytes(noise(65536, 12))
    subprocess.run(
        [sys.executable, root / "tools" / "combine", whole, firmware / "boot-cm5.hex", firmware / "play-cm5.hex", "--motions", motions], check=True
    )
    board = Board(images=[str(whole)])
    assert bytes(board.flash[0xE000:0x1E000]) == noise(65536, 12)
    board.expect(PROMPT, ms=600)
    assert say(board, "id", ms=2000).endswith("app=good")
    say(board, "app")
    board.send("go\r")
    board.run(ms=200)
    assert started(board)


def test_state_handed_over():
    board = board_with(application())
    assert run_to_application(board)
    board.run(ms=1)
    registers = bytes(board.ram[0:0x100])
    io = {
        name: registers[address]
        for name, address in {
            "DDRC": 0x34,
            "PORTC": 0x35,
            "DDRD": 0x31,
            "PORTD": 0x32,
            "DDRB": 0x37,
            "PORTB": 0x38,
            "DDRE": 0x22,
            "PORTE": 0x23,
            "UCSR1B": 0x9A,
            "UBRR1L": 0x99,
            "UCSR0B": 0x2A,
            "UBRR0L": 0x29,
            "TCCR1B": 0x4E,
            "TCCR0": 0x53,
            "WDTCR": 0x41,
            "MCUCR": 0x55,
        }.items()
    }
    assert board.ram[0x200] & 0x80 == 0, "interrupts are off"
    assert io == {
        "DDRC": 0x77,
        "PORTC": 0x7E,
        "DDRD": 0x70,
        "PORTD": 0x51,
        "DDRB": 0x20,
        "PORTB": 0x20,
        "DDRE": 0x0C,
        "PORTE": 0x00,
        "UCSR1B": 0x98,
        "UBRR1L": 34,
        "UCSR0B": 0x18,
        "UBRR0L": 0,
        "TCCR1B": 0,
        "TCCR0": 0,
        "WDTCR": 0,
        "MCUCR": 0,
    }
    assert board.ram[0x201] & 0x02 and board.ram[0x202] & 0x02, "both UARTs at double speed"


@pytest.mark.parametrize("cause, bit", [("power-on", 0), ("external", 1), ("watchdog", 3)])
def test_the_reset_cause_is_handed_on(cause, bit):
    board = board_with(application())
    if cause == "watchdog":
        board.eeprom[BOOT_MODE] = 0xFF
        board.expect(PROMPT, ms=400)
        say(board, "app")
        board.send("reset\r")
        board.run(ms=40)
    elif cause == "external":
        board.run(ms=10)
        board.reset()
    assert run_to_application(board)
    assert board.ram[0x54] & 1 << bit


def mailbox_board(page, state=0xAA, **options):
    board = board_with(application(), **options)
    data = noise(512, 77)
    board.eeprom[0x800:0xA00] = data
    board.eeprom[0xFF5] = page
    board.eeprom[0xFF4] = state
    return board, data


@pytest.mark.parametrize("page", [0, 127])
def test_mailbox_is_answered_whatever_the_mode(page):
    board, data = mailbox_board(page)
    before = bytes(board.flash)
    assert run_to_application(board)
    address = 0xE000 + 512 * page
    assert board.take().startswith(b"\xff Writing ")
    assert bytes(board.flash[address : address + 512]) == data
    assert bytes(board.flash[:address]) == before[:address]
    assert bytes(board.flash[address + 512 :]) == before[address + 512 :]
    assert board.eeprom[0xFF4] == 0x55


@pytest.mark.parametrize("page", [128, 255])
def test_mailbox_refuses_pages_above_127(page):
    board, _ = mailbox_board(page)
    before = bytes(board.flash)
    assert run_to_application(board)
    assert bytes(board.flash) == before
    assert board.eeprom[0xFF4] == 0xFF


@pytest.mark.parametrize("state", [0x00, 0x55, 0xFF, 0xA5])
def test_other_mailbox_states_are_left_alone(state):
    board, _ = mailbox_board(3, state)
    before = bytes(board.flash)
    assert run_to_application(board)
    assert bytes(board.flash) == before and board.eeprom[0xFF4] == state
    assert board.take() == b"\xff"


def test_a_pending_page_of_the_journal_is_finished_first():
    board = new_board()
    page = noise(512, 31)
    pending_record(board, 9, page)
    board.run(ms=60)
    assert board.take() == b"\xff"
    assert bytes(board.flash[0xF200:0xF400]) == page
    board.run(ms=10)
    assert bytes(board.flash[JOURNAL_START + 522 : JOURNAL_START + 524]) == b"\0\0"


@pytest.mark.parametrize("address", [0xE000, 0xE200])
def test_a_download_drops_a_pending_page(address):
    """A page that the recovery could not finish must not overwrite a later download, of that page or another one."""
    board = prompt_board()
    pending_record(board, 0, noise(512, 31))
    data = noise(256, 32)
    assert load(board, address, data)[0] == "Success"
    board.reset()
    board.run(ms=300)
    assert bytes(board.flash[0xE000:0xE400]) == (b"\xff" * (address - 0xE000) + data).ljust(0x400, b"\xff")
