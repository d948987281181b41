# SPDX-License-Identifier: MIT
"""Parses the text of a .mtn into pages. FILES.md has the table of fields, which `_header` and `read` implement."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

from m512.errors import FileError
from m512.files.image import Image
from m512.files.mtn.envelope import unwrap
from m512.files.mtn.long_pages import place_long_pages
from m512.files.page import POS_UNUSED, SCHEDULE_TIME, STEPS, Page
from m512.files.scale12 import HINT
from m512.files.wording import counted, pages_text

IDS = 26  # the text has IDs 0..25
PAGES = 255  # and pages 1..255
UNITS_PER_SECOND = 125  # of pause and time: a unit is 8 ms in RoboPlus
UNUSED_WORD = 0x4200
DIGITS_MOST = 40
VERSIONS = ("1.00", "1.01")
TOP = {10: 1023, 12: 4095}


class Lines:
    """The lines of the text, with the position for error messages."""

    def __init__(self, text: str, where: str):
        self.lines = text.split("\n")
        self.where, self.at = where, 0
        self.end = next((n for n in range(len(self.lines), 0, -1) if self.lines[n - 1].strip()), 0)

    def error(self, message: str) -> FileError:
        return FileError(f"{self.where}:{self.at}: {message}")

    def next(self) -> str:
        if not self.more:
            raise self.error("the file ends too early")
        self.at += 1
        return self.lines[self.at - 1]

    @property
    def more(self) -> bool:
        """Whether more than blank lines follow."""
        return self.at < self.end

    def next_is(self, key: str) -> bool:
        return self.lines[self.at].startswith(key + "=")

    def value(self, key: str) -> str:
        line = self.next()
        name, equals, value = line.partition("=")
        if name != key or not equals:
            raise self.error(f'"{key}=" expected, not {ascii(line[:40])}')
        return value

    def numbers(self, text: str, what: str, count: int) -> list[Fraction]:
        parts = text.replace(",", ".").split()
        if len(parts) != count:
            raise self.error(f"{what} has {counted(len(parts), 'value')}, not {count}")
        try:
            # No exponents and few digits: "1e999999" would take forever.
            if any(len(part) > DIGITS_MOST or set(part) - set("0123456789.-") for part in parts):
                raise ValueError
            return [Fraction(int(part) if part.isdigit() else part) for part in parts]
        except (ValueError, ZeroDivisionError):
            raise self.error(f"{what}: a value is not a number") from None

    def integers(self, text: str, what: str, count: int, low: int, high: int) -> list[int]:
        return [self.integer(value, what, low, high) for value in self.numbers(text, what, count)]

    def integer(self, value: Fraction, what: str, low: int, high: int) -> int:
        if value.denominator != 1 or not low <= value <= high:
            raise self.error(f"{what} {float(value):g} is not a number {low}..{high}")
        return int(value)

    def units(self, value: Fraction, what: str) -> int:
        units = int(value * UNITS_PER_SECOND + Fraction(1, 2))
        if value < 0 or units > 255:
            raise self.error(f"{what} {float(value):g} s is not 0..2.04 s")
        return units


@dataclass
class Step:
    positions: list[int]
    pause: int
    time: int
    line: int


@dataclass
class Block:
    """One page of the text, with any number of steps. `page` holds everything but the steps."""

    page: Page
    rate: Fraction
    steps: list[Step] = field(default_factory=list)


@dataclass
class _File:
    enabled: list[bool]
    blocks: list[Block]
    notes: list[str]


def read(data: bytes, where: str = "mtn", bits: int | None = None) -> Image:
    """A .mtn as a 256-page image with an empty page 0. `bits`: 10 or 12; None guesses from the positions. FileError: incomplete, or a
    value that a page cannot hold."""
    text, notes = unwrap(data, where)
    lines = Lines(text, where)
    file = _read_file(lines, notes)
    image = Image.empty(PAGES + 1)
    image.bits = _bits_of(file, bits, where)
    image.notes = file.notes
    _note_rates(file)
    for number, block in enumerate(file.blocks, 1):
        image[number] = block.page
        fill(image[number], block.steps[:STEPS], file.enabled)
    place_long_pages(image, file.blocks, lambda page, steps: fill(page, steps, file.enabled), where)
    return image


def _read_file(lines: Lines, notes: list[str]) -> _File:
    if lines.value("type") != "motion":
        raise lines.error('the type is not "motion"')
    version = lines.value("version").replace(",", ".")
    if version not in VERSIONS:
        notes.append(f"version {ascii(version)[1:-1]} is not known; the file is read like version 1.01")
    enabled = [bool(value) for value in lines.integers(lines.value("enable"), "enable", IDS, 0, 1)]
    if lines.next_is("motor_type") and any(lines.integers(lines.value("motor_type"), "motor_type", IDS, 0, 65535)):
        notes.append("motor types are not kept: pages have no place for them")
    file = _File(enabled, [], notes)
    while lines.more:
        file.blocks.append(_read_block(lines, len(file.blocks) + 1, file))
    del file.blocks[PAGES:]  # the surplus blocks are empty
    if len(file.blocks) < PAGES:
        notes.append(f"the file holds {len(file.blocks)} of {PAGES} pages; the others are taken as empty")
    return file


def _read_block(lines: Lines, number: int, file: _File) -> Block:
    if lines.next().strip() != "page_begin":
        raise lines.error('"page_begin" expected')
    block = _header(lines, number, file.notes)
    while True:
        line = lines.next()
        if line.strip() == "page_end":
            break
        if not line.startswith("step="):
            raise lines.error('"step=" or "page_end" expected')
        block.steps.append(_read_step(lines, line[5:]))
    if number > PAGES and (block.steps or block.page.name):
        raise lines.error(f"page {number} has no place: there are {PAGES} pages")
    return block


def _header(lines: Lines, number: int, notes: list[str]) -> Block:
    page = Page(bytes(512))
    page.data[:14] = _name(lines.value("name"), number, notes).ljust(14, b"\0")
    for joint, level in enumerate(lines.integers(lines.value("compliance"), "compliance", IDS, 0, 15)):
        page.set_compliance(joint, level * 17)
    next_, exit_, repeat, rate, inertia = lines.numbers(lines.value("play_param"), "play_param", 5)
    page.next, page.exit = lines.integer(next_, "next page", 0, 255), lines.integer(exit_, "exit page", 0, 255)
    page.repeat, page.accel = lines.integer(repeat, "repeat", 0, 255), lines.integer(inertia, "inertia", 0, 255)
    if rate <= 0 or not 1 <= 32 // rate <= 255:
        raise lines.error(f"rate {float(rate):g} gives no page speed 1..255 (0.13..32 do)")
    page.speed = int(32 // rate)
    page.schedule, page.byte63 = SCHEDULE_TIME, 0x55
    return Block(page, rate)


def _name(text: str, number: int, notes: list[str]) -> bytes:
    name = text.encode("utf-8", "surrogateescape").replace(b"\0", b"")
    if len(name) > 13:
        notes.append(f"page {number}: the name is longer than 13 bytes and was cut")
        name = name[:13].decode("utf-8", "ignore").encode("utf-8")
    return name


def _read_step(lines: Lines, text: str) -> Step:
    values = lines.numbers(text, "step", IDS + 2)
    positions = [lines.integer(value, f"position of ID {joint}", 0, TOP[12]) for joint, value in enumerate(values[:IDS])]
    return Step(positions, lines.units(values[IDS], "pause"), lines.units(values[IDS + 1], "time"), lines.at)


def fill(page: Page, steps: list[Step], enabled: list[bool]) -> None:
    """Writes at most seven steps into a page, unused ones as RoboPlus does, and seals it."""
    page.steps = len(steps)
    for number in range(STEPS):
        step = steps[number] if number < len(steps) else None
        for joint in range(IDS):
            word = UNUSED_WORD if step is None else step.positions[joint] | (0 if enabled[joint] else POS_UNUSED)
            page.set_word(number, joint, word)
        page.set_pause(number, step.pause if step else 0)
        page.set_time(number, step.time if step else 0)
    page.seal()


def _bits_of(file: _File, bits: int | None, where: str) -> int:
    """10 or 12. With 12 bits most positions lie beyond 1023; a few such positions in a 10-bit file are errors."""
    used = [(step.line, joint, step.positions[joint]) for block in file.blocks for step in block.steps for joint in range(IDS) if file.enabled[joint]]
    high = [place for place in used if place[2] > TOP[10]]
    if bits == 12 or not high:
        return bits or 10
    if bits is None and 2 * len(high) > len(used):
        file.notes.append(f"looks like 12 bit (positions up to {max(at for _, _, at in high)}) and is read so; {HINT}")
        return 12
    line, joint, at = high[0]
    raise FileError(
        f"{where}:{line}: position {at} of ID {joint} is beyond {TOP[10]}"
        + (
            ", like most in this file: looks like 12 bit: --bits 12 --scale 10"
            if 2 * len(high) > len(used)
            else f", like {len(high)} of {len(used)} in this file: a mistake, or servos of 12 bits (--bits 12)"
        )
    )


def _note_rates(file: _File) -> None:
    """Notes the pages with steps whose rate is not 32 / page speed, within the one decimal of the text."""
    uneven: list[tuple[Fraction, int, list[int]]] = []
    for number, block in enumerate(file.blocks, 1):
        held = Fraction(32, block.page.speed)
        if not block.steps or abs(held - block.rate) <= Fraction(1, 20):
            continue
        known = next((pages for rate, _, pages in uneven if rate == block.rate), None)
        if known is None:
            known = []
            uneven.append((block.rate, block.page.speed, known))
        known.append(number)
    for rate, speed, pages in uneven:
        file.notes.append(
            f"{pages_text(pages)}: a page cannot hold rate {float(rate):g}; it becomes 32 / {speed} = {32 / speed:.2f}, "
            "as RoboPlus itself makes it on the robot"
        )
