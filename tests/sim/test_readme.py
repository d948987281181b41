# SPDX-License-Identifier: MIT
"""Runs every command line of the simulator's README. Every option of cm5sim must occur there."""

import os
import re
import select
import shutil
import signal
import socket
import subprocess
import sys

import pytest

from cm5sim.script import QUANTITIES, VERBS
from tests.sim.sim_command import BUILD, CM5SIM, TOP, run

README = (TOP / "tools" / "sim" / "README.md").read_text(encoding="utf-8")
COMMANDS = [line.split("  #")[0].strip() for block in re.findall(r"```sh\n(.*?)```", README, re.S) for line in block.splitlines() if "cm5sim" in line]
SHOWN_S = 0.5  # how long a command without an end of its own runs after its first output
BEGUN_S = 120

# One page; joint 3 ends at 600. No other joint is used.
WALK = """\
motion512 1
page 1 walk
code U+B1
accel 8
step 100 | 3:512
step 60 | 3:600
"""


def needs(command):
    """Images of a command that are not built."""
    return [name for name in re.findall(r"\S+\.hex", command) if not (BUILD / "firmware" / name).exists()]


@pytest.fixture(name="made", scope="module")
def _made(tmp_path_factory):
    """The files that the README's commands take."""
    folder = tmp_path_factory.mktemp("made")
    script = re.search(r"This is `walk.txt`:\n\n```\n(.*?)```", README, re.S)[1]
    (folder / "walk.txt").write_text(script)
    (folder / "walk.m512").write_text(WALK)
    subprocess.run([sys.executable, "-m", "m512", "convert", "walk.m512", "walk.bin"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture(name="folder")
def _folder(made, tmp_path):
    return shutil.copytree(made, tmp_path, dirs_exist_ok=True)


def execute(command, folder):
    """Runs a command line in a shell. Ends a command that waits for a user by SIGINT."""
    for port in re.findall(r"=(\d{4})\b", command):  # replaces the ports of --tcp and --gdb by free ones
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            command = command.replace(f"={port}", f"={probe.getsockname()[1]}")
    ends = any(word in command for word in ("--script", "--time", "|"))
    line = command if "|" in command else f"exec {command}"
    process = subprocess.Popen(
        ["sh", "-c", line],
        cwd=folder,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        env={**os.environ, "PATH": f"{CM5SIM.parent}:{os.environ['PATH']}"},
    )
    try:
        if not ends:
            select.select([process.stdout, process.stderr], [], [], BEGUN_S)
        process.wait(600 if ends else SHOWN_S)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGINT)
    try:
        _, errors = process.communicate(timeout=300)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        raise
    return process.returncode, errors.decode()


def test_readme_has_commands():
    assert len(COMMANDS) >= 18


@pytest.mark.parametrize("command", COMMANDS)
def test_command_of_the_readme_runs(command, folder):
    assert not needs(command), "not built; tools/dev/build makes it"
    code, errors = execute(command, folder)
    assert code == 0, errors
    for option, name in re.findall(r"--(plot|trace|flash|eeprom|servo-eeprom) (\S+)", command):
        assert (folder / name).stat().st_size > 20, f"--{option} left nothing in {name}"
    if "--trace" in command:
        assert ",600" in (folder / "walk.csv").read_text()


def test_every_example_of_the_help_runs(folder):
    wide = {**os.environ, "COLUMNS": "500"}
    text = subprocess.run([CM5SIM, "--help"], env=wide, capture_output=True, text=True, check=True).stdout
    found = re.findall(r"^  (cm5sim \S.*?)(?: {2,}.*)?$", text.partition("\nExamples:\n")[2], re.M)
    assert len(found) >= 6, text
    for command in found:
        code, errors = execute(command, folder)
        assert code == 0, (command, errors)


def test_bench_prints_its_figures():
    done = subprocess.run([sys.executable, TOP / "tools" / "sim" / "bench", "--seconds", "1"], capture_output=True, text=True, check=False)
    print(done.stdout)
    # The result depends on the speed of this PC, so it does not matter here.
    assert re.search(r"^18 joints moving +[\d.]+ % +[\d.]+$", done.stdout, re.M), done.stdout + done.stderr
    assert (done.returncode, done.stdout.split()[-1]) in ((0, "reached"), (1, "MISSED")), done.stdout


def test_every_option_occurs_in_the_readme():
    options = set(re.findall(r"(--[a-z][a-z-]+)", run("--help").stdout.decode()))
    shown = "\n".join(COMMANDS) + README
    missing = [option for option in options - {"--help", "--usage", "--version"} if option not in shown]
    assert not missing


def test_every_verb_of_the_script_language_occurs_in_the_readme():
    assert {"send", "expect", "goal", "register", "quit"} < {*VERBS, *QUANTITIES}
    assert [verb for verb in (*VERBS, *QUANTITIES) if not re.search(rf"\b{verb}\b", README)] == []
