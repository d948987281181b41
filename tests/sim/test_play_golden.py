# SPDX-License-Identifier: MIT
"""Golden traces of the classic law on the shipped Play image: goals on the servo bus, tick by tick, approach off.
tests/unit/test_player_golden.c checks all of them."""

import csv

import pytest

from tests.sim.play_robot import GOLDEN, ask, robot, tick_of


def wanted_trace(name):
    """[(tick, {id: goal})]"""
    with open(GOLDEN / f"{name}.csv", newline="") as file:
        rows = list(csv.reader(file))
    ids = [int(column.removeprefix("id")) for column in rows[0][1:]]
    return [(int(row[0]), dict(zip(ids, map(int, row[1:])))) for row in rows[1:]]


def played_trace(name, servos):
    board = robot(servos=servos, pages=(GOLDEN / f"{name}.bin").read_bytes())
    ask(board, "law classic")
    ask(board, "settings approach 0")
    board.run(ms=1000)
    tick = tick_of(board)
    board.clear_trace()
    ask(board, "play 1")
    board.expect("Ended after", ms=60_000)
    board.run(ms=20)
    # At torque-on, a single servo gets its own position as goal; a play sends SYNC WRITEs.
    frames = [frame for frame in board.trace if len(frame.goals) > 1]
    first = tick(frames[0].cycle)
    return [(tick(frame.cycle) - first, frame.goals) for frame in frames]


@pytest.mark.parametrize("name", ["walk_like", "pauses_speed_base"])
def test_classic_equals_the_original_sample_by_sample(name):
    played, wanted = played_trace(name, range(1, 13)), wanted_trace(name)
    for one, other in zip(played, wanted):
        assert one == other
    assert len(played) == len(wanted)


def test_six_more_servos_change_nothing():
    """With 18 servos the original deviates from its own law after a page join; ours must not."""
    wanted = wanted_trace("repeats_and_chain")
    played = played_trace("repeats_and_chain", range(1, 19))
    assert [(tick, {i: goals[i] for i in range(1, 13)}) for tick, goals in played] == wanted
