# SPDX-License-Identifier: MIT
"""Writes pages as the text of a .mtn. The text has 26 joints, time base and two links per page; everything else is a loss."""

from __future__ import annotations

from collections import deque
from fractions import Fraction
from functools import partial
from typing import Callable

from m512.errors import RefusedError
from m512.files.image import Image
from m512.files.mtn.envelope import BOM, file_checksum
from m512.files.mtn.reader import IDS, PAGES, UNITS_PER_SECOND, UNUSED_WORD
from m512.files.page import JOINTS, SCHEDULE_TIME, STEPS, Fault, Kind, Page, is_used
from m512.files.wording import Findings, counted, named_pages_text, ranges

MIDDLE = 512  # of a joint whose position is not known


def rate_of(speed: int) -> Fraction | None:
    """The rate (one decimal) nearest to 32 / speed among those that read back as `speed`, or None."""
    exact = Fraction(32, speed) if speed else Fraction(0)
    near = int(exact * 10)
    fits = [Fraction(tenths, 10) for tenths in range(max(1, near - 1), near + 3) if 320 // tenths == speed]
    return min(fits, key=lambda rate: abs(rate - exact), default=None)


def write(image: Image) -> tuple[bytes, list[str]]:
    """The file's bytes and the losses. RefusedError: pages that the text cannot hold at all (damaged, 12-bit positions)."""
    _must_fit(image)
    losses = Findings()
    enabled = _enabled(image)
    lines = ["type=motion", "version=1.01", "enable=" + " ".join(str(int(e)) for e in enabled), "motor_type=" + " ".join(["0"] * IDS)]
    if image.first == 0 and any(image[0].trims()):
        losses.add(0, "", "the robot's trim is not in a .mtn")
    used = set(image.used())
    blank = 0
    pages = {number: image[number] if number < image.end and not _is_blank(image[number]) else Page() for number in range(1, PAGES + 1)}
    leading = _leading(pages)
    for number, page in pages.items():
        lose = partial(losses.add, number, page.title)
        _page_losses(page, lose)
        blank += number in used and _changes_without_effect(page)
        lines += _page_lines(page, _positions(pages, leading, number, enabled, lose))
    told = losses.lines()
    if blank:
        moved = f", except for servos {IDS}..{JOINTS - 1}: m512 reads a .mtn as position 0 for them, which --joints 0..{IDS - 1} avoids"
        told.append(
            f"{counted(blank, 'page')}: what lies in unused steps, unused joints and byte 63 takes RoboPlus' usual values (no effect on playing"
            + (moved if any(map(_leaves_high_joints, pages.values())) else "")
            + ")"
        )
    body = BOM + "\n".join(lines + [""]).encode("utf-8")
    return body + file_checksum(body), told


def _is_blank(page: Page) -> bool:
    """Erased flash, or flash filled with a single value: no content."""
    return len(set(page.data)) == 1


def _must_fit(image: Image) -> None:
    if image.bits != 10:
        raise RefusedError("a .mtn holds positions of 10 bits and these have 12: convert --bits 12 --scale 10 makes them fit")
    kind = Kind(PAGES + 1)
    bad = {
        number: page.title if page.fault(kind) is not Fault.CHECKSUM else ""
        for number, page in image.items()
        if number and page.fault(kind) and not _is_blank(page)
    }
    if bad:
        one = next(iter(bad))
        raise RefusedError(
            f"{named_pages_text(bad)} cannot be written into a .mtn because of damage (page {one}: "
            f"{image[one].fault_text(kind)}). convert --damaged drop leaves such pages out"
        )


def _enabled(image: Image) -> list[bool]:
    """A joint is enabled if any page drives it."""
    pages = [page for number, page in image.items() if number and not _is_blank(page)]
    return [any(is_used(page.word(step, joint)) for page in pages for step in range(page.steps)) for joint in range(IDS)]


def _name_text(page: Page) -> str:
    text = page.name[:13].decode("utf-8", "replace")
    return "".join(char for char in text if char >= " " and char != "\ufffd")


def _rate(page: Page) -> Fraction:
    """The rate to write, to one decimal."""
    near = Fraction(int(Fraction(320, page.speed) + Fraction(1, 2)), 10)
    return rate_of(page.speed) or max(near, Fraction(2, 10))


def _leading(pages: dict[int, Page]) -> dict[int, list[int]]:
    """The pages that lead to each page by their next or exit link."""
    leading: dict[int, list[int]] = {number: [] for number in pages}
    for number, page in pages.items():
        for target in sorted({page.next, page.exit} - {0}):
            leading[target].append(number)
    return leading


def _last_position(pages: dict[int, Page], leading: dict[int, list[int]], number: int, step: int, joint: int) -> int | None:
    """The position that a joint has before a step: from the last step of the page that uses the joint, else from the nearest page that leads
    to it. None: no such step."""
    seen, todo = {number}, deque([(number, step)])
    while todo:
        here, steps = todo.popleft()
        for before in reversed(range(steps)):
            if is_used(word := pages[here].word(before, joint)):
                return word
        for earlier in leading[here]:
            if earlier not in seen:
                seen.add(earlier)
                todo.append((earlier, pages[earlier].steps if pages[earlier].repeat else 0))
    return None


def _positions(pages: dict[int, Page], leading: dict[int, list[int]], number: int, enabled: list[bool], lose: Callable[..., None]) -> list[list[int]]:
    """The positions of all steps of a page. `enable=` holds for the whole file, so a joint that any page uses needs a position in every step:
    where a step leaves it alone, it gets the one that it has there. Reports these joints: lose(sentence, value)."""
    page = pages[number]
    out = [[min(page.word(step, joint) & 0x1FFF, 1023) for joint in range(IDS)] for step in range(page.steps)]
    held: dict[int, set[int]] = {}
    unknown = set()
    for step, positions in enumerate(out):
        for joint in range(IDS):
            if enabled[joint] and not is_used(page.word(step, joint)):
                last = _last_position(pages, leading, number, step, joint)
                positions[joint] = MIDDLE if last is None else last
                if last is None:
                    unknown.add(joint)
                else:
                    held.setdefault(last, set()).add(joint)
    if held:
        texts = [f"IDs {' '.join(ranges(joints))} at {position}" for position, joints in held.items()]
        lose("joints that some steps leave alone would be held there at their last position", ", ".join(texts))
    if unknown:
        lose(
            f"joints that some steps leave alone would be driven there to {MIDDLE}, because no step before gives their position",
            "IDs " + " ".join(ranges(unknown)),
        )
    return out


def _page_lines(page: Page, positions: list[list[int]]) -> list[str]:
    levels = " ".join(str(min(max(page.compliance(joint) >> 4, 0), 15)) for joint in range(IDS))
    rate_text = f"{float(_rate(page)):.1f}"
    out = [
        "page_begin",
        f"name={_name_text(page)}",
        f"compliance={levels}",
        f"play_param={page.next} {page.exit} {page.repeat} {rate_text} {page.accel}",
    ]
    for step in range(page.steps):
        pause, time = page.pause(step) / UNITS_PER_SECOND, page.time(step) / UNITS_PER_SECOND
        out.append(f"step={' '.join(map(str, positions[step]))} {pause:.3f} {time:.3f}")
    return out + ["page_end"]


def _page_losses(page: Page, lose: Callable[..., None]) -> None:
    """Reports the losses that matter: lose(sentence, value)."""
    if _name_text(page).encode("utf-8") != page.name:
        lose("the name changes", repr(_name_text(page)))
    if page.schedule != SCHEDULE_TIME:
        lose("speed base is not known there: its speeds would be read as times")
    if page.code:
        lose("play codes are left out", str(page.code))
    for which in ("link1", "link2"):
        target, key = getattr(page, which + "_page"), getattr(page, which + "_code")
        if target or key:
            lose("links by code are left out", f"page {target} on code {key}")
    if page.blend_right or page.blend_left:
        lose("blend partners are left out", f"right {page.blend_right}, left {page.blend_left}")
    if page.dxl_setup or page.data[14] or page.data[19]:
        lose("bytes 14, 19 or 23 are left out")
    if rate_of(page.speed) is None and page.steps:
        lose("the page speed is no rate of one decimal", f"{page.speed} becomes {int(32 // _rate(page))}")
    uneven = [j for j in range(IDS) if page.compliance(j) >> 4 != page.compliance(j) & 15]
    if uneven and page.steps:
        lose("softness differs clockwise and counter-clockwise; the clockwise one is taken", "IDs " + " ".join(map(str, uneven)))
    high = {joint for step in range(page.steps) for joint in range(IDS, JOINTS) if page.word(step, joint) and is_used(page.word(step, joint))}
    if high:
        lose("positions of joints above ID 25 are left out", "IDs " + " ".join(map(str, sorted(high))))


def _changes_without_effect(page: Page) -> bool:
    """Whether something changes that has no effect on playing."""
    return (
        page.byte63 != 0x55
        or any(page.compliance(j) for j in range(IDS, JOINTS))
        or any(
            page.word(s, j) != (UNUSED_WORD if j < IDS else 0) or page.pause(s) or page.time(s)
            for s in range(page.steps, STEPS)
            for j in range(JOINTS)
        )
        or _leaves_high_joints(page)
    )


def _leaves_high_joints(page: Page) -> bool:
    """Whether a step leaves a joint alone that has no place in the text, and so is read back as position 0."""
    return any(not is_used(page.word(step, joint)) for step in range(page.steps) for joint in range(IDS, JOINTS))
