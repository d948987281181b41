# SPDX-License-Identifier: MIT
"""Steps of the text format: a page under construction, and the words of a line of joints. Used by reader.py."""

from __future__ import annotations

import re

from m512.errors import WordError
from m512.files.page import JOINTS, STEPS, Page
from m512.files.text.words import Token, joints_of, mirrored, position, step_speed, ticks
from m512.files.wording import counted

Words = dict[int, int]  # joint -> position word


class Draft:
    """A page under construction: the header as a Page, the steps as blocks of 64 bytes, and what is resolved at the end."""

    def __init__(self, template: Draft | None = None):
        self.page: Page = template.page.copy() if template else Page()
        self.fill: bytes = bytes(template.fill if template else self.page.step_bytes(0))
        self.steps: list[bytes] = []
        self.spares: dict[int, bytes] = {}
        self.spare_lines: dict[int, tuple[str, int]] = {}  # step -> the statement and its line
        self.step_count: int | None = None
        self.checksum: int | None = None
        self.raw: list[tuple[int, bytes]] = list(template.raw) if template else []
        self.links: list[tuple[str, Token, str, int]] = list(template.links) if template else []
        self.units: list[tuple[str, int]] = []
        self.line = 0
        self.which = ""  # the page number or range as written in the text
        self.said: dict[str, int] = {}  # statement allowed once -> its line

    def build(self) -> Page:
        page = self.page.copy()
        page.steps = len(self.steps) if self.step_count is None else self.step_count
        for k in range(STEPS):
            block = self.steps[k] if k < len(self.steps) else self.spares.get(k, self.fill)
            page.set_step_bytes(k, block)
        sealed = True
        for offset, data in self.raw:
            page.data[offset : offset + len(data)] = data
            sealed = sealed and not offset <= 31 < offset + len(data)
        if sealed:
            page.seal()
        if self.checksum is not None:
            page.checksum = self.checksum
        return page


def block_words(block: bytes) -> Words:
    return {j: block[2 * j] | block[2 * j + 1] << 8 for j in range(JOINTS)}


def make_block(words: Words, pause: int, time: int) -> bytes:
    return b"".join(words[j].to_bytes(2, "little") for j in range(JOINTS)) + bytes([pause, time])


class JointWords:
    """The context for reading a line of joints: names, rows, pairs, poses and the resolution."""

    def __init__(self) -> None:
        self.bits = 10
        self.joints: dict[str, int] = {}
        self.row: list[int] = []
        self.pairs = {a: b for k in range(1, 18, 2) for a, b in ((k, k + 1), (k + 1, k))}
        self.poses: dict[str, Words] = {}

    @property
    def pos_max(self) -> int:
        return (1 << self.bits) - 1

    def block(self, draft: Draft, line: int, rest: list[Token], what: str, before: bytes | None, base: bytes | None = None) -> bytes:
        """`TIME [pause TIME] | joints` as the 64 bytes of a step. `before`: the step before it. `base`: the words of unnamed joints, if
        not the page's fill."""
        bar = next((i for i, token in enumerate(rest) if token.text == "|" and not token.quoted), len(rest))
        head, joints = rest[:bar], rest[bar + 1 :]
        if len(head) not in (1, 3) or (len(head) == 3 and head[1].text != "pause"):
            raise WordError(f"usage: {what} TIME [pause TIME] | joints")
        pause = ticks(head[2], "pause") if len(head) == 3 else 0
        if head[0].text.endswith("dps"):
            time = step_speed(head[0])
            draft.units.append(("dps", line))
        else:
            time = ticks(head[0], "time")
            if head[0].text.endswith("s"):
                draft.units.append(("s", line))
            if time == 0 and what == "step":
                draft.units.append(("zero", line))
        words = block_words(base if base is not None else draft.fill)
        words = self.joint_words(joints, words, block_words(before) if before else None)
        return make_block(words, pause, time)

    def joint_words(self, tokens: list[Token], words: Words, before: Words | None) -> Words:
        """Applies the joint part of a line, left to right, to a copy of `words` and returns it. `before`: the step before, for `same`."""
        words, at = dict(words), 0
        while at < len(tokens):
            text = tokens[at].text
            if tokens[at].quoted or text == "|":
                raise WordError(f"unexpected {tokens[at]}")
            if text == "mirror":
                at += 1
                source = self._source(tokens[at].text if at < len(tokens) else "", before)
                words.update(self._mirror(source))
            elif text == "same" or text.startswith("@"):
                words.update(self._source(text, before))
            elif ":" in text:
                joints, _, value = text.rpartition(":")
                for joint in joints_of(joints, self.joints):
                    words[joint] = position(value, words.get(joint, 0x4000), self.pos_max)
            else:
                at = self._positional(tokens, at, words) - 1
            at += 1
        return words

    def _source(self, text: str, before: Words | None) -> Words:
        if text == "same":
            if before is None:
                raise WordError("same: there is no step before this one")
            return before
        if text[:1] != "@" or text[1:] not in self.poses:
            raise WordError(f"no pose is called {text[1:]}" if text[:1] == "@" else "mirror @pose or mirror same")
        return self.poses[text[1:]]

    def _mirror(self, words: Words) -> Words:
        out: Words = {}
        for joint, word in words.items():
            pair = self.pairs.get(joint)
            out[joint if pair is None else pair] = word if pair is None else mirrored(word, self.pos_max)
        return out

    def _positional(self, tokens: list[Token], first: int, words: Words) -> int:
        """Applies the row that begins at token `first`; returns the index after its end."""
        end = first
        while end < len(tokens) and not re.match(r"@|same\Z|mirror\Z|.*:", tokens[end].text):
            end += 1
        count = end - first
        if not self.row:
            raise WordError(f'{tokens[first]}: neither joint:position nor a pose; a row of positions needs a "row" line')
        if count != len(self.row):
            raise WordError(f"{counted(count, 'position')}; the row has {counted(len(self.row), 'joint')}")
        for joint, token in zip(self.row, tokens[first:end]):
            word = position(token.text, words.get(joint, 0x4000), self.pos_max)
            if token.text != "." or joint in words:
                words[joint] = word
        return end
