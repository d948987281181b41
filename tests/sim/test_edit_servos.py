# SPDX-License-Identifier: MIT
"""What Edit does to servos: GO, MIRROR, ON, OFF, SET on the work pose, PLAY with its keys, MON; editor-original.md
sections 7, 8, 10 and 11, and "nothing moves by surprise"."""
import re

import pytest
from cm5sim import Board
from cm5sim.board import CYCLES_PER_TICK

from edit_robot import page, robot, UNUSED

POSE = page("pose", [(64, {1: 400, 2: 700}), (64, {3: 612})], code=1)


def start(**options):
    pages = {1: page("neutral", [(40, {})]), 5: POSE,
             6: page("loop", [(40, {1: 560}), (40, {1: 464})], next=6, exit=7), 7: page("end", [(30, {})]),
             8: page("long", [(255, {1: 800}), (255, {1: 200})], repeat=20, exit=7, speed=64),
             9: page("la", [(30, {})], next=9, exit=10), 10: page("lb", [(30, {})], exit=9)}
    pages.update(options.pop("pages", {}))
    r = robot(pages=pages, **options)
    r.line("page 5")
    return r


def goals(r):
    return {joint: r.board.servos[joint].goal for joint in range(1, 19)}


def writes_since(r, mark):
    return [bytes(packet) for _, packet in r.board.packets[mark:] if packet[4] == 3]


def test_on_holds_the_pose_made_by_hand_and_off_lets_go():
    with start() as r:
        r.board.servos[3].push_to(300)
        r.line("on")
        assert r.cell(0, 3) == "0300" and r.cell(0, 1) == "0512"
        assert all(r.board.servos[joint].torque for joint in range(1, 19))
        assert abs(r.board.servos[3].present - 300) <= 1
        r.line("off 3 4")
        assert r.cell(0, 3) == "????" and r.cell(0, 5) == "0512"
        assert not r.board.servos[3].torque and r.board.servos[5].torque
        r.line("off")
        assert not any(r.board.servos[joint].torque for joint in range(1, 19))


def test_off_and_on_take_ranges_of_servos():
    with start() as r:
        r.line("on")
        assert r.line("off 1-3 7") == "off 1-3 7"
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1, 2, 3, 7]
        r.line("on 2-7")
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1]
        r.line("off 6-4")   # the other way round
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1, 4, 5, 6]
        r.line("on 4-6")
        for wrong in ("off 3-", "off -3", "off 1-31", "off 1-x"):
            assert r.line(wrong) == f"{wrong} ID must be 0..30"
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1]


def test_servos_that_answer_read_only_are_driven_and_not_called_dead():
    with start() as r:
        for joint in range(1, 19):
            r.board.servos[joint].write(16, [1])   # status return level; Edit looks at it when it starts
        r.board.reset()
        r.terminal.screen.reset()
        r.settle(ms=1500)
        r.line("page 5")
        r.line("on")
        mark = len(r.board.packets)
        r.line("go 0", ms=2000)
        assert "ervo" not in r.message
        assert goals(r)[1] == 400 and r.board.servos[1].table[32] == (512 - 400) // 4
        assert len([packet for packet in writes_since(r, mark) if packet[2] == 1]) == 1   # not asked again


def test_teaching_off_pose_on_write():
    with start() as r:
        r.line("off")
        r.board.servos[7].push_to(650)
        r.line("on")
        r.line("write")
        assert r.cell(3, 7) == "0650" and r.cell(9, 9) == "003"
        r.line("save")
        assert r.message.endswith("OK")
        assert int.from_bytes(r.flash_page(5)[64 + 128 + 14:64 + 128 + 16], "little") == 650


def test_go_moves_every_joint_in_about_the_same_time():
    with start() as r:
        r.line("on")
        r.line("go 0")
        assert r.text(34, 72, 3) == "000" and r.cell(0, 1) == "0400" and r.cell(0, 31) == "000" and r.cell(0, 32) == "064"
        assert goals(r)[1] == 400 and goals(r)[2] == 700
        assert r.board.servos[1].table[32] == (512 - 400) // 4 and r.board.servos[2].table[32] == (700 - 512) // 4
        r.settle(3000)
        assert abs(r.board.servos[2].present - 700) <= 2


def test_go_asks_behind_the_last_step_and_names_joints_without_a_value():
    with start() as r:
        r.line("on")
        r.line("go 4", "n")
        assert goals(r)[1] == 512
        assert r.line("go 4", "y").endswith("No value, not moved: ID 1-18")
        assert goals(r)[1] == 512


def test_go_never_drives_unused_or_released_joints():
    made = page("part", [(64, {1: 400})])
    made.set_word(0, 2, UNUSED | 100)
    made.set_word(0, 3, 0x2000 | 100)
    with start(pages={11: made}, servos=range(1, 20)) as r:
        r.line("page 11")
        r.line("on")
        message = r.line("go 0")
        r.settle(2000)
        assert "No value, not moved: ID 2 19" in message
        assert r.board.servos[2].goal == 512 and r.board.servos[19].goal == 512
        assert not r.board.servos[3].torque and r.board.servos[3].goal == 512
        assert r.cell(0, 3) == "????" and r.cell(0, 1) == "0400"


def test_mirror_exchanges_the_pairs_and_never_drives_empty_joints():
    with start() as r:
        r.line("on")
        r.line("mirror 0")
        assert goals(r)[1] == 1024 - 700 and goals(r)[2] == 1024 - 400 and goals(r)[3] == 512
        before = goals(r)
        r.line("mirror 5")
        assert goals(r) == before
        r.line("pairs 1 3")
        r.line("mirror 1")
        assert goals(r)[1] == 1024 - 612


def test_set_and_keys_on_the_work_pose_move_the_servo():
    with start() as r:
        r.line("on 4")
        r.line("goto 0 4")
        r.line("set 600")
        assert r.board.servos[4].goal == 600 and r.cell(0, 4) == "0600" and r.board.servos[4].table[32] == 22
        r.settle(2500)
        r.keys("]")
        assert r.board.servos[4].goal == 601
        r.keys("{")
        assert r.board.servos[4].goal == 591 and r.board.servos[4].table[32] == 8
        r.keys(" ")
        assert r.cell(0, 4) == "????" and not r.board.servos[4].torque
        r.keys(" ")
        assert r.board.servos[4].torque and r.cell(0, 4) != "????"
        r.line("goto 0 20")
        r.line("set 77")
        assert r.cell(0, 20) == "0077"


def test_play_ends_with_ok_and_the_work_pose_shows_where_it_stands():
    with start() as r:
        r.line("play", ms=4000)
        r.settle(2000)
        assert r.message.startswith("Page 5 step ") and r.message.endswith(" OK")
        assert r.cell(0, 1) == "0512" and r.cell(0, 3) == "0612"
        assert r.board.servos[3].goal == 612


def test_play_takes_unsaved_edits_from_ram():
    with start() as r:
        r.line("goto 2 3")
        r.line("set 700")
        r.line("play", ms=5000)
        r.settle(1000)
        assert r.board.servos[3].goal == 700 and r.unsaved


def test_while_it_plays_the_screen_shows_goals_and_where_the_servos_are():
    """Joint 1 moves 100 units a second: what stands there is at most a round of 31 ticks old."""
    made = page("slow", [(5, {1: 300}), (255, {1: 700})], schedule=10, speed=64)
    with start(pages={20: made}) as r:
        r.line("go 0", ms=2500)   # near step 0 of page 20: joint 1 stands at 400
        r.board.send("play 20\r")
        r.board.run(ms=1500)
        seen = []
        for _ in range(6):
            r.board.run(ms=300)
            r.pump()
            assert re.fullmatch(r"Page 20 step 1 repetition 1", r.message), r.message
            goal, live = int(r.cell(0, 1)), int(r.text(2, 14, 4))
            assert abs(goal - r.board.servos[1].goal) <= 30 and abs(live - r.board.servos[1].present) <= 60
            seen.append(goal)
        assert len(set(seen)) == 6
        r.keys(" ", ms=1500)
        assert r.text(2, 14, 4) == "0x01" and not r.unsaved


def move_ticks(r, line, joint):
    """Ticks from 300, where the approach has led the joint, to 700 after `line`."""
    r.line("go 0", ms=1500)
    mark = len(r.board.trace)
    r.line(line, ms=6500)
    way = [(frame.tick, frame.goals[joint]) for frame in r.board.trace[mark:] if joint in frame.goals]
    return min(tick for tick, goal in way if goal == 700) - max(tick for tick, goal in way if goal == 300)


def test_play_n_rate_shortens_and_stretches_steps_and_lasts_for_one_play():
    """128 ticks as stored, shaping.md: ticks / rate."""
    made = page("timed", [(10, {1: 300}), (128, {1: 700})], schedule=10, accel=0)
    with start(pages={20: made}) as r:
        r.line("page 20")
        stored = move_ticks(r, "play", 1)
        assert stored == 128
        for rate in (50, 100, 200):
            assert abs(move_ticks(r, f"play 20 {rate}", 1) - stored * 100 / rate) <= 1, rate
        assert abs(move_ticks(r, "play 20", 1) - stored) <= 1
        move_ticks(r, "play 20 200", 1)
        assert abs(move_ticks(r, "@play 20", 1) - stored) <= 1
        assert r.line("play 20 9") == "play 20 9 Percent must be 10..400"
        assert r.line("play 20 401") == "play 20 401 Percent must be 10..400"
        assert r.line("play 20 x") == "play 20 x Percent must be 10..400"


def test_play_at_a_high_rate_asks_no_servo_for_more_than_its_battery_gives():
    """400 units in 32 ticks at rate 400 are 12.5 a tick. body.md: 8.7 units a tick at 11.1 V, 90 % of it: 6.8 at 9.6 V."""
    made = page("timed", [(10, {1: 300}), (128, {1: 700})], schedule=10, accel=0)
    with start(pages={20: made}) as r:
        r.board.battery(9.6)
        r.line("page 20", ms=600)
        ticks = move_ticks(r, "play 20 400", 1)
        assert 400 / 6.8 <= ticks <= 400 / 6.8 + 3


def test_play_begins_with_the_approach():
    with start() as r:
        r.board.servos[1].push_to(900)
        r.keys("play\r", ms=3000)
        trace = [frame for frame in r.board.trace if 1 in frame[2]]
        steps = [abs(b[2][1] - a[2][1]) for a, b in zip(trace, trace[1:])]
        assert max(steps[:100]) <= 4   # 60 degrees/s = 1.6 units a tick
        r.keys(" ")


@pytest.mark.parametrize("key, shown, exit_page", [("\r", "[STOP]", True), ("\x1b", "[Exit]", False)])
def test_play_stops_at_the_end_of_the_page(key, shown, exit_page):
    with start() as r:
        r.keys("play 6\r", ms=2500)
        assert r.message.startswith("Page 6 step ")
        r.keys(key, ms=4000)
        r.settle(1500)
        assert r.message.startswith("Page ") and r.message.endswith(" OK")
        assert (r.board.servos[1].goal == 512) == exit_page


@pytest.mark.parametrize("key", [" ", "\x03"])
def test_play_breaks_at_once_and_slows_down(key):
    with start() as r:
        r.keys("play 8\r", ms=3000)
        r.keys(key, ms=600)
        assert r.message.startswith("Page 8 step ") and r.message.endswith("[BREAK] OK")
        assert all(r.board.servos[joint].torque for joint in range(1, 19))
        stood = goals(r)
        r.settle(1000)
        assert goals(r) == stood


def test_space_just_behind_the_end_of_a_play_changes_no_cell():
    with start() as r:
        r.line("goto 1 1")
        r.board.send("play 5\r")
        for _ in range(2000):
            r.board.run(ms=5)
            r.pump()
            if r.message.endswith(" OK"):
                break
        assert r.message.endswith(" OK")
        r.keys(" ", ms=1000)
        assert r.cell(1, 1) == "0400" and not r.unsaved
        r.keys(" ")
        assert r.cell(1, 1) == "????" and r.unsaved


def test_what_is_typed_while_a_broken_play_slows_down_is_kept():
    with start() as r:
        r.keys("play 8\r", ms=3000)
        r.keys("  page 6\r", ms=1000)
        assert r.text(2, 76, 4) == "0006" and not r.unsaved


def test_play_of_what_cannot_be_played_says_why():
    torn = page("torn", [(30, {})])
    torn.data[99] ^= 1
    with start(pages={20: torn, 21: page("none")}) as r:
        assert r.line("play 20") == "play 20 Page 20 is damaged: checksum is wrong"
        assert "empty" in r.line("play 21")
        r.line("page 0")
        assert r.line("play") == "play Page must be 1..127"


def test_play_ends_in_a_loop_of_exit_links():
    with start() as r:
        r.keys("play 9\r", ms=2000)
        r.keys("\r", ms=3000)
        r.settle(500)
        assert r.message.endswith("[STOP] OK, the exit links loop")


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


def play_until(r, fault):
    """A play that this fault of servo 4 ends."""
    r.keys("play 8\r", ms=2500)
    r.board.servos[4].fault(fault)
    r.settle(1500)


def test_fault_that_ends_a_play_is_named_behind_its_end():
    with start() as r:
        play_until(r, "overheating")
        assert r.message.strip() == "Ended: a servo failed. Hot: ID 4"


def eeprom_with_rule_limp():
    """A play goes on without a servo that fails. Edit has no command for this setting, so Play writes it."""
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
        for joint in range(2, 19):      # each is told at another time within a tick
            r.board.servos[joint].fault("silent")
            r.board.run(ms=300 + joint % 8)
        r.pump()
        assert r.message.strip() == "No answer: ID 2-18"
        frames = [frame.cycle for frame in r.board.trace]
        latest = max(after - before for before, after in zip(frames, frames[1:])) - CYCLES_PER_TICK
        assert len(frames) > 600 and latest < 12_000


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


def test_page_0_computes_the_trim():
    with start() as r:
        r.line("page 0")
        assert r.terminal.row(34)[19:40] == "STP7  MSTR SLAV OFST "
        r.line("goto 1 3")
        r.line("set 512")
        r.line("goto 2 3")
        r.line("set 500")
        assert r.cell(3, 3) == "-012"
        r.line("step 3")
        r.line("save")
        assert r.message.startswith("save OK")
        r.line("page 5")
        r.line("on")
        r.line("go 1")
        assert r.board.servos[3].goal == 612 - 12 and r.cell(0, 3) == "0612"




def test_exit_restarts_the_controller():
    with start() as r:
        resets = r.board.resets
        r.line("exit", ms=1500)
        r.settle()
        assert r.board.resets == resets + 1 and r.text(2, 76, 4) == "0001"


def test_play_says_that_the_classic_law_is_not_here():
    with Board(images=["boot-cm5.hex", "play-cm5.hex"], servos=range(1, 19)) as other:   # the setting is made with Play
        other.eeprom[0xFFF] = 0x11
        other.run(ms=2500)
        other.send("law classic\r")
        other.run(ms=1500)
        eeprom = bytes(other.eeprom[0:0x800])
    with start() as r:
        r.board.eeprom[0:0x800] = eeprom
        r.board.reset()
        r.terminal.screen.reset()
        r.settle(ms=1500)
        message = r.line("play 5", ms=300)
        assert "classic" in message.lower() or "law" in message.lower(), message
        assert not any(r.board.servos[joint].torque for joint in range(1, 19))


def test_mon_says_where_it_is():
    with start() as r:
        assert r.line("mon") == r.line("monitor").replace("monitor MON", "mon MON") and "monitor.hex" in r.message
        assert not r.unsaved
