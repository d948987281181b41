# SPDX-License-Identifier: MIT
"""Every example of m512 in a --help text or in a README of the project works as described. The files that it names exist, a robot
answers at every port, and the user says yes and presses Space."""

import re
import shlex
import shutil
import subprocess
from contextlib import contextmanager
from pathlib import Path

import click
import pytest
from conftest import REPO, starting
from mtn_files import Block, made, step
from virtual_peer import open_port

from m512.board import driving, link, motions, ports, terminal
from m512.cli import main, shape
from m512.files import formats
from m512.files.image import Image
from m512.files.text import read_text

NAMES = ["stand", "walk", "wave", "wave_over", "walk_start", "walk_loop", "walk_end", "bow", "kick_left"]
LIBRARY = (
    "motion512 1\n"
    + "".join(f"page {n} {name}\n  exit stand\n  step 0.5s | 1..18:500\n  step 0.5s | 1..18:{510 + n}\n" for n, name in enumerate(NAMES, 1))
    + """
page 12 chosen
  step 0.5s | 1:500
page 15 table
  step 0.5s | 1:500
page 16 old_wave
  step 0.5s | 1:500
page 20 round
  next round; exit stand
  step 0.5s | 1..18:490
  step 0.5s | 1..18:530
"""
)
LAID_OVER = {"layer", "aim", "swing", "free"}  # these need a play that runs
THROUGH_EDIT = {"put"}
AT_THE_PROMPT = {"flash", "run", "backup", "restore", "term", "doctor"}  # the loader's prompt
READERS = {"backup", "diff", "doctor", "get", "pages"}
READS = {("pose",), ("pose", "--text"), ("shape",), ("stop",), ("stop", "--now")}
FOUND_SOMETHING = {"diff", "doctor"}  # exit code 3 is also a result
RUN_ELSEWHERE = "## Without a robot"  # in test_readme.py, line by line


def of_help(command, path):
    """The examples of a command and of its subcommands."""
    text = (command.epilog or "") + (command.help if path == "m512" else "")
    for line in text.splitlines():
        if re.match(r"\s*(Example: |With(out)? a robot: +)?m512 \S", line):
            yield from ((path, found) for found in re.findall(r"m512 \S.*?(?=\s{2,}|$)", line))
    if isinstance(command, click.Group):
        for name in command.list_commands(click.Context(command)):
            yield from of_help(command.get_command(None, name), f"{path} {name}")


def of_texts():
    files = subprocess.run(["git", "ls-files", "*.md"], cwd=REPO, capture_output=True, text=True, check=True).stdout.split()
    for file in files:
        text = (REPO / file).read_text()
        text = re.sub(rf"^{RUN_ELSEWHERE}$.*?^## ", "", text, flags=re.S | re.M)
        for block in re.findall(r"^```\w*\n(.*?)^```", text, re.S | re.M):
            yield from ((file, line.strip()) for line in block.splitlines() if line.strip().startswith("m512 "))
        plain = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
        yield from ((file, " ".join(span.split())) for span in re.findall(r"`(m512 [^`]+)`", plain))
        yield from ((file, line) for line in re.findall(r"^ {4}(m512 \S.*?)(?=\s{2,}|$)", plain, re.M))


def words_of(line):
    return tuple(shlex.split(line.partition(" || ")[0], comments=True)[1:])


EXAMPLES = sorted({words_of(line): where for where, line in [*of_texts(), *of_help(main, "m512")]}.items())


def is_about_files(words):
    return words[0] == "convert" or (words[0] == "pages" and not words[1].startswith("/dev/")) or words[:2] == ("diff", "old.bin")


def is_a_name(words):
    """Whether the words only name a command that needs arguments, such as "m512 pages check"."""
    command, wants = main, False
    for word in words:
        command = command.get_command(None, word) if isinstance(command, click.Group) else None
        if command is None:
            return False
        wants |= any(isinstance(parameter, click.Argument) and parameter.required for parameter in command.params)
    return wants


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the files that the examples name."""
    top, text = tmp_path_factory.mktemp("examples"), read_text(LIBRARY)
    for name in ("library.m512", "lib.m512", "walk.m512", "wave.m512", "motions.m512"):
        (top / name).write_text(LIBRARY)
    for name in ("out", "build/motions", "build/firmware"):
        (top / name).mkdir(parents=True)
    for name in ("lib.bin", "walk.bin", "old.bin", "new.bin", "other.bin", "out/motions.bin", "build/motions/motions.bin"):
        (top / name).write_bytes(text.to_bytes())
    blocks = [Block("walk" if n == 201 else f"m{n}", steps=[step()]) for n in range(1, 242)]
    (top / "large.mtn").write_bytes(made(blocks))
    (top / "robot.mtn").write_bytes(made(blocks[:100], full=False))
    (top / "other.mtn").write_bytes(made(blocks[29:36], full=False))
    formats.save(top / "op3.bin", read_text("motion512 1\npages 0..255\nbits 12\npage 1 high\n  step 50 | 1..18:2048\n"))
    for image in ("play-cm5.hex", "edit-cm5.hex"):
        shutil.copy(REPO / "build" / "firmware" / image, top / image)
        shutil.copy(REPO / "build" / "firmware" / image, top / "build" / "firmware" / image)
    return top


def only_reads(words):
    return words in READS or words[0] in READERS


def memory(robot):
    return bytes(robot.board.flash), bytes(robot.board.eeprom)


def powered(start, command):
    images = ("boot-cm5.hex", "edit-cm5.hex" if command in THROUGH_EDIT else "play-cm5.hex")
    robot = start(*images, text=LIBRARY, servos=range(1, 21), applied=command not in AT_THE_PROMPT)
    if command not in AT_THE_PROMPT:
        robot.pass_time(0.5)
    return robot


@pytest.fixture(scope="module")
def shared():
    """shared(command) -> the robot for all examples that only read: one in Play, one at the loader's prompt."""
    robots, memories = {}, {}
    with starting() as start:

        def robot_for(command):
            key = command in AT_THE_PROMPT
            if key not in robots:
                robots[key] = powered(start, command)
                memories[key] = memory(robots[key])
            return robots[key]

        yield robot_for
        assert {key: memory(robot) for key, robot in robots.items()} == memories


@pytest.fixture
def world(tmp_path, monkeypatch, started, shared, folder):
    """Copies that folder; world(words) -> a robot, which answers at every port."""
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("m512.ui.confirm", lambda question, yes: None)

    def at_every_port(words):
        robot = shared(words[0]) if only_reads(words) else powered(started, words[0])

        def open_any(url, image="play"):
            return open_port(url if url.startswith(("peer://", "/dev/pts")) else robot.path, image)

        for module in (link, motions, terminal):
            monkeypatch.setattr(module, "Link", open_any)
        monkeypatch.setattr(ports, "available", lambda: [("/dev/ttyUSB0", "USB serial")])
        return robot

    return at_every_port


def before(m512, command, words, robot):
    """Sets up what the example presupposes."""
    if command == "restore":
        assert m512("backup", words[1], "--what", "motions").exit_code == 0
    if command == "diff" and "backup-20260101-120000" in words:
        assert m512("backup", words[2], "--what", "motions").exit_code == 0
    if command in LAID_OVER:
        assert m512("play", "round").exit_code == 0
        robot.pass_time(3)
    if words[0] == "shape" and len(words) > 1:
        assert m512("play", "round").exit_code == 0


@contextmanager
def space_is_pressed():
    keys = driving.Keys()
    keys.press(" ")
    yield keys


@pytest.mark.parametrize("words, where", EXAMPLES, ids=[" ".join(words) for words, _ in EXAMPLES])
def test_an_example_does_what_it_says(m512, world, tmp_path, monkeypatch, words, where):
    if words == ("--help",) or is_a_name(words):
        assert m512(*words[:1], "--help").exit_code == 0
        return
    command = words[0]
    robot = world(words) if "--sim" not in words and not is_about_files(words) else None
    if "merge" in words:  # into free pages
        formats.save(Path(words[1]), Image.empty(), replace=True)
    if robot:
        before(m512, command, words, robot)
    outputs = [words[words.index("-o") + 1]] if "-o" in words else words[2:3] if command == "convert" and "--force" not in words else []
    for output in outputs:
        (tmp_path / output).unlink(missing_ok=True)
    monkeypatch.setattr(shape, "_keys", space_is_pressed)
    monkeypatch.setenv("M512_BUILD", str(REPO / "build"))
    result = m512(*words, input="")
    allowed = (0, 3) if command in FOUND_SOMETHING or "check" in words else (0,)
    assert result.exit_code in allowed, (where, words, result.stdout, result.stderr)
    for output in outputs:
        assert (tmp_path / output).stat().st_size > 0


def test_there_are_examples_of_every_command():
    assert {words[0] for words, _ in EXAMPLES} >= set(main.list_commands(None))
    assert len(EXAMPLES) > 70
