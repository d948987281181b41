# SPDX-License-Identifier: MIT
"""The Monitor image: words and packets of edit/ORIGINAL.md section 11, and refusals."""

import pytest

from tests.sim.monitor_robot import robot, say


@pytest.fixture(scope="module", name="m")
def _m():
    board = robot()
    yield board
    board.close()


def sent(board):
    return [bytes(made) for _, made in board.packets]


@pytest.mark.parametrize(
    "line, answer",
    [
        ("cid", "Invalid Parameter"),
        ("cid 255", "ID must be 0..254"),
        ("id", "Invalid Parameter"),
        ("id 254", "ID must be 0..253"),
        ("read", "Invalid Parameter"),
        ("read 50", "Address must be 0..49"),
        ("read 0 51", "Count must be 1..50"),
        ("write 24", "Invalid Parameter"),
        ("write 24 256", "Value must be 0..255"),
        ("write 3" + 32 * " 1", "Invalid Parameter"),
        ("reg_wr 30", "Invalid Parameter"),
        ("reg_wr 3" + 32 * " 1", "Invalid Parameter"),
        ("go 1024", "Position must be 0..1023"),
        ("go 5 1024", "Speed must be 0..1023"),
        ("led", "Invalid Parameter"),
        ("led 2", "Value must be 0..1"),
        ("baud 0", "BAUD 1"),
        ("baud 9", "BAUD 34"),
        ("baud 255", "No image speaks another rate"),
        ("baud 256", "Value must be 0..255"),
        ("swr 30 2 1 0", "SWR address count"),
        ("swr 30 0 1 1", "SWR address count"),
        ("swr 30 1 1 256", "Value must be 0..255"),
        ("swr 30 2" + 11 * " 1 0 1", "Invalid Parameter"),
        ("reset no", "RESET YES"),
        ("action 1", "Invalid Parameter"),
        ("ping 255", "ID must be 0..254"),
        ("scan 254", "ID must be 0..253"),
        ("page 1", "Bad Command"),
        ("save", "Bad Command"),
    ],
)
def test_monitor_checks_arguments_and_sends_nothing_then(m, line, answer):
    m.clear_trace()
    assert answer in say(m, line)
    assert sent(m) == []


@pytest.mark.parametrize("line", ["id 5", "read 3", "dump", "reset yes", "baud 1"])
def test_monitor_does_to_one_servo_only_what_would_be_fatal_for_all(m, line):
    m.clear_trace()
    assert "One servo only: CID first" in say(m, "cid 254", line)
    assert sent(m) == []
    say(m, "cid 1")


def test_monitor_registered_moves_and_lamps(m):
    assert "->[Dynamixel]: FF FF 02 05 04 1E 00 01 D5" in say(m, "cid 2", "reg_wr 30 0 1")
    assert m.servos[2].goal == 512
    assert "->[Dynamixel]: FF FF FE 02 05 FA" in say(m, "cid 254", "action")
    assert m.servos[2].goal == 256
    say(m, "led 1")
    assert all(m.servos[j].table[25] == 1 for j in range(1, 19))
    say(m, "led 0", "cid 1")


def test_monitor_help_hex_and_case(m):
    heard = say(m, "?")
    for word in ("dump", "cid", "reg_wr", "exit", "swr", "search"):
        assert word in heard.lower()
    assert "FF FF 10 02 01 EC" in say(m, "HEX", "Cid 10", "PING")
    assert "FF FF 01 02 01 FB" in say(m, "dec", "cid 1", "ping")


def test_monitor_search_finds_servos_at_both_rates():
    board = robot(servos=(1, 2))
    heard = say(board, "search")
    board.run(ms=2500)
    heard += board.take().decode("latin-1")
    assert "57142 bps" in heard and "000 Dynamixels" in heard and "1000000 bps" in heard and "001 002" in heard.replace("  ", " ")
    board.close()


def test_monitor_makes_slow_servos_fast():
    board = robot(servos=(1, 2))
    slow = board.servos.add(20, "dx117")
    heard = say(board, "fast")
    board.run(ms=2500)
    heard += board.take().decode("latin-1")
    assert "Moved to 1 Mbps: 020" in heard and "001 002 020" in heard.replace("  ", " ") and "003 Dynamixels" in heard
    assert slow.table[4] == 1
    board.close()


def test_fast_leaves_a_servo_whose_id_is_taken_at_1_mbps_and_says_what_to_do():
    """Two servos with one ID at one rate can only be told apart by unplugging one."""
    board = robot(servos=(1, 3))
    slow, free, fast = board.servos.add(1, "dx117"), board.servos.add(20, "dx117"), board.servos[3]
    heard = say(board, "fast")
    board.run(ms=2500)
    heard += board.take().decode("latin-1")
    assert "Moved to 1 Mbps: 020\r" in heard and "Left at 57142 bps, because 1 Mbps has that ID: 001\r" in heard
    assert "Give the servo at 1 Mbps another ID (CID, ID), then FAST" in heard
    assert (slow.table[4], free.table[4]) == (34, 1)
    say(board, "cid 1", "id 5", "fast")
    board.run(ms=2500)
    heard = board.take().decode("latin-1")
    assert "001 003 005 020 004 Dynamixels" in heard and "Left" not in heard
    assert (slow.id, slow.table[4], fast.id) == (1, 1, 3)
    board.close()


def test_fast_names_a_servo_that_has_not_moved():
    board = robot(servos=(1,))
    board.servos.add(20, "dx117").write(47, [1])  # its EEPROM is locked until power-off
    board.send("fast\r")
    board.run(ms=2500)
    heard = board.take().decode()
    assert " Moved to 1 Mbps:\r\n ID: 001 001 Dynamixels" in heard
    assert " Not at 1 Mbps, did not obey: 020\r\n Switch the servos' power off and on" in heard
    board.close()


def test_scan_shows_an_id_that_two_servos_share():
    board = robot(servos=(1, 2, 3))
    assert "?" not in say(board, "scan 10")
    board.servos.add(2).write(5, [240])  # answers 20 us earlier
    heard = say(board, "scan 10")
    assert " ID: 001 002? 003 002 Dynamixels Found." in heard and "Two servos have this ID, or its cable is bad" in heard
    board.close()


def test_a_new_id_is_free_at_both_rates():
    board = robot(servos=(1, 3))
    slow = board.servos.add(21, "dx117")
    assert "That ID is taken at 57142 bps: FAST first" in say(board, "cid 3", "id 21")
    assert "ID 03 error 00" in say(board, "ping") and slow.id == 21
    assert "error 00" in say(board, "id 22")
    board.close()


def test_reset_makes_no_second_servo_with_id_1_at_the_other_rate():
    """Not even of servo 1: factory values may include 57,142 bps."""
    for servo in (1, 3):
        board = robot(servos=(servo,))
        slow = board.servos.add(1, "dx117")
        assert "That ID is taken at 57142 bps: FAST first" in say(board, f"cid {servo}", "reset yes")
        assert f"ID 0{servo} error 00" in say(board, "ping") and slow.table[4] == 34
        board.close()


def test_an_id_that_two_servos_share_is_taken():
    """Their answers collide, so neither is a good one."""
    board = robot(servos=(1, 3))
    board.servos.add(3).write(5, [240])  # answers 20 us earlier
    assert "That ID is taken" in say(board, "cid 1", "id 3")
    board.close()


@pytest.mark.parametrize("times", [1, None])
def test_an_id_whose_answers_are_cut_short_is_taken(times):
    board = robot(servos=(1, 3))
    board.servos[3].fault("short", times=times)
    assert "That ID is taken" in say(board, "cid 1", "id 3") and board.servos.ids == [1, 3]
    board.close()


@pytest.mark.parametrize(
    ("line", "told", "prompt"),
    [
        ("id 9", "It has obeyed: it answers now as ID 9 at 1 Mbps", "CID:009"),
        ("reset yes", "It has obeyed: it answers now as ID 1 at 1 Mbps", "CID:001"),
        ("baud 34", "It has obeyed: it answers now as ID 3 at 57142 bps", "CID:003"),
    ],
)
def test_a_servo_that_has_moved_and_whose_answer_is_lost_is_found(line, told, prompt):
    """The repeated packet goes to an ID or a rate that nobody has any more. A servo that answers READ only (level 1) never confirms."""
    for fault in ("checksum", "short", "level 1"):
        board = robot(servos=(2, 3))
        say(board, "cid 3")
        if fault == "level 1":
            board.servos[3].write(16, [1])
        else:
            board.servos[3].fault(fault, times=1)
        heard = say(board, line)
        assert told in heard and prompt in heard, fault
        board.close()
    board = robot(servos=(2,))
    assert "It has obeyed" not in say(board, "cid 3", line)
    board.close()


def test_baud_moves_a_servo_to_the_other_rate_and_fast_brings_it_back():
    board = robot(servos=(1, 3))
    assert "03 04 03 04 22" in say(board, "cid 3", "baud 34")
    assert board.servos[3].table[4] == 34 and "Timeout" in say(board, "ping")
    say(board, "fast")
    board.run(ms=2500)
    assert "ID 03 error 00" in say(board, "ping")
    one, slow = board.servos[1], board.servos.add(1, "dx117")
    assert "That ID is taken at 57142 bps: FAST first" in say(board, "cid 1", "baud 34")
    assert (one.table[4], slow.table[4]) == (1, 34)
    board.close()


def test_monitor_shows_packets_word_by_word():
    board = robot()
    for line, expected in (
        ("cid 3", ""),
        ("ping", "<-[Dynamixel]: ID 03 error 00"),
        ("read 36 2", "00 02"),
        ("write 25 1", "->[Dynamixel]: FF FF 03 04 03 19 01"),
        ("read 99", "Address must be 0..49"),
        ("foo", "Bad Command"),
        ("go 600 50", "58 02 32 00"),
        ("cid 99", ""),
        ("ping", "[Err:RxD Timeout]"),
        ("cid 4", ""),
        ("id 5", "That ID is taken"),
        ("id 40", "04 03 03 28"),
        ("scan", "018 Dynamixels"),
        ("reset", "RESET YES"),
        ("swr 30 2 1 0 2", "83 1E 02 01 00 02"),
        ("dump", "040:"),
    ):
        assert expected in say(board, line), line
    assert board.servos[3].table[25] == 1
    board.close()


def test_reset_makes_no_second_servo_with_id_1():
    board = robot(servos=(1, 3))
    assert "That ID is taken" in say(board, "cid 3", "reset yes")
    assert "ID 03 error 00" in say(board, "ping")
    assert "FF FF 01 02 06" in say(board, "cid 1", "reset yes")  # the servo that has it
    board.close()
    board = robot(servos=(3,))
    assert say(board, "cid 3", "reset yes").endswith("[CID:001(0X01)] ")
    assert "ID 01 error 00" in say(board, "ping")
    board.close()


def test_ctrl_c_drops_the_typed_line():
    board = robot(servos=(1,))
    board.send(b"go 200\x03", wait=True)
    assert "ID 01 error 00" in say(board, "ping") and board.servos[1].goal == 512
    board.close()


def test_exit_restarts():
    board = robot()
    resets = board.resets
    say(board, "exit")
    board.run(ms=500)
    assert board.resets == resets + 1
    board.close()
