# SPDX-License-Identifier: MIT
"""Words of the text format: tokens, numbers, times, codes, positions. FORMAT.md is the specification."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from m512.errors import WordError
from m512.files.page import JOINTS, POS_TORQUE_OFF, POS_UNUSED, TICKS_PER_SECOND
from m512.files.selection import number_range

KEYS = {"U": 1, "D": 2, "L": 4, "R": 8, "B1": 16, "B2": 32, "B3": 64, "B4": 128}
UNITS_PER_DEGREE = 1024 / 300
SPEED_UNITS_PER_DPS = 256 / 720  # of a step in speed base

IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_TOKEN = re.compile(r'\s*(?:(?P<comment>#.*)|(?P<sep>[;|])|"(?P<quoted>(?:[^"\\]|\\.)*)"|(?P<bare>[^\s#;|"]+)|(?P<bad>"))')
_OUTSIDE, _IN_QUOTES = re.compile(r'[^"#]*'), re.compile(r'(?:[^"\\]|\\.)*', re.S)
_ESCAPE = re.compile(rb"\\(x[0-9A-Fa-f]{2}|.)", re.S)


@dataclass(frozen=True)
class Token:
    text: str
    quoted: bool = False

    def __str__(self) -> str:
        return f'"{self.text}"' if self.quoted else self.text


def tokenize(line: str) -> list[list[Token]]:
    """The statements of a line (`;` separates them), without comments. `|` is a token of its own."""
    statements: list[list[Token]] = [[]]
    at, line = 0, line.rstrip()
    while at < len(line):
        match = _TOKEN.match(line, at)
        if not match or match.group("bad"):
            raise WordError("a quote is opened and not closed")
        at = match.end()
        if match.group("comment") is not None:
            break
        if match.group("sep") == ";":
            statements.append([])
        elif match.group("sep"):
            statements[-1].append(Token("|"))
        elif match.group("quoted") is not None:
            statements[-1].append(Token(match.group("quoted"), True))
        else:
            statements[-1].append(Token(match.group("bare")))
    return [statement for statement in statements if statement]


def continues(line: str, quoted: bool = False) -> tuple[bool, bool]:
    """(whether a backslash at the end joins the next line, whether a quote is open there). In a comment the backslash is part of the
    comment. quoted: whether a quote is open at the start of the line."""
    if not line.endswith("\\"):
        return False, False
    at, line = 0, line[:-1] + " "
    while at < len(line):
        some = (_IN_QUOTES if quoted else _OUTSIDE).match(line, at)
        at = some.end() if some else at  # both patterns match any text, even an empty one
        if line[at : at + 1] == "#" and not quoted:
            return False, False
        if at < len(line):
            quoted, at = not quoted, at + 1
    return True, quoted


def name_bytes(token: Token) -> bytes:
    """The bytes of a name token, at most 14. In quotes the escapes \\xNN, \\\\ and \\" are resolved; \\0 is a NUL."""
    try:
        raw = token.text.encode("ascii")
    except UnicodeEncodeError:
        raise WordError(f'{token}: a page name is ASCII; other bytes are written "\\xNN"') from None

    def unescape(match: re.Match[bytes]) -> bytes:
        what = match.group(1)
        if what.startswith(b"x") and len(what) == 3:
            return bytes([int(what[1:], 16)])
        if what in (b"\\", b'"'):
            return what
        if what == b"0":
            return b"\0"
        raise WordError(f"{token}: unknown escape \\{what.decode()}")

    name = _ESCAPE.sub(unescape, raw) if token.quoted else raw
    if len(name) > 14 or (len(name) == 14 and b"\\" not in raw):
        raise WordError(f"{token}: a page name has at most 13 characters, not {len(name)}")
    return name


def quote_name(name: bytes) -> str:
    """A name as a token: bare if that reads back the same, else quoted. Trailing NULs of a 14-byte name are dropped."""
    name = name.rstrip(b"\0") if len(name) == 14 else name
    if IDENTIFIER.match(name.decode("latin-1")) and len(name) < 14 and name not in (b"self", b"none"):
        return name.decode()
    out = "".join(f"\\{chr(b)}" if chr(b) in '"\\' else chr(b) if 0x20 <= b < 0x7F else f"\\x{b:02X}" for b in name)
    if len(name) == 14 and "\\" not in out:  # an escape marks a name of the full 14 bytes
        out = out[:-1] + f"\\x{name[13]:02X}"
    return f'"{out}"'


def number(token: Token, low: int, high: int, what: str) -> int:
    """A decimal or 0x number within a range. WordError: names the range."""
    text = token.text
    try:
        value = int(text, 16) if text[:2].lower() == "0x" else int(text, 10) if re.fullmatch(r"-?[0-9]+", text) else None
    except ValueError:
        value = None
    if value is None or token.quoted:
        raise WordError(f"{what} is a number {low}..{high}, not {token}")
    if not low <= value <= high:
        raise WordError(f"{what} must be {low}..{high}, not {token}")
    return value


def joint_list(tokens: list[Token], names: dict[str, int]) -> list[int]:
    """`1..6 11 r_hand` as IDs, in order, no ID twice."""
    out: list[int] = []
    for token in tokens:
        out.extend(joints_of(token.text, names))
    if len(set(out)) != len(out):
        raise WordError("a joint is named twice")
    return out


def joints_of(text: str, names: dict[str, int]) -> list[int]:
    """`7`, `1..6`, `1,3,5`, a joint name, or any of these joined by commas."""
    out = []
    for part in text.split(","):
        span = number_range(part)
        if span:
            part_ids = list(range(span[0], min(span[1], 999) + 1))
        elif re.fullmatch("[0-9]{1,9}", part):
            part_ids = [int(part)]
        elif part in names:
            part_ids = [names[part]]
        else:
            raise WordError(f"no joint is called {part!r}")
        if part_ids[-1] >= JOINTS:
            raise WordError(f"{part}: joints are IDs 0..{JOINTS - 1}")
        out += part_ids
    return out


def joint_pairs(texts: Iterable[str], names: dict[str, int]) -> dict[int, int]:
    """{joint: its partner} from `1-2`, `3-4` and single joints (`19`), which are mirrored in place."""
    pairs: dict[int, int] = {}
    for text in texts:
        ids = [joint for part in text.split("-") for joint in joints_of(part, names)]
        if len(ids) not in (1, 2) or len(set(ids)) != len(ids) or any(joint in pairs for joint in ids):
            raise WordError(f"{text}: pairs are 1-2 3-4 ..., a single joint 19 is mirrored in place, none twice")
        pairs[ids[0]], pairs[ids[-1]] = ids[-1], ids[0]
    return pairs


# What to do if a time does not fit into a byte (motion/PAGE_FORMAT.md: the page's speed scales times and pauses, no ramp).
TOO_LONG = {
    "time": "Raise the page's speed (32 = as written) or use two steps",
    "pause": "Raise the page's speed (32 = as written), in speed base lower it, or use two steps",
    "accel": "There is no longer ramp",
}


def ticks(token: Token, what: str) -> int:
    """A time as a byte: ticks of 1/128 s, or a decimal number with `s` or `ms`, rounded to the nearest tick."""
    match = re.fullmatch(r"([0-9]{1,9}(?:\.[0-9]*)?|\.[0-9]+)(ms|s)", token.text)
    if not match or token.quoted:
        return number(token, 0, 255, what)
    seconds = float(match.group(1)) / (1000 if match.group(2) == "ms" else 1)
    value = int(seconds * TICKS_PER_SECOND + 0.5)
    if value > 255:
        raise WordError(f"{what} {token} is {value} ticks; a byte holds 255 (1.992 s). {TOO_LONG[what]}")
    if value == 0 and seconds:
        raise WordError(f"{what} {token} is less than half a tick (7.8125 ms)")
    return value


def step_speed(token: Token) -> int:
    """A step's speed in speed base: units (256 = 720 degrees/s) or degrees per second with `dps`."""
    match = re.fullmatch(r"([0-9]{1,9}(?:\.[0-9]*)?)dps", token.text)
    if not match:
        return number(token, 0, 255, "speed")
    value = int(float(match.group(1)) * SPEED_UNITS_PER_DPS + 0.5)
    if not 1 <= value <= 255:
        raise WordError(f"speed {token} is {value} units; 1..255 (2.8..717 dps) is possible")
    return value


def code(token: Token) -> int:
    """A remote code: `none`, a number, or keys joined by +."""
    if token.text == "none":
        return 0
    if token.text[:1].isascii() and token.text[:1].isdigit():
        return number(token, 0, 255, "code")
    value = 0
    for key in token.text.split("+"):
        if key.upper() not in KEYS:
            raise WordError(f"code {token}: a number or keys of {' '.join(KEYS)} joined by +")
        value |= KEYS[key.upper()]
    return value


def code_text(value: int) -> str:
    """The reverse of code(). 255 means stop and stays a number."""
    if value in (0, 255):
        return str(value)
    return "+".join(key for key, bit in KEYS.items() if value & bit)


def position(text: str, before: int, pos_max: int) -> int:
    """A position word. `before` is the joint's current word (for +, - and `.`)."""
    if text == "-":
        return POS_UNUSED
    if text == ".":
        return before
    token = Token(text)
    if text[:1] in ("~", "?"):
        flag = POS_UNUSED if text[0] == "~" else POS_TORQUE_OFF
        return flag | number(Token(text[1:] or text), 0, 0x1FFF, f"the position after {text[0]}")
    if text[:2].lower() == "0x":
        return number(token, 0, 0xFFFF, "a raw word")
    degrees = re.fullmatch(r"([+-]?[0-9]{1,9}(?:\.[0-9]*)?)deg", text)
    if degrees and text[0] == "+":
        raise WordError(
            f"{text}: an angle is from the centre, a + is from where the joint is. Say {text[1:]} for the angle, or "
            f"+{round(float(text[1:-3]) * (UNITS_PER_DEGREE if pos_max == 1023 else 4096 / 360))} to go so far"
        )
    if degrees:
        scale = UNITS_PER_DEGREE if pos_max == 1023 else 4096 / 360
        value = (pos_max + 1) // 2 + round(float(degrees.group(1)) * scale)
    elif re.fullmatch(r"[+-][0-9]{1,9}", text):
        if before & (POS_UNUSED | POS_TORQUE_OFF) or before > pos_max:
            raise WordError(f"{text}: there is no position to change")
        value = before + int(text)
    else:
        return number(token, 0, pos_max, "a position")
    if not 0 <= value <= pos_max:
        raise WordError(f"{text}: {value} is outside 0..{pos_max}")
    return value


def position_text(word: int, pos_max: int) -> str:
    """The shortest text that position() reads as `word`."""
    if word <= pos_max:
        return str(word)
    if word == POS_UNUSED:
        return "-"
    top = word & 0xE000
    if top in (POS_UNUSED, POS_TORQUE_OFF):
        return ("~" if top == POS_UNUSED else "?") + str(word & 0x1FFF)
    return f"0x{word:04X}"


def mirrored(word: int, pos_max: int) -> int:
    """A position mirrored about the centre (512, or 2048). Unused words stay as they are."""
    if word > pos_max:
        return word
    value = (pos_max + 1) - word
    if value > pos_max:
        raise WordError(f"the mirror image of position {word} is outside 0..{pos_max}")
    return value
