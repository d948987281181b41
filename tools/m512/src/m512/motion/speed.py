# SPDX-License-Identifier: MIT
"""Finds where a motion asks for more speed than a servo has.

An AX-12 turns at 59 rpm without load at 12 V (data sheet), and proportionally slower at a lower supply. It does not reach goals that move
faster: the joint lags, and the motion differs from the intended one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from m512.files.image import Image
from m512.files.page import JOINTS
from m512.motion.player import play

NO_LOAD_RPM, SHEET_V = 59.0, 12.0
BATTERY_V = 9.6  # a CM-5's pack: 8 cells of 1.2 V
DEGREES_PER_UNIT = 300 / 1024
TICKS_PER_SECOND = 128
WINDOW = 4  # ticks over which the speed is measured, because goals are integers


@dataclass
class TooFast:
    """The fastest joint in a step that asks for too much speed."""

    page: int
    step: int  # 1..7
    joint: int
    degrees_s: float


def no_load_degrees_s(volts: float) -> float:
    return NO_LOAD_RPM * 6 * volts / SHEET_V


def no_load_units_per_tick(volts: float) -> float:
    return no_load_degrees_s(volts) / DEGREES_PER_UNIT / TICKS_PER_SECOND


def too_fast(image: Image, number: int, volts: float = BATTERY_V, pose: Sequence[int] | None = None, seconds: float = 60) -> list[TooFast]:
    """The steps of a play from page `number` (along its next links) in which a joint must move faster than an unloaded servo can at this
    supply. `pose`: the initial pose; by default that of the page's first step, because the robot approaches it slowly."""
    limit = no_load_units_per_tick(volts)
    found: dict[tuple[int, int], TooFast] = {}
    recent: deque[list[int]] = deque(maxlen=WINDOW + 1)
    for tick in play(image, number, pose or _first_pose(image, number), int(seconds * TICKS_PER_SECOND)):
        if tick.goals is None:
            continue
        recent.append(tick.goals)
        speed, joint = max((abs(tick.goals[j] - recent[0][j]) / WINDOW, j) for j in range(JOINTS))
        if len(recent) > WINDOW and speed > limit:
            place = tick.page, tick.step
            if place not in found or found[place].degrees_s < speed * DEGREES_PER_UNIT * TICKS_PER_SECOND:
                found[place] = TooFast(*place, joint, speed * DEGREES_PER_UNIT * TICKS_PER_SECOND)
    return list(found.values())


def _first_pose(image: Image, number: int) -> list[int]:
    page = image[number]
    return [page.word(0, joint) if page.steps and page.word(0, joint) <= 1023 else 512 for joint in range(JOINTS)]
