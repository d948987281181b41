# SPDX-License-Identifier: MIT
"""The user's terminal: raw mode, meanings of keys, and messages over the robot's screen.

A terminal reports only presses, so a button of the remote or the panel counts as held for a while after its last key press. Messages
appear on the alternate screen, so the robot's screen is unchanged afterwards. Output of the robot waits meanwhile.
"""

from __future__ import annotations

import atexit
import os
import termios
import tty
from contextlib import suppress
from typing import Any

from .console import STDIN, STDOUT, Console

LEAVE, PREFIX, CTRL_C, ESC = 0x1D, 0x14, 0x03, 0x1B  # Ctrl-], Ctrl-T
HELP = """\
Ctrl-]           leave
Ctrl-T h         a hand at the robot: `push 3 600`, `let go`, `battery 7.0`, ...
Ctrl-T v         servos: goal, present position, torque, alarms
Ctrl-T r         keyboard <-> RC-100 (arrows or w s a d; 1..6; space = 6, stop)
Ctrl-T arrow, s  panel buttons Up, Down, Left, Right, START
Ctrl-T m         MODE button (reset)
Ctrl-T p         power off / on
Ctrl-T Ctrl-T    sends Ctrl-T
"""
ANY_KEY = "\n(any key goes back to the robot)"
ARROWS = {"A": "UP", "B": "DOWN", "C": "RIGHT", "D": "LEFT"}
BUTTONS = {"s": "START", "m": "MODE"}
RC_KEYS = {"UP": 1, "w": 1, "DOWN": 2, "s": 2, "LEFT": 4, "a": 4, "RIGHT": 8, "d": 8, " ": 16 << 5} | {str(n): 8 << n for n in range(1, 7)}
OTHER_SCREEN, ROBOTS_SCREEN = "\x1b[?1049h\x1b[0m\x1b[H\x1b[2J", "\x1b[?1049l"
KEEP_TITLE, TITLE_BACK = "\x1b[22;2t", "\x1b[23;2t"
TITLE = "\x1b]2;cm5sim: Ctrl-] ends it, Ctrl-T ? shows its keys\a"
HINT = "Ctrl-] ends the simulator"
ROBOT_ROWS = 35  # of Edit's screen, the largest (edit/ORIGINAL.md section 3)


class Keys:
    """The meaning of bytes from the keyboard. take() returns a kind and its value:

    byte (for the robot), rc (a bit of the remote's word), button (its name), mode (True: the keyboard is now a remote),
    exit, help, power, servos, line (the user wants to type an action), or "" for nothing yet.
    """

    def __init__(self, rc: bool) -> None:
        self.rc = rc
        self._prefixed = False
        self._escape = ""  # received part of an arrow key's sequence

    def take(self, byte: int) -> tuple[str, Any]:
        if not self._prefixed:
            if byte == LEAVE:
                return "exit", None
            if byte == PREFIX:
                self._prefixed, self._escape = True, ""
                return "", None
            if not self.rc:
                return "byte", byte
        key = self._key(byte)
        if key == "":
            return "", None
        if not self._prefixed:
            return ("rc", RC_KEYS[key]) if key in RC_KEYS else ("", None)
        self._prefixed = False
        if byte == PREFIX:
            return "byte", PREFIX
        if key == "r":
            self.rc = not self.rc
            return "mode", self.rc
        if key in BUTTONS or key in ARROWS.values():
            return "button", BUTTONS.get(key, key)
        return {"p": "power", "v": "servos", "h": "line"}.get(key, "help"), None

    def _key(self, byte: int) -> str:
        """Returns a letter in lower case, or the name of an arrow; "": the sequence is not complete."""
        if (not self._escape and byte == ESC) or (self._escape == "\x1b" and byte in b"[O"):
            self._escape += chr(byte)
            return ""
        whole, self._escape = len(self._escape) == 2, ""
        return ARROWS.get(chr(byte), "?") if whole else chr(byte).lower()


class Terminal:
    """Standard input and output of a person. raw: keys arrive one by one. shows: what covers the robot's screen: "" nothing, "note"
    (disappears by itself or at the next key, which still counts), "page" (disappears at the next key, which does nothing else) or "line"
    (being typed)."""

    def __init__(self, console: Console, raw: bool) -> None:
        self._console = console
        self._before: list[Any] | None = None
        if raw and os.isatty(STDIN):
            self._before = termios.tcgetattr(STDIN)
            tty.setraw(STDIN, termios.TCSANOW)
            atexit.register(self.restore)
        term = os.environ.get("TERM", "dumb")
        self.draws = self.raw and not console.stdout_ended and os.isatty(STDOUT) and term != "dumb"
        self._titled = self.draws and not term.startswith("linux")  # the consoles of older kernels would print it
        self.shows = ""
        self.until = 0  # cycle at which a note disappears
        self._line = bytearray()
        self._escape = 0  # last byte of a sequence being skipped
        self._hint_at_start = 0
        if self._titled:
            self.add(KEEP_TITLE + TITLE)

    @property
    def raw(self) -> bool:
        return self._before is not None

    def restore(self) -> None:
        before, self._before = self._before, None
        if before is not None:
            with suppress(termios.error):  # the window was closed: there is no terminal any more
                termios.tcsetattr(STDIN, termios.TCSADRAIN, before)

    def leave_screen(self) -> None:
        """Leaves the robot's screen: further output appears below it."""
        self.hide()
        if self.draws and self._console.draws:
            self._console.draws = False
            self.add("\x1b[0m\x1b[999;1H\n")  # normal attributes, last line

    def close(self) -> None:
        self.leave_screen()
        if self._titled:
            self.add(TITLE_BACK)
        self._titled = False
        self.restore()

    def add(self, text: str) -> None:
        self._console.write_stdout(text.replace("\n", "\r\n").encode())

    def show(self, kind: str, text: str) -> None:
        self._console.hold()
        self.shows, self._escape = kind, 0
        self._line.clear()
        self.add(OTHER_SCREEN + text + (ANY_KEY if kind == "page" else ""))

    def hide(self) -> None:
        if self.shows:
            self.shows = ""
            self.add(ROBOTS_SCREEN)
            self._console.let_go()

    def type(self, byte: int) -> bytes | None:
        """Takes a byte of the line being typed. Returns the line when it is complete."""
        if self._is_skipped(byte):
            return None
        if byte in b"\r\n":
            return bytes(self._line)
        gone = len(self._line) if byte == 0x15 else int(byte in b"\b\x7f" and len(self._line) > 0)  # Ctrl-U, Backspace
        if gone:
            del self._line[-gone:]
            self.add("\b \b" * gone)
        elif 0x20 <= byte < 0x7F:
            self._line.append(byte)
            self.add(chr(byte))
        return None

    def _is_skipped(self, byte: int) -> bool:
        """Skips cursor keys and the like: ESC, "[" or "O", then up to a letter or "~"."""
        before, self._escape = self._escape, 0
        if before == ESC:
            self._escape = byte if byte in b"[O" else 0
        elif before:
            self._escape = before if byte < 0x40 else 0
        elif byte == ESC:
            self._escape = ESC
        return bool(before or byte == ESC)

    def hint(self, start: int) -> None:
        """Writes into the last row how to leave, after the robot has redrawn its screen and is silent. It appears after every redraw if the
        terminal has a row below the robot's screen, else once for each start of the robot, until the robot writes there."""
        self._console.cleared = False
        columns, rows = os.get_terminal_size(STDOUT)
        if columns >= 2 * len(HINT):
            if rows > ROBOT_ROWS or start != self._hint_at_start:
                self.add(f"\x1b7\x1b[{rows};{columns + 1 - len(HINT)}H{HINT}\x1b8")  # returns the cursor to where the robot put it
            self._hint_at_start = start
