# SPDX-License-Identifier: MIT
"""The robot's folder: what cannot be one is refused with the real reason, and --motions says when it is not read."""

import os
import subprocess

import pytest

from tests.host.pc_robot import program


def refusal(*arguments, port="/dev/null", **environment):
    """What the program says on its way out."""
    done = subprocess.run(
        [program("play"), *arguments, port],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env={name: value for name, value in dict(os.environ, **environment).items() if value is not None},
    )
    assert done.returncode == 4, done
    return done.stderr


def test_what_is_no_folder_is_called_what_it_is(tmp_path):
    (tmp_path / "file").write_text("hello")
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    assert "file: the robot's folder cannot be used: it is a file" in refusal("--robot", tmp_path / "file")
    assert "link: the robot's folder cannot be used: it is a link that leads nowhere" in refusal("--robot", tmp_path / "link")
    assert "file/in: the robot's folder cannot be made: Not a directory" in refusal("--robot", tmp_path / "file" / "in")
    assert "too long" in refusal("--robot", tmp_path / ("long/" * 120))
    assert sorted(os.listdir(tmp_path)) == ["file", "link"]


@pytest.mark.parametrize("home", ["", "somewhere", None])
def test_without_a_home_a_folder_must_be_named(home):
    assert "no home folder (HOME) to keep the robot's pages in: name a folder with --robot" in refusal(HOME=home, XDG_DATA_HOME=None)


def test_a_folder_in_use_is_called_so(make):
    robot = make().run()
    assert "in use by another program for this robot: end that first" in refusal("--robot", robot.folder / "robot")


def test_motions_of_a_folder_that_has_its_own_are_not_read_and_it_says_so(make, tmp_path):
    robot = make().run()
    robot.expect("] ")  # its files are made after "serial port" and before the prompt
    robot.stop()
    robot.run("--motions", tmp_path / "missing.bin")
    assert robot.told(r"robot has its own motions: .*missing\.bin is not read")


def test_motions_that_cannot_be_read_are_called_so(make, tmp_path):
    port = make().port
    assert "missing.bin: cannot be read: No such file" in refusal("--robot", tmp_path / "new", "--motions", tmp_path / "missing.bin", port=port)
    (tmp_path / "odd.bin").write_bytes(bytes(100))
    assert "odd.bin: not a raw motion area" in refusal("--robot", tmp_path / "new", "--motions", tmp_path / "odd.bin", port=port)
