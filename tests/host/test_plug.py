# SPDX-License-Identifier: MIT
"""An adapter that is unplugged, and lines that lose bytes and flip bits."""

import pytest

from m512.files.image import Image
from tests.host.pc_robot import GOAL, SYNC_WRITE, until
from tests.sim.made_page import page

WRITE = 3


@pytest.fixture
def files(tmp_path):
    image = Image.empty()
    image[1] = page("stand", [(40, {})])
    image[2] = page("swing", [(64, {1: 600, 2: 424}), (64, {1: 424, 2: 600})], next=2, exit=1)
    path = tmp_path / "motions.bin"
    path.write_bytes(image.to_bytes())
    return path


def sent_since_it_is_back(robot):
    lines = robot.log.read_text().splitlines()
    last = len(lines) - lines[::-1].index("back")
    return [bytes.fromhex(line[2:]) for line in lines[last:] if line.startswith("> ")]


def goals_since_it_is_back(robot):
    return [packet for packet in sent_since_it_is_back(robot) if packet[4] == SYNC_WRITE and packet[5] == GOAL]


def told_a_goal(packets):
    """The servos that were written a goal one by one, as Edit does it."""
    return {packet[2] for packet in packets if packet[4:6] == bytes([WRITE, GOAL])}


def test_a_plug_that_comes_back_goes_on_only_after_on(make, files):
    robot = make(motions=files).run()
    robot.expect("] ")
    robot.send("play 2\r")
    at = robot.expect("repetition 1\r\n")
    until(lambda: len(robot.frames()) > 60, "no goals")
    robot.pull()
    robot.told(r"the servo adapter \S+ is gone")
    at = robot.expect("The servo adapter is gone: plug it in, then on", at)
    at = robot.expect("Broken off in page 2", at)
    robot.plug()
    robot.told("the servo adapter is back")
    at = robot.expect("Servo 18 answers again", at)  # health polling continues
    assert "Nothing is playing" in robot.ask("status")
    refused = robot.ask("play 2")
    assert "OK" not in refused and "on" in refused.split()
    assert goals_since_it_is_back(robot) == []
    assert " OK" in robot.ask("on")
    robot.send("play 1\r")
    robot.expect("Ended after page 1", len(robot.console))
    assert goals_since_it_is_back(robot) != []


def test_a_plug_pulled_while_nothing_plays_is_named_too(make, files):
    robot = make(motions=files).run()
    robot.expect("18 servos")
    robot.pull()
    robot.expect("The servo adapter is gone")
    robot.ask("status")  # it goes on to answer
    robot.plug()
    robot.told("the servo adapter is back")
    assert goals_since_it_is_back(robot) == []


def test_edit_drives_after_the_plug_is_back_what_a_person_moves(make, files):
    """GO switches on what it moves, as after OFF on a board; a program's @move does not."""
    robot = make(image="edit", motions=files).run()
    robot.expect("HELP explains")
    robot.send("on\r")
    until(lambda: robot.take() or told_a_goal(robot.packets()) == set(range(1, 19)), "not held")
    robot.pull()
    robot.told(r"the servo adapter \S+ is gone")
    robot.plug()
    robot.told("the servo adapter is back")
    robot.take()
    start = len(robot.console)
    robot.send("@move 90 1 200\r")
    robot.expect("@move ERR 8", start)
    assert told_a_goal(sent_since_it_is_back(robot)) == set() and goals_since_it_is_back(robot) == []
    robot.send("page 2\rgo 0\r")
    until(lambda: robot.take() or told_a_goal(sent_since_it_is_back(robot)) == set(range(1, 19)), "no goals")


def test_while_the_plug_is_out_all_count_as_switched_off(make, files):
    robot = make(motions=files).run()
    robot.expect("] ")
    assert " OK" in robot.ask("on")
    assert "Torque on: 1-18" in robot.ask("status")
    robot.pull()
    robot.expect("The servo adapter is gone")
    assert "Torque on: none" in robot.ask("status")


def test_servos_that_were_not_told_are_not_called_off(make, files):
    robot = make(motions=files, arguments=["--off"]).run()
    robot.expect("] ")
    assert " OK" in robot.ask("on")
    robot.pull()
    robot.expect("The servo adapter is gone")
    assert robot.stop() == 6
    assert "ended. The adapter is gone: the servos keep their torque" in robot.said.decode() and "is off" not in robot.said.decode()


def test_what_is_advised_after_a_search_without_the_plug_helps(make, files):
    robot = make(motions=files).run()
    robot.expect("] ")
    robot.pull()
    robot.expect("The servo adapter is gone")
    assert "0 servos: none" in robot.ask("servos find")
    assert "then search again" in robot.ask("on")
    robot.plug()
    robot.told("the servo adapter is back")
    assert "then search again" in robot.ask("on")
    assert "18 servos: 1-18" in robot.ask("servos find")
    assert " OK" in robot.ask("on")
    robot.send("play 1\r")
    robot.expect("Ended after page 1", len(robot.console))


def test_lost_and_false_bytes_lose_no_servo_and_make_no_leap(make, files, tmp_path):
    trace = tmp_path / "trace.csv"
    robot = make(motions=files, adapter=["--drop", "0.01", "--flip", "0.01", "--latency", "2", "--jitter", "1"], bus=["--trace", trace]).run()
    robot.expect("18 servos: 1-18")
    robot.send("play 2\r")
    at = robot.expect("repetition 1\r\n")
    begun = len(robot.frames())
    until(lambda: robot.take() or len(robot.frames()) > begun + 1000, lambda: f"no goals: {robot.console.decode()}")
    assert "does not answer" not in robot.console.decode()
    robot.send("stop\r")
    robot.expect("Stopped after page 1", at)
    assert "does not answer" not in robot.console.decode()
    ways = [max(abs(after[joint] - before[joint]) for joint in before) for before, after in zip(robot.frames(), robot.frames()[1:])]
    assert max(ways) <= 12  # the page's own speed: 176 units in 64 ticks, plus acceleration
