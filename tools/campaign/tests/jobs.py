# SPDX-License-Identifier: MIT
"""Jobs for test_campaign.py: functions of a module, as each() wants them."""

import os
import random
import time

PATIENCE_S = 300


def number(seed):
    """By chance, from the seed alone; later items are quicker, so that they are done first."""
    time.sleep(0.05 if seed < 3 else 0)
    return seed, random.Random(seed).random()


def meet(folder, number):
    """Waits until so many processes have come here: none of them can have done the others' work. Its own number."""
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
