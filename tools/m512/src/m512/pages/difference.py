# SPDX-License-Identifier: MIT
"""The differences between two motion areas, in words: page, field or step and joint, old value, new value."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from m512.files.image import Image, is_erased
from m512.files.page import EMPTY, JOINTS, SCHEDULE_SPEED, SCHEDULE_TIME, STEPS, TRIM_STEP, Fault, Kind, Page
from m512.files.text.words import code_text, position_text
from m512.files.wording import pages_text


@dataclass(frozen=True)
class Change:
    page: int
    name: str
    what: str
    before: str
    after: str
    step: int | None = None  # 1..7
    joint: int | None = None

    def __str__(self) -> str:
        where = f"page {self.page}" + (f' "{self.name}"' if self.name else "")
        if self.step is not None:
            where += f", step {self.step}"
        if self.joint is not None:
            where += f", ID {self.joint}"
        move = f" ({int(self.after) - int(self.before):+d})" if self.before.isdigit() and self.after.isdigit() and self.joint is not None else ""
        what = f" {self.what}" if self.what else ""
        if not self.before and not self.after:
            return f"{where}:{what}"
        return f"{where}:{what} {self.before} -> {self.after}{move}"

    def as_dict(self) -> dict[str, Any]:
        return {key: value for key, value in asdict(self).items() if value is not None}


FIELDS = {
    "repeat": "repeat",
    "speed": "speed",
    "dxl_setup": "dxl_setup",
    "accel": "accel",
    "next": "next",
    "exit": "exit",
    "link1_page": "link1 page",
    "link2_page": "link2 page",
    "blend_right": "blend right",
    "blend_left": "blend left",
    "byte63": "byte 63",
}
CODES = {"code": "code", "link1_code": "link1 code", "link2_code": "link2 code"}
BOARD = Kind()  # the default: a page of a board
SCHEDULES = {SCHEDULE_TIME: "time base", SCHEDULE_SPEED: "speed base"}


BOTH_EMPTY = "empty in both; bytes without effect differ"


def lines(changes: list[Change]) -> list[str]:
    """The changes as lines for people. Empty pages share one line at the end."""
    empty = [change.page for change in changes if change.what == BOTH_EMPTY]
    return [str(change) for change in changes if change.what != BOTH_EMPTY] + ([f"{pages_text(empty)}: {BOTH_EMPTY}"] if empty else [])


def images(first: Image, second: Image) -> list[Change]:
    out: list[Change] = []
    for number in range(min(first.first, second.first), max(first.end, second.end)):
        a = first[number] if first.first <= number < first.end else None
        b = second[number] if second.first <= number < second.end else None
        if a is None or b is None:
            here = a or b
            if here is not None and not here.is_empty and not is_erased(here):
                out.append(Change(number, here.title, f"only in the {'second' if a is None else 'first'}", "", ""))
        elif a != b and not _both_nothing(a, b):
            out += pages(number, a, b, first.kind, second.kind)
    return out


def _both_nothing(a: Page, b: Page) -> bool:
    """Erased flash and the empty page mean the same to a robot."""
    return is_erased(a) and bytes(b) == EMPTY or is_erased(b) and bytes(a) == EMPTY


def pages(number: int, a: Page, b: Page, kind: Kind = BOARD, other: Kind = BOARD) -> list[Change]:
    """All changes between two versions of a page; never empty if their bytes differ."""
    whole = _whole(number, a, b, kind, other)
    if whole:
        return whole
    name, out = b.title or a.title, []  # type: str, list[Change]

    def add(what: str, before: object, after: object, step: int | None = None, joint: int | None = None) -> None:
        if before != after:
            out.append(Change(number, name, what, str(before), str(after), None if step is None else step + 1, joint))

    add("name", f'"{a.title}"', f'"{b.title}"')
    if a.name == b.name and a.data[:14] != b.data[:14]:
        add("bytes behind the name", bytes(a.data[:14]).hex(" "), bytes(b.data[:14]).hex(" "))
    add("schedule", _schedule(a), _schedule(b))
    for field, what in FIELDS.items():
        add(what, getattr(a, field), getattr(b, field))
    for field, what in CODES.items():
        add(what, code_text(getattr(a, field)), code_text(getattr(b, field)))
    add("steps", a.steps, b.steps)
    add("reserved bytes", bytes(a.data[14:15] + a.data[19:20]).hex(" "), bytes(b.data[14:15] + b.data[19:20]).hex(" "))
    for joint in range(JOINTS):
        add("softness", _softness(a, joint), _softness(b, joint), joint=joint)
    trims = [] if number else _trims(a, b)
    out += trims
    used = sorted({*a.poses(number), *b.poses(number)})
    for step in used:
        add("pause", a.pause(step), b.pause(step), step)
        add("time" if b.schedule == SCHEDULE_TIME else "speed", a.time(step), b.time(step), step)
        for joint in range(JOINTS):
            add("", position_text(a.word(step, joint), kind.pos_max), position_text(b.word(step, joint), other.pos_max), step, joint)
    unused = [step for step in range(STEPS) if step not in used and a.step_bytes(step) != b.step_bytes(step) and not (trims and step == TRIM_STEP)]
    if unused:
        out.append(Change(number, name, f"contents of unused steps differ ({', '.join(str(step + 1) for step in unused)})", "", ""))
    if Fault.CHECKSUM in (a.fault(), b.fault()):
        add("checksum", f"0x{a.checksum:02X}", f"0x{b.checksum:02X}")
    return out


def _trims(a: Page, b: Page) -> list[Change]:
    return [Change(0, "", "trim", str(x), str(y), joint=joint) for joint, (x, y) in enumerate(zip(a.trims(), b.trims())) if x != y]


def _schedule(page: Page) -> str:
    return SCHEDULES.get(page.schedule, f"0x{page.schedule:02X}")


def _softness(page: Page, joint: int) -> str:
    return f"{page.compliance(joint) >> 4}/{page.compliance(joint) & 15}"


def _whole(number: int, a: Page, b: Page, kind: Kind, other: Kind) -> list[Change]:
    """The change as a whole, for pages that appear, disappear or have nothing in common; else an empty list."""
    if number == 0 and all(is_erased(page) or page.is_empty for page in (a, b)):
        trims = _trims(a, b)
        if trims:
            return trims
    if is_erased(a) or is_erased(b):
        before, after = (("erased flash" if is_erased(p) else _summary(p, its)) for p, its in ((a, kind), (b, other)))
        return [Change(number, (b if is_erased(a) else a).title, "", before, after)]
    if a.is_empty and not b.is_empty:
        return [Change(number, b.title, "", "empty", _summary(b, other))]
    if b.is_empty and not a.is_empty:
        return [Change(number, a.title, "", _summary(a, kind), "empty")]
    if a.is_empty and b.is_empty and a != b:
        return [Change(number, "", BOTH_EMPTY, "", "")]
    return []


def _summary(page: Page, kind: Kind) -> str:
    if page.fault(kind) is not Fault.OK:
        return "damaged page"
    return f"{page.steps} step{'s' if page.steps != 1 else ''}" if not page.is_empty else "empty"
