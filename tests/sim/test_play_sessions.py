# SPDX-License-Identifier: MIT
"""Every word of Play with good and bad arguments, as recorded sessions: the terminal's text, line by line. M512_RECORD=1 records the
sessions anew (read them before you keep them)."""

import os

import pytest

from tests.sim.play_robot import SESSIONS, robot, run_session


@pytest.mark.parametrize("path", sorted(SESSIONS.glob("play_*.txt")), ids=lambda path: path.stem)
def test_session(path):
    board = robot()
    wanted = path.read_text()
    went = run_session(board, wanted)
    if os.environ.get("M512_RECORD"):
        path.write_text(went)
    assert went == wanted


def test_words_and_short_words_are_all_different():
    """Of two equal ones only the first would be found."""
    help_text = (SESSIONS / "play_words.txt").read_text().partition("] help\n")[2].partition(" OK\n")[0]
    words = [word for line in help_text.splitlines() for word in (line[:10].strip(), line[10:15].strip()) if word]
    assert {"play", "p", "help", "?"} <= set(words) and len(words) == len(set(words))
