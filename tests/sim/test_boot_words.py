# SPDX-License-Identifier: MIT
"""Every word of the boot loader's prompt, against boot/ORIGINAL.md section 2 and firmware/boot/DIFFERENCES.md."""

import re

import pytest

from tests.sim.boot_board import APP_END, BOOT_MODE, PROMPT, crc16, new_board, noise, prompt_board, say

BAD_COMMAND = "\r\n Bad Command.(see 'help')"
BAD_ARGUMENT = "\r\n Bad Argument."
BAD_ADDRESS = "\r\n Bad Address."


def dump_lines(memory, address, size):
    """Eight lines of a dump in the format of section 2."""
    text = ""
    for row in range(8):
        start = (address + 16 * row) % size
        row_bytes = bytes(memory[(start + i) % size] for i in range(16))
        text += (
            f"\r\n {start:08X} : "
            + "".join(f"{byte:02X} " for byte in row_bytes)
            + "".join(chr(byte) if 0x20 <= byte < 0x80 else "." for byte in row_bytes)
        )
    return text + "\r\n"


@pytest.fixture
def board():
    return prompt_board()


def test_start_says_ff_banner_prompt():
    board = new_board()
    board.run(ms=250)
    assert re.fullmatch(rb"\xff\r\n\n SYSTEM O\.K\. \(Motion512 Boot loader V1\.00\)\r\n - ", board.take())


def test_three_leds_light_for_100_ms_before_the_banner():
    board = new_board()
    board.run(ms=40)
    assert board.leds == {"power"}
    board.run(ms=60)
    assert board.leds == {"power", "manage", "program", "aux"} or {"manage", "program"} <= board.leds
    board.expect(PROMPT, ms=200)
    board.run(ms=5)
    assert board.leds == {"power"}


def test_help_lists_every_word(board):
    text = say(board, "help")
    for word in (
        "HELP FLASH EEP RAM LOAD LD L DOWN DN UP EEP_UP EEP_DN VERIFY CLEAR_EEPROM GO RESET APP SYS EDIT PLAY MON TOSS DUMP CHECK ID"
    ).split():
        assert f" {word} " in text


def test_flash_dump(board):
    board.flash[0x0E000:0x0E080] = noise(128)
    for word in ("f", "flash", "FLASH", "Flash"):
        assert say(board, f"{word} e000") == dump_lines(board.flash, 0xE000, 0x20000), word


def test_numbers_and_what_separates_them(board):
    """Every character from space to / and tab separates. Leading zeros do no harm."""
    board.flash[0x0E000:0x0E080] = noise(128)
    for line in ("f 0xe000", "f 0XE000", "f,e000", "f , e000", "f\te000", "f/e000", "f.e000 ", "  f  e000  ", "f#e000", "f 0000000000000e000"):
        assert say(board, line) == dump_lines(board.flash, 0xE000, 0x20000), line
    assert say(board, "f 1fff0") == dump_lines(board.flash, 0x1FFF0, 0x20000)


def test_eeprom_and_ram_dump(board):
    board.eeprom[0xF80:0x1000] = noise(128)
    for word in ("e", "eep", "eeprom"):
        assert say(board, f"{word} f88") == dump_lines(board.eeprom, 0xF88, 0x1000), word
    for word in ("r", "ram"):
        assert say(board, f"{word} f00") == dump_lines(board.ram, 0xF00, 0x1100), word
    assert say(board, "r 0").count("\r\n ") == 8  # the registers; those of the buttons' pins are among them


def test_dump_goes_on_where_the_last_one_ended(board):
    board.flash[0x100:0x300] = noise(512)
    say(board, "f 100")
    assert say(board, "f") == dump_lines(board.flash, 0x180, 0x20000)
    assert say(board, "f") == dump_lines(board.flash, 0x200, 0x20000)


def test_first_dump_without_address_is_at_0(board):
    assert say(board, "f") == dump_lines(board.flash, 0, 0x20000)


def test_dumps_can_be_typed_ahead(board):
    board.send("f 0\rf\rf\r")
    board.run(ms=600)
    assert board.take().count(b"\r\n - ") == 3


def test_bad_numbers_and_extra_arguments_are_refused(board):
    before = bytes(board.flash), bytes(board.eeprom)
    for line in (
        "f xyz,f g,f 1g,f 0x,f x,f 1x1,f 0x0x1,f :,f @,f ~,f 1 z,f -1 2,f 100000,f 21e0000,f 123456789,f 10000000000000000000000000000e000,"
        "load 1 2,load e000 20,help 1,go 1 2,app 1,f 1 2 3,up 1 2 3,up 1 2 ggg,verify 1"
    ).split(","):
        assert say(board, line) == BAD_ARGUMENT, line
    assert (bytes(board.flash), bytes(board.eeprom)) == before


def test_bad_addresses_are_refused(board):
    for line in (
        "load 1e000,load 0x1ffff,load 20000,load fffff,up 1ffff 2,up 20000 1,eep_up fff 2,eep_up 1000 1,eep_dn fff 2,eep_dn 0 801,go 10000,"
        "flash 20000,f 2e000,eeprom 1000,ram 2000"
    ).split(","):
        assert say(board, line) == BAD_ADDRESS, line


def test_unknown_words(board):
    for line in ("foo", "hel", "helpp", "load1", "~", "0x10"):
        assert say(board, line) == BAD_COMMAND, line


def test_hashes_left_over_from_the_start_do_not_swallow_a_word(board):
    for line in ("#app", "#####app", " # app", "# #\tapp"):
        assert say(board, line) == say(board, "app") != "", line


def test_empty_lines_do_nothing(board):
    for line in ("", "   ", "####", " # ", "/help", "-help", "*", "#-x"):
        assert say(board, line) == "", line


@pytest.mark.parametrize("end, prompts", [("\r", 1), ("\n", 1), ("\r\n", 1), ("\r\r", 2), ("\n\n", 2)])
def test_line_ends(board, end, prompts):
    board.send("app" + end)
    board.run(ms=100)
    assert board.take().decode().count(PROMPT) == prompts


def test_backspace_rubs_out_and_del_does_not(board):
    board.send("apx\x08p\r")
    text = board.expect(PROMPT)
    assert text.startswith("apx\x08 \x08p\r\n Boot to Application")
    board.send("\x08\x08\r")
    assert board.expect(PROMPT) == PROMPT
    assert say(board, "ap\x7fp") == BAD_COMMAND


def test_nul_and_esc_are_not_echoed(board):
    board.send(b"a\x00p\x1bp\r")
    assert board.expect(PROMPT).startswith("app\r\n Boot")


def test_no_length_of_line_overruns(board):
    for count in (78, 79, 80, 81, 255, 1000):
        board.send("z" * count + "\r")
        text = board.expect(PROMPT, ms=2000)
        assert text == "z" * min(count, 79) + BAD_COMMAND + PROMPT, count
    assert say(board, "app") == "\r\n Boot to Application"


def test_a_flood_of_number_signs_does_no_harm(board):
    board.send("#" * 5000 + "\r")
    board.expect(PROMPT, ms=3000)
    assert say(board, "app") == "\r\n Boot to Application"


def test_type_ahead_beyond_the_ring_loses_the_new_bytes_only(board):
    board.send("clear_eeprom 100 10\r")
    board.eeprom[0x100:0x140] = bytes(64)
    board.send("app\r" + "x" * 600 + "\r")
    board.run(ms=1000)
    board.take()
    assert board.eeprom[BOOT_MODE] == 0x11


@pytest.mark.parametrize(
    "word, text, address, value",
    [
        ("app", " Boot to Application", 0xFFF, 0x11),
        ("application", " Boot to Application", 0xFFF, 0x11),
        ("sys", " Boot to System", 0xFFF, 0xFF),
        ("system", " Boot to System", 0xFFF, 0xFF),
        ("play", " Play Mode", 0xFF3, 0x12),
        ("toss", " Toss Mode", 0xFF3, 0x13),
        ("mon", " Monitor Mode", 0xFF3, 0x14),
        ("monitor", " Monitor Mode", 0xFF3, 0x14),
        ("edit", " Motion Edit Mode", 0xFF3, 0x15),
        ("dump", " DUMP485 Mode", 0xFF3, 0x16),
    ],
)
def test_words_that_store_a_byte(board, word, text, address, value):
    board.eeprom[address] = 0x77
    assert say(board, word) == "\r\n" + text
    assert board.eeprom[address] == value
    assert say(board, word.upper()) == "\r\n" + text


@pytest.mark.parametrize("word", ["up", "eep_up", "eep_dn"])
def test_usage_of_the_transfers(board, word):
    assert say(board, word) == f"\r\n {word.upper()} StartAddress, Length"
    assert say(board, word + " 1") == f"\r\n {word.upper()} StartAddress, Length"


@pytest.mark.parametrize("word, memory", [("up", "flash"), ("eep_up", "eeprom")])
def test_up_by_a_key(board, word, memory):
    data = noise(300, 5)
    getattr(board, memory)[0x200 : 0x200 + 300] = data
    board.send(f"{word} 200 12c\r")
    board.expect("\r\n Push button when ready...")
    board.run(ms=500)
    assert board.take() == b""
    board.send("\r")
    board.run(ms=150)
    got = board.take()
    assert got[:300] == data
    board.expect(" - ", ms=200)


def test_up_by_the_button(board):
    board.send("up 0 10\r")
    board.expect("ready...")
    board.press("START")
    board.run(ms=300)
    assert board.take() == b""
    board.release("START")
    board.run(ms=20)
    assert board.take() == b"\xff" * 16
    board.expect(PROMPT, ms=300)
    board.run(ms=300)
    assert board.take() == b""


def test_up_blinks(board):
    board.send("up 0 10\r")
    board.expect("ready...")
    seen = set()
    for _ in range(40):
        board.run(ms=10)
        seen.add(frozenset(board.leds))
    assert len(seen) == 2


def test_up_is_left_by_esc(board):
    board.send("up 0 10\r")
    board.expect("ready...")
    board.send(b"\x1b")
    assert board.expect(PROMPT) == PROMPT


def test_eep_dn(board):
    data = noise(0x208, 7)
    board.send("eep_dn 300 208\r")
    board.expect("\r\n Write Address : 00000300\r\n Ready")
    board.send(data)
    text = board.expect(PROMPT, ms=10000)
    assert text == "..\r\n O.K." + PROMPT
    assert bytes(board.eeprom[0x300:0x508]) == data
    assert board.eeprom[0x508] == 0xFF and board.eeprom[0x2FF] == 0xFF


def test_eep_dn_with_cr_lf_takes_no_lf_as_data(board):
    board.send("eep_dn 300 2\r\n")
    board.expect("Ready")
    board.send(b"\x0a\x0d")
    board.expect("O.K.")
    assert bytes(board.eeprom[0x300:0x302]) == b"\x0a\x0d"


def test_eep_dn_gives_up_after_two_seconds(board):
    board.send("eep_dn 300 10\r")
    board.expect("Ready")
    board.send(b"abc")
    text = board.expect(PROMPT, ms=2500)
    assert text == "\r\n Error" + PROMPT
    assert bytes(board.eeprom[0x300:0x310]) == b"\xff" * 16


def test_verify_sums_the_last_download(board):
    data = noise(1000, 3)
    board.flash[0:1000] = data
    board.eeprom[0xFF6] = sum(data) & 0xFF
    board.eeprom[0xFF7:0xFFB] = sum(data).to_bytes(4, "little")
    board.eeprom[0xFFB:0xFFF] = (1001).to_bytes(4, "little")
    for word in ("verify", "v"):
        assert say(board, word) == (
            f"\r\n Program Length : 0x000003E9\r\n Verified Checksum : {sum(data) & 0xFF:02X}-{sum(data):08X}-{sum(data):08X}"
        )


def test_verify_without_a_download_ends(board):
    assert say(board, "verify", ms=4000).startswith("\r\n Program Length : 0xFFFFFFFF")


def test_clear_eeprom_in_part(board):
    board.eeprom[0x100:0x120] = bytes(32)
    assert say(board, "clear_eeprom 104 8") == "\r\n EEPROM Clearing"
    assert bytes(board.eeprom[0x100:0x120]) == bytes(4) + b"\xff" * 8 + bytes(20)


def test_clear_eeprom_with_one_argument_does_nothing(board):
    board.eeprom[0x100] = 0
    assert say(board, "clear_eeprom 100") == ""
    assert board.eeprom[0x100] == 0


@pytest.mark.parametrize("answer, cleared", [("n", False), ("\r", False), ("y", True), ("Y", True)])
def test_clear_eeprom_asks(board, answer, cleared):
    board.eeprom[0x100:0x120] = bytes(32)
    board.eeprom[BOOT_MODE] = 0x11
    board.send("clear_eeprom\r")
    board.expect("(y/N)")
    board.send(answer)
    text = board.expect(PROMPT, ms=4000)
    assert (board.eeprom[0x100] == 0xFF) == cleared
    assert (board.eeprom[BOOT_MODE] == 0xFF) == cleared
    assert text.count(".") == (16 if cleared else 0)


def test_reset_restarts_by_the_watchdog(board):
    board.send("reset\r")
    board.run(ms=5)
    board.expect("\xff\r\n\n SYSTEM O.K.".encode("latin-1"), ms=400)
    assert board.reset_cause == "watchdog"


def test_go_without_an_application_stays(board):
    assert say(board, "go") == "\r\n Jump Address : 0x00000000\r\n No application."


def test_go_to_the_loader_starts_it_again(board):
    board.send("go f000\r")
    board.expect("\r\n Jump Address : 0x0000F000")
    board.expect("SYSTEM O.K.", ms=400)


def test_check_tells_every_page_and_repeats_it_as_one_line():
    board = prompt_board()
    good = bytearray(512)
    good[15], good[20], good[22] = 1, 1, 32
    good[31] = (0xFF - sum(good)) & 0xFF
    empty = bytearray(good)
    empty[20], empty[31] = 0, empty[31] + 1
    bad = bytearray(good)
    bad[100] ^= 1
    board.flash[0xE000 : 0xE000 + 2048] = bytes(good + empty + bad + good)
    board.flash[0x100:0x110] = noise(16)
    text = say(board, "check", ms=5000)
    lines = text.split("\r\n ")
    rows = lines[2:6]
    assert rows[0].startswith("+.X+....") and [len(row) for row in rows] == [32] * 4
    match = re.fullmatch(r"CHECK app=(\w+),([0-9A-F]{4}) motion=([0-9A-F]{4}),02,7D,01 boot=0000 ram=good ee=([0-9A-F]{10})", lines[6])
    assert match, lines[6]
    assert match[1] == "none"
    assert int(match[2], 16) == crc16(board.flash[0:APP_END])
    assert int(match[3], 16) == crc16(board.flash[0xE000:0x1E000])


def test_check_keeps_what_is_typed_while_it_tests_the_ram():
    """The RAM test also writes patterns over the count of received bytes. A byte that arrives at any instruction of that moment must not be
    lost."""
    head, at_test = prompt_board().variable("head"), []

    def at_the_test():
        """A board shortly before the test, which begins while " ram=" is being sent. expect() polls every 20 ms, but the test takes only 6."""
        board = prompt_board()
        board.send("check\r")
        start = len(board.console)
        while b"boot=0000" not in board.console[start:]:
            board.run(ms=0.1)
        board.expect("boot=0000")
        return board

    for place in range(14):
        board = at_the_test()
        if not at_test:
            watched = at_the_test()
            start, value = watched.now_cycles, watched.ram[head]
            while watched.ram[head] == value:
                at_test[:] = [watched.now_cycles - start]
                watched.step()
        board.run(cycles=at_test[0] - 4)
        for _ in range(place):
            board.step()
        board.interrupt("console byte", ord("~"))
        assert board.expect(PROMPT).startswith(" ram=good "), place
        board.run(ms=2)
        assert board.take() == b"~", place


def test_check_sees_a_damaged_loader():
    board = prompt_board()
    board.flash[0x1FFF4] = 0x7F
    assert "boot=0000" not in say(board, "check", ms=5000)


def test_id_is_one_line(board):
    assert re.fullmatch(r"\r\n ID Motion512 boot 1\.00 CM5 api=1 app=none", say(board, "id"))


def test_cm2_has_the_same_prompt():
    board = prompt_board(kind="cm2")
    assert "CM2" in say(board, "id")
    board.press("START")
    board.run(ms=100)
    assert board.take() == b""


def test_late_binary_data_are_not_commands(board):
    before = bytes(board.flash)
    board.send(b"\x80\x91app\r")
    board.run(ms=100)
    assert bytes(board.flash) == before and board.eeprom[BOOT_MODE] == 0xFF
