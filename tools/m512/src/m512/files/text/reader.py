# SPDX-License-Identifier: MIT
"""Reads the text format of motions into an Image. FORMAT.md is the specification.

A Reader goes through the lines once. Statements about the file change its tables. Statements about a page change the open
page, or the template of later pages (before the first page and after `defaults`). A file that is included begins with the template; if
it has pages, no page is open after it. Links by name are resolved at the end, when all
names are known.
"""

from __future__ import annotations

import re
from functools import partialmethod
from io import StringIO
from pathlib import Path

from m512.errors import FileError, TextError, WordError
from m512.files import storage
from m512.files.image import Image
from m512.files.page import JOINTS, PAGE_BYTES, SCHEDULE_SPEED, SCHEDULE_TIME, STEPS, Page
from m512.files.selection import number_range
from m512.files.text.steps import Draft, JointWords, block_words, make_block
from m512.files.text.words import IDENTIFIER, Token, code, continues, joint_list, joint_pairs, joints_of, name_bytes, number, ticks, tokenize

VERSION = 1
ONCE = set("repeat speed accel base code next exit link1 link2 dxl_setup byte63 steps checksum fill erased".split())  # at most once in a page
ABOUT_THE_FILE = set("pages bits joint row pairs pose include defaults page".split())  # all other statements are about a page
MAX_INCLUDE_DEPTH = 8
MAX_INCLUDES = 1000  # files that include each other twice would take hours


class Reader(JointWords):
    def __init__(self) -> None:
        super().__init__()
        self.first, self.end = 0, 128
        self.said: dict[str, str] = {}  # the file's values of `pages` and `bits`
        self.template = Draft()
        self.draft = self.template
        self.ended_by = ""  # the included file whose pages ended the open page, until `page` or `defaults`
        self.pages: dict[int, Draft] = {}
        self.where, self.line, self.folder, self.depth = "", 0, Path("."), 0
        self.origin: dict[int, str] = {}
        self.included: list[Path] = []
        self.included_bytes = 0

    # Files and lines

    def read(self, text: str, where: str, folder: Path) -> None:
        outer = self.where, self.line, self.folder
        self.where, self.folder, self.line = where, folder, 0
        started, quoted = False, False
        held: list[str] = []
        for last, line in enumerate(StringIO(text, newline=None), 1):
            line = line.rstrip("\n")
            self.line = last - len(held)
            goes_on, quoted = continues(line, quoted)
            if goes_on:
                held.append(line[:-1] + " ")
                continue
            held, line = [], "".join([*held, line])
            try:
                for statement in tokenize(line):
                    if not started:
                        self._version(statement)
                        started = True
                    else:
                        self._statement(statement)
            except WordError as error:
                raise TextError(str(error), where, self.line, last) from None
        if held:
            raise TextError("the last line ends in a backslash: what it goes on with is missing", where, last)
        if not started:
            raise FileError(f'{where}: empty; a motion text starts with "motion512 {VERSION}"')
        self.where, self.line, self.folder = outer

    def _version(self, statement: list[Token]) -> None:
        if statement[0].text != "motion512" or len(statement) != 2:
            raise WordError(f'a motion text starts with "motion512 {VERSION}" and no other word')
        if number(statement[1], 1, 999, "format version") != VERSION:
            raise WordError(f"this is format version {statement[1]}; this program reads version {VERSION}")

    def _statement(self, tokens: list[Token]) -> None:
        word, rest = tokens[0].text, tokens[1:]
        handler = getattr(self, f"_do_{word}", None)
        if handler is None or tokens[0].quoted:
            raise WordError(f"unknown word {tokens[0]}")
        if self.ended_by and word not in ABOUT_THE_FILE:
            raise WordError(f'{word}: {self.ended_by} has pages, so no page is open after it: write "page" or "defaults" first')
        if word in ONCE:
            self._once(word)
        elif word == "blend" and rest:
            self._once(f"blend {rest[0]}")
        handler(rest)

    @staticmethod
    def _count(rest: list[Token], low: int, high: int | None, usage: str) -> None:
        if len(rest) < low or (high is not None and len(rest) > high):
            raise WordError(f"usage: {usage}")

    def _once(self, what: str) -> None:
        """WordError: the open page already has this statement. The defaults may change from page to page."""
        if self.draft is not self.template:
            if what in self.draft.said:
                raise WordError(f"page {self.draft.which}: {what} is here a second time, after line {self.draft.said[what]}")
            self.draft.said[what] = self.line

    def _same_as_before(self, what: str, text: str) -> None:
        """WordError: the file, or a file that it includes, states a different value."""
        if self.said.setdefault(what, text) != text:
            raise WordError(f"{what} {text}: {what} {self.said[what]} was said before")

    # Statements about the file

    def _do_pages(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "pages 0..127 | 1..127 | 0..255")
        kinds = {"0..127": (0, 128), "1..127": (1, 128), "0..255": (0, 256)}
        if rest[0].text not in kinds:
            raise WordError("pages are 0..127, 1..127 or 0..255")
        if self.pages:
            raise WordError('"pages" comes before the first page')
        self._same_as_before("pages", rest[0].text)
        self.first, self.end = kinds[rest[0].text]

    def _do_bits(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "bits 10 | 12")
        self.bits = number(rest[0], 10, 12, "bits")
        if self.bits == 11 or self.pages or self.poses:
            raise WordError("bits are 10 or 12, said before the first pose or page")
        self._same_as_before("bits", rest[0].text)

    def _do_include(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, 'include "file"')
        path = self.folder / rest[0].text
        before, ended_by, pages = self.draft, self.ended_by, len(self.pages)
        self.draft, self.ended_by = self.template, ""
        self.depth += 1
        if self.depth > MAX_INCLUDE_DEPTH:
            raise WordError(f"include goes deeper than {MAX_INCLUDE_DEPTH} files (in a circle?)")
        if storage.is_stream(path):
            raise WordError(f"cannot read {path}: it is a pipe or a device and not a file")
        try:
            data = storage.read(path)
            text = data.decode("utf-8")
        except FileError as error:
            raise WordError(str(error)) from None
        except (UnicodeError, ValueError):
            raise WordError(f"cannot read {path}: not UTF-8 text") from None
        self.included.append(path)
        if len(self.included) > MAX_INCLUDES:
            raise WordError(f"more than {MAX_INCLUDES:,} includes in all, which is no motion")
        self.included_bytes += len(data)
        if self.included_bytes > storage.MOST_BYTES:
            raise WordError(f"what is included has more than {storage.MOST_BYTES >> 20} MiB in all, which is no motion")
        self.read(text, str(path), path.parent)
        self.depth -= 1
        self.draft, self.ended_by = before, str(rest[0]) if len(self.pages) > pages else ended_by

    def _do_joint(self, rest: list[Token]) -> None:
        self._count(rest, 2, 2, "joint ID name")
        joint, name = number(rest[0], 0, JOINTS - 1, "joint ID"), rest[1].text
        if not IDENTIFIER.match(name) or name in ("same", "mirror"):
            raise WordError(f"{rest[1]}: a joint name is a letter, then letters, digits and _ (not same, mirror)")
        if self.joints.get(name, joint) != joint:
            raise WordError(f"{name} is joint {self.joints[name]} already")
        self.joints[name] = joint

    def _do_row(self, rest: list[Token]) -> None:
        self._count(rest, 1, None, "row IDs (1..18, or a list)")
        self.row = joint_list(rest, self.joints)

    def _do_pairs(self, rest: list[Token]) -> None:
        self.pairs = joint_pairs((token.text for token in rest), self.joints)

    def _do_pose(self, rest: list[Token]) -> None:
        self._count(rest, 3, None, "pose name | joints")
        if not IDENTIFIER.match(rest[0].text) or rest[1].text != "|":
            raise WordError("usage: pose name | joints")
        if rest[0].text in self.poses:
            raise WordError(f"pose {rest[0]} is there already")
        self.poses[rest[0].text] = self.joint_words(rest[2:], {}, None)

    def _do_defaults(self, rest: list[Token]) -> None:
        self._count(rest, 0, 0, "defaults")
        self.draft, self.ended_by = self.template, ""

    def _do_page(self, rest: list[Token]) -> None:
        self._count(rest, 1, 2, "page NUMBER [name]")
        one = re.fullmatch("[0-9]{1,9}", rest[0].text)
        span = (int(one.group()), int(one.group())) if one else number_range(rest[0].text)
        if not span:
            raise WordError(f"page {rest[0]}: a number {self.first}..{self.end - 1} or a range 20..25")
        low, high = span
        if not self.first <= low <= high < self.end:
            raise WordError(f"page must be {self.first}..{self.end - 1}, not {rest[0]}")
        self.draft, self.ended_by = Draft(self.template), ""
        self.draft.line, self.draft.which = self.line, rest[0].text
        if len(rest) == 2:
            self.draft.page.data[:14] = name_bytes(rest[1]).ljust(14, b"\0")
        for page in range(low, high + 1):
            if page in self.pages:
                raise WordError(f"page {page} is there already ({self.origin[page]})")
            self.pages[page] = self.draft
            self.origin[page] = f"{self.where}:{self.line}"

    # Statements about a page (or the template)

    def _byte(self, field: str, rest: list[Token]) -> None:
        self._count(rest, 1, 1, f"{field} 0..255")
        setattr(self.draft.page, field, number(rest[0], 0, 255, field))

    _do_repeat, _do_speed = partialmethod(_byte, "repeat"), partialmethod(_byte, "speed")
    _do_dxl_setup, _do_byte63 = partialmethod(_byte, "dxl_setup"), partialmethod(_byte, "byte63")

    def _do_accel(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "accel TIME")
        self.draft.page.accel = ticks(rest[0], "accel")

    def _do_base(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "base time | speed")
        names = {"time": SCHEDULE_TIME, "speed": SCHEDULE_SPEED}
        if rest[0].text in names:
            self.draft.page.schedule = names[rest[0].text]
        elif rest[0].text[:2] == "0x":
            self.draft.page.schedule = number(rest[0], 0, 255, "base")
        else:
            raise WordError(f"base is time or speed, not {rest[0]}")

    def _do_code(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "code CODE")
        self.draft.page.code = code(rest[0])

    def _link(self, field: str, token: Token) -> None:
        self.draft.links = [link for link in self.draft.links if link[0] != field]
        self.draft.links.append((field, token, self.where, self.line))

    def _do_next(self, rest: list[Token], field: str = "next") -> None:
        self._count(rest, 1, 1, f"{field} PAGE")
        self._link(field, rest[0])

    _do_exit = partialmethod(_do_next, field="exit")

    def _do_link1(self, rest: list[Token], field: str = "link1") -> None:
        self._count(rest, 2, 2, f"{field} CODE PAGE")
        setattr(self.draft.page, f"{field}_code", code(rest[0]))
        self._link(f"{field}_page", rest[1])

    _do_link2 = partialmethod(_do_link1, field="link2")

    def _do_blend(self, rest: list[Token]) -> None:
        self._count(rest, 2, 2, "blend right PAGE | blend left PAGE")
        if rest[0].text not in ("right", "left"):
            raise WordError(f"blend right or blend left, not {rest[0]}")
        self._link(f"blend_{rest[0].text}", rest[1])

    def _do_softness(self, rest: list[Token]) -> None:
        self._count(rest, 1, None, "softness [LEVEL] joint:LEVEL ... (LEVEL 1..7, or CW/CCW)")
        for place, token in enumerate(rest):
            joints, _, level = token.text.rpartition(":")
            if not joints and (place or "softness" in self.draft.said):
                raise WordError(f"{token}: the level of all joints comes first, then joint:level")
            parts = [number(Token(part), 0, 15, "softness") for part in level.split("/")]
            if len(parts) > 2:
                raise WordError(f"{token}: a level, or clockwise/counter-clockwise levels")
            for joint in joints_of(joints, self.joints) if joints else range(JOINTS):
                self.draft.page.set_compliance(joint, parts[0] << 4 | parts[-1])
        if self.draft is not self.template:
            self.draft.said["softness"] = self.line

    def _do_steps(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "steps N")
        self._page_only("steps")
        self.draft.step_count = number(rest[0], 0, 255, "steps")

    def _do_checksum(self, rest: list[Token]) -> None:
        self._count(rest, 1, 1, "checksum 0xNN")
        self._page_only("checksum")
        self.draft.checksum = number(rest[0], 0, 255, "checksum")

    def _do_raw(self, rest: list[Token]) -> None:
        self._count(rest, 2, None, "raw OFFSET hex bytes")
        offset = number(rest[0], 0, PAGE_BYTES - 1, "offset")
        try:
            data = bytes.fromhex("".join(token.text for token in rest[1:]))
        except ValueError:
            raise WordError("raw: the bytes are pairs of hex digits") from None
        if offset + len(data) > PAGE_BYTES:
            raise WordError(f"raw: {len(data)} bytes at {offset} go beyond the page's 512")
        self.draft.raw.append((offset, data))

    def _do_erased(self, rest: list[Token]) -> None:
        """A page of flash that was never written."""
        self._count(rest, 0, 0, "erased")
        self._page_only("erased")
        self.draft.raw.append((0, b"\xff" * PAGE_BYTES))

    def _page_only(self, what: str) -> None:
        if self.draft is self.template:
            raise WordError(f"{what} belongs into a page")

    # Steps

    def _do_step(self, rest: list[Token]) -> None:
        self._page_only("step")
        if len(self.draft.steps) == STEPS:
            raise WordError("a page has 7 steps; go on in another page (link it with next)")
        self.draft.steps.append(self.block(self.draft, self.line, rest, "step", self.draft.steps[-1] if self.draft.steps else None))

    def _do_spare(self, rest: list[Token]) -> None:
        self._page_only("spare")
        self._count(rest, 3, None, "spare K TIME [pause TIME] | joints")
        k = number(rest[0], 0, STEPS - 1, "step")
        self._once(f"spare {k}")
        self.draft.spares[k] = self.block(self.draft, self.line, rest[1:], "spare K", None)
        self.draft.spare_lines[k] = f"spare {k}", self.line

    def _do_offset(self, rest: list[Token]) -> None:
        """Page 0: the third step holds signed offsets."""
        if self.draft is not self.pages.get(0):
            raise WordError("offset belongs into page 0, the trim")
        words = block_words(self.draft.spares.get(2, self.draft.fill))
        for token in rest[1:] if rest and rest[0].text == "|" else rest:
            joints, _, value = token.text.rpartition(":")
            signed = number(Token(value.lstrip("+")), -1023, 1023, "an offset")
            for joint in joints_of(joints, self.joints):
                self._once(f"the offset of joint {joint}")
                words[joint] = signed & 0xFFFF
        self.draft.spares[2] = make_block(words, 0, 0)
        self.draft.spare_lines[2] = "offset", self.line

    def _do_fill(self, rest: list[Token]) -> None:
        if self.draft.steps or self.draft.spares:
            raise WordError("fill comes before the page's steps")
        base = Page().step_bytes(0)
        if rest and rest[0].text == "|":
            rest = [Token("0")] + rest
        self.draft.fill = self.block(self.draft, self.line, rest, "fill", None, base)

    # The end

    def image(self) -> Image:
        image = Image(
            [Page() for _ in range(self.first, self.end)],
            self.first,
            self.bits,
            joints={joint: name for name, joint in reversed(list(self.joints.items()))},
            included=self.included,
        )
        built = {id(draft): (page, draft) for page, draft in self.pages.items()}
        for page, draft in built.values():
            self._check_spares(draft, self._file_of(page))
            self._check_units(draft, self._file_of(page))
        names: dict[bytes, list[int]] = {}
        for page, draft in self.pages.items():
            names.setdefault(draft.page.name, []).append(page)
        for page, draft in self.pages.items():
            for field, token, where, line in draft.links:
                try:
                    setattr(draft.page, field, self._resolve(token, page, names))
                except WordError as error:
                    raise TextError(str(error), where, line) from None
            image[page] = draft.build()
        return image

    def _file_of(self, page: int) -> str:
        return self.origin[page].rsplit(":", 1)[0]

    @staticmethod
    def _check_spares(draft: Draft, where: str) -> None:
        """TextError: a `spare` or `offset` for a step that the page uses."""
        for k, (statement, line) in draft.spare_lines.items():
            if k < len(draft.steps):
                raise TextError(
                    f"page {draft.which}: {statement} sets step {k}, counted from 0, and the page's {len(draft.steps)} step lines use it", where, line
                )

    @staticmethod
    def _check_units(draft: Draft, where: str) -> None:
        for unit, line in draft.units:
            if draft.page.schedule == SCHEDULE_SPEED and unit == "zero":
                raise TextError("a step in speed base has a speed of 1..255, not 0", where, line)
            if draft.page.schedule == SCHEDULE_SPEED and unit == "s":
                raise TextError("a time in s or ms, but the page has speed base", where, line)
            if draft.page.schedule == SCHEDULE_TIME and unit == "dps":
                raise TextError("a speed in dps, but the page has time base", where, line)

    def _resolve(self, token: Token, page: int, names: dict[bytes, list[int]]) -> int:
        if not token.quoted:
            if token.text in ("none", "self"):
                return page if token.text == "self" else 0
            if token.text[:2] == "0x":
                return number(token, 0, 255, "a raw link")
            if token.text.isascii() and token.text.isdigit():
                return number(token, 0, self.end - 1, "a link")
        hits = names.get(name_bytes(token).split(b"\0")[0], [])
        if len(hits) != 1:
            raise WordError(f"no page is called {token}" if not hits else f"{token} is the name of pages {', '.join(map(str, hits))}: link by number")
        return hits[0]


def read_text(text: str, where: str = "text", folder: Path = Path(".")) -> Image:
    """The image that a text describes. TextError: with file and line."""
    reader = Reader()
    reader.read(text.lstrip("\ufeff"), where, folder)
    reader.where = where
    return reader.image()
