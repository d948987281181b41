# SPDX-License-Identifier: MIT
"""Converts positions between 10 bits (1024 = 300 degrees) and 12 bits (4096 = 360 degrees), about the centre.

One 12-bit unit is exactly 0.3 10-bit units. Positions out of range are clipped and reported. The rounding error is reported too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from fractions import Fraction

from m512.errors import RefusedError
from m512.files.image import TWELVE_BIT_MAX, Image
from m512.files.page import JOINTS, POS_UNUSED, STEPS, Fault, Page, is_used
from m512.files.wording import counted, pages_text

SHOWN = 4  # clipped positions reported one by one
HINT = "m512 convert --bits 12 --scale 10 makes it fit a board of 10 bits"


def as_said(image: Image, bits: int | None) -> Image:
    """The image of a text, which states its own resolution. A note says that `bits` is another and has no effect."""
    if bits and bits != image.bits:
        image.notes.append(f"--bits {bits} has no effect on a text, which says its resolution itself; this one has {image.bits} bits")
    return image


def must_be_clear(image: Image, source: object) -> None:
    """RefusedError if an image was judged to have 10 bits and some positions have more: scaling would ruin one or the other."""
    high = {
        number: max(words)
        for number, page in image.items()
        if (words := [word for step in range(min(page.steps, STEPS)) for word in page.words(step) if 1023 < word <= TWELVE_BIT_MAX])
        and number
        and page.fault() is not Fault.CHECKSUM
    }
    if image.bits == 10 and high:
        raise RefusedError(
            f"{source}: most positions are within 10 bits, but not those in {pages_text(high)} (up to {max(high.values())}), so it is not "
            "clear what is to be scaled. Say --bits 12 if they are of 12 bits, or --bits 10 if those pages are damaged"
        )


def judged(image: Image, bits: int | None) -> Image:
    """The image, marked as 12-bit if `bits` is None and it looks like that: more than half of the positions used by pages with a good
    checksum are beyond 1023 (12-bit poses lie around 2048). Positions of 0 and beyond 4095 do not count: unused joints often hold them.
    A note reports it, also if `bits` is 10."""
    words = [
        (number, word)
        for number, page in image.items()
        if number and page.fault() is not Fault.CHECKSUM
        for step in range(min(page.steps, STEPS))
        for word in page.words(step)
        if 0 < word <= TWELVE_BIT_MAX and is_used(word)
    ]
    high = [(number, word) for number, word in words if word > 1023]
    if bits == 12 or 2 * len(high) <= len(words):
        return image
    image.bits = bits or 12
    image.notes.append(
        f"looks like 12 bit (positions up to {max(word for _, word in high)} in {pages_text(number for number, _ in high)}) and is "
        + ("read as 10 bit, as asked" if bits else "read so")
        + f"; {HINT}"
    )
    return image


def scaled(image: Image, bits: int) -> tuple[Image, list[str]]:
    """A copy of `image` with `bits` (10 or 12), and a report. Pages with other damage than impossible positions stay as they are."""
    out = Image([page.copy() for page in image.pages], image.first, bits, list(image.notes), form=image.form, given=image.given)
    work = _Work(bits)
    for number, page in out.items():
        if page.fault(image.kind) not in (Fault.OK, Fault.POSITION):
            work.damaged.append(number)
            continue
        if number == 0:
            work.scale_trim(page)
        else:
            work.scale_steps(number, page, range(min(page.steps, STEPS)))
        page.seal()
    return out, work.report(image.bits)


class _Work:
    """One scaling, with the data for its report."""

    def __init__(self, bits: int):
        self.bits = bits
        self.factor = Fraction(3, 10) if bits == 10 else Fraction(10, 3)
        self.top_in, self.centre_in, self.centre, self.top = (4095, 2048, 512, 1023) if bits == 10 else (1023, 512, 2048, 4095)
        self.count, self.trims, self.worst = 0, 0, Fraction(0)
        self.damaged: list[int] = []
        self.cut: list[tuple[int, int, str]] = []  # page, joint, in words
        self.impossible: list[tuple[int, int]] = []  # page, joint

    def scale_trim(self, page: Page) -> None:
        """Page 0: its poses and its trim. Where the trim is the difference of the first two poses, it stays so."""
        before, trims = page.copy(), page.trims()
        self.scale_steps(0, page, page.poses(0))
        for joint, trim in enumerate(trims):
            if trim:
                master, own = page.word(0, joint), page.word(1, joint)
                is_difference = is_used(master) and is_used(own) and trim == before.word(1, joint) - before.word(0, joint)
                page.set_trim(joint, own - master if is_difference else round_away(self.factor * trim))
                self.trims += 1

    def scale_steps(self, number: int, page: Page, steps: Iterable[int]) -> None:
        for step in steps:
            for joint in range(JOINTS):
                word = page.word(step, joint)
                if is_used(word) and word > self.top_in:
                    page.set_word(step, joint, POS_UNUSED)
                    self.impossible.append((number, joint))
                elif is_used(word):
                    page.set_word(step, joint, self._scale(word, number, step, joint))

    def _scale(self, word: int, number: int, step: int, joint: int) -> int:
        exact = self.factor * (word - self.centre_in)
        value = self.centre + round_away(exact)
        self.count += 1
        if not 0 <= value <= self.top:
            self.cut.append((number, joint, f"page {number} step {step + 1} ID {joint}: {word} would be {value}"))
            return min(max(value, 0), self.top)
        self.worst = max(self.worst, abs(value - self.centre - exact))
        return value

    def report(self, bits_before: int) -> list[str]:
        out = [f"{pages_text(self.damaged)}: damaged, not scaled"] if self.damaged else []
        if self.count:
            out.insert(
                0,
                f"{self.count} positions scaled from {bits_before} to {self.bits} bits; rounding moved none by more than "
                f"{float(self.worst):.2g} units",
            )
        if self.trims:
            out.append(f"{counted(self.trims, 'trim')} of page 0 scaled and rounded")
        if self.cut:
            out.append(
                f"{len(self.cut)} positions cut at the end of the range: IDs {_ids(joint for _, joint, _ in self.cut)} in "
                f"{pages_text(page for page, _, _ in self.cut)} ({'; '.join(text for _, _, text in self.cut[:SHOWN])}"
                + (f" and {len(self.cut) - SHOWN} more" if len(self.cut) > SHOWN else "")
                + "). --joints leaves out what the robot has not"
            )
        if self.impossible:
            out.append(
                f"{len(self.impossible)} positions were no {bits_before}-bit positions and are now unused: IDs "
                f"{_ids(joint for _, joint in self.impossible)} in {pages_text(page for page, _ in self.impossible)}"
            )
        return out


def _ids(joints: Iterable[int]) -> str:
    return " ".join(map(str, sorted(set(joints))))


def round_away(value: Fraction) -> int:
    """Rounds to the nearest integer, halves away from zero: symmetric about the centre."""
    whole = int(abs(value) + Fraction(1, 2))
    return whole if value >= 0 else -whole


def keep_joints(image: Image, joints: Iterable[int], scaled_later: bool = False) -> list[str]:
    """Sets all other joints unused, in place. Returns a line with what was dropped. Pages that are damaged without these
    joints, too, stay as they are; if they are `scaled_later`, which mends them, not those with impossible positions."""
    others = set(range(JOINTS)) - set(joints)
    dropped: Counter[int] = Counter()
    untrimmed: set[int] = set()
    for number, page in image.items():
        if page.fault(image.kind) not in (Fault.OK, Fault.POSITION):
            continue
        gone = [(step, joint) for step in page.poses(number) for joint in others if is_used(page.word(step, joint))]
        trims = {joint for joint, trim in enumerate(page.trims()) if trim and joint in others} if not number else set()
        rest = page.copy()
        for step, joint in gone:
            rest.set_word(step, joint, POS_UNUSED)
        for joint in trims:
            rest.set_trim(joint, None)
        if scaled_later or not rest.seal().fault(image.kind):
            image[number] = rest.seal()
            dropped.update(joint for _, joint in gone)
            untrimmed |= trims
    out = [f"{sum(dropped.values())} positions of joints left out (IDs {_ids(dropped)})"] if dropped else []
    return out + ([f"{counted(len(untrimmed), 'trim')} of page 0 left out (IDs {_ids(untrimmed)})"] if untrimmed else [])
