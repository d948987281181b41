# SPDX-License-Identifier: MIT
"""The two laws of motion, for plots and play times: `classic` equal to the original sample by sample, `exact` ours.

An independent telling of the specification of the player; the firmware's player is in C. A play is a generator of
Ticks, one each 1/128 s. Only next and exit links are followed: there is no remote control here.

    speed          ________
                 /        \\          sections of a step: RISE (A ticks), CRUISE (N - 2A), FALL (A), HOLD (the pause)
       w -------/          \\
              RISE  CRUISE FALL HOLD
"""
from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

from m512.image import Image
from m512.page import JOINTS, SCHEDULE_TIME, Page, is_used

CLASSIC, EXACT = "classic", "exact"
NEUTRAL = 512


@dataclass
class Tick:
    """What one tick did. goals is None in a pause and in idle ticks: nothing is sent."""

    number: int
    page: int
    step: int                      # 1..7
    goals: Optional[List[int]]


@dataclass
class Step:
    """A step as the player meets it, `following` the one it looks ahead to (None: the play ends here)."""

    page: int
    number: int                    # 1..7
    data: Page
    first_of_page: bool = False

    def target(self, joint: int, before: int) -> int:
        word = self.data.word(self.number - 1, joint)
        return word if is_used(word) else before


class Walk:
    """The order of steps: pages, repetitions, links. `why` says what ended it when it was not the last link."""

    def __init__(self, image: Image, page: int):
        self.image, self.page = image, page
        self.step, self.left = 0, 0
        self.follow: Optional[int] = None    # page after this one, decided at the beginning of its last step
        self.stopping, self.ended, self.why = False, False, ""
        self.exits: Dict[int, None] = {}
        self._enter(page)

    def _enter(self, number: int) -> None:
        """Begins a page; those with PLAY_COUNT 0 are passed over along their link."""
        seen = set()
        while True:
            if number == 0 or number in seen:
                self.ended = True
                return
            page = self.image[number]
            fault = page.fault_text(self.image.kind)
            if fault or page.steps == 0:
                self.ended, self.why = True, f"page {number} " + (f"is damaged: {fault}" if fault else "has no steps")
                return
            if page.repeat:
                self.page, self.step, self.left = number, 0, page.repeat
                return
            seen.add(number)
            number = self._link(page)

    def _link(self, page: Page) -> int:
        target = page.exit if self.stopping else page.next
        if self.stopping and target in self.exits:
            self.why = f"the exit links come back to page {target}"
            return 0
        if self.stopping and target:
            self.exits[target] = None
        return target if self.image.first <= target < self.image.end else 0

    def advance(self) -> Optional[Tuple[Step, Optional[Step]]]:
        """The next step and the one to look ahead to; None at the end."""
        if self.ended:
            return None
        page = self.image[self.page]
        if self.step == page.steps:
            if self.follow != self.page or not self.left:
                self._enter(self.follow or 0)
                if self.ended:
                    return None
            self.step = 0
            page = self.image[self.page]
        self.step += 1
        here = Step(self.page, self.step, page, self.step == 1)
        if self.step < page.steps:
            return here, Step(self.page, self.step + 1, page)
        self.left = 0 if self.stopping else (self.left - 1) & 0xFF
        self.follow = self.page if self.left else self._link(page)
        if not self.follow:
            return here, None
        return here, Step(self.follow, 1, self.image[self.follow], True)


def play(image: Image, page: int, law: str = EXACT, pose: Optional[Sequence[int]] = None,
         limit: int = 128 * 60, stop_at: Optional[int] = None) -> Iterator[Tick]:
    """The ticks of a play that starts with `page`, at most `limit` of them. `pose`: where the joints stand."""
    walk = Walk(image, page)
    machine = (Classic if law == CLASSIC else Exact)(walk, list(pose or [NEUTRAL] * JOINTS))
    for number in range(limit):
        if number == stop_at:
            walk.stopping = True
        goals = machine.tick()
        if machine.ended:
            return
        yield Tick(number, machine.here.page, machine.here.number, goals)


# Classic: integers of the original's widths

def int16(value: int) -> int:
    return ((value + 0x8000) & 0xFFFF) - 0x8000


def divide(a: int, b: int) -> int:
    """Truncates toward zero."""
    quotient = abs(a) // abs(b)
    return quotient if (a < 0) == (b < 0) else -quotient


RISE, CRUISE, FALL, HOLD = range(4)


@dataclass
class ClassicJoint:
    out: int
    target: int
    start: int = 0
    move: int = 0        # M
    before: int = 0      # w: the carried speed
    speed: int = 0       # v
    goal_speed: int = 0  # g
    risen: int = 0       # acc
    main: int = 0
    through: bool = False


class Classic:
    def __init__(self, walk: Walk, pose: List[int]):
        self.walk, self.ended, self.over = walk, False, False
        self.joints = [ClassicJoint(p, p) for p in pose]
        self.section, self.count, self.num = HOLD, 0, 0
        self.here: Step = None  # type: ignore[assignment]
        self.length = self.ramp = self.pause = 0   # N, A, P

    def tick(self) -> Optional[List[int]]:
        if self.over:
            self.ended = True
            return None
        if self.count == self.num:
            self._next_section()
        if self.num == 0:
            return None
        self.count += 1
        if self.section == HOLD:
            return None
        for joint in self.joints:
            joint.out = min(max(joint.start + self._offset(joint), 0), 1023)
        return [joint.out for joint in self.joints]

    def _offset(self, joint: ClassicJoint) -> int:
        c, a = self.count, self.ramp
        if self.section == CRUISE or (self.section == FALL and joint.through):
            joint.goal_speed = joint.speed
            return int16(divide(joint.main * c, self.num))
        change = int16(divide((joint.speed - joint.before if self.section == RISE else -joint.before) * c, a))
        joint.goal_speed = joint.before + change
        way = int16(divide((joint.before + (change >> 1)) * c * 144, 15) >> 9)
        if self.section == RISE:
            joint.risen = way
        return way

    def _next_section(self) -> None:
        for joint in self.joints:
            joint.start, joint.before = joint.out, joint.goal_speed
        self.count = 0
        if self.here is None or self.section == HOLD:
            for joint in self.joints:
                joint.before = joint.goal_speed = 0
            self._begin_step()
        elif self.section == RISE:
            self.section, self.num = CRUISE, self.length - 2 * self.ramp
            for joint in self.joints:
                joint.main = self._main(joint)
        elif self.section == CRUISE:
            self.section, self.num = FALL, self.ramp
            for joint in self.joints:
                joint.main = int16(joint.move - joint.main - joint.risen)
        elif self.pause:
            self.section, self.num = HOLD, self.pause
        else:
            self._begin_step()

    def _main(self, joint: ClassicJoint) -> int:
        n, a = self.length, self.ramp
        if joint.through:
            return int16(divide((joint.move - joint.risen) * (n - 2 * a), n - a)) if n != a else 0
        return int16(joint.move - joint.risen - int16(divide(joint.speed * a * 12, 5) >> 8))

    def _begin_step(self) -> None:
        following = self.walk.advance()
        if following is None:
            # The original finds out too late: the first tick of a RISE still goes out, with the speed of the last step
            # and the length of its last section, up to 8 units off the target.
            self.over, self.section, self.ramp = True, RISE, self.num
            return
        self.here, ahead = following
        for joint in self.joints:
            joint.start = joint.out = joint.target
        page, k = self.here.data, self.here.number - 1
        self.pause = divide(page.pause(k) << 5, page.speed)
        unit = max((page.time(k) * page.speed & 0xFFFF) >> 5, 1)
        for i, joint in enumerate(self.joints):
            self._aim(i, joint, ahead)
        longest = max(abs(joint.move) for joint in self.joints)
        self.length = unit if page.schedule == SCHEDULE_TIME else (40 * longest // (3 * unit)) & 0xFFFF
        self.ramp = page.accel
        if self.length <= 2 * self.ramp:
            self.ramp = (self.length - 1) >> 1 if self.length else 0
            if self.ramp == 0:
                self.length = 0
        for joint in self.joints:
            joint.speed = self._speed(joint)
        self.section, self.num = RISE, self.ramp

    def _aim(self, i: int, joint: ClassicJoint, ahead: Optional[Step]) -> None:
        before, now = joint.start, self.here.target(i, joint.target)
        after = ahead.target(i, now) if ahead else now
        joint.target, joint.move, joint.risen = now, now - before, 0
        turns = not (before < now < after or before > now > after)
        joint.through = not turns and self.pause == 0 and ahead is not None

    def _speed(self, joint: ClassicJoint) -> int:
        n, a = self.length, self.ramp
        way = divide(joint.move * 2560, 12) - joint.before * 2 * a
        by = 4 * n - 2 * a if joint.through else 4 * (n - a)
        return min(max(int16(divide(way, by or 1)), -1023), 1023)


# Exact

class Exact:
    def __init__(self, walk: Walk, pose: List[int]):
        self.walk, self.ended = walk, False
        self.target, self.start, self.move = list(pose), list(pose), [0] * JOINTS
        self.before, self.after = [Fraction(0)] * JOINTS, [Fraction(0)] * JOINTS   # speeds at the way-points
        self.here: Step = None  # type: ignore[assignment]
        self.carry = Fraction(0)
        self.count = self.length = self.ramp = self.hold = 0

    def tick(self) -> Optional[List[int]]:
        if self.count == self.length + self.hold:
            self._begin_step()
            if self.ended:
                return None
        self.count += 1
        if self.count > self.length:
            return None
        return [self._at(joint) for joint in range(JOINTS)]

    def _begin_step(self) -> None:
        following = self.walk.advance()
        if following is None:
            self.ended = True
            return
        self.here, ahead = following
        self.start, self.before, self.count = list(self.target), self.after, 0
        self.target = [self.here.target(j, self.start[j]) for j in range(JOINTS)]
        self.move = [b - a for a, b in zip(self.start, self.target)]
        pause = pause_ticks(self.here)
        ideal = step_ticks(self.here, self.move)
        self.length = self._whole(ideal, 1)
        self.hold = self._whole(pause, 0)
        self.ramp = min(self.here.data.accel, self.length // 2)
        self.after = self._way_point(ahead, bool(pause))

    def _whole(self, ideal: Fraction, least: int) -> int:
        """Whole ticks; what is left is carried on, so that a page takes the time it should."""
        self.carry += ideal
        ticks = max(int(self.carry), least)
        self.carry -= ticks
        return ticks

    def _way_point(self, ahead: Optional[Step], pause: bool) -> List[Fraction]:
        if ahead is None or pause:
            return [Fraction(0)] * JOINTS
        onward = [ahead.target(j, self.target[j]) - self.target[j] for j in range(JOINTS)]
        ticks = max(step_ticks(ahead, onward), Fraction(1))
        out = []
        for move, go in zip(self.move, onward):
            here, there = Fraction(move, self.length), go / ticks
            out.append(min(here, there, key=abs) if move * go > 0 else Fraction(0))
        return out

    def _at(self, joint: int) -> int:
        c, n, a = self.count, self.length, self.ramp
        move, w0, w1 = self.move[joint], self.before[joint], self.after[joint]
        if c == n or move == 0:
            return self.target[joint]
        if a == 0:
            way = Fraction(move * c, n)
        else:
            v = (move - (w0 + w1) * a / 2) / (n - a)
            if c <= a:
                way = w0 * c + (v - w0) * c * c / (2 * a)
            elif c <= n - a:
                way = (w0 + v) * a / 2 + v * (c - a)
            else:
                left = n - c
                way = move - (w1 * left + (v - w1) * left * left / (2 * a))
        whole = int(abs(way) + Fraction(1, 2))
        return self.start[joint] + (whole if way >= 0 else -whole)


def step_ticks(step: Step, move: Sequence[int]) -> Fraction:
    """The ideal length of a step in ticks."""
    page, time = step.data, step.data.time(step.number - 1)
    if page.schedule == SCHEDULE_TIME:
        return Fraction(time * page.speed, 32)
    return Fraction(40 * 32 * max(map(abs, move)), 3 * max(time, 1) * page.speed)


def pause_ticks(step: Step) -> Fraction:
    page, pause = step.data, step.data.pause(step.number - 1)
    return Fraction(pause * page.speed, 32) if page.schedule == SCHEDULE_TIME else Fraction(pause * 32, page.speed)


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


def end_pose_before(image: Image, number: int) -> List[int]:
    """Where the joints stand when page `number` begins: as the page that leads to it leaves them; for a page that
    repeats or follows itself as it leaves them itself; else in the middle."""
    page, pose = image[number], [NEUTRAL] * JOINTS
    leads = [p for n, p in image.items() if n and n != number and p.next == number and p.is_playable and not p.fault(image.kind)]
    source = leads[0] if leads else page if page.repeat > 1 or page.next == number else None
    if source is None or source.fault(image.kind):
        return pose
    for step in range(source.steps):
        pose = [Step(0, step + 1, source).target(j, pose[j]) for j in range(JOINTS)]
    return [min(p, 1023) for p in pose]
