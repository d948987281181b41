# SPDX-License-Identifier: MIT
"""What somebody has left open in a board's terminal when m512 comes (a name, a question, a list, a half-typed line, a play): nothing of it
is changed, done or stopped by that, and m512 says what it was. Against the simulated board, in simulated time. What Edit has in RAM is told
by its own `@crc`."""

import json
import random

import pytest
from factory_peer import FactoryPeer
from virtual_peer import VirtualLink

from m512.board import contact
from m512.board.client import Client

MOTIONS = """motion512 1
page 1 stand
  step 0.5s | 1..18:512
page 2 bow
  repeat 8
  step 1s | 1..18:440
  step 1s pause 0.8s | 1..18:584
page 4 rest
  step 1s pause 1.95s | 7:584
page 9 forever
  next self; exit stand
  step 0.5s | 1..18:440
  step 0.5s | 1..18:584
"""
SEED = 20261123
NAME, QUESTION, LINE, NOTHING = "waiting for a name", "Are you sure?", "half-typed", ""
OPEN = [
    (["name\r"], NAME),
    (["name\r", "salu"], NAME),
    (["new\r"], QUESTION),
    (["delete 1"], LINE),
    (["new"], LINE),
    (["play 22"], LINE),
    (["x" * 90], LINE),
    (["9" * 111], LINE),
    (["name\r", "y" * 90], NAME),
    (["@torque of"], NOTHING),
    (["@play 2"], NOTHING),
    (["help\r"], NOTHING),
    (["list\r"], NOTHING),
    (["@where\r"], NOTHING),
    (["page 4\r", "page 2\r"], NOTHING),
    ([], NOTHING),
]


@pytest.fixture
def board(started):
    """board("edit-cm5.hex", ...) -> it runs, and `said` is all that it has said."""

    def start(image, servos=range(1, 19)):
        end = started(image, text=MOTIONS, servos=servos)
        end.pass_time(1.5)
        return end

    return start


def type_(end, *lines, rest=0.7):
    for line in lines:
        end.put(line.encode())
        end.pass_time(rest)


def said(end):
    return end.board.console.decode("latin-1")


def crc(end):
    """Of the page in Edit's RAM."""
    with VirtualLink(end.path) as link:
        return Client(link).ask("crc")


def test_what_is_open_in_edit_is_not_changed(m512, board, tmp_path):
    looks = [("pose",), ("torque", "on"), ("doctor",), ("stop",), ("get", "2", "--force", "-o", tmp_path / "got.bin")]
    chance, edit = random.Random(SEED), board("edit-cm5.hex")
    type_(edit, "page 2\r")
    page, flash = crc(edit), bytes(edit.board.flash[0xE000:0x1E000])
    for keys, told in chance.sample(OPEN, len(OPEN)):
        where = f"{keys}, seed {SEED}"
        type_(edit, "x\r", *keys)  # brings the screen back first
        mark = len(said(edit))
        result = m512(*chance.choice(looks), "-p", edit.path)
        assert result.exit_code == 0, (where, result.stderr)
        assert told in result.stderr and result.stderr.count("note:") == (told != NOTHING), (where, result.stderr)
        answer = said(edit)[mark:]
        assert "Bad Command" not in answer and "ERR" not in answer and "[35;1H* unsaved" not in answer, (where, answer)
        assert crc(edit) == page and bytes(edit.board.flash[0xE000:0x1E000]) == flash, where
        assert not [servo for servo in range(1, 19) if edit.board.servos[servo].goal not in (None, 512)], where


@pytest.mark.parametrize("image", ["edit-cm5.hex", "play-cm5.hex"])
def test_a_long_line_is_not_run_either(board, image):
    """More characters than a boot loader's knock rubs out; what is left of them would be a command."""
    there = board(image)
    type_(there, "x\r", "play 2" + " " * 104)
    mark = len(said(there))
    with VirtualLink(there.path) as link:
        contact.make(link)
    there.pass_time(3)
    assert "OK" not in said(there)[mark:] and "step 0" not in said(there)[mark:]
    with VirtualLink(there.path) as link:
        assert Client(link).where()["state"] == "idle"
    assert not [servo for servo in range(1, 19) if there.board.servos[servo].goal not in (None, 512)]


def test_a_typed_play_is_left_to_its_end(m512, board, tmp_path):
    motions, edit = tmp_path / "lib.m512", board("edit-cm5.hex")
    motions.write_text(MOTIONS)
    type_(edit, "play 2\r", rest=3.0)
    for words in (
        ("pose",),
        ("get", "all", "-o", tmp_path / "got.bin"),
        ("flash", motions),
        ("flash", motions, "--dry-run"),
        ("pages", edit.path, "list"),
        ("backup", tmp_path / "folder"),
    ):
        result = m512(*words, *([] if words[0] == "pages" else ["-p", edit.path]))
        assert result.exit_code == 5 and "m512 stop" in result.stderr and "MODE" not in result.stderr, (words, result.stderr)
        edit.pass_time(0.3)
    looked = m512("doctor", "-p", edit.path)
    assert looked.exit_code == 0 and "m512 stop" in looked.stdout
    edit.board.expect("step 1 repetition 8", ms=60_000)
    edit.board.expect("OK", ms=10_000)
    assert "[STOP]" not in said(edit) and "[BREAK]" not in said(edit)
    assert m512("pose", "-p", edit.path).exit_code == 0


def test_a_play_of_one_joint_in_its_pause_is_no_silence(m512, board):
    """It draws least of all: every 0.24 s, as each tick has its joint of 31."""
    edit = board("edit-cm5.hex", servos=[7])
    type_(edit, "play 4 10\r", rest=14.0)  # ten times as slow: its pause lasts 19.5 s
    for _ in range(5):
        assert m512("pose", "-p", edit.path).exit_code == 5
        edit.pass_time(0.61)
    assert "step 0" in said(edit) and "[STOP]" not in said(edit)


@pytest.mark.parametrize("now, word", [((), "[STOP]"), (("--now",), "[BREAK]")])
def test_stop_ends_a_typed_play(m512, board, now, word):
    edit = board("edit-cm5.hex")
    type_(edit, "play 9\r", rest=3.0)
    result = m512("stop", *now, "--json", "-p", edit.path)
    assert result.exit_code == 0 and json.loads(result.stdout)["state"] == "idle", result.stderr
    assert word in said(edit) and "it ends now" in result.stderr


@pytest.mark.parametrize("keys, told", [((), NOTHING), (("play 22",), LINE), (("nonsen",), LINE)])
def test_a_line_that_is_half_typed_into_play_is_not_run(m512, board, keys, told):
    play = board("play-cm5.hex")
    type_(play, *keys)
    result = m512("pose", "-p", play.path)
    assert result.exit_code == 0 and told in result.stderr and result.stderr.count("note:") == (told != NOTHING), result.stderr
    with VirtualLink(play.path) as link:
        assert Client(link).where()["state"] == "idle"


@pytest.mark.parametrize("keys, told", [((), NOTHING), (("g",), LINE), (("load e000",), LINE)])
def test_a_line_that_is_half_typed_into_our_loader_is_not_run(m512, board, keys, told):
    loader = board("boot-cm5.hex")
    type_(loader, *keys)
    result = m512("doctor", "-p", loader.path)
    assert "Motion512 boot loader" in result.stdout, result.stdout
    assert told in result.stderr and result.stderr.count("note:") == (told != NOTHING), result.stderr
    assert "Jump" not in said(loader) and "Ready" not in said(loader)


@pytest.mark.parametrize("keys, told", [("", NOTHING), ("g", LINE), ("load e000", LINE)])
def test_a_line_that_is_half_typed_into_the_factorys_loader_is_not_run(m512, keys, told):
    with FactoryPeer() as loader:
        loader.put(keys.encode())
        result = m512("doctor", "-p", loader.path)
        assert "factory boot loader" in result.stdout, result.stdout
        assert told in result.stderr and result.stderr.count("note:") == (told != NOTHING), result.stderr
        assert not {b"g", b"load e000"} & set(loader.words) and not loader.hurt


def test_what_plays_in_play_goes_on(m512, board):
    play = board("play-cm5.hex")
    assert m512("play", "forever", "-p", play.path).exit_code == 0
    for _ in range(5):
        assert m512("pose", "-p", play.path).exit_code == 0
        play.pass_time(0.37)
    with VirtualLink(play.path) as link:
        assert Client(link).where()["state"] == "playing"
