# SPDX-License-Identifier: MIT
"""What blend, amplitude, clamp, rate and limit do to a step: a model of the specification page "Shaping a motion while it plays".

Written from that page alone, without reading motion/. All values are exact (fractions) up to the one place where the page rounds. Speeds
are in servo units per tick, lengths in ticks. READING marks a sentence that can be read in two ways; README.md lists them.
"""

import math
from dataclasses import dataclass, field
from fractions import Fraction

from tests.models.classic_law import FLAGGED, JOINTS, LAST_PAGE, TIME_BASE, Page

UNITS_PER_DEGREE = Fraction(1024, 300)
TICKS_PER_S = 128
NO_LOAD_DEGREES_PER_S = 59 * 6  # an AX-12 at 12 V: 59 rpm
PARTNER_RIGHT, PARTNER_LEFT = 17, 18  # bytes of the page's header


@dataclass
class Shape:
    """The values in force. blend: -100..100 %, right is positive. amplitude: {joint: 0..150 %}, 100 if not given. rate: 10..400 %."""

    blend: int = 0
    amplitude: dict = field(default_factory=dict)
    rate: int = 100
    centre_page: int = 1
    volts: Fraction = Fraction(12)

    def is_set(self):
        """READING 8: a value without effect in this page (a blend without a partner) counts as set."""
        return self.blend != 0 or self.rate != 100 or any(percent != 100 for percent in self.amplitude.values())


def used(word):
    return not word & FLAGGED


def rounded(displacement):
    """Rounds to the nearest integer, halves away from zero: a mirrored displacement gives the mirrored result. READING 9."""
    return int(math.copysign(math.floor(abs(displacement) + Fraction(1, 2)), displacement))


def exact_position(p, q, c, blend, amplitude):
    """Returns p2 as a fraction: p1 = p + W (q - p), p2 = c + A (p1 - c). q None: not blended. c None: not scaled. blend and amplitude in
    percent."""
    p1 = Fraction(p) if q is None else p + Fraction(abs(blend), 100) * (q - p)
    return p1 if c is None else c + Fraction(amplitude, 100) * (p1 - c)


def shaped_position(p, q, c, blend, amplitude):
    """Returns the planned position 0..1023. It is rounded once, as a displacement from c (from p if nothing is scaled). READING 9."""
    anchor = p if c is None else c
    return max(0, min(1023, anchor + rounded(exact_position(p, q, c, blend, amplitude) - anchor)))


def partner(image, page, blend):
    """Returns the page to blend in. None if byte 17 or 18 is 0 or above 127, or the page is refused or has another number of steps."""
    number = page.raw[PARTNER_RIGHT if blend > 0 else PARTNER_LEFT]
    if blend == 0 or not 0 < number <= LAST_PAGE:
        return None
    other = Page(image, number)
    return None if other.refused() or other.steps != page.steps else other


def centre(image, shape, joint):
    """Returns the joint's position in the centre pose. None if that pose does not use the joint, or the page cannot be played."""
    page = Page(image, shape.centre_page)
    return None if page.refused() or not used(page.word(1, joint)) else page.word(1, joint)


def shaped_pose(image, number, step, shape):
    """Returns {joint: position} of the joints that the step uses. Steps count from 1."""
    page = Page(image, number)
    other = partner(image, page, shape.blend)
    pose = {}
    for joint in range(JOINTS):
        p = page.word(step, joint)
        if not used(p):
            continue
        q = None if other is None or not used(other.word(step, joint)) else other.word(step, joint)
        pose[joint] = shaped_position(p, q, centre(image, shape, joint), shape.blend, shape.amplitude.get(joint, 100))
    return pose


def top_speed(volts):
    """Returns the servo's top speed in units per tick: 9.44 at 12 V, proportional to the supply."""
    return NO_LOAD_DEGREES_PER_S * UNITS_PER_DEGREE / TICKS_PER_S * Fraction(volts) / 12


def ideal_step(page, step, longest, shape, after_shaped=False):
    """Returns the ideal length of a step in ticks: the exact law's length, divided by the rate, stretched by the limit. longest: the
    largest |M| of the shaped step, from the (also shaped) targets before it. READING 10: the limit applies to the mean speed |M| / N.
    after_shaped: the step before it is shaped."""
    if page.schedule == TIME_BASE:
        length = Fraction(page.time(step) * page.speed, 32)
    else:
        length = Fraction(40 * longest * 32, 3 * max(1, page.time(step) * page.speed))
    length = length * 100 / shape.rate
    if shape.is_set() or after_shaped:
        length = max(length, longest / (Fraction(9, 10) * top_speed(shape.volts)))
    return length


def ideal_pause(page, step, shape):
    """Returns the ideal length in ticks of the pause after a step."""
    pause = page.pause(step)
    nominal = Fraction(pause * page.speed, 32) if page.schedule == TIME_BASE else Fraction(pause * 32, page.speed)
    return nominal * 100 / shape.rate
