# SPDX-License-Identifier: MIT
"""Stock avrdude against the loader on the simulated board, over a pseudo terminal; and STK500v1 by hand for errors that avrdude does not
make."""

import fcntl
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import time
import tty

import intelhex
import pytest

from tests.sim.boot_board import BOOT_START, PLAIN_APP, PROMPT, new_board, noise, prompt_board, say

AVRDUDE = shutil.which("avrdude")


BUSY_TURNS = 1500  # of 2 ms: longest work of the board after the last byte; a page of EEPROM takes 2.2 s


def run_avrdude(board, *arguments, part="m128", limit=800):
    """Exit code and output of avrdude with the board at the far end of the line. On an idle line simulated time runs slower than the clock,
    so that a busy PC can delay avrdude without a time-out of the loader."""
    master, slave = pty.openpty()
    try:
        tty.setraw(master)
        tty.setraw(slave)
        fcntl.fcntl(master, fcntl.F_SETFL, os.O_NONBLOCK)
        command = [AVRDUDE, "-c", "arduino", "-p", part, "-b", "57600", "-P", os.ttyname(slave), *map(str, arguments)]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        board.take()
        end, idle = time.monotonic() + limit, 0
        while process.poll() is None:
            assert time.monotonic() < end, "avrdude hangs"
            try:
                board.send(os.read(master, 4096))
                idle = 0
            except BlockingIOError:
                pass
            board.run(ms=2)
            said = board.take()
            if said:
                os.write(master, said)
            idle = 0 if said or board.waiting else idle + 1
            if idle:
                select.select([master], [], [], 0.0005 if idle < BUSY_TURNS else 0.02)
        return process.returncode, process.stdout.read()
    finally:
        os.close(master)
        os.close(slave)


def binary(tmp_path, data, name="image.bin"):
    path = tmp_path / name
    path.write_bytes(data)
    return path


def test_play_image_written_and_started(tmp_path):
    hex_file = pathlib.Path(__file__).parents[2] / "build" / "firmware" / "play-cm5.hex"
    board = prompt_board()
    code, text = run_avrdude(board, "-U", f"flash:w:{hex_file}:i")
    assert code == 0 and "verified" in text, text
    board.take()
    assert say(board, "id", ms=2000).endswith("app=good")
    say(board, "app")
    board.send("reset\r")
    board.run(ms=400)
    assert board.pc < BOOT_START


def test_motions_on_both_sides_of_64_kib_are_written_and_verified(tmp_path):
    board = prompt_board()
    before, motions = bytes(board.flash), noise(4096, 2)
    contents = intelhex.IntelHex()
    contents.frombytes(motions, 0xF800)
    contents.write_hex_file(str(tmp_path / "motions.hex"))
    code, text = run_avrdude(board, "-U", f"flash:w:{tmp_path / 'motions.hex'}:i")
    assert code == 0 and "4096 bytes of flash verified" in text, text
    assert bytes(board.flash) == before[:0xF800] + motions + before[0x10800:]


def test_eeprom_written_and_verified(tmp_path):
    board = prompt_board()
    data = noise(300, 3)
    code, text = run_avrdude(board, "-U", f"eeprom:w:{binary(tmp_path, data)}:r")
    assert code == 0 and "300 bytes of eeprom verified" in text, text
    assert bytes(board.eeprom[:300]) == data and board.eeprom[300] == 0xFF


def test_eeprom_read(tmp_path):
    board = prompt_board()
    board.eeprom[0:0xFF0] = noise(0xFF0, 3)
    path = tmp_path / "eeprom.bin"
    code, text = run_avrdude(board, "-U", f"eeprom:r:{path}:r")
    assert code == 0, text
    data = path.read_bytes()
    assert data == bytes(board.eeprom)[: len(data)] and len(data) >= 0xFF0


def test_wrong_part_is_refused(tmp_path):
    board = prompt_board()
    before = bytes(board.flash)
    code, text = run_avrdude(board, "-U", f"flash:w:{binary(tmp_path, noise(512))}:r", part="m64")
    assert code != 0 and re.search("signature|programmer|device", text), text
    assert bytes(board.flash) == before


def test_boot_section_is_not_written(tmp_path):
    board = prompt_board()
    before = bytes(board.flash)
    contents = intelhex.IntelHex()
    contents.frombytes(noise(512, 5), BOOT_START)
    contents.write_hex_file(str(tmp_path / "boot.hex"))
    code, text = run_avrdude(board, "-U", f"flash:w:{tmp_path / 'boot.hex'}:i")
    assert code != 0 and "expects OK byte 0x10 but got 0x11" in text, text
    assert bytes(board.flash[BOOT_START:]) == before[BOOT_START:]


def test_prompt_is_there_again_afterwards():
    board = prompt_board()
    code, text = run_avrdude(board)
    assert code == 0 and "0x1e9702" in text, text
    board.run(ms=50)
    board.take()
    assert say(board, "app").endswith("Application")


FUSES = {"lfuse": 0x3F, "hfuse": 0xC2, "efuse": 0xFE, "lock": 0xEF}


def fused(board):
    """The board with four fuse and lock bytes that differ from each other and from the simulator's defaults."""
    board._lib.board_set_fuses(board._pointer, FUSES["lfuse"], FUSES["hfuse"], FUSES["efuse"])
    board._lib.board_set_lock(board._pointer, FUSES["lock"])
    return board


def test_fuses_and_lock_bits_are_read(tmp_path):
    asked = [word for memory in FUSES for word in ("-U", f"{memory}:r:{tmp_path / memory}:h")]
    code, text = run_avrdude(fused(prompt_board()), *asked)
    assert code == 0, text
    assert {memory: int((tmp_path / memory).read_text(), 16) for memory in FUSES} == FUSES


def test_a_new_fuse_is_refused():
    code, text = run_avrdude(fused(prompt_board()), "-U", "lfuse:w:0x1F:m")
    assert code != 0 and "0x11" in text, text


# STK500v1 by hand

SYNC = b"\x30\x20"
IN_SYNC_OK = b"\x14\x10"


def ask(board, request, count, ms=500):
    board.take()
    board.send(request)
    end = board.now_ms + ms
    got = b""
    while len(got) < count and board.now_ms < end:
        board.run(ms=1)
        got += board.take()
    return got


@pytest.fixture
def stk():
    board = prompt_board()
    assert ask(board, SYNC, 2) == IN_SYNC_OK
    return board


def page(address, data, kind=b"F"):
    return (b"\x55" + (address // 2).to_bytes(2, "little") + b"\x20", b"\x64" + len(data).to_bytes(2, "big") + kind + data + b"\x20")


def test_sync_in_the_window_stays_without_a_banner():
    board = new_board()
    board.flash[0 : len(PLAIN_APP)] = PLAIN_APP
    board.eeprom[0xFFF] = 0x11
    board.run(ms=30)
    board.send(SYNC)
    board.run(ms=200)
    assert board.take() == b"\xff" + IN_SYNC_OK


def test_a_typed_zero_is_text():
    board = prompt_board()
    assert say(board, "0") == "\r\n Bad Command.(see 'help')"
    assert say(board, "00 ") == "\r\n Bad Command.(see 'help')"
    assert say(board, "f 0 ").startswith("\r\n 00000000 : ")


def begin_application(board):
    """Enters the programming mode and writes the first page of an application without a record."""
    assert ask(board, b"\x50\x20", 2) == IN_SYNC_OK
    for request in page(0, PLAIN_APP + bytes(256 - len(PLAIN_APP))):
        assert ask(board, request, 2) == IN_SYNC_OK


def leave(board):
    board.send(b"\x51\x20")
    board.expect(IN_SYNC_OK)
    board.expect(PROMPT)


def test_an_application_without_a_record_is_complete_when_avrdude_leaves(stk):
    begin_application(stk)
    leave(stk)
    assert say(stk, "id").endswith("app=plain")


def test_an_application_without_a_record_is_incomplete_when_avrdude_is_stopped(stk):
    begin_application(stk)
    stk.expect(PROMPT, ms=12000)  # silence ends the session
    assert say(stk, "id").endswith("app=bad")
    for request in (SYNC, b"\x50\x20", *page(0xE000, noise(256))):  # another session, without the application
        assert ask(stk, request, 2) == IN_SYNC_OK
    leave(stk)
    assert say(stk, "id").endswith("app=bad")


def test_an_application_without_a_record_is_incomplete_when_avrdude_leaves_after_a_page_that_failed(stk):
    """avrdude ends each session with LEAVE."""
    begin_application(stk)
    address, block = page(BOOT_START, noise(256))  # refused, like a page that is worn out
    assert (ask(stk, address, 2), ask(stk, block, 2)) == (IN_SYNC_OK, b"\x14\x11")
    leave(stk)
    assert say(stk, "id").endswith("app=bad")
    assert ask(stk, SYNC, 2) == IN_SYNC_OK  # sent again
    begin_application(stk)
    leave(stk)
    assert say(stk, "id").endswith("app=plain")


def test_signature(stk):
    assert ask(stk, b"\x75\x20", 5) == b"\x14\x1e\x97\x02\x10"


@pytest.mark.parametrize("instruction, memory", [("50000000", "lfuse"), ("58080000", "hfuse"), ("50080000", "efuse"), ("58000000", "lock")])
def test_serial_instructions_that_read_fuses(stk, instruction, memory):
    """Data sheet, table "Serial Programming Instruction Set"."""
    fused(stk)
    assert ask(stk, b"\x56" + bytes.fromhex(instruction) + b"\x20", 3) == bytes((0x14, FUSES[memory], 0x10))


@pytest.mark.parametrize("instruction, end", [("AC800000", 0x10), ("ACA0003F", 0x11), ("ACE000EF", 0x11), ("38000000", 0x11)])
def test_of_the_other_serial_instructions_only_chip_erase_is_accepted(stk, instruction, end):
    answer = ask(stk, b"\x56" + bytes.fromhex(instruction) + b"\x20", 3)
    assert (answer[0], answer[2]) == (0x14, end)


@pytest.mark.parametrize("byte", [0x00, 0x01, 0x31, 0xFF])
def test_a_byte_that_is_no_command_ends_the_session(stk, byte):
    """0, which ends the table of commands, was once accepted as a command."""
    stk.send(bytes([byte, 0x20]))
    stk.expect(PROMPT, ms=500)


def test_no_programming_before_enter(stk):
    address, block = page(0xE000, noise(256))
    assert ask(stk, address, 2) == IN_SYNC_OK
    assert ask(stk, block, 2) == b"\x14\x11"
    assert ask(stk, b"\x50\x20", 2) == IN_SYNC_OK
    assert ask(stk, block, 2) == IN_SYNC_OK
    assert bytes(stk.flash[0xE000:0xE100]) == noise(256)


def test_part_of_a_page_keeps_the_rest(stk):
    stk.flash[0xE000:0xE100] = noise(256, 8)
    before = bytes(stk.flash)
    ask(stk, b"\x50\x20", 2)
    address, block = page(0xE020, noise(64, 9))
    ask(stk, address, 2)
    assert ask(stk, block, 2) == IN_SYNC_OK
    assert bytes(stk.flash) == before[:0xE020] + noise(64, 9) + before[0xE060:]


@pytest.mark.parametrize("address, count", [(0x1E000, 256), (0x1FF00, 256), (0xE080, 256), (0xE000, 300)])
def test_blocks_that_do_not_fit_are_refused(stk, address, count):
    before = bytes(stk.flash)
    ask(stk, b"\x50\x20", 2)
    where, block = page(address, noise(count))
    ask(stk, where, 2)
    assert ask(stk, block, 2) == b"\x14\x11"
    assert bytes(stk.flash) == before


def write_eeprom(board, address, data):
    """The answer to the block."""
    where, block = page(address, data, b"E")
    ask(board, b"\x50\x20", 2)
    ask(board, where, 2)
    return ask(board, block, 2, ms=3000)


@pytest.mark.parametrize("address, count", [(0x1000, 1), (0xFFE, 3), (0xF02, 256), (0x10000, 1), (0x1FFFE, 4), (0, 257)])
def test_eeprom_blocks_that_do_not_fit_are_refused(stk, address, count):
    before = bytes(stk.eeprom)
    assert write_eeprom(stk, address, noise(count)) == b"\x14\x11"
    assert bytes(stk.eeprom) == before


def test_an_eeprom_block_up_to_the_last_byte_is_written(stk):
    assert write_eeprom(stk, 0xF00, noise(256)) == IN_SYNC_OK
    assert bytes(stk.eeprom[0xF00:]) == noise(256)


def test_missing_end_of_packet_is_no_sync(stk):
    assert ask(stk, b"\x50\x21", 1) == b"\x15"
    assert ask(stk, SYNC, 2) == IN_SYNC_OK


def test_a_packet_cut_short_ends_the_session(stk):
    before = bytes(stk.flash)
    ask(stk, b"\x50\x20", 2)
    ask(stk, page(0xE000, b"")[0], 2)
    stk.send(page(0xE000, noise(256))[1][:100])
    stk.run(ms=600)
    assert stk.take().decode("latin-1").endswith(PROMPT)
    assert bytes(stk.flash) == before


def test_leave_gives_the_prompt_and_so_does_text(stk):
    assert ask(stk, b"\x51\x20", 2 + len(PROMPT)) == IN_SYNC_OK + PROMPT.encode()
    ask(stk, SYNC, 2)
    stk.send("\r")
    stk.expect(PROMPT)


def test_ten_seconds_of_silence_leave(stk):
    stk.run(ms=9900)
    assert stk.take() == b""
    stk.expect(PROMPT, ms=200)


def test_reading_past_the_end_begins_again(stk):
    stk.flash[0:16] = noise(16, 3)
    ask(stk, b"\x55\xfc\xff\x20", 2)  # word FFFC: eight bytes before the end
    got = ask(stk, b"\x74\x00\x10F\x20", 18)
    assert got[1:-1] == bytes(stk.flash[0x1FFF8:0x20000]) + noise(16, 3)[:8]


def test_equal_pages_are_not_worn(stk):
    ask(stk, b"\x50\x20", 2)
    for _ in range(3):
        where, block = page(0xE000, noise(256))
        ask(stk, where, 2)
        assert ask(stk, block, 2) == IN_SYNC_OK
    assert stk.wear(0xE0) == 1
