# SPDX-License-Identifier: MIT
"""Three pages for tests of Edit's commands that leave the flash unchanged, and the return to page 1. The robot is in conftest.py."""

from tests.sim.edit_robot import page

BASE = page("base", [(40, {1: 480, 2: 544}, 3), (50, {3: 300}), (60, {4: 10})], code=7, next=3)
OTHER = page("other", [(11, {1: 900}), (22, {2: 100})])
FULL = page("full", [(10 + k, {1: 100 * k}) for k in range(7)])
PAGES = {1: BASE, 2: OTHER, 3: FULL}


def opened(shared):
    """The robot with page 1 from flash at X1 Y0; unsaved edits are discarded."""
    shared.line("page 1")
    if "[y/N]" in shared.command:
        shared.keys("y")
    shared.line("goto 1 0")
    return shared


def bytes_of(r):
    """The page in RAM as a program reads it: saved to page 127 (SAVE seals it) and read from flash."""
    r.line("save 127")
    if "[y/N]" in r.command:
        r.keys("y")
    assert "OK" in r.message, r.message
    return r.flash_page(127)


def step(data, k):
    return bytes(data[64 + 64 * k : 128 + 64 * k])
