# SPDX-License-Identifier: MIT
"""Jobs for test_campaign.py: functions of a module, as each() wants them."""
import os
import random
import time


def number(seed):
    """By chance, from the seed alone; later items are quicker, so that they are done first."""
    time.sleep(0.05 if seed < 3 else 0)
    return seed, random.Random(seed).random()


def where(_):
    time.sleep(0.1)
    return os.getpid()


def scaled(factor, item):
    return factor * item


def fails(item):
    if item == 3:
        raise ValueError("job 3 is bad")
    return item
