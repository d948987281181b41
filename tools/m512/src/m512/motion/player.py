# SPDX-License-Identifier: MIT
"""Plays pages by the exact law, to compute play times and speeds.

This is a model of the law; the firmware's player is in C. A play is a generator of Ticks, one per 1/128 s. It follows only next links:
nobody presses a key or stops it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from m512.files.image import Image
from m512.files.page import JOINTS, Page, is_used
from m512.motion.law_exact import Exact
from m512.motion.walk import Step, Walk, pause_ticks, step_ticks

NEUTRAL = 512


@dataclass
class Tick:
    """The result of one tick. goals is None in a pause and in idle ticks: nothing is sent."""

    number: int
    page: int
    step: int  # 1..7
    goals: list[int] | None


def play(image: Image, page: int, pose: Sequence[int] | None = None, limit: int = 128 * 60) -> Iterator[Tick]:
    """The ticks of a play that starts with `page`, at most `limit` of them. `pose`: the initial pose."""
    law = Exact(Walk(image, page), list(pose or [NEUTRAL] * JOINTS))
    for number in range(limit):
        goals = law.tick()
        if law.ended:
            return
        yield Tick(number, law.here.page, law.here.number, goals)


def first_pose(image: Image, number: int) -> list[int]:
    """The pose in which a play of the page begins. Joints that its first step does not use are in the middle."""
    page = image[number]
    centre = (image.kind.pos_max + 1) // 2
    return [page.word(0, joint) if page.steps and is_used(page.word(0, joint)) else centre for joint in range(JOINTS)]


def page_seconds(page: Page, start: Sequence[int] | None = None, bits: int = 10) -> float:
    """Ideal play time of one repetition in seconds. `start`: the pose before it. Without it, a page in speed base is assumed to begin
    where it ends, like a repeated page."""
    if page.steps == 0 or page.speed == 0:
        return 0.0
    steps = [Step(0, k + 1, page) for k in range(min(page.steps, 7))]
    pose = list(start or [NEUTRAL] * JOINTS)
    if start is None:
        for step in steps:
            pose = [step.target(j, pose[j]) for j in range(JOINTS)]
    total = Fraction(0)
    for step in steps:
        after = [step.target(j, pose[j]) for j in range(JOINTS)]
        total += max(step_ticks(step, [b - a for a, b in zip(pose, after)], bits), Fraction(1)) + pause_ticks(step)
        pose = after
    return float(total / 128)
