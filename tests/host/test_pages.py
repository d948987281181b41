# SPDX-License-Identifier: MIT
"""256 pages, all that a link can address: loops over pages end, the last page plays and can be linked to, a smaller board reports a misfit."""

import os
import subprocess
import sys

import pytest

from m512.files.image import Image
from tests.sim.made_page import page

LAST = 255


@pytest.fixture
def files(tmp_path):
    """Page 1 links to the last page, which links to page 200."""
    image = Image.empty(256)
    image[1] = page("first", [(30, {1: 540})], next=LAST)
    image[LAST] = page("last", [(30, {1: 484})], next=200, code=16)
    image[200] = page("end", [(30, {})])
    path = tmp_path / "motions.bin"
    path.write_bytes(image.to_bytes())
    return path


def test_the_last_page_is_played_listed_linked_and_called(make, files):
    robot = make(motions=files).run()
    robot.expect("18 servos: 1-18")
    for line in ("play first", f"play {LAST}", "code 16"):
        at = len(robot.console)
        robot.send(line + "\r")
        robot.expect("Ended after page 200 (end)", at)
    listed = robot.ask("list")
    assert "255 last" in listed and "200 end" in listed
    assert f'{LAST}:1:"last" OK' in robot.ask("@list")
    assert len(robot.ask("@crcs").split()[1]) == 4 * 256
    assert "pages=256" in robot.ask("@ver")
    assert "must be" in robot.ask("play 256")
    assert robot.ask("settings centre 255").endswith("OK\n] ")


def test_lists_of_edit_end_at_the_last_page(make, files):
    robot = make(image="edit", motions=files).run()
    robot.expect("Arrows move")
    for line, text in (("list", "last"), (f"list {LAST}", "last"), (f"page {LAST}", "last")):
        at = len(robot.console)
        robot.send(line + "\r")
        at = robot.expect(text, at)
        if line.startswith("list"):
            robot.expect("-- end --", at)
            robot.send("\r")
    at = len(robot.console)
    robot.send("next\r")
    robot.expect("No such page", at)


def test_paste_copies_a_step_of_the_last_page(make, files):
    robot = make(image="edit", motions=files).run()
    robot.expect("Arrows move")
    for line, text in ((f"page {LAST}", "last"), ("take 0", "Noted for PASTE"), ("page 1", "first"), ("paste 1", "0484")):
        at = len(robot.console)
        robot.send(line + "\r")
        robot.expect(text, at)


def test_m512_takes_all_of_them_and_a_board_says_what_does_not_fit(make, files, tmp_path):
    robot, back = make(), tmp_path / "back.bin"

    def m512(*words):
        return subprocess.run(
            [sys.executable, "-m", "m512", *map(str, words)],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
            env=dict(os.environ, M512_ROBOT=str(tmp_path / "kept")),
        )

    done = m512("put", files, "all", "-p", f"bus:{robot.port}")
    assert done.returncode == 0 and "saved: pages 1 200 255" in done.stdout + done.stderr, done
    assert m512("get", "all", "-o", back, "-p", f"bus:{robot.port}").returncode == 0
    assert back.read_bytes()[512:] == files.read_bytes()[512:]
    done = m512("play", "first", "--sim", "--motions", files)
    assert done.returncode == 5 and "no room among this board's 128 pages" in done.stderr and "last" in done.stderr
