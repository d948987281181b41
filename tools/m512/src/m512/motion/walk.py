# SPDX-License-Identifier: MIT
"""The order of steps in a play: pages, repetitions, next links. Independent of the law of motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from m512.files.image import Image
from m512.files.page import SCHEDULE_TIME, Page, is_used

LONGEST_TICKS = 32_767  # of a step, which the firmware cuts to that (motion/step_ticks.h)


@dataclass
class Step:
    """One step of a play."""

    page: int
    number: int  # 1..7
    data: Page

    def target(self, joint: int, before: int) -> int:
        word = self.data.word(self.number - 1, joint)
        return word if is_used(word) else before


class Walk:
    """The order of steps: pages, repetitions, next links."""

    def __init__(self, image: Image, page: int):
        self.image, self.page = image, page
        self.step, self.left = 0, 0
        self.follow: int | None = None  # the page after this one; set at the beginning of the last step
        self.ended = False
        self._enter(page)

    def _enter(self, number: int) -> None:
        """Begins a page. Pages with PLAY_COUNT 0 are skipped along their link."""
        seen = set()
        while number and number not in seen:
            page = self.image[number]
            if page.fault(self.image.kind) or page.steps == 0:
                break
            if page.repeat:
                self.page, self.step, self.left = number, 0, page.repeat
                return
            seen.add(number)
            number = self._link(page)
        self.ended = True

    def _link(self, page: Page) -> int:
        return page.next if self.image.first <= page.next < self.image.end else 0

    def advance(self) -> tuple[Step, Step | None] | None:
        """(the next step, the step to look ahead to), or None at the end."""
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
        here = Step(self.page, self.step, page)
        if self.step < page.steps:
            return here, Step(self.page, self.step + 1, page)
        self.left -= 1
        self.follow = self.page if self.left else self._link(page)
        if not self.follow:
            return here, None
        return here, Step(self.follow, 1, self.image[self.follow])


def degrees_per_unit(bits: int) -> Fraction:
    """Of positions of 10 bits (AX-12) or 12 bits."""
    return Fraction(300, 1024) if bits == 10 else Fraction(360, 4096)


def step_ticks(step: Step, move: Sequence[int], bits: int = 10) -> Fraction:
    """The ideal length of a step in ticks. In speed base 256 means 720 degrees/s."""
    page, time = step.data, step.data.time(step.number - 1)
    if page.schedule == SCHEDULE_TIME:
        return Fraction(time * page.speed, 32)
    degrees = max(map(abs, move)) * degrees_per_unit(bits)
    return min(degrees / 720 * Fraction(256, max(time, 1)) * Fraction(32, page.speed) * 128, Fraction(LONGEST_TICKS))


def pause_ticks(step: Step) -> Fraction:
    page, pause = step.data, step.data.pause(step.number - 1)
    return Fraction(pause * page.speed, 32) if page.schedule == SCHEDULE_TIME else Fraction(pause * 32, page.speed)
