# SPDX-License-Identifier: MIT
"""Two motions on one body: some joints do one, the others another, whatever their lengths.

Each motion is a page and what it links to. Its way-points stand on a time line, in ticks from the start; the merged motion
has a way-point wherever one of the two has one, at exactly that tick. A joint that is under way there gets the position on
its straight line, rounded. What ends first holds its last pose, or goes round again if it leads back to itself.

    base     |------------|------|------------|          way-points of the legs
    other    |----|-----------|                          ... of the arms
    merged   |----|-------|---|--|------------|          steps of both
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction

from m512.errors import RefusedError
from m512.files.image import Image, is_erased
from m512.files.page import JOINTS, POS_UNUSED, STEPS, Page, is_used
from m512.motion.walk import Step, pause_ticks, step_ticks
from m512.pages.operations import keep_trim, need_good

STEP_TICKS = 255
MOST_STEPS = 7 * 60
Point = tuple[int, int]  # (tick, position)


@dataclass
class Line:
    """A motion on its time line. `points` of each joint, ascending; the first one at tick 0 is where it starts."""

    points: dict[int, list[Point]] = field(default_factory=dict)
    ticks: set[int] = field(default_factory=set)
    length: int = 0
    loops: bool = False

    def at(self, joint: int, tick: int) -> int | None:
        """Where the joint is; None: this motion does not drive it."""
        points = self.points.get(joint)
        if not points:
            return None
        if self.loops and self.length:
            tick = (tick - 1) % self.length + 1 if tick else 0
        before = points[0]
        for point in points:
            if point[0] >= tick:
                span = point[0] - before[0]
                return _round(before[1] + Fraction((point[1] - before[1]) * (tick - before[0]), span)) if span else point[1]
            before = point
        return before[1]

    def ticks_until(self, end: int) -> set[int]:
        if not self.loops or not self.length:
            return {tick for tick in self.ticks if tick <= end}
        return {tick + lap for lap in range(0, end, self.length) for tick in self.ticks if tick + lap <= end}


def _tick(value: Fraction) -> int:
    """The whole tick at which the exact law is done with what is due by then."""
    return int(value)


def _round(value: Fraction) -> int:
    return int(value + Fraction(1, 2))


def line_of(image: Image, number: int, joints: Iterable[int]) -> Line:
    """A page and what follows it, once; the robot is taken to stand in the first step's pose, to which a play leads it."""
    out, now, seen, chosen = Line(), Fraction(0), set(), list(joints)
    pose: dict[int, int] = {}
    while number and number not in seen:
        page = need_good(image, number)
        seen.add(number)
        for step in [Step(number, k + 1, page) for k in range(page.steps)] * page.repeat:
            if len(out.ticks) > MOST_STEPS:
                raise RefusedError(f"page {number}: this motion is longer than {MOST_STEPS} steps")
            goals = {joint: page.word(step.number - 1, joint) for joint in chosen if is_used(page.word(step.number - 1, joint))}
            moves = [
                step.target(joint, pose.get(joint, step.target(joint, 512))) - pose.get(joint, step.target(joint, 512)) for joint in range(JOINTS)
            ]
            begin, now = now, now + max(step_ticks(step, moves), Fraction(1))
            for joint, goal in goals.items():
                points = out.points.setdefault(joint, [(0, goal)])
                points += [(_tick(begin), points[-1][1]), (_tick(now), goal)]
            pose.update({joint: step.target(joint, pose.get(joint, 512)) for joint in range(JOINTS)})
            out.ticks.add(_tick(now))
            now += pause_ticks(step)
            out.ticks.add(_tick(now))
        number = page.next
    out.length, out.loops = _tick(now), bool(number) and number in seen
    if not out.length:
        raise RefusedError("a motion without steps cannot be merged")
    return out


def combine(image: Image, base: int, other_image: Image, other: int, joints: Iterable[int], target: int, replace: bool = False) -> list[str]:
    """From page `target` on: the motion of page `base`, with `joints` doing that of page `other` (of another image, or the
    same). Returns remarks. What `base` leads back to is gone on with when `other` is over."""
    if image.bits != other_image.bits:
        raise RefusedError(f"the sources have {image.bits} and {other_image.bits} bits: scale one of them first (convert --scale)")
    for number in (base, other):
        keep_trim(number, target)
    taken = set(joints)
    below = line_of(image, base, set(range(JOINTS)) - taken)
    above = line_of(other_image, other, taken)
    total = max(below.length, above.length)
    if below.loops:
        laps = 1 if above.loops else -(-above.length // below.length)
        total = laps * below.length
    steps = _steps(below, above, taken, total)
    pages = _pages(image, image[base], other_image[other], taken, steps, target, replace or target == base)
    last = pages[-1][1]
    if below.loops:
        last.next = pages[0][0] if above.loops or above.length == below.length else base
    for number, page in pages:
        image[number] = page.seal()
    return _remarks(image, pages, below, above, total)


def _steps(below: Line, above: Line, taken: set[int], total: int) -> list[tuple[int, int, dict[int, int]]]:
    """[(ticks, pause, {joint: position})]."""
    ticks = sorted((below.ticks_until(total) | above.ticks_until(total) | {total}) - {0})
    out: list[tuple[int, int, dict[int, int]]] = []
    before = 0
    for tick in ticks:
        pieces = -(-(tick - before) // STEP_TICKS)
        for piece in range(1, pieces + 1):
            here = before + (tick - before) * piece // pieces
            last = before + (tick - before) * (piece - 1) // pieces
            pose = {}
            for joint in range(JOINTS):
                at = (above if joint in taken else below).at(joint, here)
                if at is not None:
                    pose[joint] = at
            if out and out[-1][2] == pose and out[-1][1] + here - last <= STEP_TICKS:
                out[-1] = (out[-1][0], out[-1][1] + here - last, pose)
            else:
                out.append((here - last, 0, pose))
        before = tick
    return out


def _pages(
    image: Image, base: Page, other: Page, taken: set[int], steps: list[tuple[int, int, dict[int, int]]], target: int, replace: bool
) -> list[tuple[int, Page]]:
    """The steps on pages that follow each other: `target` and free ones behind it."""
    count = -(-len(steps) // STEPS)
    free = [n for n in range(target + 1, image.end) if image[n].is_empty or is_erased(image[n])]
    if not image[target].is_empty and not is_erased(image[target]) and not replace:
        raise RefusedError(f'page {target} "{image[target].title}" is not empty (--replace overwrites it)')
    if len(free) < count - 1:
        raise RefusedError(f"{len(steps)} steps need {count} pages; behind page {target} only {len(free)} are free")
    numbers = [target, *free[: count - 1]]
    out = []
    for k, number in enumerate(numbers):
        page = Page()
        page.name = base.name[:13] if k == 0 else base.name[:11] + str(k + 1).encode()
        page.accel, page.exit, page.byte63, page.code = base.accel, base.exit, base.byte63, base.code if k == 0 else 0
        for joint in range(JOINTS):
            page.set_compliance(joint, (other if joint in taken else base).compliance(joint))
        chunk = steps[k * STEPS : (k + 1) * STEPS]
        page.steps = len(chunk)
        for at, (ticks, pause, pose) in enumerate(chunk):
            page.set_time(at, ticks)
            page.set_pause(at, pause)
            for joint in range(JOINTS):
                page.set_word(at, joint, pose.get(joint, POS_UNUSED))
        page.next = numbers[k + 1] if k + 1 < count else 0
        out.append((number, page))
    return out


def _remarks(image: Image, pages: list[tuple[int, Page]], below: Line, above: Line, total: int) -> list[str]:
    out = []
    count = sum(page.steps for _, page in pages)
    if len(pages) > 1:
        out.append(f"page {pages[0][0]} has {count} steps: continued in " + ", ".join(str(number) for number, _ in pages[1:]))
    for line, what in ((below, "the base"), (above, "the other")):
        if line.length < total and not line.loops:
            out.append(f"{what} ends after {line.length / 128:.3f} s of {total / 128:.3f} s and holds its last pose")
        elif line.loops and total % line.length:
            out.append(f"{what} is cut in its round at {total / 128:.3f} s (a round takes {line.length / 128:.3f} s)")
    after = pages[-1][1].next
    if after:
        out.append(f"page {pages[-1][0]} goes on with page {after}" + (f' "{image[after].title}"' if image[after].name else ""))
    return out
