# SPDX-License-Identifier: MIT
"""The classic law: the original's motion, sample by sample, in integers of its widths. Source: the specification of the
player, section 1; the names are its letters where it has some.

    speed          ________
                 /        \\          sections of a step: RISE (A ticks), CRUISE (N - 2A), FALL (A), HOLD (the pause)
       w -------/          \\
              RISE  CRUISE FALL HOLD
"""
from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional

from m512.files.page import SCHEDULE_TIME
from m512.motion.walk import Step, Walk


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
