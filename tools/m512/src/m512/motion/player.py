# SPDX-License-Identifier: MIT
"""Plays pages by either law, for plots and play times.

Models of the specification of the player; the firmware's player is in C. A play is a generator of
Ticks, one each 1/128 s. Only next and exit links are followed: there is no remote control here.
"""
from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Iterator, List, Optional, Sequence

from m512.files.image import Image
from m512.files.page import JOINTS, PAGE_BYTES, Page
from m512.motion.law_classic import STOP, ClassicPlay
from m512.motion.law_exact import Exact
from m512.motion.walk import Step, Walk, pause_ticks, step_ticks

CLASSIC, EXACT = "classic", "exact"
NEUTRAL = 512


@dataclass
class Tick:
    """What one tick did. goals is None in a pause and in idle ticks: nothing is sent."""

    number: int
    page: int
    step: int                      # 1..7
    goals: Optional[List[int]]


def play(image: Image, page: int, law: str = EXACT, pose: Optional[Sequence[int]] = None,
         limit: int = 128 * 60, stop_at: Optional[int] = None) -> Iterator[Tick]:
    """The ticks of a play that starts with `page`, at most `limit` of them. `pose`: where the joints stand."""
    stand = list(pose or [NEUTRAL] * JOINTS)
    return (_play_classic if law == CLASSIC else _play_exact)(image, page, stand, limit, stop_at)


def _play_exact(image: Image, page: int, pose: List[int], limit: int, stop_at: Optional[int]) -> Iterator[Tick]:
    walk = Walk(image, page)
    law = Exact(walk, pose)
    for number in range(limit):
        if number == stop_at:
            walk.stopping = True
        goals = law.tick()
        if law.ended:
            return
        yield Tick(number, law.here.page, law.here.number, goals)


def _play_classic(image: Image, page: int, pose: List[int], limit: int, stop_at: Optional[int]) -> Iterator[Tick]:
    pages = bytes(image.first * PAGE_BYTES) + image.to_bytes()
    codes = {} if stop_at is None else {stop_at: STOP}
    law = ClassicPlay(pages, page, (1 << JOINTS) - 1, dict(enumerate(pose)), codes)
    for number, goals in enumerate(law.ticks(limit)):
        if law.ended and goals is None:
            return
        yield Tick(number, law.page.number, min(law.step, law.page.steps), list(goals) if goals else None)


def page_seconds(page: Page, start: Optional[Sequence[int]] = None) -> float:
    """Ideal play time of one repetition. `start`: the pose before it; without one a page in speed base is taken to begin
    where it ends, as pages that are repeated do."""
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
        total += max(step_ticks(step, [b - a for a, b in zip(pose, after)]), Fraction(1)) + pause_ticks(step)
        pose = after
    return float(total / 128)


def pose_before(image: Image, number: int) -> List[int]:
    """Where the joints stand when page `number` begins: as the page that leads to it leaves them; for a page that
    repeats or follows itself as it leaves them itself; else in its first step, where the board's approach brings them."""
    page, pose = image[number], [NEUTRAL] * JOINTS
    leads = [p for n, p in image.items() if n and n != number and p.next == number and p.is_playable and not p.fault(image.kind)]
    itself = page.repeat > 1 or page.next == number
    source, steps = (leads[0], leads[0].steps) if leads else (page, page.steps if itself else 1)
    if source.fault(image.kind):
        return pose
    for step in range(min(steps, source.steps)):
        pose = [Step(0, step + 1, source).target(j, pose[j]) for j in range(JOINTS)]
    return [min(p, 1023) for p in pose]
