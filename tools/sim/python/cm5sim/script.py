# SPDX-License-Identifier: MIT
"""Scripts of timed actions and expectations, one per line (README.md, "Scripts"). A script is read and checked completely before the
run."""

from __future__ import annotations

import codecs
import operator
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, NoReturn

from . import words
from .board import BUTTONS, LEDS
from .library import CYCLES_PER_MS
from .options import EXIT_EXPECTATION, EXIT_GOOD, NEVER
from .servo import COUNTED_FAULTS, FAULTS

if TYPE_CHECKING:
    from .session import Session

Act = Callable[["Session"], None]
Poll = Callable[["Session", bool], bool]  # (session, is the time over) -> is it done; raises Failed

PRESS_MS, WITHIN_MS = 100, 1000
TAIL_BYTES = 400  # length of console output shown when an expectation fails
RELATIONS = {"==": operator.eq, "!=": operator.ne, "<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge}
QUANTITIES = {  # name: (address, bytes) in the control table
    "goal": (30, 2), "present": (36, 2), "torque": (24, 1), "moving": (46, 1), "speed": (32, 2), "voltage": (42, 1), "temperature": (43, 1),
    "led": (25, 1), "alarms": (0, 0), "register": (-1, 1),
}  # fmt: skip


class Mistake(ValueError):
    """A line is wrong: what is wrong, and at which word."""

    def __init__(self, what: str, at: str = "") -> None:
        super().__init__(f'{what} (at "{at}")' if at else what)


class Failed(Exception):
    """An expectation was not met, or an action is impossible."""


class Step(NamedTuple):
    """One line of a script. act: called once at the beginning; None for an expectation. Then poll is called until it returns True."""

    line: int
    when: tuple[str, int]  # ("at" or "after", cycles), or ("", 0)
    cycles: int  # within, for, held
    act: Act | None
    poll: Poll


class Line:
    """The words of a line, taken one by one."""

    def __init__(self, line: bytes) -> None:
        self._words, self._at = words.split(line), 0

    def __len__(self) -> int:
        return len(self._words) - self._at

    def wrong(self, what: str) -> NoReturn:
        place = min(self._at, len(self._words) - 1)
        raise Mistake(what, shown(self._words[place].text))

    def word(self, what: str) -> str:
        if not len(self) or self._words[self._at].quoted:
            self.wrong(what)
        return shown(self._words[self._at].text)

    def skip(self) -> None:
        self._at += 1

    def has(self, word: str) -> bool:
        found = len(self) > 0 and self._words[self._at] == (word.encode(), False)
        self._at += found
        return found

    def text(self, what: str) -> bytes:
        if not len(self) or not self._words[self._at].quoted:
            self.wrong(what)
        self.skip()
        return self._words[self._at - 1].text

    def one_of(self, names: tuple[str, ...], what: str) -> str:
        word = self.word(what)
        found = next((name for name in names if name.lower() == word.lower()), None)
        if found is None:
            self.wrong(what)
        self.skip()
        return found

    def number(self, low: int, high: int, what: str) -> int:
        value = words.number(self.word(what), low, high)
        if value is None:
            self.wrong(what)
        self.skip()
        return value

    def real(self, low: float, high: float, what: str) -> float:
        try:
            value = float(self.word(what))
        except ValueError as error:
            if isinstance(error, Mistake):
                raise
            self.wrong(what)
        if not low <= value <= high:
            self.wrong(what)
        self.skip()
        return value

    def time(self) -> int:
        what = "a time like 500ms or 2s is missing here"
        cycles = words.duration(self.word(what))
        if cycles is None:
            self.wrong(what)
        self.skip()
        return cycles

    def within(self) -> int:
        return self.time() if self.has("within") else WITHIN_MS * CYCLES_PER_MS

    def is_on(self) -> bool:
        return self.one_of(("off", "on"), "on or off is missing here") == "on"

    def servo(self, what: str = "a servo ID 0..253 is missing here") -> int:
        return self.number(0, 253, what)


def shown(text: bytes) -> str:
    return text.decode("utf-8", "replace")


def seconds(cycles: int) -> str:
    return f"{cycles / 1000 / CYCLES_PER_MS:.3f} s"


# Meanings of verbs. Each function takes the words after the verb and returns the duration, the action at the beginning, and the function to
# poll afterwards. `done` serves for actions that last for their duration.


def done(session: Session, late: bool) -> bool:
    return late


Meaning = tuple[int, "Act | None", Poll]


def at_once(act: Act) -> Meaning:
    return 0, act, done


def _send(line: Line) -> Meaning:
    text = line.text('a "text" to send is missing here')
    return at_once(lambda session: session.send(text))


def _expect(line: Line) -> Meaning:
    no = line.has("no")
    text = line.text('a "text" to expect is missing here')
    if not text:
        line.wrong("an empty text is always there")
    if no and not line.has("for"):
        line.wrong('for how long? (expect no "text" for 2s)')
    cycles = line.time() if no else line.within()

    def absent(session: Session, late: bool) -> bool:
        if session.find(text):
            raise Failed(f'"{shown(text)[:80]}" came, and should not have')
        return late

    def present(session: Session, late: bool) -> bool:
        found = session.find(text)
        if late and not found:
            raise Failed(f'"{shown(text)[:80]}" did not come within {seconds(cycles)}\n{tail(session)}')
        return found

    return cycles, None, absent if no else present


def tail(session: Session) -> str:
    """The robot's latest output, with control characters made visible."""
    said = session.heard[session.heard_from :][-TAIL_BYTES:]
    text = "".join(chr(c) if 0x20 <= c < 0x7F else {13: "\\r", 10: "\\n"}.get(c, f"\\x{c:02X}") for c in said)
    return f'    since the last match the robot said: "{text}"'


def _wait(line: Line) -> Meaning:
    return line.time(), None, done


def _button(line: Line) -> str:
    return line.one_of(BUTTONS, "buttons are UP DOWN LEFT RIGHT START MODE")


def _press(line: Line) -> Meaning:
    button = _button(line)
    cycles = line.time() if len(line) else PRESS_MS * CYCLES_PER_MS

    def poll(session: Session, late: bool) -> bool:
        if late and cycles:
            session.release(button)
        return late

    return cycles, lambda session: session.press(button, cycles or NEVER), poll


def _release(line: Line) -> Meaning:
    button = _button(line)
    return at_once(lambda session: session.release(button))


def _reset(line: Line) -> Meaning:
    cycles = PRESS_MS * CYCLES_PER_MS
    return cycles, lambda session: session.press("MODE", cycles), done


def _rc(line: Line) -> Meaning:
    what = "keys are U D L R 1..6, joined by +, or 0"
    keys = words.rc_keys(line.word(what))
    if keys is None:
        line.wrong(what)
    line.skip()
    word, cycles = keys, line.time() if len(line) else 0
    return cycles, lambda session: session.rc_hold(word, cycles) if word and cycles else session.rc_once(word), done


def _power(line: Line) -> Meaning:
    on = line.is_on()
    return at_once(lambda session: session.power(on))


def _battery(line: Line) -> Meaning:
    volts = line.real(0, 20, "volts (0..20) are missing here")
    return at_once(lambda session: session.board.battery(volts))


def _servo(line: Line) -> Meaning:
    what = f"what about the servo? push, load, clear or a fault: {' '.join(FAULTS)}"
    servo = line.servo()
    word = line.one_of(("clear", "push", "load", *FAULTS), what)
    if word == "clear":
        return at_once(lambda session: session.servo(servo).clear())
    if word == "push":
        return _pushed(line, servo, False, "a position 0..1023 is missing here")
    if word == "load":
        load = line.real(-1, 1, "a load -1..1 (of stall torque) is missing here")
        return at_once(lambda session: setattr(session.servo(servo), "outside_load", load))
    if word not in COUNTED_FAULTS and len(line):
        line.wrong(f"{word} lasts until `servo {servo} clear`; for some times: {' '.join(COUNTED_FAULTS)}")
    times = line.number(1, 1000000, "how many times? (servo 5 silent 3 times)") if len(line) else None
    if times and not line.has("times"):
        line.wrong('"times" is missing at the end')
    return at_once(lambda session: session.servo(servo).fault(word, times))


def _push(line: Line) -> Meaning:
    servo = line.servo("a servo ID 0..253 is missing here (push 3 600)")
    return _pushed(line, servo, True, "a position 0..1023 is missing here (push 3 600)")


def _pushed(line: Line, number: int, hold: bool, what: str) -> Meaning:
    position = line.real(0, 1023, what)

    def act(session: Session) -> None:
        servo = session.servo(number)
        servo.held = 0
        servo.push_to(position)
        servo.held = hold

    return at_once(act)


def _let(line: Line) -> Meaning:
    if not line.has("go"):
        line.wrong("let go, or let go of one servo: let go 3")
    number = line.servo("let go of which servo? (let go 3)") if len(line) else None

    def act(session: Session) -> None:
        for servo in session.board.servos if number is None else [session.servo(number)]:
            servo.held = 0

    return at_once(act)


def _panel(line: Line) -> Meaning:
    led = line.one_of(LEDS, "LEDs are POWER TXD RXD AUX MANAGE PROGRAM PLAY")
    on, cycles = line.is_on(), line.within()

    def poll(session: Session, late: bool) -> bool:
        found = (led in session.board.leds) == on
        if late and not found:
            raise Failed("the LED is not lit" if on else "the LED is lit")
        return found

    return cycles, None, poll


def _note(line: Line) -> Meaning:
    text = line.text('a "text" to say is missing here')
    return at_once(lambda session: session.say(f"{seconds(session.board.now_cycles)}: {shown(text)}"))


def _quit(line: Line) -> Meaning:
    return at_once(lambda session: session.end(EXIT_GOOD))


def _quantity(line: Line, name: str) -> Meaning:
    address, count = QUANTITIES[name]
    servo = line.servo()
    if address < 0:
        address = line.number(0, 49, "an address 0..49 is missing here")
    what = "a comparison is missing here: == != < > <= >="
    relation = RELATIONS[line.one_of(tuple(RELATIONS), what)]
    right, cycles = line.real(0, 65535, "a number is missing here"), line.within()

    def poll(session: Session, late: bool) -> bool:
        value = session.servo(servo).register(address, count) if count else session.servo(servo).alarm_bits
        found = bool(relation(value, right))
        if late and not found:
            raise Failed(f"it is {value} after {seconds(cycles)}")
        return found

    return cycles, None, poll


VERBS: dict[str, Callable[[Line], Meaning]] = {
    "send": _send, "expect": _expect, "wait": _wait, "press": _press, "release": _release, "rc": _rc, "power": _power, "reset": _reset,
    "battery": _battery, "servo": _servo, "push": _push, "let": _let, "panel": _panel, "note": _note, "quit": _quit,
}  # fmt: skip


def parse(text: bytes, number: int = 0) -> Step | None:
    """Parses one line. None: the line is empty. ValueError: what is wrong."""
    line = Line(text)
    if not len(line):
        return None
    when = next(((word, line.time()) for word in ("at", "after") if line.has(word)), ("", 0))
    verb = line.word("an action is missing here")
    if verb not in VERBS and verb not in QUANTITIES:
        line.wrong(f"unknown action (known: {' '.join([*VERBS, *QUANTITIES])})")
    line.skip()
    meaning = VERBS[verb](line) if verb in VERBS else _quantity(line, verb)
    if len(line):
        line.wrong("too many words: this one was not expected")
    return Step(number, when, *meaning)


def act_at_once(session: Session, text: bytes) -> str:
    """Performs the action on one line at once. Returns why it was not done, or ""."""
    try:
        step = parse(text)
        if step and step.when[0]:
            return "this is done at once: no `at`, no `after`"
        if step and not step.act:
            return "only scripts wait and expect"
        if step and step.act:
            step.act(session)
    except (ValueError, Failed) as error:
        return str(error)
    return ""


class Script:
    """A script and its progress."""

    def __init__(self, path: str) -> None:
        """OSError: the file cannot be read. ValueError: one line for each mistake."""
        self.path = path
        self._steps: list[Step] = []
        self._next = self._ended = 0
        self._begun: int | None = None
        mistakes = []
        text = Path(path).read_bytes()
        if text.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            raise ValueError(f"{path}: UTF-16 text: in an editor, save it as UTF-8")
        for number, line in enumerate(text.removeprefix(codecs.BOM_UTF8).split(b"\n"), 1):
            try:
                step = parse(line, number)
            except ValueError as error:
                mistakes.append(f"{path}:{number}: {error}")
            else:
                self._steps += [step] if step else []
        if mistakes:
            raise ValueError("\n".join(mistakes))

    @property
    def place(self) -> str:
        return f"{self.path}:{self._steps[self._next].line}"

    def step(self, session: Session) -> int:
        """Does what is due. Returns the latest cycle for the next call. Ends the session at the end of the script."""
        try:
            while self._next < len(self._steps) and not session.done:
                waits_until = self._go_on(session, self._steps[self._next])
                if waits_until is not None:
                    return waits_until
        except Failed as error:
            print(f"{self.place}: at {seconds(session.board.now_cycles)}: {error}", file=sys.stderr)
            session.end(EXIT_EXPECTATION)
        if not session.done:
            session.end(EXIT_GOOD)
        return NEVER

    def _go_on(self, session: Session, step: Step) -> int | None:
        now = session.board.now_cycles
        if self._begun is None:
            due = step.when[1] + (self._ended if step.when[0] == "after" else 0)
            if now < due:
                return due
            self._begun = now
            if step.act:
                step.act(session)
            if session.done:
                return None
        end = self._begun + step.cycles
        if not step.poll(session, now >= end):
            return end
        self._begun, self._ended = None, now
        self._next += 1
        return None
