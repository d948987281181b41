# SPDX-License-Identifier: MIT
"""Joints moved by code with `aim`, `swing`, `free` (SHAPING.md), in the shipped Play image, with and without a play."""

import pytest

from tests.sim.play_robot import JOINTS, STOP, ask, press_start, robot
from tests.sim.walking_robot import EXIT, LOOP, looping, pages, where

HEAD = (19, 20)
WITH_HEAD = (*JOINTS, *HEAD)
HAND_OVER = 2  # 60 degrees/s are 1.6 units a tick


def row_of(board, joint):
    """All goals sent to a joint, in order."""
    return [frame.goals[joint] for frame in board.trace if joint in frame.goals]


def speeds(row):
    return [b - a for a, b in zip(row, row[1:])]


def test_aim_while_nothing_plays_moves_this_joint_only_and_slowly():
    board = robot(servos=WITH_HEAD, pages=pages())
    board.clear_trace()
    assert ask(board, "aim 19 700") == " OK"
    board.run(ms=1500)
    row = row_of(board, 19)
    assert row[0] <= 512 + HAND_OVER and row[-1] == 700 and set(speeds(row)) <= {0, 1, 2}
    assert [joint for joint in WITH_HEAD if row_of(board, joint)] == [19]
    assert [joint for joint in WITH_HEAD if board.servos[joint].torque] == [19]
    assert where(board)["aim"] == f"{1 << 19:08X}" and where(board)["state"] == "idle"
    board.clear_trace()
    assert ask(board, "@aim 19 500 240") == "@aim OK"
    board.run(ms=500)
    assert row_of(board, 19)[-1] == 500 and max(map(abs, speeds(row_of(board, 19)))) == 7  # 6.4 units a tick
    assert ask(board, "free") == " OK"
    assert where(board)["aim"] == "00000000" and board.servos[19].torque


def test_refused_words_say_one_sentence_and_change_nothing():
    board = robot(servos=WITH_HEAD, pages=pages())
    board.clear_trace()
    for line, said in (
        ("aim 25 512", "None of these servos can be moved: missing, or off (stop, then on)"),
        ("aim 31 512", "ID must be 0..30"),
        ("aim 19 1024", "Position must be 0..1023"),
        ("aim 19 512 0", "Degrees/s must be 1..360"),
        ("aim 19 512 361", "Degrees/s must be 1..360"),
        ("swing 19 512 100 124", "Milliseconds must be 125..30000"),
        ("swing 19 512 100 1000 360", "Phase must be 0..359"),
        ("free 31", "ID must be 0..30"),
        ("swing 19 50 100 1000", "Too far or too fast"),
        ("swing 19 512 200 500", "Too far or too fast"),
        ("aim 19", "Too few or too many words"),
    ):
        assert ask(board, line).removesuffix(": try help") == said
        answer = ask(board, "@" + line)
        assert answer.startswith(f"@{line.split()[0]} ERR ") and answer.endswith(said), answer
    assert where(board)["aim"] == "00000000" and not board.trace and not any(board.servos[joint].torque for joint in WITH_HEAD)
    for joint in (1, 2, 19, 20):
        assert ask(board, f"aim {joint} 520") == " OK"
    assert ask(board, "aim 3 520") == "Four joints are moved already: free one"
    assert ask(board, "aim 20 530") == " OK"  # replaces the aim of the same joint
    ask(board, "off 5")
    ask(board, "free 1")
    assert ask(board, "aim 5 520") == "None of these servos can be moved: missing, or off (stop, then on)"  # switched off by hand
    assert ask(board, f"play {LOOP}") == " OK"
    assert ask(board, "aim 4 520") == "Busy: stop what is playing first"  # in its approach
    assert not board.servos[5].torque


def test_a_play_begins_and_ends_while_a_joint_swings():
    board = robot(servos=WITH_HEAD, pages=pages())
    assert ask(board, "swing 19 512 80 2000") == " OK"
    board.run(ms=1000)
    board.clear_trace()
    assert ask(board, f"play {LOOP}") == " OK"
    board.run(ms=4000)
    assert ask(board, "stop") == " OK"
    board.expect(f"Stopped after page {EXIT}", ms=5000)
    board.run(ms=300)
    row = row_of(board, 19)
    assert max(map(abs, speeds(row))) <= 3 and max(row) > 585 and min(row) < 440
    assert where(board)["missed"] == "0" and where(board)["aim"] == "00000000"  # a stop ends it


@pytest.mark.parametrize("how", ["break", "off 19", "off", "stop"])
def test_what_ends_it(how):
    board = robot(servos=WITH_HEAD, pages=pages())
    ask(board, "swing 19 512 80 2000")
    board.run(ms=800)
    assert ask(board, how) == " OK"
    board.run(ms=100)
    at = board.servos[19].goal
    board.clear_trace()
    board.run(ms=1000)
    assert board.servos[19].goal == at and not row_of(board, 19)
    assert board.servos[19].torque == (not how.startswith("off"))
    assert where(board)["aim"] == "00000000"


def test_a_silent_servo_ends_a_swing_and_is_told():
    board = robot(servos=WITH_HEAD, pages=pages())
    ask(board, "swing 19 512 80 2000")
    board.run(ms=500)
    board.servos[19].fault("silent")
    board.expect("Servo 19 does not answer", ms=2000)
    assert where(board)["aim"] == "00000000"


def test_an_aim_holds_in_a_pause_and_after_it():
    board = looping()
    assert ask(board, "aim 3 600") == " OK"
    board.run(ms=200)
    ask(board, "pause")
    board.run(ms=500)
    at = board.servos[3].goal
    board.run(ms=500)
    assert board.servos[3].goal == at < 600
    assert ask(board, "resume") == " OK"
    board.run(ms=1500)
    assert board.servos[3].goal == 600


# --- code-made motion and the rest of the robot ---


@pytest.mark.parametrize("away", [100, 103])
def test_a_freed_joint_that_the_page_does_not_move_comes_back_to_its_place(away):
    board = robot(servos=WITH_HEAD, pages=pages())
    ask(board, f"play {LOOP}")
    board.run(ms=2000)
    before = row_of(board, 19)[-1:]
    ask(board, f"aim 19 {512 - away} 240")
    board.run(ms=800)
    assert row_of(board, 19)[-1] == 512 - away
    ask(board, "free 19")
    board.run(ms=3000)
    assert row_of(board, 19)[-1] == 512 and where(board)["page"] == str(LOOP) and before in ([], [512])


def test_a_joint_that_is_freed_in_an_approach_goes_to_the_first_pose_slowly():
    board = robot()
    ask(board, "aim 8 0")
    board.run(ms=4500)
    board.clear_trace()
    ask(board, "play 2")
    board.run(ms=300)
    assert ask(board, "free") == " OK"
    text = board.expect("Ended after", ms=15000)
    assert text.count("Going to the first pose") == 1  # the second approach: the first was in the answer to `play`
    row = row_of(board, 8)
    assert row[0] < 10 and row[-1] == 512 and max(map(abs, speeds(row))) <= HAND_OVER


def by_button_6(board):
    board.rc(STOP)
    board.run(ms=50)
    board.rc(0)


@pytest.mark.parametrize("stop", [by_button_6, press_start, lambda board: ask(board, "code 255"), lambda board: ask(board, "stop")])
def test_every_stop_ends_what_code_moves_while_nothing_plays(stop):
    board = robot()
    ask(board, "swing 1 512 100 2000")
    board.run(ms=900)
    stop(board)
    board.run(ms=200)
    assert where(board)["aim"] == "00000000"
    board.clear_trace()
    board.run(ms=1000)
    assert len(set(row_of(board, 1))) <= 1


def test_stop_of_a_joint_that_rests_where_it_was_aimed_is_done():
    board = robot()
    ask(board, "aim 1 600")
    board.run(ms=2500)
    assert ask(board, "stop") == " OK" and where(board)["aim"] == "00000000"
    assert ask(board, "stop") == "Nothing is playing"


@pytest.mark.parametrize("word", ["aim 5 600", "swing 5 512 50 2000"])
def test_move_takes_a_joint_from_code(word):
    board = robot()
    ask(board, word)
    board.run(ms=1500)
    board.clear_trace()
    assert ask(board, "@move 60 5 12C") == "@move OK"
    assert ask(board, "status").startswith("On the way to the pose")
    board.expect("The pose is reached", ms=6000)
    board.run(ms=1000)
    row = row_of(board, 5)
    assert row[-1] == board.servos[5].goal == 300 and max(map(abs, speeds(row))) <= HAND_OVER + 1


def test_move_of_joints_that_are_switched_off_says_so():
    board = robot()
    ask(board, "on")
    ask(board, "off 5")
    assert ask(board, "@move 60 5 12C").startswith("@move ERR 8 ") and ask(board, "status").startswith("Nothing is playing")
