# SPDX-License-Identifier: MIT
"""The strict board with the shipped image and the program in simulated time do the same: goals, text, motion pages, settings."""

import pytest

from tests.campaigns.told import board


@pytest.mark.parametrize("seed", range(3))
def test_board_and_simulated_time_do_the_same(seed):
    frames, differs = board.difference(seed)
    assert frames > 500 and not differs, differs
