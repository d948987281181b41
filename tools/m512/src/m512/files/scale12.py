# SPDX-License-Identifier: MIT
"""Positions between 10 bits (1024 = 300 degrees) and 12 bits (4096 = 360 degrees), about the centre.

One 12-bit unit is exactly 0.3 10-bit units. What does not fit is cut and reported; what rounding costs is reported.
"""
from __future__ import annotations

from fractions import Fraction
from typing import Iterable, List, Tuple

from m512.files.image import Image
from m512.files.page import JOINTS, POS_UNUSED, STEPS, Fault, Page, is_used

SHOWN = 4   # cut positions told one by one, per page


def scaled(image: Image, bits: int) -> Tuple[Image, List[str]]:
    """A copy of `image` with `bits` (10 or 12), and the report. Pages with a wrong checksum stay as they are."""
    out = Image([page.copy() for page in image.pages], image.first, bits, list(image.notes))
    report, worst, count = [], Fraction(0), 0
    for number, page in out.items():
        if page.fault() is Fault.CHECKSUM:
            report.append(f"page {number} has a wrong checksum: not scaled")
            continue
        cut, impossible, error, changed = _scale_page(page, bits)
        worst, count = max(worst, error), count + changed
        if cut:
            more = f" and {len(cut) - SHOWN} more" if len(cut) > SHOWN else ""
            report.append(f"page {number}: {len(cut)} positions cut at the end of the range: {', '.join(cut[:SHOWN])}{more}")
        if impossible:
            report.append(f"page {number}: {impossible} positions were no {image.bits}-bit positions and are now unused")
        page.seal()
    head = [f"{count} positions scaled from {image.bits} to {bits} bits; rounding moved none by more than "
            f"{float(worst):.2g} units"]
    return out, head + report if count else report


def _scale_page(page: Page, bits: int) -> Tuple[List[str], int, Fraction, int]:
    factor = Fraction(3, 10) if bits == 10 else Fraction(10, 3)
    top_in, centre_in, centre, top = (4095, 2048, 512, 1023) if bits == 10 else (1023, 512, 2048, 4095)
    cut: List[str] = []
    impossible, worst, changed = 0, Fraction(0), 0
    for step in range(min(page.steps, STEPS)):
        for joint in range(JOINTS):
            word = page.word(step, joint)
            if not is_used(word):
                continue
            if word > top_in:
                page.set_word(step, joint, POS_UNUSED)
                impossible += 1
                continue
            exact = factor * (word - centre_in)
            value = centre + round_away(exact)
            fitting = min(max(value, 0), top)
            if value != fitting:
                cut.append(f"step {step} ID {joint} ({word} would be {value})")
            else:
                worst = max(worst, abs(value - centre - exact))
            page.set_word(step, joint, fitting)
            changed += 1
    return cut, impossible, worst, changed


def round_away(value: Fraction) -> int:
    """To the nearest whole number, halves away from zero: the same on both sides of the centre."""
    whole = int(abs(value) + Fraction(1, 2))
    return whole if value >= 0 else -whole


def keep_joints(image: Image, joints: Iterable[int]) -> List[str]:
    """Sets all other joints unused, in place; says how many positions that drops. Pages with a wrong checksum stay."""
    kept, dropped = set(joints), {}
    for number, page in image.items():
        if page.fault() is Fault.CHECKSUM:
            continue
        for step in range(min(page.steps, STEPS)):
            for joint in set(range(JOINTS)) - kept:
                if is_used(page.word(step, joint)):
                    dropped[joint] = dropped.get(joint, 0) + 1
                    page.set_word(step, joint, POS_UNUSED)
        page.seal()
    return [f"{sum(dropped.values())} positions of joints left out (IDs " + " ".join(map(str, sorted(dropped))) + ")"] \
        if dropped else []
