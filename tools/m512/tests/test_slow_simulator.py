# SPDX-License-Identifier: MIT
"""Commands with --sim on a PC so busy that the simulated board runs a hundred times slower than a real one from power-on. The image is
Play; the clocks of m512 and of the board are both simulated."""

import json

import pytest
from virtual_peer import SimulatedBoard

from m512.board import sim

SLOW = 100
MOTIONS = """motion512 1
page 100 nod
  step 25 | 1:560
"""


class SlowBoard(SimulatedBoard):
    """On m512's clock SLOW seconds pass per second of the board's clock."""

    SLICE_MS = 0.05
    silent = False

    def now(self):
        return SLOW * super().now()

    def pass_time(self, seconds):
        super().pass_time(seconds / SLOW)

    def get(self, limit, seconds):
        if self.silent:
            self.board.run(ms=max(1000 * seconds / SLOW, self.SLICE_MS))
            self.board.take()
            return b""
        return super().get(limit, seconds)


@pytest.fixture
def slow(monkeypatch, repo):
    """The board that --sim starts."""
    monkeypatch.setenv("M512_BUILD", str(repo / "build"))
    from cm5sim import Board
    from m512.files.text import read_text

    with Board(images=["play-cm5.hex"], motions=read_text(MOTIONS).to_bytes(), servos=range(1, 19)) as chip, SlowBoard(chip) as board:

        class Started:
            url = board.path

            def __init__(self, *_):
                pass

            __enter__ = lambda self: self  # noqa: E731
            __exit__ = lambda self, *_: None  # noqa: E731

        monkeypatch.setattr(sim, "Simulator", Started)
        yield board


def test_play_waits_for_a_slow_simulator(m512, slow):
    result = m512("play", "nod", "--sim", "--json")
    assert result.exit_code == 0, result.stderr
    assert "playing: page 100" in result.stderr and json.loads(result.stdout)["state"] == "idle"
    assert slow.now() > 100


def test_doctor_waits_for_a_slow_simulator(m512, slow):
    result = m512("doctor", "--sim", "--json")
    found = {finding["what"]: finding["text"] for finding in json.loads(result.stdout)}
    assert found["image"].startswith("play ") and found["servos"].startswith("18 servos"), found


def test_a_simulator_that_never_answers_is_given_up_after_minutes(m512, slow):
    slow.silent = True
    result = m512("pose", "--sim")
    assert result.exit_code == 7 and 240 < slow.now() < 1000
    assert "5 minutes" in result.stderr and "--image" in result.stderr, result.stderr
