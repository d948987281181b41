# SPDX-License-Identifier: MIT
"""Runs the example of tools/sim/YOUR_CI.md: its files make a repository, its script checks it, and it fails where it must."""

import os
import re
import subprocess
import sys

import pytest

from tests.sim.sim_command import CM5SIM, TOP

PAGE = (TOP / "tools" / "sim" / "YOUR_CI.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"This is `([^`]+)`[^\n]*:\n\n```\w*\n(.*?)```", PAGE, re.S))


@pytest.fixture(name="repository")
def _repository(tmp_path):
    """The example's repository, and the two commands that its first step installs."""
    for name, text in FILES.items():
        (tmp_path / "repository" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "repository" / name).write_text(text, encoding="utf-8")
    commands = tmp_path / "bin"
    commands.mkdir()
    (commands / "m512").write_text(f'#!/bin/sh\nexec {sys.executable} -m m512 "$@"\n')
    (commands / "m512").chmod(0o755)
    (commands / "cm5sim").symlink_to(CM5SIM)
    return tmp_path / "repository"


def check(repository, steps=None):
    """Runs the workflow without pip. steps: number of commands of check.sh to run; None: all."""
    if steps is not None:
        kept, seen = [], 0
        for line in (repository / "check.sh").read_text().splitlines():
            seen += line.startswith(("m512 ", "cm5sim "))
            if seen > steps:
                break
            kept.append(line)
        (repository / "check.sh").write_text("\n".join(kept) + "\n")
    lines = re.findall(r"- run: (.*)", FILES[".github/workflows/motions.yml"])
    assert lines[0].startswith("pip install wheels/") and len(lines) == 2
    return subprocess.run(
        ["sh", "-c", lines[1]],
        check=False,
        cwd=repository,
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "PATH": f"{repository.parent}/bin:{os.environ['PATH']}"},
    )


def spoil(repository, name, before, after):
    text = (repository / name).read_text()
    assert before in text
    (repository / name).write_text(text.replace(before, after))


def without_plot(repository):
    """Removes the plot, which takes most of a run; the test of the good example covers it."""
    spoil(repository, "check.sh", " --plot out/joints.svg", "")


def test_the_page_has_all_its_files():
    assert set(FILES) == {"motions.m512", "play.txt", "check.sh", ".github/workflows/motions.yml"}


def test_the_example_is_good_and_leaves_its_artefacts(repository):
    done = check(repository)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (repository / "out" / "joints.svg").read_text().lstrip().startswith("<?xml")
    assert len((repository / "out" / "joints.csv").read_text().splitlines()) > 500
    assert "put down" in done.stdout and "0 falls" in done.stdout


def test_a_motion_that_falls_is_told(repository):
    """The same bow, backwards: both checks before the body succeed."""
    spoil(repository, "motions.m512", "11:+120 12:-120", "11:-150 12:+150")
    without_plot(repository)
    done = check(repository)
    assert done.returncode == 1 and "the robot falls" in done.stderr and "fell" in done.stdout


@pytest.mark.parametrize(
    "name, before, after, steps, code, says",
    [
        ("motions.m512", "step 1s | @ready", "step 1s | @redy", 1, 4, "motions.m512:"),
        ("motions.m512", "exit ready", "exit 77", 2, 3, "exit leads to page 77"),
        ("play.txt", "present 13 <= 328", "present 13 <= 300", 3, 1, "play.txt:7"),
        ("play.txt", "play bow", "play wave", 3, 1, "No page is named wave"),
    ],
)
def test_what_is_wrong_is_told_where_it_is(repository, name, before, after, steps, code, says):
    spoil(repository, name, before, after)
    without_plot(repository)
    done = check(repository, steps)
    assert done.returncode == code and says in done.stdout + done.stderr, done.stdout + done.stderr
