# SPDX-License-Identifier: MIT
"""Noise at Edit's console (edit_noise.py says what it is made of and what is looked at). M512_FUZZ_BYTES sets how many
bytes, 200,000 by default; the proof's 10^7: tools/prove fuzz."""

import os

import pytest

from tests.sim.edit_noise import fuzz

BYTES = int(os.environ.get("M512_FUZZ_BYTES", "200000"))
SEEDS = {"never saved": 0, "our loader": 1, "the factory loader": 2}


@pytest.mark.parametrize("who", SEEDS)
def test_noise_does_no_harm(who):
    figures = fuzz(SEEDS[who], BYTES // len(SEEDS))
    print(
        f"noise, {who}: {figures.sent} bytes in {figures.seconds:.0f} s of the board, {figures.saves} saves, {figures.restarts} "
        f"restarts, stack headroom {figures.headroom}"
    )
    assert figures.sent == BYTES // len(SEEDS) and (figures.saves > 0) == (SEEDS[who] > 0)
