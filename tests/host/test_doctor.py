# SPDX-License-Identifier: MIT
"""m512 doctor -p bus:...: first contact with unknown servos. Source of the registers and rates: hal/DYNAMIXEL.md."""

import json
import os
import subprocess
import sys

READ, PING, WRITE = 2, 1, 3
TORQUE, GOAL, BAUD = 24, 30, 4


def doctor(robot, *words, code=0):
    done = subprocess.run(
        [sys.executable, "-m", "m512", "doctor", "-p", f"bus:{robot.port}", "--json", *words],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        env=dict(os.environ),
    )
    assert done.returncode == code, done.stdout + done.stderr
    return json.loads(done.stdout)


def of(found, what):
    return [one for one in found if one["what"] == what]


def written(robot):
    """(ID, address, value) of each WRITE sent."""
    return [(packet[2], packet[5], packet[6]) for packet in robot.packets(WRITE)]


def test_limits_faults_gaps_and_doubles_are_named_and_nothing_is_written(make):
    robot = make(servos="1-3,5:dx117,6@115200", bus=["--fault", "2:duplicate", "--fault", "3:overload"])
    found = doctor(robot, code=3)
    assert "goes 0..1023, torque off up to 100 %" in of(found, "servo 1")[0]["text"]
    assert "two servos have ID 2" in of(found, "servo 2")[0]["text"] and of(found, "servo 2")[0]["state"] == "bad"
    assert "carried too much" in of(found, "servo 3")[0]["advice"]
    texts = " ".join(one["text"] for one in of(found, "servos"))
    assert "IDs 1..3" in texts and "1 at 57142 baud: IDs 5" in texts and "1 at 115200 baud: IDs 6" in texts
    assert "nobody has ID 4" in texts
    assert written(robot) == []


def test_rates_are_mended_when_asked_and_nothing_else_is_written(make):
    robot = make(servos="1-3,5:dx117,6@115200")
    doctor(robot, "--mend")
    assert sorted(set(written(robot))) == [(5, BAUD, 1), (6, BAUD, 1)]
    assert "5 at 1000000 baud: IDs 1..3 5..6" in of(doctor(robot), "servos")[0]["text"]


def test_a_servo_is_not_moved_to_a_rate_at_which_another_has_its_id(make):
    robot = make(servos="1-3,3@57142,6@57142,6@115200")
    found = doctor(robot, "--mend", code=3)
    assert set(written(robot)) == {(6, BAUD, 1)}  # the first of the two, once
    assert "stays at 57142 baud: another servo has ID 3 at 1000000" in " ".join(one["text"] for one in of(found, "servo 3"))
    assert "another servo has ID 6 at 1000000" in " ".join(one["text"] for one in of(found, "servo 6"))


def test_silence_says_what_to_look_at(make):
    found = doctor(make(servos="none"), code=3)
    assert "power" in of(found, "servos")[-1]["advice"] and of(found, "servos")[-1]["state"] == "bad"


def test_an_adapter_that_repeats_is_named(make):
    found = doctor(make(servos="1-3", adapter=["--echo", "--latency", "2"]))
    assert "repeats" in of(found, "echo")[0]["text"]
    assert "3 at 1000000 baud: IDs 1..3" in of(found, "servos")[0]["text"]
