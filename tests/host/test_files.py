# SPDX-License-Identifier: MIT
"""The robot's folder: what cannot be one is refused with the real reason, and --motions says when it is not read."""

import os
import subprocess

import pytest

from m512.files.image import Image, from_bytes
from tests.host.pc_robot import program
from tests.sim.made_page import page


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
    image = Image.empty()
    image[1] = page("one", [(30, {})])
    (tmp_path / "motions.bin").write_bytes(image.to_bytes())
    robot = make().run()
    robot.expect("] ")  # its files are made after "serial port" and before the prompt
    robot.stop()
    assert "missing.bin: cannot be read" in refusal("--robot", tmp_path / "robot", "--motions", tmp_path / "missing.bin", port=robot.port)
    robot.run("--motions", tmp_path / "motions.bin").expect("] ")  # it has none yet
    assert from_bytes((tmp_path / "robot" / "pages.bin").read_bytes())[1].name == b"one"
    robot.stop()
    robot.run("--motions", tmp_path / "missing.bin")
    assert robot.told(r"robot has its own motions: .*missing\.bin is not read")


def test_motions_that_cannot_be_read_are_called_so(make, tmp_path):
    port = make().port
    assert "missing.bin: cannot be read: No such file" in refusal("--robot", tmp_path / "new", "--motions", tmp_path / "missing.bin", port=port)
    for odd in (100, 512, 130560, 131584):
        (tmp_path / "odd.bin").write_bytes(bytes(odd))
        assert "odd.bin: not a raw motion area" in refusal("--robot", tmp_path / "new", "--motions", tmp_path / "odd.bin", port=port)


def test_motions_without_page_0_keep_their_numbers(make, tmp_path):
    image = Image.empty()
    image[1], image[127] = page("one", [(30, {})]), page("last", [(30, {})])
    (tmp_path / "motions.bin").write_bytes(image.to_bytes()[512:])
    make(motions=tmp_path / "motions.bin").run().expect("] ")
    kept = from_bytes((tmp_path / "robot" / "pages.bin").read_bytes())
    assert (bytes(kept[0]), kept[1].name, kept[127].name) == (b"\xff" * 512, b"one", b"last")


def test_a_save_into_a_file_that_another_program_has_replaced_is_no_save(make, tmp_path):
    robot = make(image="edit").run()
    robot.expect("HELP explains")
    pages = tmp_path / "robot" / "pages.bin"
    (tmp_path / "robot" / "other").write_bytes(pages.read_bytes())
    os.replace(tmp_path / "robot" / "other", pages)
    robot.send("page 100\rinsert 0\rsave\r")
    robot.expect("Not saved")
    assert robot.told(r"pages\.bin: not saved: another program has replaced or removed the file")


def test_pages_that_a_link_should_lead_to_are_not_made_anew(tmp_path, make):
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "pages.bin").symlink_to(tmp_path / "stick" / "pages.bin")
    assert "pages.bin: it is a link that leads nowhere" in refusal("--robot", tmp_path / "robot", port=make().port)
    assert (tmp_path / "robot" / "pages.bin").is_symlink()
