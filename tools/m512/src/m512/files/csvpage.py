# SPDX-License-Identifier: MIT
"""One page as a table for spreadsheets: header fields, then one line per step. An empty cell is an unused joint."""

from __future__ import annotations

import csv
from io import StringIO

from m512.errors import FileError, WordError
from m512.files.image import Image
from m512.files.page import JOINTS, STEPS, Page
from m512.files.text.words import Token, name_bytes, number, position, position_text, quote_name
from m512.files.wording import counted, pages_text

FIELDS = (
    "repeat",
    "schedule",
    "code",
    "speed",
    "accel",
    "next",
    "exit",
    "link1_page",
    "link1_code",
    "link2_page",
    "link2_code",
    "dxl_setup",
    "blend_right",
    "blend_left",
    "byte63",
)
HEAD = ("page", "bits", "name", "softness", *FIELDS)
COLUMNS = ["step", "time", "pause"] + [f"id{joint}" for joint in range(JOINTS)]


def write(image: Image, which: int | None) -> tuple[bytes, list[str]]:
    left = image.first == 0 and any(image[0].trims()) and not which
    if which is None:
        used = [n for n, page in image.items() if n and not page.is_empty]
        if len(used) != 1:
            there = f"here are {pages_text(used)}; `m512 convert SOURCE TARGET.csv --page NUMBER|NAME` takes one" if used else "here is none"
            raise FileError(f"a CSV holds one page, and {there}")
        which = used[0]
    page = image[which]
    if page.steps > STEPS:
        raise FileError(f"page {which} is damaged: {page.fault_text(image.kind)}")
    out = StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["page", which])
    if image.bits != 10:
        table.writerow(["bits", image.bits])
    name = quote_name(page.name)
    table.writerow(["name", name[1:-1] if name.startswith('"') else name])
    for field in FIELDS:
        table.writerow([field, getattr(page, field)])
    table.writerow(["softness"] + [f"0x{page.compliance(joint):02X}" for joint in range(JOINTS)])
    table.writerow(COLUMNS)
    for step in range(page.steps):
        words = ["" if word == 0x4000 else position_text(word, image.kind.pos_max) for word in page.words(step)]
        table.writerow([step, page.time(step), page.pause(step)] + words)
    data = out.getvalue()
    trim = ["page 0: the robot's trim is not in a .csv"] if left else []
    again = read(data, "csv")[which]
    losses = (
        []
        if again == page
        else [
            f"page {which}: what lies in unused steps, reserved bytes or behind the name's end"
            + (" and its wrong checksum" if page.fault_text() else "")
        ]
    )
    return data.encode(), trim + losses


def read(text: str, where: str) -> Image:
    """A 128-page image (256 if the number needs it) with the table's page. FileError: not a valid table."""
    lines = text.replace("\r\n", "\n").replace("\r", "\n").replace("\0", "")
    page, which, line, in_steps, bits = Page(), 0, 0, False, 0
    said: set[str] = set()
    try:
        rows = list(csv.reader(StringIO(lines)))
        for line, row in enumerate(rows, 1):
            key, cells = (row[0], row[1:]) if row else ("", [])
            if key and not in_steps:
                if key in said:
                    raise WordError(f"page {which}: {key} is here a second time")
                said.add(key)
            if not in_steps and key in HEAD and any(cells[JOINTS if key == "softness" else 1 :]):
                raise WordError(f"page {which}: {key} has too many values")
            if in_steps:
                if any(row):
                    _read_step(page, row)
            elif key == "page":
                which = number(Token(cells[0]), 0, 255, "page")
            elif key == "bits":
                bits = number(Token(cells[0]), 10, 12, "bits")
                if bits == 11:
                    raise WordError("bits are 10 or 12")
            elif key == "name":
                page.data[:14] = name_bytes(Token(cells[0], True)).ljust(14, b"\0")
            elif key in FIELDS:
                setattr(page, key, number(Token(cells[0]), 0, 255, key))
            elif key == "softness":
                for joint, cell in enumerate(cells[:JOINTS]):
                    page.set_compliance(joint, number(Token(cell), 0, 255, "softness"))
            elif key == "step":
                if row != COLUMNS:
                    raise WordError("the columns are " + ",".join(COLUMNS[:4]) + f",..id{JOINTS - 1}")
                in_steps = True
            elif any(row):
                raise WordError(f"unknown field {key!r}")
    except (WordError, IndexError) as error:
        raise FileError(f"{where}:{line}: {error if isinstance(error, WordError) else 'a value is missing'}") from None
    except csv.Error as error:
        raise FileError(f"{where}: {error}") from None
    if not in_steps:
        raise FileError(f"{where}: no line of columns (step,time,pause,id0,...)")
    if "page" not in said:
        raise FileError(f"{where}: no line page,NUMBER (0..255), which says which page this is")
    image = Image.empty(128 if which < 128 else 256)
    image.bits = _resolution(page, bits, where)
    if image.bits != bits and image.bits == 12:
        image.notes.append("positions above 1023: taken as 12 bit (a line `bits,12` says so)")
    image[which] = page.seal()
    return image


def _resolution(page: Page, said: int, where: str) -> int:
    """10 or 12 bits: from the table's `bits` line, else as large as its positions need."""
    highest = max((word for step in range(page.steps) for word in page.words(step) if word <= 4095), default=0)
    if said == 10 and highest > 1023:
        raise FileError(f"{where}: bits are 10 and there is a position {highest} (0..1023)")
    return said or (12 if highest > 1023 else 10)


def _read_step(page: Page, row: list[str]) -> None:
    if page.steps == STEPS:
        raise WordError("a page has 7 steps")
    if len(row) != len(COLUMNS):
        raise WordError(f"{counted(len(row), 'value')}, not {len(COLUMNS)}")
    step = page.steps
    page.set_time(step, number(Token(row[1]), 0, 255, "time"))
    page.set_pause(step, number(Token(row[2]), 0, 255, "pause"))
    for joint, cell in enumerate(row[3:]):
        page.set_word(step, joint, position(cell.strip() or "-", 0x4000, 4095))
    page.steps += 1
