# SPDX-License-Identifier: MIT
"""The shipped image on the simulated board with its servos in a physical body: lock step, and the resulting motion."""

import csv
import os
import pathlib
import re
import shutil
import subprocess

import pytest

from body.description import load
from body.hand import Hand
from body.physics import Physics
from body.trial import try_motion
from cm5sim import Board
from m512.files.formats import load as load_motions
from tests.sim.snapshot import attempt

TOP = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = load_motions(TOP / "tools" / "motions" / "motions.m512")
NUMBER = {page.title: number for number, page in LIBRARY.items() if number and page.is_playable}
IMAGE = LIBRARY.to_bytes()


@pytest.fixture(scope="module")
def on_its_feet():
    """A board with Play and a humanoid that has played `ready` while held and then been put down. A test works on a copy (snapshot)."""
    physics = Physics(load("humanoid"))
    board = Board(images=["play-cm5.hex"], motions=IMAGE, servos=range(1, 19))
    board.battery(11.1)
    hand = Hand(physics)
    board.attach(physics)
    board.expect("] ", ms=3000)
    board.send("play ready\r")
    for _ in range(1000):
        board.run(ticks=1)
        if hand.look() == "down":
            break
    assert hand.put_down_s is not None
    board.attach(physics)
    board.expect("Ended after page 1", ms=3000)
    return board, physics, hand


def walk(board, physics, hand):
    start = physics.x_mm
    board.send("play walk\r")
    board.expect("page 20 (walk)", ms=3000)
    for _ in range(16):
        board.run(ms=250)
        hand.look()
    expected = try_motion(IMAGE, NUMBER["walk"], 4).x_mm
    assert hand.falls == 0 and physics.upright > 0.98
    assert physics.x_mm - start == pytest.approx(expected, rel=0.2) and expected > 80


def test_walks_as_without_its_chip(on_its_feet):
    """The player on the ATmega128, with commands and bus, moves the body as far as the same player on this machine."""
    attempt(walk, *on_its_feet)


def carry_and_go_limp(board, physics, _):
    knee = board.servos[13]
    assert knee.present == pytest.approx(physics.robot.position(13, physics.joint(13)), abs=1)
    assert 1 < abs(knee.present - knee.goal) < 25 and knee.load != 0  # it carries weight, so it droops
    assert board.servos[7].load == pytest.approx(0, abs=0.08)
    for servo in board.servos:
        servo.write(24, [0])
    board.run(ms=700)
    assert abs(knee.present - knee.goal) > 60  # limp, so it collapses
    assert physics.z_mm < 270


def test_registers_show_what_the_body_does(on_its_feet):
    attempt(carry_and_go_limp, *on_its_feet)


def detach(board, physics, _):
    present = board.servos.present
    board.attach(None)
    assert all(abs(board.servos.present[servo] - present[servo]) <= 1 for servo in present)
    before = physics.time_s
    board.run(ms=500)
    assert physics.time_s == before and board.servos[13].present == pytest.approx(board.servos[13].goal, abs=2)


def test_detached_servos_stay_where_they_are_and_turn_by_themselves(on_its_feet):
    attempt(detach, *on_its_feet)


def cm5sim(*words, script=None, tmp_path=None):
    command = [str(TOP / "tools" / "sim" / "cm5sim"), *words]
    if script:
        (tmp_path / "script.txt").write_text(script)
        command += ["--script", str(tmp_path / "script.txt")]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def test_command_tells_falls_way_and_heading(tmp_path):
    (tmp_path / "motions.bin").write_bytes(IMAGE)
    begin = 'expect "] " within 3s\nsend "play ready\\r"\nexpect "Ended" within 5s\nwait 500ms\n'
    how = ["play-cm5.hex", "--motions", str(tmp_path / "motions.bin"), "--body", "humanoid"]
    run = cm5sim(*how, script=begin + "quit\n", tmp_path=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "put down on its soles" in run.stderr and re.search(r"0 falls; -?\d+ mm forward, .* heading -?\d degrees .*; stands", run.stderr)
    toes_up = "servo 15 load 1\nservo 16 load -1\nwait 2s\nquit\n"  # shanks forward, so it falls on its face
    run = cm5sim(*how, script=begin + toes_up, tmp_path=tmp_path)
    assert "s: fell" in run.stderr and re.search(r"1 falls; \d+ mm forward, .*; lies", run.stderr), run.stderr


def test_command_with_head_servos_turns_the_head_and_servos_without_a_joint_turn_freely(tmp_path):
    (tmp_path / "motions.bin").write_bytes(IMAGE)
    script = """expect "] " within 3s
send "play look\\r"
expect "Playing page" within 5s
wait 8s
torque 19 == 1
send "stop\\r"
expect "Stopped" within 9s
send "aim 25 600\\r"
present 25 > 597 within 5s
servo 25 push 500
present 25 < 590
quit
"""
    trace = tmp_path / "trace.csv"
    how = ["--motions", str(tmp_path / "motions.bin"), "--body", "humanoid", "--servos", "1-20,25", "--trace", str(trace)]
    run = cm5sim("play-cm5.hex", *how, script=script, tmp_path=tmp_path)
    assert run.returncode == 0, run.stderr + run.stdout
    assert "overload" not in run.stdout
    with trace.open() as rows:
        positions = [int(row["present19"]) for row in csv.DictReader(rows)]
    assert max(positions) - min(positions) > 50


def test_command_says_what_is_wrong_with_a_body(monkeypatch):
    for display in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(display, raising=False)
    for words, code, says in (
        (["play-cm5.hex", "--body", "robocop"], 4, "known here: gp, humanoid"),
        (["play-cm5.hex", "--view"], 2, "--view shows the --body"),
        (["play-cm5.hex", "--body", "gp", "--view"], 4, "--view needs a display, and none answers here"),
        (["--body", "humanoid", "--bus-pty"], 2, "--body needs a board"),
    ):
        run = cm5sim("--time", "10ms", "--fast", *words)
        assert run.returncode == code and says in run.stderr, run.stderr
        assert "Traceback" not in run.stderr and "GLFW" not in run.stderr


def test_command_takes_the_body_as_any_option_is_written():
    """Also: it reports what to do about a robot that was never put down."""
    run = cm5sim("play-cm5.hex", "--time", "10ms", "--fast", "--bod", "humanoid")
    assert run.returncode == 0 and "the hand held it to the end" in run.stderr and "Play `ready`" in run.stderr, run.stderr


@pytest.fixture(name="demo")
def _demo(tmp_path):
    """demo(words, display): output of tools/demo and the words with which it starts cm5sim. Setup and build are stubs."""
    for path, text in (("tools/dev/setup", ""), ("tools/dev/build", ""), ("tools/sim/cm5sim", 'echo "cm5sim $@"')):
        stub = tmp_path / path
        stub.parent.mkdir(parents=True, exist_ok=True)
        stub.write_text(f"#!/bin/sh\n{text}\n")
        stub.chmod(0o755)
    shutil.copy(TOP / "tools" / "demo", tmp_path / "tools" / "demo")

    def run(words, display=None):
        environment = {"PATH": os.environ["PATH"]} | ({"DISPLAY": display} if display else {})
        done = subprocess.run(
            [tmp_path / "tools" / "demo", *words], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True
        )
        said = done.stdout.splitlines()
        return "\n".join(said[:-1]), said[-1].split()

    return run


@pytest.mark.parametrize("words, body", [(["play", "--body"], "humanoid"), (["--body"], "humanoid"), (["play", "--body", "gp"], "gp")])
def test_demo_shows_the_body_where_there_is_a_display_and_says_where_there_is_none(demo, words, body):
    said, started = demo(words)
    assert started[started.index("--body") + 1] == body and "--view" not in started
    assert "no display here: the robot's body is not shown" in said
    said, started = demo(words, display=":0")
    assert started[started.index("--body") + 1] == body and "--view" in started and "no display" not in said


def test_demo_without_a_body_asks_for_none(demo):
    said, started = demo(["play"], display=":0")
    assert "--body" not in started and "--view" not in started and "display" not in said
