# SPDX-License-Identifier: MIT
"""Writes an Image in the text format, such that reading it gives the same bytes. FORMAT.md is the specification.

What most pages share (softness, ramp, words of unused joints) is written once before the first page. Pages equal to the empty page are
left out, runs of equal empty pages are written once. The text is read back; pages that words do not describe exactly are written as
raw bytes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TypeVar

from m512.errors import TextError
from m512.files.image import Image, is_erased
from m512.files.page import EMPTY, JOINTS, POS_TORQUE_OFF, POS_UNUSED, SCHEDULE_SPEED, SCHEDULE_TIME, STEPS, Fault, Page
from m512.files.text.reader import VERSION, read_text
from m512.files.text.steps import block_words
from m512.files.text.words import code_text, position_text, quote_name
from m512.files.wording import spans

STANDARD_FILL = Page().step_bytes(0)
MAX_ODD_WORDS = 8  # with more impossible positions than this, the page is not a motion and is shown as bytes


class Style:
    """What the whole file shares."""

    def __init__(self, image: Image):
        self.image = image
        self.pos_max = image.kind.pos_max
        pages = [page for _, page in image.items() if bytes(page) != EMPTY and is_motion(page, image)]
        self.fill = _common((clean_fill(page) for page in pages), STANDARD_FILL)
        self.softness = _common((bytes(page.data[32:63]) for page in pages), EMPTY[32:63])
        self.accel = _common((page.accel for page in pages), 32)
        self.byte63 = _common((page.byte63 for page in pages), 0)
        self.row = sorted(
            {
                joint
                for page in pages
                for step in range(min(page.steps, STEPS))
                for joint in range(JOINTS)
                if page.word(step, joint) != block_words(self.fill_of(page))[joint]
            }
        )
        self.names = {numbers[0]: quote_name(name) for name, numbers in image.names().items() if len(numbers) == 1}

    def fill_of(self, page: Page) -> bytes:
        return clean_fill(page) or self.fill


T = TypeVar("T")


def _common(values: Iterable[T | None], standard: T) -> T:
    """The value that more than half of the pages share, else the standard one."""
    counted = Counter(value for value in values if value is not None)
    if not counted:
        return standard
    value, count = counted.most_common(1)[0]
    return value if 2 * count > sum(counted.values()) else standard


def clean_fill(page: Page) -> bytes | None:
    """The block that fills the page's unused steps, if the last step is unused and holds no pose."""
    if page.steps >= STEPS:
        return None
    block = page.step_bytes(STEPS - 1)
    words = block_words(block).values()
    return block if all(word == 0 or word & 0xE000 == 0x4000 for word in words) and block[62] == 0 else None


def is_motion(page: Page, image: Image) -> bool:
    """Whether words describe a page better than raw bytes."""
    odd = sum(
        1
        for step in range(min(page.steps, STEPS))
        for word in page.words(step)
        if word > image.kind.pos_max and word & 0xE000 not in (POS_UNUSED, POS_TORQUE_OFF)
    )
    return odd <= MAX_ODD_WORDS


def ranges(numbers: Iterable[int]) -> str:
    """`1..6 9 11..18`."""
    return " ".join(str(a) if a == b else f"{a}..{b}" for a, b in spans(numbers))


def grouped(values: dict[int, str]) -> list[str]:
    """`0..25:~512 26..30:0` from one text per joint."""
    out, run = [], []  # type: list[str], list[int]
    for joint in sorted(values):
        if run and (values[run[0]] != values[joint] or run[-1] != joint - 1):
            out.append(f"{ranges(run)}:{values[run[0]]}")
            run = []
        run.append(joint)
    return out + ([f"{ranges(run)}:{values[run[0]]}"] if run else [])


def softness_text(levels: bytes) -> str:
    texts = [str(b >> 4) if b >> 4 == b & 15 else f"{b >> 4}/{b & 15}" for b in levels]
    main = Counter(texts).most_common(1)[0][0]
    return " ".join(["softness", main] + grouped({j: t for j, t in enumerate(texts) if t != main}))


def time_text(block: bytes) -> str:
    return f"{block[63]}" + (f" pause {block[62]}" if block[62] else "")


def fill_text(block: bytes, pos_max: int) -> str:
    words = {j: position_text(w, pos_max) for j, w in block_words(block).items() if w != 0x4000}
    return f"fill {time_text(block)} | " + " ".join(grouped(words))


def _sparse(word: str, block: bytes, fill: bytes, pos_max: int) -> str:
    base = block_words(fill)
    words = {j: position_text(w, pos_max) for j, w in block_words(block).items() if w != base[j]}
    return f"  {word} {time_text(block)} | " + " ".join(grouped(words))


def link_text(target: int, number: int, style: Style) -> str:
    if target == number and target:
        return "self"
    if target >= style.image.end:
        return f"0x{target:02X}"
    return style.names.get(target, str(target)) if target else "none"


def _header(page: Page, number: int, style: Style) -> list[str]:
    out = []
    if page.code:
        out.append(f"code {code_text(page.code)}")
    if page.repeat != 1:
        out.append(f"repeat {page.repeat}")
    if page.schedule != SCHEDULE_TIME:
        out.append("base speed" if page.schedule == SCHEDULE_SPEED else f"base 0x{page.schedule:02X}")
    if page.speed != 32:
        out.append(f"speed {page.speed}")
    if page.accel != style.accel:
        out.append(f"accel {page.accel}")
    if page.next:
        out.append(f"next {link_text(page.next, number, style)}")
    if page.exit:
        out.append(f"exit {link_text(page.exit, number, style)}")
    if page.link1_page or page.link1_code:
        out.append(f"link1 {code_text(page.link1_code)} {link_text(page.link1_page, number, style)}")
    if page.link2_page or page.link2_code:
        out.append(f"link2 {code_text(page.link2_code)} {link_text(page.link2_page, number, style)}")
    for side in ("right", "left"):
        if partner := getattr(page, f"blend_{side}"):
            out.append(f"blend {side} {link_text(partner, number, style)}")
    if page.dxl_setup:
        out.append(f"dxl_setup {page.dxl_setup}")
    if bytes(page.data[32:63]) != style.softness:
        out.append(softness_text(bytes(page.data[32:63])))
    if page.byte63 != style.byte63:
        out.append(f"byte63 {page.byte63}")
    for offset, count in ((14, 1), (19, 1)):
        data = bytes(page.data[offset : offset + count])
        if any(data):
            out.append(f"raw {offset} {data.hex(' ')}")
    if style.fill_of(page) != style.fill:
        out.append(fill_text(style.fill_of(page), style.pos_max))
    return out


def _offset(page: Page, fill: bytes) -> str:
    """The trim of page 0 as an `offset` statement; empty if that cannot describe the third step."""
    base, block = block_words(fill), block_words(page.step_bytes(2))
    trims = {joint: word - 0x10000 if word & 0x8000 else word for joint, word in block.items() if word != base[joint]}
    if any(page.step_bytes(2)[-2:]) or not all(abs(trim) <= 1023 for trim in trims.values()):
        return ""
    return " ".join(["offset"] + grouped({joint: f"{trim:+d}" for joint, trim in trims.items()}))


def _steps(page: Page, number: int, style: Style) -> list[str]:
    fill, base = style.fill_of(page), block_words(style.fill_of(page))
    count = min(page.steps, STEPS)
    table = [
        ["step", str(page.time(k)), f"pause {page.pause(k)}" if page.pause(k) else "", "|"]
        + ["." if page.word(k, j) == base[j] else position_text(page.word(k, j), style.pos_max) for j in style.row]
        for k in range(count)
    ]
    out = []
    if table and style.row:
        table.insert(0, ["# ID", "", "", "|"] + [str(j) for j in style.row])
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))] if table else []
    for line in table:
        cells = [cell.ljust(width) if i in (0, 2) else cell.rjust(width) for i, (cell, width) in enumerate(zip(line, widths)) if width]
        out.append(" ".join(cells).rstrip())
    spares = [k for k in range(count, STEPS) if page.step_bytes(k) != fill]
    offset = _offset(page, fill) if number == 0 and 2 in spares else ""
    out += [offset if offset and k == 2 else _sparse(f"spare {k}", page.step_bytes(k), fill, style.pos_max).strip() for k in spares]
    if page.steps != count:
        out.append(f"steps {page.steps}")
    return out


def _title(page: Page, numbers: tuple[int, int]) -> str:
    first, last = numbers
    name = bytes(page.data[:14])
    named = any(name) and not is_erased(page)
    return f"page {first}" + (f"..{last}" if last != first else "") + (f" {quote_name(name)}" if named else "")


def page_text(page: Page, numbers: tuple[int, int], style: Style) -> str:
    """One page (or a run of equal ones) in words."""
    out = [_title(page, numbers)]
    fault = page.fault_text(style.image.kind)
    if fault:
        out.append(f"# damaged: {fault}")
    out += _header(page, numbers[0], style) + _steps(page, numbers[0], style)
    if page.fault() is Fault.CHECKSUM:
        out.append(f"checksum 0x{page.checksum:02X}")
    return "\n  ".join(out) + "\n"


def raw_text(page: Page, numbers: tuple[int, int], style: Style) -> str:
    """The same as raw bytes."""
    out = [_title(page, numbers)]
    if is_erased(page):
        return f"{out[0]} ; erased\n"
    fault = page.fault_text(style.image.kind)
    if fault:
        out.append(f"# damaged: {fault}")
    out += [f"raw {at:3} {bytes(page.data[at : at + 32]).hex(' ')}" for at in range(0, 512, 32)]
    return "\n  ".join(out) + "\n"


def _preamble(style: Style) -> list[str]:
    image = style.image
    out = [f"motion512 {VERSION}"]
    if (image.first, image.end) != (0, 128):
        out.append(f"pages {image.first}..{image.end - 1}")
    if image.bits != 10:
        out.append(f"bits {image.bits}")
    if style.row:
        out.append("row " + ranges(style.row))
    if style.accel != 32:
        out.append(f"accel {style.accel}")
    if style.softness != EMPTY[32:63]:
        out.append(softness_text(style.softness))
    if style.byte63:
        out.append(f"byte63 {style.byte63}")
    if style.fill != STANDARD_FILL:
        out.append(fill_text(style.fill, style.pos_max))
    return out


def write_text(image: Image) -> str:
    """The text of an image. read_text() gives the same bytes back."""
    style = Style(image)
    head = "\n".join(_preamble(style)) + "\n"
    runs = [(numbers, page) for numbers, page in _runs(image) if bytes(page) != EMPTY]
    whole = "\n".join(
        [head] + [page_text(page, numbers, style) if is_motion(page, image) else raw_text(page, numbers, style) for numbers, page in runs]
    )
    if _reads_as(whole, image):
        return whole
    # Rare: words cannot describe every page. Finds these pages one by one, with links by number.
    style.names = {}
    out = [head]
    for numbers, page in runs:
        text = page_text(page, numbers, style)
        out.append(text if _reads_alone(head, text, numbers, page) else raw_text(page, numbers, style))
    return "\n".join(out)


def _runs(image: Image) -> list[tuple[tuple[int, int], Page]]:
    """Runs of equal pages that are empty, erased or filled with one value. Every other page is on its own."""
    out: list[tuple[tuple[int, int], Page]] = []
    for number, page in image.items():
        if out and out[-1][1] == page and out[-1][0][1] == number - 1 and (page.is_empty or len(set(page.data)) == 1):
            out[-1] = ((out[-1][0][0], number), page)
        else:
            out.append(((number, number), page))
    return out


def _reads_as(text: str, image: Image) -> bool:
    try:
        return read_text(text).to_bytes() == image.to_bytes()
    except TextError:
        return False


def _reads_alone(head: str, text: str, numbers: tuple[int, int], page: Page) -> bool:
    try:
        image = read_text(head + text)
    except TextError:
        return False
    return all(image[n] == page for n in numbers)
