# SPDX-License-Identifier: MIT
"""Servos that are lost or report faults while Edit runs: the message row, and what continues."""

from cm5sim import Board
from cm5sim.board import CYCLES_PER_TICK
from tests.sim.edit_servos import goals, start


def test_lost_servo_is_named_in_the_message_row_and_the_screen_stays():
    with start() as r:
        before = r.show().splitlines()[:30]
        r.board.servos[5].fault("silent")
        r.settle(1500)
        assert r.message.strip() == "No answer: ID 5"
        assert r.show().splitlines()[:30] == before
        r.board.servos[5].clear()
        r.settle(1500)
        assert r.message.strip() == "All servos are well"
        r.board.servos[6].fault("silent")
        assert "6" in r.line("on 6")


def test_servos_at_57142_bps_are_named_at_the_start():
    with start() as r:
        for joint in (20, 21):
            r.board.servos.add(joint, rate=57142)
        r.board.reset()
        r.settle(1500)
        assert r.message == "Arrows move, HELP explains, EXIT leaves Not used, at 57142 bps: ID 20-21"


def test_all_that_is_wrong_stands_in_one_row():
    with start() as r:
        r.line("on")
        for joint in (5, 6, 7, 9):
            r.board.servos[joint].fault("silent")
        r.board.servos[12].fault("overload")
        r.board.servos[2].fault("angle-limit")
        r.settle(1500)
        assert r.message.strip() == "Angle limit: ID 2 No answer: ID 5-7 9 Overload: ID 12"
        for joint in (2, 5, 6, 7, 9, 12):
            r.board.servos[joint].clear()
        r.settle(1000)
        assert r.message.strip() == "Lost torque: ID 12" and r.cell(0, 12) == "????"
        r.line("on 12")
        assert r.board.servos[12].torque


def test_heat_goes_from_the_row_when_it_goes_from_the_servo():
    with start() as r:
        r.line("on")
        r.board.servos[8].fault("overheating")
        r.settle(1500)
        assert r.message.strip() == "Hot: ID 8"
        r.board.servos[8].clear()
        for _ in range(60):
            if r.board.servos[8].temperature < 67:
                break
            r.board.run(ms=1000)
        r.settle(1500)
        assert r.message.strip() == "Lost torque: ID 8"


def play_until(r, fault):
    """Starts a play that this fault of servo 4 ends."""
    r.keys("play 8\r", ms=2500)
    r.board.servos[4].fault(fault)
    r.settle(1500)


def test_fault_that_ends_a_play_is_named_behind_its_end():
    with start() as r:
        play_until(r, "overheating")
        assert r.message.strip() == "Ended: a servo failed. Hot: ID 4"


def test_work_pose_after_a_play_that_loses_the_bus_is_what_was_sent_last():
    with start() as r:
        r.keys("play 8\r", ms=1200)
        before = goals(r)
        r.board.run(ms=100)
        for joint in range(1, 19):
            r.board.servos[joint].fault("dead")
        assert goals(r) != before  # the joints are moving
        r.board.clear_trace()
        r.settle(2500)
        assert r.message.strip() == "Ended: a servo failed. No answer: ID 1-18"
        sent = {}  # dead servos have not received it
        for frame in r.board.trace:
            sent |= frame.goals
        assert {joint: int(r.cell(0, joint)) for joint in range(1, 19)} == sent


def eeprom_with_rule_limp():
    """EEPROM with the setting that lets a play continue without a failed servo. Edit has no command for it, so Play writes it."""
    with Board(images=["play-cm5.hex"]) as board:
        board.expect("] ", ms=2000)
        board.send("settings fault 2\r")
        board.run(ms=1000)
        return bytes(board.eeprom[0:4096])


def test_play_that_goes_on_without_a_servo_keeps_its_ticks():
    with start(eeprom=eeprom_with_rule_limp()) as r:
        r.line("on")
        r.keys("play 6\r", ms=2200)
        r.board.clear_trace()
        for joint in range(2, 19):  # the faults come at different times within a tick
            r.board.servos[joint].fault("silent")
            r.board.run(ms=300 + joint % 8)
        r.pump()
        assert r.message.strip() == "No answer: ID 2-18"
        frames = [frame.cycle for frame in r.board.trace]
        latest = max(after - before for before, after in zip(frames, frames[1:])) - CYCLES_PER_TICK
        assert len(frames) > 600 and latest < 12_000


def test_servo_that_the_rule_let_go_is_named_limp_when_it_is_back():
    with start(eeprom=eeprom_with_rule_limp()) as r:
        r.line("off 5")
        r.keys("play 8\r", ms=2500)
        for joint in (4, 5):  # both recover without torque, which is intended for joint 5 only
            r.board.servos[joint].fault("dead")
        r.settle(1500)
        assert r.message.strip() == "No answer: ID 4-5"
        for joint in (4, 5):
            r.board.servos[joint].clear()
        r.settle(1500)
        assert r.message.strip() == "Lost torque: ID 4"
        r.keys(" ", ms=1000)
        r.line("on 4")
        r.board.servos[9].fault("silent")
        r.settle(1000)
        r.board.servos[9].clear()
        r.settle(1000)
        assert r.message.strip() == "All servos are well"


def test_end_of_a_play_is_still_told_when_one_more_servo_fails():
    with start() as r:
        play_until(r, "overheating")
        r.board.servos[9].fault("silent")
        r.settle(1000)
        assert r.message.strip() == "Ended: a servo failed. Hot: ID 4 No answer: ID 9"
        r.board.servos[4].clear()
        r.board.servos[9].clear()
        r.line("on 4")
        r.settle(1000)
        r.board.servos[9].fault("silent")
        r.settle(1000)
        assert r.message.strip() == "No answer: ID 9"


def test_servo_whose_silence_ends_a_play_is_named_once():
    with start() as r:
        play_until(r, "silent")
        assert r.message.strip() == "Ended: a servo failed. No answer: ID 4"
        r.board.servos[4].clear()
        r.settle(1000)
        assert r.message.strip() == "Ended: a servo failed. All servos are well"


def test_servo_that_fails_a_command_is_told_when_it_answers_again():
    with start() as r:
        r.board.servos[3].fault("silent", times=3)
        r.board.send("on 3\r")
        rows = []
        for _ in range(200):
            r.board.run(ms=5)
            r.pump()
            rows += [r.message.strip()] * (rows[-1:] != [r.message.strip()])
        assert rows.index("on 3 No answer: ID 3") < rows.index("All servos are well") == len(rows) - 1, rows


def test_fault_is_told_again_when_the_row_is_free():
    with start() as r:
        r.line("on")
        r.board.servos[3].fault("silent")
        r.settle(1500)
        for line, said in (("page 6", "page 6"), ("zzz", "zzz Bad Command")):
            r.line(line)
            r.settle(1000)
            assert r.message.strip() == said
            r.settle(5000)
            assert r.message.strip() == "No answer: ID 3"
        r.keys("\r", ms=1000)
        assert r.message == ""
        r.settle(5000)
        assert r.message.strip() == "No answer: ID 3"
        r.keys("pag", ms=6000)
        assert r.message == "pag"
        r.line("e 5", ms=5000)
        r.board.servos[3].clear()
        r.settle(1500)
        assert r.message.strip() == "All servos are well"
        r.line("page 6", ms=6000)
        assert r.message.strip() == "page 6"


def test_write_names_the_servos_that_do_not_answer():
    with start() as r:
        r.line("on")
        r.board.servos[3].fault("silent")
        r.settle(1500)
        assert r.line("write") == "write No answer: ID 3"
        r.line("off 5")
        assert r.line("insert 0") == "insert 0 Off: 5 No answer: ID 3"
