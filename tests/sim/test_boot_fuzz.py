# SPDX-License-Identifier: MIT
"""Noise at the prompt, in STK500 sessions and in block sessions (boot_noise.py). M512_FUZZ_BYTES says how many bytes in all
(default 120,000; tools/prove fuzz sends 10,000,000)."""

import os

import pytest

from tests.sim.boot_noise import MAKERS, fuzz

BYTES = int(os.environ.get("M512_FUZZ_BYTES", 120_000))


@pytest.mark.parametrize("make", MAKERS)
def test_noise(make):
    figures = fuzz(make, 0, BYTES // len(MAKERS))
    print(f"{make.__name__}: {figures.sent} bytes, {figures.licensed} chunks with a valid writing command by chance")
