# SPDX-License-Identifier: MIT
"""PLAY in Edit with its keys: edit/ORIGINAL.md section 8, and "nothing moves by surprise"."""

import re

import pytest

from cm5sim import Board
from tests.sim.edit_robot import page
from tests.sim.edit_servos import goals, start


def test_play_ends_with_ok_and_the_work_pose_shows_where_it_stands():
    with start() as r:
        r.line("play", ms=4000)
        r.settle(2000)
        assert r.message.startswith("Page 5 step ") and r.message.endswith(" OK")
        assert r.cell(0, 1) == "0512" and r.cell(0, 3) == "0612"
        assert r.board.servos[3].goal == 612


@pytest.mark.parametrize("last", [1, 2, 4])
def test_no_step_is_told_behind_the_end(last):
    """All joints move, so that the positions fill the line, and the last step is so short that its report may still wait."""
    steps = [(64, dict.fromkeys(range(1, 19), 400)), (8, dict.fromkeys(range(1, 19), 420)), (last, dict.fromkeys(range(1, 19), 430))]
    with start(pages={20: page("rush", steps)}) as r:
        r.keys("play 20\r", ms=5000)
        assert r.message.endswith(" OK"), r.message


def test_play_takes_unsaved_edits_from_ram():
    with start() as r:
        r.line("goto 2 3")
        r.line("set 700")
        r.line("play", ms=5000)
        r.settle(1000)
        assert r.board.servos[3].goal == 700 and r.unsaved


def test_while_it_plays_the_screen_shows_goals_and_where_the_servos_are():
    """Joint 1 moves 100 units a second: its position on the screen is at most one round of 31 ticks old."""
    made = page("slow", [(5, {1: 300}), (255, {1: 700})], schedule=10, speed=64)
    with start(pages={20: made}) as r:
        r.line("go 0", ms=2500)  # near step 0 of page 20: joint 1 is at 400
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
    """Ticks after `line` from 300, where the approach has moved the joint, to 700."""
    r.line("go 0", ms=1500)
    mark = len(r.board.trace)
    r.line(line, ms=4000)
    way = [(frame.tick, frame.goals[joint]) for frame in r.board.trace[mark:] if joint in frame.goals]
    return min(tick for tick, goal in way if goal == 700) - max(tick for tick, goal in way if goal == 300)


def test_play_n_rate_shortens_and_stretches_steps_and_lasts_for_one_play():
    """128 ticks as stored, SHAPING.md: ticks / rate."""
    made = page("timed", [(10, {1: 300}), (128, {1: 700})], schedule=10, accel=0)
    with start(pages={20: made}) as r:
        r.line("page 20")
        stored = move_ticks(r, "play", 1)
        assert stored == 128
        for rate in (50, 200):
            assert abs(move_ticks(r, f"play 20 {rate}", 1) - stored * 100 / rate) <= 1, rate
        assert abs(move_ticks(r, "@play 20", 1) - stored) <= 1
        assert r.line("play 20 9") == "play 20 9 Percent must be 10..400"
        assert r.line("play 20 401") == "play 20 401 Percent must be 10..400"
        assert r.line("play 20 x") == "play 20 x Percent must be 10..400"


def test_play_at_a_high_rate_asks_no_servo_for_more_than_its_battery_gives():
    """400 units in 32 ticks at rate 400 are 12.5 a tick. body/README.md: 8.7 units a tick at 11.1 V, 90 % allowed: 6.8 at 9.6 V."""
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
        assert max(steps[:100]) <= 4  # 60 degrees/s = 1.6 units a tick
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


@pytest.mark.parametrize("before", ["", "\r"])
def test_the_end_of_a_line_that_began_during_a_play_is_no_command(before):
    """The space in the line breaks the play. `off` after it would let the robot fall."""
    with start() as r:
        r.keys("play 8\r", ms=3000)
        r.keys(before, ms=150)
        r.keys("help off\r", ms=1500)
        assert r.message.endswith("[BREAK] OK")
        assert all(r.board.servos[joint].torque for joint in range(1, 19))
        r.line("off 3")
        assert not r.board.servos[3].torque


def test_play_of_what_cannot_be_played_says_why():
    torn = page("torn", [(30, {})])
    torn.data[99] ^= 1
    with start(pages={20: torn, 21: page("none"), 22: page("count 0", [(40, {})], repeat=0)}) as r:
        assert r.line("play 20") == "play 20 Page 20 is damaged: checksum is wrong"
        assert "empty" in r.line("play 21")
        assert r.line("play 22") == "play 22 Page 22 has PlayCount 0"
        r.line("page 0")
        assert r.line("play") == "play Page must be 1..127"


def test_play_ends_in_a_loop_of_exit_links():
    with start() as r:
        r.keys("play 9\r", ms=2000)
        r.keys("\r", ms=3000)
        r.settle(500)
        assert r.message.endswith("[STOP] OK, the exit links loop")


def test_play_says_that_the_classic_law_is_not_here():
    with Board(images=["boot-cm5.hex", "play-cm5.hex"], servos=range(1, 19)) as other:  # Play writes this setting
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
