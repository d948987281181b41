# SPDX-License-Identifier: MIT
"""Finds where a motion asks for more speed than a servo has.

An AX-12 turns at 59 rpm without load at 12 V (data sheet), and proportionally slower at a lower supply. It does not reach goals that move
faster: the joint lags, and the motion differs from the intended one.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

from m512.files.image import Image
from m512.files.page import JOINTS
from m512.motion.player import first_pose, play
from m512.motion.walk import degrees_per_unit

NO_LOAD_RPM, SHEET_V = 59.0, 12.0
BATTERY_V = 9.6  # a CM-5's pack: 8 cells of 1.2 V
TICKS_PER_SECOND = 128
LOOKED_SECONDS = 60.0  # of a play; it takes this PC some seconds
WINDOW = 4  # ticks of a step over which the speed is measured, because goals are integers; a shorter step is measured as a whole


@dataclass
class TooFast:
    """The fastest joint in a step that asks for too much speed."""

    page: int
    step: int  # 1..7
    joint: int
    degrees_s: float


def no_load_degrees_s(volts: float) -> float:
    return NO_LOAD_RPM * 6 * volts / SHEET_V


def no_load_units_per_tick(volts: float, bits: int = 10) -> float:
    return no_load_degrees_s(volts) / float(degrees_per_unit(bits)) / TICKS_PER_SECOND


def too_fast(image: Image, number: int, volts: float = BATTERY_V, seconds: float = LOOKED_SECONDS) -> list[TooFast]:
    """The steps of a play from page `number` (along its next links) in which a joint must move faster than an unloaded servo can at this
    supply. The play begins in the pose of the page's first step, because the robot approaches it slowly."""
    limit, degrees_s = no_load_units_per_tick(volts, image.bits), float(degrees_per_unit(image.bits)) * TICKS_PER_SECOND
    found: dict[tuple[int, int], TooFast] = {}
    start = first_pose(image, number)
    ticks = play(image, number, start, int(seconds * TICKS_PER_SECOND))
    for place, step in groupby(ticks, lambda tick: (tick.page, tick.step)):
        goals = [start] + [tick.goals for tick in step if tick.goals is not None]
        window = min(WINDOW, len(goals) - 1)
        for before, after in zip(goals, goals[window:]):
            speed, joint = max((abs(after[j] - before[j]) / window, j) for j in range(JOINTS))
            if speed > limit and (place not in found or found[place].degrees_s < speed * degrees_s):
                found[place] = TooFast(*place, joint, speed * degrees_s)
        start = goals[-1]
    return list(found.values())


def looked(total: float, end: str) -> float:
    """How many seconds of a play too_fast() looks at: all of it, once more if it goes on for ever, but not more than LOOKED_SECONDS."""
    return min(total if end.startswith("ends") else 2 * total, LOOKED_SECONDS)
