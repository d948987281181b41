# SPDX-License-Identifier: MIT
"""A second page over a play (SHAPING.md), in the shipped Play image."""

import random

from m512.files.image import from_bytes
from tests.sim.play_robot import JOINTS, ask, robot, tick_of
from tests.sim.walking_robot import LOOP, WAVE, looping, pages, run_of_a_walk, where


def test_layer_in_a_walk_leaves_the_other_joints_goals_as_they_are():
    plain = run_of_a_walk([(0, "version"), (4000, "version")])
    assert len(plain) > 700
    for seed in (1, 7):  # 1: the layer ends in the tick between two steps, when the next is already planned
        chance = random.Random(seed)
        layer_in_a_walk(plain, on_ms=chance.randrange(1000), off_ms=3000 + chance.randrange(1000))


def layer_in_a_walk(plain, on_ms, off_ms):
    lent = run_of_a_walk([(on_ms, "layer 34"), (off_ms, "layer off")])
    others = [joint for joint in JOINTS if joint not in (3, 5)]
    assert plain.keys() == lent.keys()
    for at, goals in plain.items():
        assert [lent[at][joint] for joint in others] == [goals[joint] for joint in others], at
    for joint, high in ((3, 700), (5, 640)):
        row = [goals[joint] for _, goals in sorted(lent.items())]
        assert row[0] == row[-1] == 512 and max(row) == high
        speeds = [b - a for a, b in zip(row, row[1:])]
        # The pages move at most 3 units a tick, the hand-over 1 or 2. There is no jump at either end: the largest change is that of a joint
        # that meets a source moving the other way.
        assert max(map(abs, speeds)) <= 3
        assert max(abs(b - a) for a, b in zip(speeds, speeds[1:])) <= 3 + 2


def test_layer_on_named_joints_moves_only_these():
    board = looping()
    assert ask(board, "layer 34 3") == " OK"
    board.run(ms=2000)
    assert board.servos[3].goal > 600 and board.servos[5].goal == 512
    assert where(board)["layer"] == "34"


def test_layer_that_ends_by_itself_is_told_and_its_joints_come_back():
    board = robot(pages=pages())
    ask(board, f"play {LOOP}")
    board.run(ms=3000)
    assert ask(board, "layer 1 3") == " OK"  # a page of one step, without a link
    board.expect("The layer ended after page 1 (ready)", ms=3000)
    assert where(board)["layer"] == "0" and where(board)["state"] == "playing"


def test_refused_layers_say_one_sentence_and_change_nothing():
    board = looping()
    for line, said in (
        ("layer 0", "Page must be 1..127"),
        ("layer 128", "Page must be 1..127"),
        ("layer 34 25", "No answer: ID 25"),
        ("layer 34 31", "ID must be 0..30"),
        ("layer 11", "Page 11 is damaged: checksum is wrong"),
        ("layer 10", "Page 10 is empty"),
    ):
        assert ask(board, line) == said
        assert where(board)["layer"] == "0"
        answer = ask(board, "@" + line)
        assert answer.startswith("@layer ERR ") and answer.endswith(said)
    for word in ("pause", "break"):
        ask(board, word)
        board.run(ms=500)
        assert ask(board, "layer 34") == "A layer needs a page that plays"


def test_a_layer_on_joints_moved_by_code_is_told_so():
    board = looping()
    said = "None of these servos can be moved: missing, off, or moved by code (free first)"
    assert ask(board, "aim 5 600") == " OK"
    assert ask(board, "layer 34 5") == said
    assert ask(board, "@layer 34 5") == "@layer ERR 7 " + said
    assert ask(board, "free 5") == " OK" and ask(board, "layer 34 5") == " OK"


def test_break_pause_and_a_silent_servo_hold_both_plays():
    for how in ("break", "pause", "fault"):
        board = looping()
        assert ask(board, "layer 34") == " OK"
        board.run(ms=1500)
        if how == "fault":
            board.servos[3].fault("silent")  # a joint of the layer
        else:
            ask(board, how)
        board.run(ms=1500)
        before = {joint: board.servos[joint].goal for joint in JOINTS}
        board.run(ms=1000)
        assert {joint: board.servos[joint].goal for joint in JOINTS} == before, how
        assert where(board)["state"] == ("paused" if how == "pause" else "idle")
        assert all(board.servos[joint].torque for joint in JOINTS if joint != 3)
        if how == "pause":
            ask(board, "resume")
            board.clear_trace()
            board.run(ms=1000)
            assert where(board)["layer"] == "34"
            assert len({frame.goals[3] for frame in board.trace if 3 in frame.goals}) > 10


def test_no_tick_is_missed_with_all_of_it_in_force():
    board = looping()
    for word in ("rate 120", "amplitude 80", "layer 34"):
        assert ask(board, word) == " OK"
    tick = tick_of(board)
    board.clear_trace()
    for _ in range(100):
        board.send("@drive 30 120 80\r")
        board.run(ms=50)
    ticks = [tick(frame.cycle) for frame in board.trace if len(frame.goals) > 1]
    assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))
    assert where(board)["missed"] == "0"


def slopes(board, joint):
    """CW and CCW compliance slope in the servo's table."""
    return tuple(board.servos[joint].table[28:30])


def test_a_layer_brings_the_slopes_of_its_own_page_and_takes_them_away_again():
    image = from_bytes(pages())
    for at, nibble in ((LOOP, 0x66), (WAVE, 0x33), (1, 0x22)):
        image[at].data[32:63] = bytes([nibble]) * 31
        image[at].seal()
    board = robot(pages=image.to_bytes())
    assert ask(board, f"play {LOOP}") == " OK"
    board.run(ms=3000)
    assert slopes(board, 3) == slopes(board, 5) == slopes(board, 1) == (64, 64)
    assert ask(board, f"layer {WAVE}") == " OK"
    board.run(ms=300)
    assert slopes(board, 3) == slopes(board, 5) == (8, 8) and slopes(board, 1) == (64, 64)
    board.run(ms=3000)  # the main page has started again
    assert slopes(board, 3) == (8, 8) and slopes(board, 1) == (64, 64)
    board.take()
    board.expect(f"Page {LOOP} step 2", ms=3000)  # its end, where a page sets its slopes, is half a second away
    board.run(ms=100)
    assert ask(board, "layer off") == " OK"
    board.run(ms=100)
    assert slopes(board, 3) == slopes(board, 5) == (64, 64)
    assert ask(board, "layer 1 3") == " OK"  # ends by itself
    board.run(ms=100)
    assert slopes(board, 3) == (4, 4)
    board.expect("The layer ended", ms=3000)
    board.run(ms=100)
    assert slopes(board, 3) == (64, 64)
