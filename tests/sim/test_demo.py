# SPDX-License-Identifier: MIT
"""tools/demo at a terminal: one robot for both images, stored between runs, used by one terminal at a time."""

import pathlib
import shutil

import pexpect
import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
WORN = b"worn before"


@pytest.fixture(name="demo")
def _demo(tmp_path):
    """demo(words): the terminal of tools/demo, with a stand-in for cm5sim that prints its words and ends on Enter. Builds nothing."""
    for path, text in (("tools/dev/build", ""), ("tools/sim/cm5sim", 'echo "cm5sim $*"; read -r line')):
        stub = tmp_path / path
        stub.parent.mkdir(parents=True, exist_ok=True)
        stub.write_text(f"#!/bin/sh\n{text}\n")
        stub.chmod(0o755)
    shutil.copy(TOP / "tools" / "demo", tmp_path / "tools" / "demo")
    opened = []

    def start(*words):
        opened.append(pexpect.spawn(str(tmp_path / "tools" / "demo"), list(words), timeout=300, dimensions=(24, 500), encoding="utf-8"))
        return opened[-1]

    start.robot = tmp_path / "build" / "robot"
    yield start
    for terminal in opened:
        terminal.close(force=True)


def memories(terminal):
    terminal.expect(r"cm5sim .*--flash (\S+) --eeprom (\S+)\r")
    return terminal.match.groups()


def leave(terminal):
    terminal.sendline()
    terminal.expect(pexpect.EOF)


def test_what_edit_saves_is_what_play_finds(demo):
    edit = demo()
    taught = memories(edit)
    leave(edit)
    assert memories(demo("play")) == taught


def test_the_robot_that_edit_had_for_itself_goes_on(demo):
    demo.robot.mkdir(parents=True)
    for memory in ("flash", "eeprom"):
        (demo.robot / f"edit.{memory}").write_bytes(WORN)
    for name in memories(demo("play")):
        assert (demo.robot.parent.parent / name).read_bytes() == WORN


def test_a_second_terminal_is_refused_and_the_next_one_is_not(demo):
    first = demo()
    memories(first)
    second = demo("play")
    second.expect("in use in another terminal")
    second.expect(pexpect.EOF)
    second.close()
    assert second.exitstatus == 5
    leave(first)
    memories(demo("play"))
