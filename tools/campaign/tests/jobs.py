# SPDX-License-Identifier: MIT
"""Jobs for test_campaign.py: module-level functions, as each() requires."""

import os
import random
import time

PATIENCE_S = 300


def number(seed):
    """A random number that depends only on the seed. Later items are faster, so that they finish first."""
    time.sleep(0.05 if seed < 3 else 0)
    return seed, random.Random(seed).random()


def meet(folder, number):
    """Waits until `number` processes have arrived here, so that none of them can have done the others' work. Returns its process ID."""
    folder.joinpath(str(os.getpid())).touch()
    end = time.monotonic() + PATIENCE_S
    while len(list(folder.iterdir())) < number:
        if time.monotonic() > end:
            raise TimeoutError(f"{len(list(folder.iterdir()))} of {number} processes came")
        time.sleep(0.01)
    return os.getpid()


def scaled(factor, item):
    return factor * item


def fails(item):
    if item == 3:
        raise ValueError("job 3 is bad")
    return item
