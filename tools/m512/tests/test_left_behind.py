# SPDX-License-Identifier: MIT
"""A command with --sim leaves nothing behind, however it ends: no temporary file and no running simulator."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import REPO

from m512.files.image import Image
from m512.files.page import Page
from m512.files.text import read_text

WAVE = "motion512 1\npage 3 wave\n  next wave\n  step 50 | 1:500\n  step 50 | 1:520\n"


@pytest.fixture
def world(tmp_path):
    """start(words, **environment) -> a process of m512 whose temporary folder is `world.temporary`."""
    world = type("World", (), {})()
    world.temporary, world.folder = tmp_path / "tmp", tmp_path
    world.temporary.mkdir()
    (tmp_path / "wave.m512").write_text(WAVE)
    large = Image.empty(256)
    large[200] = read_text(WAVE)[3]
    (tmp_path / "large.bin").write_bytes(large.to_bytes())
    high = Page()
    high.steps = 1
    for joint in range(1, 19):
        high.set_word(0, joint, 2048)
    (tmp_path / "high.bin").write_bytes(bytes(512) + bytes(high.seal()) + bytes(Page()) * 126)

    def start(*words, before=(), **environment):
        env = {"M512_BUILD": str(REPO / "build"), "HOME": str(tmp_path), "PATH": "/usr/bin:/bin", "TMPDIR": str(world.temporary), **environment}
        return subprocess.Popen(
            [*before, sys.executable, "-m", "m512", *words], env=env, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    world.start = start
    return world


def children(pid):
    return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


@pytest.mark.parametrize(
    "words, environment, says",
    [
        (["play", "1", "--sim", "--motions", "high.bin"], {}, "12-bit"),
        (["play", "1", "--sim", "--motions", "large.bin"], {}, "no room"),
        (["play", "1", "--sim", "--motions", "no.bin"], {}, "cannot read"),
        (["play", "1", "--sim", "--image", "no.hex"], {}, "no.hex"),
        (["play", "1", "--sim", "--servos", "1:nonsense"], {}, "did not start"),
        (["play", "1", "--sim"], {"M512_CM5SIM": "/bin/false"}, "did not start"),
        (["doctor", "--sim"], {"M512_CM5SIM": "/bin/false"}, "did not start"),
        (["term", "--sim", "--motions", "high.bin"], {}, "12-bit"),
        (["play", "nothing", "--sim", "--motions", "wave.m512"], {}, "nothing"),
        (["pose", "--sim", "--motions", "wave.m512"], {}, ""),
    ],
)
def test_no_file_is_left(world, words, environment, says):
    process = world.start(*words, **environment)
    _, stderr = process.communicate(timeout=600)
    assert says in stderr and "Traceback" not in stderr, stderr
    assert (process.returncode == 0) == (says == "")
    assert not list(world.temporary.iterdir())


def wait_for_the_end(pid):
    """Waits until a process, possibly an orphan, is gone or a zombie."""
    state = Path(f"/proc/{pid}/stat")
    deadline = time.monotonic() + 60
    while True:
        try:
            letter = state.read_text().rpartition(")")[2].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return
        if letter in "ZX":
            return
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux ends a child with its parent")
def test_the_simulator_ends_with_a_command_that_was_killed(world):
    process = world.start("play", "wave", "--sim", "--motions", "wave.m512", "--wait")
    while "playing" not in process.stderr.readline():
        assert process.poll() is None
    (simulator,) = children(process.pid)
    process.kill()
    process.communicate(timeout=600)
    wait_for_the_end(simulator)


@pytest.mark.skipif(sys.platform != "linux", reason="needs setsid of Linux")
def test_ctrl_c_in_a_terminal_stops_the_simulated_robot_softly(world):
    """A terminal sends Ctrl-C to a whole group of programs. The simulator once ended by it, and m512 said that the line broke."""
    process = world.start("play", "wave", "--sim", "--motions", "wave.m512", "--wait", before=("setsid",))
    while "playing" not in process.stderr.readline():
        assert process.poll() is None
    (simulator,) = children(process.pid)
    os.killpg(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 130 and "stopping through the exit page" in said and "stopped by Ctrl-C" in said, said
    wait_for_the_end(simulator)


@pytest.mark.parametrize("when", ["starting", "playing"])
def test_a_reader_that_has_gone_stops_the_robot(world, when):
    """`m512 play walk --wait 2>&1 | head -3`: nobody sees any more what the robot does."""
    process = world.start("play", "wave", "--sim", "--motions", "wave.m512", "--wait")
    while when == "playing" and "playing" not in process.stderr.readline():
        assert process.poll() is None
    process.stderr.close()
    assert process.wait(600) == 128 + signal.SIGPIPE
    process.stdout.close()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("when", ["starting", "playing"])
def test_a_signal_ends_the_simulator_too(world, number, when):
    mute = world.folder / "mute"
    mute.write_text("#!/bin/sh\nexec sleep 600\n")  # a simulator that reports no port
    mute.chmod(0o755)
    environment = {"M512_CM5SIM": str(mute), "M512_BUILD": str(REPO / "build")} if when == "starting" else {}
    process = world.start("play", "wave", "--sim", "--motions", "wave.m512", "--wait", **environment)
    if when == "playing":
        while "playing" not in process.stderr.readline():
            assert process.poll() is None
    else:
        while not children(process.pid):
            assert process.poll() is None
            time.sleep(0.05)
    simulators = children(process.pid)
    assert len(simulators) == 1
    for _ in range(3):  # the first Ctrl-C stops softly, the second at once, the third ends the command
        process.send_signal(number)
        try:
            process.wait(3 if number == signal.SIGINT else 600)
            break
        except subprocess.TimeoutExpired:
            pass
    process.communicate(timeout=600)
    wait_for_the_end(simulators[0])
    assert not list(world.temporary.iterdir())


@pytest.mark.skipif(sys.platform != "linux", reason="finds the children of a process in /proc")
@pytest.mark.parametrize("before, ends", [((), True), (("nohup",), False)])
def test_nohup_keeps_a_command_alive_when_its_terminal_closes(world, before, ends):
    mute = world.folder / "mute"
    mute.write_text("#!/bin/sh\nexec sleep 600\n")
    mute.chmod(0o755)
    process = world.start("play", "wave", "--sim", "--motions", "wave.m512", before=before, M512_CM5SIM=str(mute))
    while not children(process.pid):
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGHUP)
    try:
        assert ends == (process.wait(600 if ends else 3) == 128 + signal.SIGHUP)
    except subprocess.TimeoutExpired:
        assert not ends
    process.terminate()
    process.communicate(timeout=600)
    assert process.returncode == 128 + (signal.SIGHUP if ends else signal.SIGTERM)
