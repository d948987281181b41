# SPDX-License-Identifier: MIT
"""Driving a motion that plays: turns keys into `@drive` lines, 20 per second.

The board ends the play through its exit page when no `@drive` arrives for a second (setting `drive`). So a lost cable or a program
that hangs does not leave a robot walking.
"""

from __future__ import annotations

import re
from collections import deque
from contextlib import suppress
from dataclasses import dataclass
from typing import Callable

from m512.board.client import Client
from m512.board.link import Link
from m512.errors import BoardError, CancelledError, NoAnswerError, PortError

PERIOD = 0.05  # seconds between two lines
# A board answers within 0.7 s (firmware/common/PROTOCOL.md). A line without an answer is not repeated: the next one says more. The keys are
# looked at before each.
ANSWER_SECONDS, UNANSWERED_MOST, HALT_TRIES = 0.7, 4, 2
ASK_EVERY = 20  # lines between two checks that the play still runs
RATES, AMPLITUDES, BLENDS = (10, 400), (0, 150), (-100, 100)
# What a terminal sends for an arrow, End, F4 and so on. The last letter of some is a letter that drives.
SEQUENCE = re.compile(r"\x1b(?:O|\[\[?[0-9;]*)([A-Za-z~^$@])")
BEGUN = re.compile(r"\x1b(O|\[\[?[0-9;]*)?\Z")  # the rest of it has not arrived
ARROWS = {"A": "w", "B": "s", "C": "d", "D": "a"}


@dataclass
class Stick:
    """The commanded values in percent: blend to the right, rate, amplitude. layer: whether the second page plays over the first. `done`:
    "stop" or "break"; cancelled: by Ctrl-C. `said`: a message for the user."""

    blend: float = 0.0
    rate: float = 100.0
    amplitude: float = 100.0
    layer: bool = False
    done: str = ""
    cancelled: bool = False
    said: str = ""

    def line(self) -> str:
        return f"drive {_within(self.blend, BLENDS)} {_within(self.rate, RATES)} {_within(self.amplitude, AMPLITUDES)}"


class Keys:
    """Keys of a terminal, which reports key presses but no releases. So the steering returns to straight by itself."""

    HELP = "a d or arrows left right steer, w s or up down speed, e q size, space stops, x or Ctrl-C at once"
    STEER, BACK, FASTER, LARGER = 25.0, 60.0, 10.0, 10.0  # percent a key; percent a second; percent a key

    def __init__(self) -> None:
        self.typed: deque[str] = deque()  # since the last update; another thread presses
        self.begun = ""  # the first part of a key's sequence

    def press(self, key: str) -> None:
        self.typed.append(key)

    def update(self, stick: Stick, seconds: float) -> None:
        pressed = self.begun
        while self.typed:
            pressed += self.typed.popleft()
        begun = BEGUN.search(pressed)
        self.begun = begun[0] if begun else ""
        keys = SEQUENCE.sub(_arrow, pressed.removesuffix(self.begun)).lower()
        if not any(key in "ad" for key in keys):
            stick.blend -= max(-self.BACK * seconds, min(self.BACK * seconds, stick.blend))
        for key in keys:
            stick.blend = _clamp(stick.blend + self.STEER * ((key == "d") - (key == "a")), BLENDS)
            stick.rate = _clamp(stick.rate + self.FASTER * ((key == "w") - (key == "s")), (50, 150))
            stick.amplitude = _clamp(stick.amplitude + self.LARGER * ((key == "e") - (key == "q")), (0, 120))
            stick.layer ^= key == "f"
            if key in "x\x03":
                stick.done = "break"
            elif key == " ":
                stick.done = stick.done or "stop"  # x a moment before is the stronger wish
            stick.cancelled |= key == "\x03"


def _arrow(sequence: re.Match[str]) -> str:
    """The letter that does what this arrow does. Empty for any other key, and for F2 of the Linux console (ESC [ [ B)."""
    return "" if sequence[0].startswith("\x1b[[") else ARROWS.get(sequence[1], "")


def drive(
    client: Client, keys: Keys, link: Link, told: Callable[[Stick], object], layer: int = 0, begin: Callable[[], object] = lambda: None
) -> Stick:
    """Begins the play, then sends lines until the keys set `done` or the play ends; calls `told(stick)` after each line. layer: the
    second page, 0: none. An exception stops the play softly, unless the board refuses to begin it."""
    stick, laid, lines, unanswered, begun = Stick(), False, 0, 0, False
    try:
        begin()
        begun, before = True, link.now()
        while not stick.done:
            now, lines = link.now(), lines + 1
            keys.update(stick, now - before)
            before = now
            if stick.done and unanswered:
                break
            try:
                client.ask(stick.line(), ANSWER_SECONDS, tries=1)
                has_ended = lines % ASK_EVERY == 0 and client.where(ANSWER_SECONDS, 1)["state"] == "idle"
                unanswered = 0
            except NoAnswerError:
                unanswered += 1
                if unanswered == UNANSWERED_MOST:
                    keys.update(stick, link.now() - before)
                    if not stick.cancelled:
                        raise
                continue
            if has_ended:
                stick.said = "the play has ended"
                told(stick)
                return stick
            if layer and stick.layer != laid:
                laid, stick.said = stick.layer, _laid(client, layer if stick.layer else "off")
            told(stick)
            link.sleep(max(PERIOD - (link.now() - now), 0))
    except BaseException as error:
        if begun or not isinstance(error, BoardError):
            with suppress(NoAnswerError, PortError):  # what came first is told
                _halt(client, "stop", 1 if unanswered else HALT_TRIES)
        raise
    try:
        _halt(client, stick.done, 1 if unanswered else HALT_TRIES)
    except NoAnswerError as error:
        if stick.cancelled:
            raise CancelledError(f"stopped by Ctrl-C, but {error}") from None
        raise
    return stick


def _halt(client: Client, word: str, tries: int) -> None:
    """Stops the play; Ctrl-C while the answer is awaited stops at once, and awaits none."""
    try:
        client.ask(word, ANSWER_SECONDS, tries)
    except KeyboardInterrupt:
        with suppress(NoAnswerError, PortError):
            client.ask("break", 0, tries=1)
        raise


def _laid(client: Client, page: int | str) -> str:
    """Starts or ends the layer. An error of the board is returned as text and does not stop the drive."""
    try:
        client.ask(f"layer {page}", ANSWER_SECONDS, UNANSWERED_MOST)
    except BoardError as error:
        return str(error)
    return ""


def _clamp(value: float, span: tuple[float, float]) -> float:
    return min(max(value, span[0]), span[1])


def _within(value: float, span: tuple[float, float]) -> int:
    return int(round(_clamp(value, span)))
