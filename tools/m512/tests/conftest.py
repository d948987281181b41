# SPDX-License-Identifier: MIT
"""Fixtures that give tests access to the repository, its sample files and the build products."""

from contextlib import contextmanager
from pathlib import Path

import pytest

REPO = Path(__file__).resolve().parents[3]


def separate_runner():
    """A runner that keeps standard error separate. click before 8.2 (Python 3.9) needs mix_stderr=False for that."""
    from click.testing import CliRunner

    try:
        return CliRunner(mix_stderr=False)
    except TypeError:
        return CliRunner()


@pytest.fixture
def repo():
    return REPO


@pytest.fixture
def sample():
    """sample("x.bin") -> path of a file in tests/samples."""
    return (REPO / "tests" / "samples").joinpath


@pytest.fixture
def m512(monkeypatch):
    """m512("convert", "a", "b") -> click result. Runs a command in this process; peer://... is a board of virtual_peer.py."""
    from virtual_peer import open_port

    from m512.board import link, motions
    from m512.cli import main

    monkeypatch.setattr(link, "Link", open_port)
    monkeypatch.setattr(motions, "Link", open_port)

    def run(*args, input=None):
        result = separate_runner().invoke(main, [str(arg) for arg in args], input=input)
        assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
        return result

    return run


@contextmanager
def starting():
    """start("boot-cm5.hex", "play-cm5.hex", text=...) -> a SimulatedBoard with these images and motions, one second after power-on.
    applied: the loader starts the application at once. Needs the build products."""
    from virtual_peer import SimulatedBoard

    from cm5sim import Board
    from m512.files.text import read_text

    boards = []

    def start(*images, text=None, servos=range(1, 19), applied=False):
        paths = [str(REPO / "build" / "firmware" / image) if not Path(image).is_absolute() else image for image in images]
        board = Board(images=paths, motions=read_text(text).to_bytes() if text else None, servos=servos)
        board.skip_waits()
        if applied:
            board.eeprom[0xFFF] = 0x11
        boards.append(SimulatedBoard(board))
        boards[-1].pass_time(1.0)
        return boards[-1]

    yield start
    for board in boards:
        board.pull()
        assert board.board.violation is None


@pytest.fixture
def started(monkeypatch):
    """starting(), for one test."""
    monkeypatch.setenv("M512_BUILD", str(REPO / "build"))
    with starting() as start:
        yield start
