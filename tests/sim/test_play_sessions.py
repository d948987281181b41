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
