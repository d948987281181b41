# SPDX-License-Identifier: MIT
"""Input that a user has left open in a board's terminal when m512 connects (a name, a question, a list, a half-typed line, a play) is
not changed, executed, stopped or redrawn. Tested against the simulated board, in simulated time. Edit's `@crc` gives the content of its
RAM."""

import random
import re

import pytest
from factory_peer import FactoryPeer
from virtual_peer import VirtualLink

from m512.board.client import Client

MOTIONS = """motion512 1
page 1 stand
  step 0.5s | 1..18:512
page 2 bow
  repeat 5
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
OPEN = [
    ["name\r"],
    ["name\r", "salu"],
    ["new\r"],
    ["delete 1"],
    ["new"],
    ["play 22"],
    ["x" * 90],
    ["9" * 111],
    ["name\r", "y" * 90],
    ["@torque of"],
    ["@play 2"],
    ["help\r"],
    ["list\r"],
    ["@where\r"],
    ["page 4\r", "page 2\r"],
    [],
]


@pytest.fixture
def board(started):
    """board("edit-cm5.hex", ...) -> a running board."""

    def start(image, servos=range(1, 19)):
        end = started(image, text=MOTIONS, servos=servos)
        end.pass_time(1.5)
        return end

    return start


def type_(end, *lines, rest=0.7):
    for line in lines:
        end.put(line.encode())
        end.pass_time(rest)


def shown(end, mark=0):
    """What a terminal shows of the board's output since `mark`."""
    return re.sub(rb"\x1e[^\n]*\n", b"", end.board.console[mark:].translate(None, b"\x11\x13")).decode("latin-1")


def crc(end):
    """The CRC of the page in Edit's RAM."""
    with VirtualLink(end.path) as link:
        return Client(link).ask("crc")


def state(end):
    with VirtualLink(end.path) as link:
        return Client(link).where()["state"]


def test_what_is_open_in_edit_is_not_touched(m512, board, tmp_path):
    looks = [("pose",), ("doctor",), ("stop",), ("get", "2", "--force", "-o", tmp_path / "got.bin")]
    chance, edit = random.Random(SEED), board("edit-cm5.hex")
    type_(edit, "page 2\r")
    page, flash = crc(edit), bytes(edit.board.flash[0xE000:0x1E000])
    for keys in chance.sample(OPEN, len(OPEN) // 2):
        where = f"{keys}, seed {SEED}"
        type_(edit, "\x03\x03x\r", *keys)  # first leaves what was open and restores the screen
        mark = len(edit.board.console)
        result = m512(*chance.choice(looks), "-p", edit.path)
        assert result.exit_code == 0 and "note:" not in result.stderr, (where, result.stderr)
        assert shown(edit, mark) == "", where
        assert crc(edit) == page and bytes(edit.board.flash[0xE000:0x1E000]) == flash, where


def test_a_name_goes_on_behind_it(m512, board):
    edit = board("edit-cm5.hex")
    type_(edit, "page 2\r", "name\r", "salu")
    assert m512("pose", "-p", edit.path).exit_code == 0
    mark = len(edit.board.console)
    type_(edit, "te\r")
    assert "salute" in shown(edit, mark)  # the page's new name, on the screen


def test_a_page_does_not_take_the_place_of_one_that_is_asked_about(m512, board, tmp_path):
    edit = board("edit-cm5.hex")
    (tmp_path / "lib.m512").write_text(MOTIONS.replace("440", "450"))
    type_(edit, "page 2\r", "new\r")
    result = m512("put", tmp_path / "lib.m512", "2:2", "-p", edit.path)
    assert result.exit_code != 0 and "waits for an answer on its terminal" in result.stderr, result.stderr


def test_a_typed_play_goes_on(m512, board, tmp_path):
    motions, edit = tmp_path / "lib.m512", board("edit-cm5.hex")
    motions.write_text(MOTIONS)
    type_(edit, "play 2\r", rest=3.0)
    for words in (("pose",), ("get", "2", "-o", tmp_path / "got.bin"), ("flash", motions, "--dry-run")):
        result = m512(*words, "-p", edit.path)
        assert result.exit_code == 0, (words, result.stderr)
    for words in (("flash", motions), ("backup", tmp_path / "folder")):
        result = m512(*words, "-p", edit.path)
        assert result.exit_code == 5 and "m512 stop" in result.stderr and "MODE" not in result.stderr, (words, result.stderr)
    edit.board.expect("step 1 repetition 5", ms=60_000)
    edit.board.expect("OK", ms=10_000)
    assert "[STOP]" not in shown(edit) and "[BREAK]" not in shown(edit)


@pytest.mark.parametrize("now", [(), ("--now",)])
def test_stop_ends_a_typed_play(m512, board, now):
    edit = board("edit-cm5.hex")
    type_(edit, "play 9\r", rest=3.0)
    result = m512("stop", *now, "-p", edit.path)
    assert result.exit_code == 0, result.stderr
    edit.pass_time(3.0)
    assert state(edit) == "idle"
    type_(edit, "nonsense\r")  # the line is free again
    assert "Bad Command" in shown(edit)


@pytest.mark.parametrize(
    "keys, rest, shows", [("", "version\r", "Motion512"), ("la", "w\r", "] law\r\nexact"), ("nonsen", "se\r", "] nonsense\r\nUnknown")]
)
def test_a_line_that_is_half_typed_into_play_goes_on(m512, board, keys, rest, shows):
    play = board("play-cm5.hex")
    type_(play, keys)
    mark = len(play.board.console)
    result = m512("pose", "-p", play.path)
    assert result.exit_code == 0 and shown(play, mark) == ""
    type_(play, rest)
    assert shows in shown(play)


@pytest.mark.parametrize("keys", ["", "g", "load e000", "app 1"])
def test_a_line_that_is_half_typed_into_our_loader_is_not_run(m512, board, keys):
    loader = board("boot-cm5.hex")
    type_(loader, keys)
    result = m512("doctor", "-p", loader.path)
    assert "Motion512 boot loader" in result.stdout, result.stdout
    assert "Jump" not in shown(loader) and "Ready" not in shown(loader)


@pytest.mark.parametrize("keys", ["", "g", "load e000"])
def test_a_line_that_is_half_typed_into_the_factorys_loader_is_not_run(m512, keys):
    with FactoryPeer() as loader:
        loader.put(keys.encode())
        result = m512("doctor", "-p", loader.path)
        assert "factory boot loader" in result.stdout, result.stdout
        assert not {b"g", b"load e000"} & set(loader.words) and not loader.hurt


def test_what_plays_in_play_goes_on(m512, board):
    play = board("play-cm5.hex")
    assert m512("play", "forever", "-p", play.path).exit_code == 0
    for _ in range(5):
        assert m512("pose", "-p", play.path).exit_code == 0
        play.pass_time(0.37)
    assert state(play) == "playing"


def test_a_program_without_the_channel_is_told_to_be_replaced(m512, board):
    """The monitor has no channel, like older versions of Play and Edit."""
    port = board("monitor-cm5.hex").path
    result = m512("pose", "-p", port)
    assert result.exit_code != 0 and "an older Play or Edit" in result.stderr and "m512 flash play-cm5.hex" in result.stderr, result.stderr
    examined = m512("doctor", "-p", port).stdout
    assert "an older Play or Edit, or another program" in examined and "-> Write a new one" in examined, examined
