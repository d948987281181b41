# SPDX-License-Identifier: MIT
"""The exact law: no overshoot at a way-point, no idle tick, every step ends on its target. The source is the specification of the
player, section 2. It computes in fractions, so that only the last rounding is inexact."""

from __future__ import annotations

from fractions import Fraction

from m512.files.page import JOINTS
from m512.motion.walk import Step, Walk, pause_ticks, step_ticks


class Exact:
    def __init__(self, walk: Walk, pose: list[int]):
        self.walk, self.ended = walk, False
        self.target, self.start, self.move = list(pose), list(pose), [0] * JOINTS
        self.before, self.after = [Fraction(0)] * JOINTS, [Fraction(0)] * JOINTS  # speeds at the way-points
        self.here: Step = None  # type: ignore[assignment]
        self.carry = Fraction(0)
        self.count = self.length = self.ramp = self.hold = 0

    def tick(self) -> list[int] | None:
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
        ideal = step_ticks(self.here, self.move, self.walk.image.bits)
        self.length = self._whole(ideal, 1)
        self.hold = self._whole(pause, 0)
        self.ramp = min(self.here.data.accel, self.length // 2)
        self.after = self._way_point(ahead, bool(pause))

    def _whole(self, ideal: Fraction, least: int) -> int:
        """Rounds down to integer ticks, at least `least`. The remainder is carried over, so that a page takes its exact time."""
        self.carry += ideal
        ticks = max(int(self.carry), least)
        self.carry -= ticks
        return ticks

    def _way_point(self, ahead: Step | None, pause: bool) -> list[Fraction]:
        if ahead is None or pause:
            return [Fraction(0)] * JOINTS
        onward = [ahead.target(j, self.target[j]) - self.target[j] for j in range(JOINTS)]
        ticks = max(step_ticks(ahead, onward, self.walk.image.bits), Fraction(1))
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
