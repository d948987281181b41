# SPDX-License-Identifier: MIT
"""Servos through the Python binding on a whole board: what a controller sees of each fault."""

import pytest

from cm5sim import Board

FINE, OVERHEATED, OVERLOADED, LOW, ANGLE = "00", "04", "20", "01", "02"


@pytest.fixture(name="robot")
def _robot():
    board = Board(images=["tests/robot.hex"], servos=range(1, 5))
    board.expect("ready\r\n")
    return board


def ping(robot):
    """Makes the robot ping servo 3 and returns its report."""
    robot.send(b"p")
    robot.expect("servo 3: ")
    return robot.expect("\r\n").strip()


def test_ping_without_faults(robot):
    assert ping(robot) == FINE


def test_goals_reach_the_servos_and_motion_follows(robot):
    assert robot.servos.present == {1: 512, 2: 512, 3: 512, 4: 512}
    assert not robot.servos[3].torque
    robot.send(b"m")
    robot.expect("moving")
    assert robot.servos[3].goal == 600 and robot.servos[3].torque and robot.servos[3].moving
    assert 512 <= robot.servos[3].present < 600  # it lags behind
    robot.run(ms=300)
    assert robot.servos[3].present in (599, 600) and not robot.servos[3].moving
    assert robot.servos[4].goal == 512 and not robot.servos[4].torque


@pytest.mark.parametrize(
    "name, says",
    [
        ("silent", "silent"),
        ("dead", "silent"),
        ("late", "silent"),
        ("checksum", "garbled"),
        ("short", "garbled"),
        ("noise", "garbled"),
        ("duplicate", "garbled"),
        ("overload", OVERLOADED),
        ("overheating", OVERHEATED),
        ("low-voltage", LOW),
        ("angle-limit", ANGLE),
    ],
)
def test_fault_is_seen_and_goes_when_cleared(robot, name, says):
    robot.servos[3].fault(name)
    assert ping(robot) == says
    robot.servos[3].clear()
    robot.run(ms=30)  # a late answer may still arrive
    assert ping(robot) == FINE


def test_a_dead_servo_comes_back_limp_and_a_late_one_is_20_ms_late(robot):
    servo = robot.servos[3]
    servo.write(24, [1])
    servo.fault("dead")
    servo.clear()
    assert not servo.torque
    servo.fault("late")
    before = robot.uart(0).received
    robot.send(b"p")
    robot.run(ms=19)
    assert robot.uart(0).received == before
    robot.run(ms=3)
    assert robot.uart(0).received == before + 6


def test_two_talkers_spoil_each_others_answers(robot):
    robot.servos[4].fault("two-talkers")
    assert ping(robot) == "garbled"
    robot.servos[4].clear()
    assert ping(robot) == FINE


def test_fault_for_some_answers_only(robot):
    robot.servos[3].fault("silent", times=2)
    assert [ping(robot) for _ in range(3)] == ["silent", "silent", FINE]


def test_weak_battery_is_reported_by_the_servo(robot):
    robot.battery(5.5)
    assert ping(robot) == LOW
    assert robot.servos[3].voltage == 5.5


def test_stray_bytes_are_heard(robot):
    robot.servos.noise([0x55, 0xAA])
    robot.run(ms=1)
    assert robot.uart(0).received == 2


def test_readings_and_mistakes_in_python(robot):
    assert robot.servos.ids == [1, 2, 3, 4] and len(robot.servos) == 4 and 4 in robot.servos and 5 not in robot.servos
    assert len(robot.servos[3].table) == 50 and robot.servos[3].table[3] == 3
    with pytest.raises(KeyError, match="no servo with ID 9"):
        _ = robot.servos[9]
    with pytest.raises(ValueError, match="known: silent"):
        robot.servos[3].fault("tired")
    with pytest.raises(AttributeError, match="write"):
        robot.servos[3].goal = 5
    slow = robot.servos.add(20, "dx117")
    assert slow.rate == 57142 and slow.model == 117
