# SPDX-License-Identifier: MIT
"""RoboPlus Motion 1.x `.mtn` text files, versions 1.00 and 1.01, both ways.

The text knows 26 joints, time base and two links a page. write() returns what it could not say, one sentence a page.
"""
from __future__ import annotations

from fractions import Fraction
from typing import Dict, List, Optional, Tuple

from m512.errors import FileError
from m512.files.image import Image
from m512.files.page import JOINTS, POS_TORQUE_OFF, POS_UNUSED, SCHEDULE_TIME, STEPS, Page, is_used

BOM = b"\xef\xbb\xbf"
IDS = 26                 # the text has IDs 0..25
PAGES = 255              # and pages 1..255
UNITS_PER_SECOND = 125   # of pause and time: a unit is 8 ms there
UNUSED_WORD = 0x4200
VERSIONS = ("1.00", "1.01")


def file_checksum(body: bytes) -> bytes:
    """The trailer: complement of the 16-bit sum of all bytes before it, high byte first."""
    return (~sum(body) & 0xFFFF).to_bytes(2, "big")


# Reading

class _Lines:
    """Lines with a place for errors."""

    def __init__(self, text: str, where: str):
        self.lines = [line.rstrip("\r") for line in text.split("\n")]
        self.where, self.at = where, 0

    def error(self, message: str) -> FileError:
        return FileError(f"{self.where}:{self.at}: {message}")

    def next(self) -> str:
        if self.at >= len(self.lines) or (self.at == len(self.lines) - 1 and not self.lines[-1]):
            raise self.error("the file ends too early")
        self.at += 1
        return self.lines[self.at - 1]

    @property
    def more(self) -> bool:
        return any(line.strip() for line in self.lines[self.at:])

    def value(self, key: str) -> str:
        line = self.next()
        name, equals, value = line.partition("=")
        if name != key or not equals:
            raise self.error(f"\"{key}=\" expected, not \"{line[:40]}\"")
        return value

    def numbers(self, text: str, what: str, count: int) -> List[Fraction]:
        parts = text.replace(",", ".").split()
        if len(parts) != count:
            raise self.error(f"{what} has {len(parts)} values, not {count}")
        try:
            # No exponents: "1e999999" would take for ever.
            if any(set(part) - set("0123456789.-") for part in parts):
                raise ValueError
            return [Fraction(part) for part in parts]
        except (ValueError, ZeroDivisionError):
            raise self.error(f"{what}: a value is not a number") from None

    def integers(self, text: str, what: str, count: int, low: int, high: int) -> List[int]:
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


def _split(data: bytes, where: str, edited: bool) -> str:
    """Body as text, after the trailer was checked and taken off."""
    body, trailer = data[:-2], data[-2:]
    if file_checksum(body) != trailer:
        if not edited:
            raise FileError(f"{where}: the file checksum is {trailer.hex(' ')} and should be "
                            f"{file_checksum(body).hex(' ')}: damaged, or edited by hand (--edited takes it as it is)")
        # An edited file may have lost its trailer, or kept the old one.
        body = data if data.rstrip().endswith(b"page_end") else data[:data.rfind(b"page_end") + 9]
    try:
        return body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"{where}: not UTF-8 text (byte 0x{body[error.start]:02X} at {error.start})") from None


def read(data: bytes, where: str = "mtn", base: Optional[Image] = None, edited: bool = False) -> Image:
    """A .mtn as a 256-page image. Page 0 comes from `base` or is the empty page.
    `edited`: a wrong file checksum is let pass."""
    lines = _Lines(_split(data, where, edited), where)
    image = Image.empty(PAGES + 1)
    if lines.value("type") != "motion":
        raise lines.error("the type is not \"motion\"")
    version = lines.value("version").replace(",", ".")
    if version not in VERSIONS:
        raise lines.error(f"version {version} is not known (1.00 and 1.01 are)")
    enabled = lines.integers(lines.value("enable"), "enable", IDS, 0, 1)
    if version == "1.01" and any(lines.integers(lines.value("motor_type"), "motor_type", IDS, 0, 65535)):
        image.notes.append("motor types are not kept: pages have no place for them")
    number = 0
    while lines.more:
        number += 1
        if number > PAGES:
            raise lines.error(f"more than {PAGES} pages")
        image[number] = _read_page(lines, number, enabled, image.notes)
    if number < PAGES:
        image.notes.append(f"the file holds {number} of {PAGES} pages; the others are taken as empty")
    if base is not None and base.first == 0:
        image[0] = base[0]
    return image


def _read_page(lines: _Lines, number: int, enabled: List[int], notes: List[str]) -> Page:
    page = Page(bytes(512))
    if lines.next() != "page_begin":
        raise lines.error("\"page_begin\" expected")
    name = lines.value("name").encode("utf-8")
    if len(name) > 13:
        notes.append(f"page {number}: the name is longer than 13 bytes and was cut")
        name = name[:13].decode("utf-8", "ignore").encode("utf-8")
    page.data[:14] = name.replace(b"\0", b"").ljust(14, b"\0")
    levels = lines.integers(lines.value("compliance"), "compliance", IDS, 0, 15)
    for joint, level in enumerate(levels):
        page.set_compliance(joint, level * 17)
    next_, exit_, repeat, rate, inertia = lines.numbers(lines.value("play_param"), "play_param", 5)
    page.next, page.exit = lines.integer(next_, "next page", 0, 255), lines.integer(exit_, "exit page", 0, 255)
    page.repeat, page.accel = lines.integer(repeat, "repeat", 0, 255), lines.integer(inertia, "inertia", 0, 255)
    if rate <= 0 or not 1 <= 32 // rate <= 255:
        raise lines.error(f"rate {float(rate):g} gives no page speed 1..255 (0.13..32 do)")
    page.speed = int(32 // rate)
    if rate_of(page.speed) != rate:
        notes.append(f"page {number}: rate {float(rate):g} becomes page speed {page.speed}, "
                     f"which is rate {float(32 / Fraction(page.speed)):.3g}")
    page.schedule, page.byte63 = SCHEDULE_TIME, 0x55
    for step in range(STEPS):
        for joint in range(IDS):
            page.set_word(step, joint, UNUSED_WORD)
    _read_steps(lines, page, enabled)
    return page.seal()


def _read_steps(lines: _Lines, page: Page, enabled: List[int]) -> None:
    while True:
        line = lines.next()
        if line == "page_end":
            return
        if not line.startswith("step=") or page.steps == STEPS:
            raise lines.error("\"page_end\" expected" if page.steps == STEPS else "\"step=\" or \"page_end\" expected")
        values = lines.numbers(line[5:], "step", IDS + 2)
        for joint in range(IDS):
            word = lines.integer(values[joint], f"position of ID {joint}", 0, 1023)
            page.set_word(page.steps, joint, word if enabled[joint] else word | POS_UNUSED)
        page.set_pause(page.steps, lines.units(values[IDS], "pause"))
        page.set_time(page.steps, lines.units(values[IDS + 1], "time"))
        page.steps += 1


# Writing

def rate_of(speed: int) -> Optional[Fraction]:
    """The rate (one decimal) that comes nearest to 32 / speed among those that read back as `speed`; None: none does."""
    exact = Fraction(32, speed) if speed else Fraction(0)
    near = int(exact * 10)
    fits = [Fraction(tenths, 10) for tenths in range(max(1, near - 1), near + 3) if 320 // tenths == speed]
    return min(fits, key=lambda rate: abs(rate - exact), default=None)


def write(image: Image, version: str = "1.01") -> Tuple[bytes, List[str]]:
    """The file and its losses."""
    losses: List[str] = []
    enabled = _enabled(image)
    lines = ["type=motion", f"version={version}", "enable=" + " ".join(str(int(e)) for e in enabled)]
    if version == "1.01":
        lines.append("motor_type=" + " ".join(["0"] * IDS))
    if image.first == 0 and any(image[0].word(2, j) not in (POS_UNUSED, 0) for j in range(JOINTS)):
        losses.append("page 0 (the robot's trim) is not in a .mtn")
    blank = 0
    for number in range(1, PAGES + 1):
        page = image[number] if number < image.end else Page()
        fault = page.fault_text(image.kind)
        if fault:
            losses.append(f"page {number} is damaged ({fault}) and is left out")
            page = Page()
        missing, plain = _page_losses(page, enabled)
        losses += [f"page {number}{' ' + repr(page.title) if page.name else ''}: {text}" for text in missing]
        blank += plain
        lines += _page_lines(page)
    if blank:
        losses.append(f"{blank} pages: what lies in unused steps, unused joints and byte 63 takes RoboPlus' usual values "
                      "(no effect on playing)")
    if image.bits != 10:
        losses.append("positions of a 12-bit image do not fit: scale it first (--scale 10)")
    body = BOM + "\n".join(lines + [""]).encode("utf-8")
    return body + file_checksum(body), losses


def _enabled(image: Image) -> List[bool]:
    """A joint is enabled when any page drives it."""
    pages = [page for number, page in image.items() if number and not page.fault(image.kind)]
    return [any(is_used(page.word(step, joint)) for page in pages for step in range(page.steps)) for joint in range(IDS)]


def _name_text(page: Page) -> str:
    text = page.name[:13].decode("utf-8", "replace")
    return "".join(char for char in text if char >= " " and char != "\ufffd")


def _page_lines(page: Page) -> List[str]:
    levels = " ".join(str(min(max(page.compliance(joint) >> 4, 0), 15)) for joint in range(IDS))
    rate = rate_of(page.speed) or Fraction(32, page.speed)
    rate_text = f"{float(max(rate, Fraction(2, 10))):.1f}"
    out = ["page_begin", f"name={_name_text(page)}", f"compliance={levels}",
           f"play_param={page.next} {page.exit} {page.repeat} {rate_text} {page.accel}"]
    for step in range(page.steps):
        positions = " ".join(str(min(page.word(step, joint) & 0x1FFF, 1023)) for joint in range(IDS))
        pause, time = page.pause(step) / UNITS_PER_SECOND, page.time(step) / UNITS_PER_SECOND
        out.append(f"step={positions} {pause:.3f} {time:.3f}")
    return out + ["page_end"]


def _page_losses(page: Page, enabled: List[bool]) -> Tuple[List[str], bool]:
    """What matters, in words, and whether something without effect changes too."""
    out = []
    if _name_text(page).encode("utf-8") != page.name:
        out.append(f"the name becomes {_name_text(page)!r}")
    if page.schedule != SCHEDULE_TIME:
        out.append("speed base is not known there: its speeds would be read as times")
    if page.code:
        out.append(f"play code {page.code}")
    for which in ("link1", "link2"):
        target, key = getattr(page, which + "_page"), getattr(page, which + "_code")
        if target or key:
            out.append(f"linked page {target} on code {key}")
    if page.dxl_setup or page.data[14] or any(page.data[17:20]):
        out.append("bytes 14, 17..19 or 23")
    if rate_of(page.speed) is None:
        out.append(f"page speed {page.speed} is no rate of one decimal")
    uneven = [j for j in range(IDS) if page.compliance(j) >> 4 != page.compliance(j) & 15]
    if uneven and page.steps:
        out.append("different softness clockwise and counter-clockwise: IDs " + " ".join(map(str, uneven)))
    out += _joint_losses(page, enabled)
    plain = (page.byte63 != 0x55 or any(page.compliance(j) for j in range(IDS, JOINTS))
             or any(page.word(s, j) != (UNUSED_WORD if j < IDS else 0) or page.pause(s) or page.time(s)
                    for s in range(page.steps, STEPS) for j in range(JOINTS))
             or any(page.word(s, j) & POS_UNUSED for s in range(page.steps) for j in range(IDS, JOINTS)))
    return out, plain


def _joint_losses(page: Page, enabled: List[bool]) -> List[str]:
    high: Dict[int, None] = {}
    driven: Dict[int, None] = {}
    for step in range(page.steps):
        for joint in range(JOINTS):
            word = page.word(step, joint)
            if joint >= IDS:
                if is_used(word) and word:
                    high[joint] = None
            elif not is_used(word) and enabled[joint]:
                driven[joint] = None
            elif word & 0x8000 or word & POS_TORQUE_OFF:
                driven[joint] = None
    out = []
    if high:
        out.append("positions of IDs " + " ".join(map(str, high)))
    if driven:
        out.append("not used in some steps, but would be driven there: IDs " + " ".join(map(str, driven)))
    return out
