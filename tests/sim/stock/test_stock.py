# SPDX-License-Identifier: MIT
"""The shipped images on the packaged simavr with its own UARTs: users who have only that must get further than the prompt.
tools/sim/board/README.md lists what it gets wrong."""

import csv

import pytest

from m512.files.image import Image
from tests.sim.made_page import page
from tests.sim.stock.stock_robot import TOP, StockRobot

GOLDEN = TOP / "tests" / "models" / "golden"
PAGE_1 = slice(512, 1024)  # of the motion area
MOTION_AREA = 0x0E000, 0x1E000


def wanted_trace(name):
    """[(tick, {id: goal})]"""
    with open(GOLDEN / f"{name}.csv", newline="") as file:
        rows = list(csv.reader(file))
    ids = [int(column.removeprefix("id")) for column in rows[0][1:]]
    return [(int(row[0]), dict(zip(ids, map(int, row[1:])))) for row in rows[1:]]


@pytest.mark.parametrize("name", sorted(path.stem for path in GOLDEN.glob("*.csv")))
def test_play_equals_the_golden_set(name):
    with StockRobot(["boot-cm5.hex", "play-cm5.hex"], range(1, 13), (GOLDEN / f"{name}.bin").read_bytes()) as robot:
        robot.expect(b"] ", ms=2000)
        robot.run(ms=300)
        assert robot.answers >= 12
        robot.ask(b"law classic")
        robot.ask(b"settings approach 0")
        robot.run(ms=1000)
        before = len(robot.frames)
        robot.type(b"play 1\r")
        robot.expect(b"Ended after", ms=60_000)
        frames = [(tick, goals) for tick, goals in robot.frames[before:] if len(goals) > 1]
        assert [(tick - frames[0][0], goals) for tick, goals in frames] == wanted_trace(name)
        assert robot.console.count(b"\xff") == 1  # one first byte of the loader: the robot started once


def test_edit_changes_a_page_saves_it_and_plays_it():
    before, wanted = Image.empty(), Image.empty()
    before[1] = page("bow", [(40, {1: 480}), (50, {3: 300})], range(1, 13))
    wanted[1] = page("bow", [(40, {1: 480}), (50, {3: 700})], range(1, 13))
    with StockRobot(["boot-cm5.hex", "edit-cm5.hex"], range(1, 13), before.to_bytes()) as robot:
        robot.expect(b"EXIT leaves", ms=2000)
        assert robot.answers >= 12
        for line in (b"goto 2 3", b"set 700", b"save"):
            robot.type(line + b"\r")
            robot.run(ms=600)
        assert robot.flash(*MOTION_AREA)[PAGE_1] == bytes(wanted[1].data)
        assert robot.flash(*MOTION_AREA) == wanted.to_bytes()
        robot.type(b"play 1\r")
        robot.run(ms=2500)
        goals = [goals for _, goals in robot.frames]
        pose = {i: 512 for i in range(1, 13)}
        assert {**pose, 1: 480} in goals and goals[-1] == {**pose, 3: 700}
        assert robot.console.count(b"\xff") == 1
