# SPDX-License-Identifier: MIT
"""WRITEs that arrive at a servo with a wrong bit: the servo ignores them and reports it in its answer (the fault "mishears"). Each image
retries, counts the rejection, and finally names the servo. Torque goes on only after the goal has arrived, and not while the servo stands
outside its own angle limits, because it would leap to the limit at full speed."""

import pytest

from tests.sim.channel import request
from tests.sim.edit_servos import start
from tests.sim.monitor_robot import robot as monitor
from tests.sim.monitor_robot import say
from tests.sim.play_robot import ask, robot

TRIES = 3
CW_LIMIT = 6
OUTSIDE = "Outside its angle limits, move it by hand: ID 3"


def push_outside(board):
    """Servo 3 is limp and has limits of 400 and 600. A hand leaves it at 800."""
    board.servos[3].write(CW_LIMIT, [*(400).to_bytes(2, "little"), *(600).to_bytes(2, "little")])
    board.servos[3].push_to(800)
    board.run(ms=300)
    return board.servos[3]


def test_edit_names_a_servo_that_does_not_take_its_goal():
    with start() as r:
        r.line("on")
        r.board.servos[3].fault("mishears")
        r.line("goto 0 3")
        r.line("set 600")
        assert r.board.servos[3].goal == 512
        assert "Not obeyed: ID 3" in r.message
        assert r.board.servos[3].goal == 512 and "512" in r.cell(0, 3)


def test_edit_names_a_servo_that_does_not_let_go():
    """The first WRITE of off is a SYNC WRITE without answer, which must be lost as well."""
    with start() as r:
        r.line("on")
        r.board.servos[3].fault("mishears")
        r.line("off 3")
        assert "Not obeyed: ID 3" in r.message


def test_play_names_a_servo_that_does_not_take_torque():
    board = robot()
    board.servos[3].push_to(300)
    board.servos[3].fault("mishears")
    assert ask(board, "on") == "Not obeyed: ID 3"
    assert "@torque ERR 7 Not obeyed: ID 3" in ask(board, "@torque on 3")
    assert not board.servos[3].torque and abs(board.servos[3].present - 300) <= 2
    assert "Servo 3 does not obey" in ask(board, "play 1") + board.expect("] ", ms=2000)


def test_play_tells_a_hot_servo_from_a_silent_one():
    board = robot()
    board.servos[5].fault("overheating")
    board.run(ms=1000)
    assert ask(board, "on") == "Not obeyed: ID 5"
    text = ask(board, "play 1") + board.expect("Ended", ms=2000)
    assert "Servo 5 does not obey" in text and "does not answer" not in text
    board.servos[5].fault("silent")
    board.send("play 1\r")
    assert "Servo 5 does not answer" in board.expect("Ended", ms=2000)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("on 3\r", OUTSIDE),
        ("on\r", OUTSIDE),
        (request("@torque on 3"), "@torque ERR 7 " + OUTSIDE),
        ("play 1\r", "Servo 3 is outside its angle limits: move it by hand"),
        ("aim 3 500 5\r", "Servo 3 is outside its angle limits: move it by hand"),
        (request("@move 5 3 1F4"), "Servo 3 is outside its angle limits: move it by hand"),
    ],
)
def test_play_does_not_switch_on_a_joint_outside_its_angle_limits(line, told):
    board = robot()
    servo = push_outside(board)
    board.send(line)
    board.expect(told, ms=2000)
    board.run(ms=1000)
    assert not servo.torque and abs(servo.present - 800) <= 2
    servo.push_to(580)
    assert ask(board, "on") == " OK" and servo.torque


def test_edit_does_not_switch_on_a_joint_outside_its_angle_limits():
    with start() as r:
        servo = push_outside(r.board)
        r.line("goto 0 3")
        for line in ("on 3", "go 0", "set 500", "play"):
            r.line(line, ms=1500)
            assert OUTSIDE in r.message and not servo.torque and abs(servo.present - 800) <= 2
        servo.fault("silent")
        r.line("on 3", ms=1500)
        assert "No answer: ID 3" in r.message  # a hand does not help any more
        servo.clear()
        servo.push_to(580)
        r.line("on 3", ms=1500)
        assert "ID" not in r.message and servo.torque


def test_monitor_shows_the_rejection_and_keeps_its_id():
    board = monitor(servos=(1,))
    board.servos[1].fault("mishears")
    heard = say(board, "id 5")
    assert "<-[Dynamixel]: ID 01 error 10" in heard and "[CID:001(0X01)]" in heard
    board.servos[1].fault("mishears", times=1)
    assert "error 00" in say(board, "id 5")
    assert board.servos.ids == [5]


def test_monitor_moves_a_slow_servo_that_hears_badly():
    board = monitor(servos=(1,))
    board.servos.add(7, model="dx117")  # at 57,142 bps
    board.servos[7].fault("mishears", times=TRIES - 1)
    board.send("fast\r")
    board.run(ms=2500)
    assert board.servos[7].table[4] == 1
