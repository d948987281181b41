# SPDX-License-Identifier: MIT
"""The first thing that is said on a line. Nobody knows what was typed there before. In Edit a name, a question, a list or a play may be
open, and a request would become the name, answer the question or stop the play. So `@` comes first, alone, and what comes back tells who
has taken it (firmware/edit/editor_keys.c):

    a line end      Edit's table, or a list: a request has begun
    "@"             a line: a name or a command in Edit, or the prompt of Play, of Monitor or of a boot loader
    only drawing    a play that was typed into Edit. It passes over `@`, but an Enter would stop it: nothing more is sent
    nothing         a request has begun while Edit's screen was away; or a question of Edit waits, or nobody is there

Then the line is emptied and ended: a name stays as it was, a question is answered no, a half-typed command is not run.
"""

from __future__ import annotations

import re

from m512 import ui
from m512.board.factory import KNOCK
from m512.board.link import Link
from m512.errors import RefusedError

# A question of Edit passes over what comes close behind another byte; NUL means nothing anywhere.
WHO = b"\0@"
# A boot loader's knock rubs out 100 characters, lines of Edit hold 111: Ctrl-U empties those. To a loader it is a letter, echoed and rubbed out.
CTRL_U = b"\x15"
EMPTY = CTRL_U + KNOCK
STOP, BREAK = b"\r", b"\x03"  # keys that end a play in Edit: through its exit page; at once
SILENT_SECONDS = 0.5  # a play draws every 0.24 s, and oftener with more than one joint
DRAWING_SECONDS = 2.0  # the whole screen takes half a second
STOPPING_SECONDS = 60.0
RUBBED_OUT = b"\x08 \x08"

PLAYS = (
    "Edit plays what was typed into its terminal (or asks something there while limp joints are moved). m512 has left it alone: wait "
    "until it ends, or end it with `m512 stop` (--now: at once)"
)


def make(link: Link, end: bytes = b"") -> None:
    """Behind it a request may be sent. What was open is told in a note. end: STOP or BREAK, for a play that was typed into Edit; without it
    such a play goes on, and RefusedError is raised."""
    link.drain(0.02, 0.5)
    heard = _ask_who(link, DRAWING_SECONDS)
    if _plays(heard) and end:
        ui.say("note: Edit plays what was typed into its terminal; it ends now")
        link.write(end)
        heard = _ask_who(link, STOPPING_SECONDS)
    if _plays(heard):
        raise RefusedError(PLAYS)
    link.write(EMPTY)
    _tell(heard, link.drain(0.05, 0.5))


def _plays(heard: bytes) -> bool:
    return b"\x1b[" in heard and not re.search(rb"[@\n]", heard)


def _ask_who(link: Link, seconds: float) -> bytes:
    """What comes back for `@`. While that is only drawing it is asked again, for so long: what draws may end."""
    deadline = link.now() + seconds
    while True:
        link.write(WHO)
        heard, again = b"", link.now() + SILENT_SECONDS
        while not re.search(rb"[@\n]", heard) and link.now() < again:
            some = link.read_some(SILENT_SECONDS)
            if not some:
                break
            heard += some
        if not _plays(heard) or link.now() >= deadline:
            return heard


def _tell(heard: bytes, answer: bytes) -> None:
    """Says what was open."""
    if b"Name kept" in answer:
        ui.say("note: Edit was waiting for a name: the page keeps the one that it has")
    elif not heard and re.match(rb"[\x00\x11\x13]* no\b", answer):
        ui.say('note: Edit was asking "Are you sure?": it was told no, and nothing was done')
    elif answer.count(RUBBED_OUT) > heard.count(b"@") + answer.count(CTRL_U):
        ui.say("note: a half-typed line in the board's terminal was not run")
