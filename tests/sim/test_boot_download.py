# SPDX-License-Identifier: MIT
"""Downloads in the original's format: sizes and faults of boot/ORIGINAL.md section 3 and firmware/boot/DIFFERENCES.md."""

import pytest

from tests.sim.boot_board import APP_END, BOOT_START, MAP, PLAIN_APP, PROMPT, begin_load, end_load, load, noise, prompt_board, say

LINE_RATE = 2_000_000 / 35 / 10  # bytes a second


@pytest.fixture
def board():
    return prompt_board()


def check_flash(board, before, address, data):
    """Checks for exactly `data` at `address` and no other change."""
    after = bytes(board.flash)
    assert after[address : address + len(data)] == data
    assert after[:address] == before[:address]
    assert after[address + len(data) :] == before[address + len(data) :]


@pytest.mark.parametrize("count", [1, 254, 255, 256, 257, 512, 1000])
def test_sizes_at_2000(board, count):
    board.flash[0x1F00:0x2600] = noise(0x700, 9)
    before, data = bytes(board.flash), noise(count, count)
    assert load(board, 0x2000, data) == ("Success", 0, count + 1, sum(data) & 0xFF, sum(data) & 0xFF)
    check_flash(board, before, 0x2000, data)


def test_record_in_eeprom(board):
    data = noise(1000, 4)
    load(board, 0x2000, data)
    assert board.eeprom[0xFF6] == sum(data) & 0xFF
    assert int.from_bytes(board.eeprom[0xFF7:0xFFB], "little") == sum(data)
    assert int.from_bytes(board.eeprom[0xFFB:0xFFF], "little") == 1001


def test_verify_after_a_download(board):
    data = noise(1000, 4)
    load(board, 0, data)
    assert say(board, "verify").endswith(f"{sum(data) & 0xFF:02X}-{sum(data):08X}-{sum(data):08X}")


@pytest.mark.parametrize("address, count", [(0x0000, 16384), (0xF000, 16384)])
def test_long_downloads_at_line_rate(board, address, count):
    before, data = bytes(board.flash), noise(count, 8)
    begin_load(board, address)
    start = board.now_ms
    board.send(data + bytes([sum(data) & 0xFF]))
    assert end_load(board)[0] == "Success"
    seconds = (board.now_ms - start) / 1000
    check_flash(board, before, address, data)
    line = (count + 1) / LINE_RATE
    print(f"load of {count} bytes: {seconds:.2f} s, line {line:.2f} s")
    assert seconds < line * 1.05 + 0.15  # its end takes 111 ms of silence plus the last page


def test_type_ahead_needs_no_ready(board):
    data = noise(600, 2)
    board.send(b"load e000\r" + data + bytes([sum(data) & 0xFF]))
    board.expect("Success", ms=2000)
    assert bytes(board.flash[0xE000 : 0xE000 + 600]) == data


def test_equal_pages_are_not_worn(board):
    data = noise(1024, 2)
    load(board, 0xE000, data)
    changed = data[:300] + b"\0" + data[301:]
    assert load(board, 0xE000, changed)[0] == "Success"
    assert [board.wear(0xE0 + i) for i in range(4)] == [1, 2, 1, 1]
    assert bytes(board.flash[0xE000:0xE400]) == changed


@pytest.mark.parametrize("address, count", [(0x2080, 17), (0x20FF, 301), (0x2001, 257), (0x20FF, 1), (0xE123, 700)])
def test_unaligned_starts(board, address, count):
    start = address & ~0xFF
    board.flash[start - 256 : start + 0x500] = noise(0x600, 3)
    before, data = bytes(board.flash), noise(count, 6)
    assert load(board, address, data)[0] == "Success"
    check_flash(board, before, address, data)


def test_wrong_sum_is_an_error_and_the_sum_byte_is_not_written(board):
    board.flash[0xE200] = 0x33
    data = noise(512, 1)
    wrong = (sum(data) + 1) & 0xFF
    assert load(board, 0xE000, data, wrong) == ("Error", 0, 513, sum(data) & 0xFF, wrong)
    assert bytes(board.flash[0xE000:0xE200]) == data
    assert board.flash[0xE200] == 0x33


def test_65536_without_a_sum_byte_touch_nothing_behind(board):
    before, data = bytes(board.flash), noise(65536, 5)
    begin_load(board, 0xE000)
    board.send(data)
    result = end_load(board)
    assert result[0] == "Error" and result[2] == 0x10000
    after = bytes(board.flash)
    assert after[0xE000:0x1DFFF] == data[:-1] and after[BOOT_START:] == before[BOOT_START:]


@pytest.mark.parametrize(
    "address, count, end", [(APP_END - 256, 300, APP_END), (0xDF80, 200, 0xE000), (0x1DF00, 300, 0x1E000), (0x1DFFF, 2, 0x1E000)]
)
def test_no_byte_goes_past_the_region(board, address, count, end):
    before, data = bytes(board.flash), noise(count, 5)
    result = load(board, address, data)
    assert result[0] == "Error" and result[2] == count + 1
    after = bytes(board.flash)
    assert after[address:end] == data[: end - address] and after[end:] == before[end:]


@pytest.mark.parametrize("gap, whole", [(100, True), (110, True), (112, False), (130, False)])
def test_a_gap_of_111_ms_ends_it(board, gap, whole):
    data = noise(400, 5)
    board.send("load 2000\r")
    board.expect("Ready..")
    board.send(data[:100])
    board.pause(gap)
    board.send(data[100:] + bytes([sum(data) & 0xFF]))
    result = end_load(board)
    assert (result[0] == "Success") == whole
    assert result[2] == (401 if whole else 100)


def test_late_data_of_a_broken_download_are_not_commands(board):
    board.send("load 2000\r")
    board.expect("Ready..")
    board.send(noise(100, 5))
    board.pause(150)
    board.send(b"app\rapp\rclear_eeprom 0 10\r" * 3)
    board.expect("Error")
    board.run(ms=1500)
    assert board.eeprom[0xFFF] == 0xFF
    assert board.take().decode("latin-1").endswith(PROMPT)
    assert say(board, "app").endswith("Boot to Application")


def test_esc_leaves_ready_and_data_may_begin_with_esc(board):
    board.send("load 2000\r")
    board.expect("Ready..")
    board.send(b"\x1b")
    assert board.expect(PROMPT, ms=300) == "\r\n Cancelled." + PROMPT
    data = b"\x1b" * 20
    assert load(board, 0x2000, data)[0] == "Success"
    assert bytes(board.flash[0x2000:0x2014]) == data


def test_start_leaves_ready_without_starting(board):
    board.flash[0 : len(PLAIN_APP)] = PLAIN_APP
    board.send("load 2000\r")
    board.expect("Ready..")
    board.press("START")
    assert board.expect(PROMPT, ms=300) == "\r\n Cancelled." + PROMPT
    board.run(ms=300)
    board.release("START")
    board.run(ms=100)
    assert board.take() == b""


def test_ready_gives_up_after_a_minute(board):
    board.send("load 2000\r")
    board.expect("Ready..")
    board.run(ms=59000)
    assert board.take() == b""
    board.expect("Cancelled.", ms=2000)


def test_cr_lf_is_no_data(board):
    board.send("load 2000\r\n")
    board.expect("Ready..")
    board.send(b"\x0a\x0a\x14")
    assert end_load(board)[0] == "Success"
    assert bytes(board.flash[0x2000:0x2002]) == b"\x0a\x0a"


# Applications without a record: only the loader itself can know that one is incomplete.

PLAIN = PLAIN_APP + noise(700, 4)
WRONG_SUM = (sum(PLAIN) + 1) & 0xFF
DAMAGED = "\r\n Jump Address : 0x00000000\r\n Damaged: FORCE starts it."


def after_a_reset(board):
    """The loader's verdict after a reset that would start the application, or "started"."""
    say(board, "app")
    board.reset()
    board.run(ms=400)
    board.take()
    return "started" if board.pc < BOOT_START else say(board, "id")[-3:]


def cut_short(board):
    """The first part of an application; then the power fails."""
    begin_load(board, 0)
    board.send(PLAIN[:600])
    board.run(ms=20)
    board.power_on()
    board.run(ms=200)
    board.take()


def test_an_application_whose_download_ended_in_an_error_is_not_started(board):
    assert load(board, 0, PLAIN, WRONG_SUM)[0] == "Error"
    assert say(board, "id").endswith("app=bad") and say(board, "go") == DAMAGED
    assert after_a_reset(board) == "bad"
    board.send("force\r")
    board.run(ms=100)
    assert board.pc < BOOT_START


def test_an_application_whose_download_was_cut_short_is_not_started(board):
    cut_short(board)
    assert bytes(board.flash[:256]) == PLAIN[:256] and after_a_reset(board) == "bad"


def test_an_incomplete_application_over_an_equal_first_page_is_not_started(board):
    board.flash[: len(PLAIN)] = PLAIN
    assert load(board, 0, PLAIN[:256] + noise(400, 5), 0)[0] == "Error"
    assert after_a_reset(board) == "bad"


def test_other_downloads_do_not_make_an_application_complete(board):
    load(board, 0, PLAIN, WRONG_SUM)
    assert load(board, 0xE000, noise(512))[0] == "Success"
    assert load(board, 0x2000, noise(512))[0] == "Success"
    assert after_a_reset(board) == "bad"


def test_the_whole_application_is_started_again(board):
    for _ in range(2):
        load(board, 0, PLAIN, WRONG_SUM)
        assert load(board, 0, PLAIN)[0] == "Success"
        assert say(board, "id").endswith("app=plain")
    assert after_a_reset(board) == "started"


@pytest.mark.parametrize("byte", [0xFF, 0x00, 0x11])
def test_what_another_program_left_in_the_mark_is_no_mark(board, byte):
    board.flash[: len(PLAIN)] = PLAIN
    board.eeprom[MAP["MEM_EE_APP_MARK"]] = byte
    assert after_a_reset(board) == "started"


def test_a_part_of_an_application_leaves_it_startable(board):
    load(board, 0, PLAIN)
    assert load(board, 0x2000, noise(512))[0] == "Success"
    assert after_a_reset(board) == "started"


def test_flash_that_does_not_take_the_data_is_tried_ten_times_and_is_an_error(board):
    board.lock(0xFB)  # BLB01: no SPM into the application section
    data = noise(600, 5)
    result = load(board, 0x2000, data)
    assert result[:3] == ("Error", 30, 601)
    assert bytes(board.flash[0x2000:0x2300]) == b"\xff" * 0x300


def test_bytes_that_are_lost_while_weak_flash_takes_several_tries_are_an_error(board):
    """Each try takes 10 ms, and the ring has 256 bytes. The sum is right all the same: the bytes are zeros."""
    tries = []

    def spoil():
        if board.operation(board.operations) == ("write", 0x2000) and len(tries) < 9:
            tries.append(0x2000)
            board.flash[0x2000] = 1

    board.on_operation(spoil)
    result, rewrites, size, _, _ = load(board, 0x2000, bytes(900))
    assert rewrites == 9 and size < 901 and board.flash[0x2000] == 0 and result == "Error"


@pytest.mark.parametrize("word", ["load", "ld", "l", "down", "dn", "LOAD"])
def test_every_name_of_load(board, word):
    board.send(f"{word} 2000\r")
    board.expect(" Write Address : 00002000\r\n Ready..")
    board.send(b"ab" + bytes([sum(b"ab") & 0xFF]))
    assert end_load(board)[0] == "Success"


def test_load_without_address_goes_to_0(board):
    board.send("load\r")
    board.expect(" Write Address : 00000000\r\n Ready..")


def test_at_full_speed_no_byte_is_lost(board):
    data = noise(20000, 7)
    load(board, 0, data)
    assert board.uart(1).overruns == 0
