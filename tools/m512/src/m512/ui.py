# SPDX-License-Identifier: MIT
"""User interaction: remarks on stderr, a progress bar on a terminal, questions."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Callable

import click

from m512.errors import FileError, RefusedError
from m512.streams import drop, is_terminal, reader_has_gone

Progress = Callable[[int, int], None]
PhaseMaker = Callable[[str], AbstractContextManager[Progress]]
_has_bar = False  # a progress bar stands at the start of the terminal's line
_unread = False  # the reader of remarks has gone, and they are dropped since


def plain(text: str) -> str:
    """Text with control characters escaped: text from a board or a file must not control the terminal."""
    return "".join(char if char in "\n\t" or char.isprintable() else f"\\x{ord(char):02X}" for char in text)


def show(text: str) -> None:
    """Prints a result to stdout. FileError: stdout is closed (`>&-`)."""
    if sys.stdout is None:
        raise FileError("standard output is closed: the result is lost")
    click.echo(plain(text))


def say(text: str) -> None:
    """Prints a remark to stderr; stdout is for results. The work continues when stderr cannot be written (`2>&1 | head`, a full disk)."""
    global _unread
    try:
        click.echo("\n" * _has_bar + plain(text), err=True)
    except OSError as error:
        _unread = isinstance(error, BrokenPipeError)
        drop(sys.stderr)


def is_unread() -> bool:
    """Whether nobody can read remarks any more: the reader of a pipe has gone (`2>&1 | head`)."""
    return _unread or reader_has_gone(sys.stderr)


@contextmanager
def phase(title: str) -> Iterator[Progress]:
    """`with phase("Writing") as progress: ... progress(done, total)`. A bar on a terminal, else a line every 10 s."""
    global _has_bar
    if is_terminal(sys.stderr):
        try:
            with click.progressbar(length=1000, label=f"{title:12}", file=sys.stderr) as bar:
                _has_bar = True
                yield lambda done, total: bar.update(1000 * done // max(total, 1) - bar.pos)
        finally:
            _has_bar = False
        return
    last = [time.monotonic()]

    def line(done: int, total: int) -> None:
        if time.monotonic() - last[0] > 10 and total:
            last[0] = time.monotonic()
            say(f"{title}: {100 * done // total} %")

    yield line


def unseen(_done: int, _total: int) -> None:
    """The Progress of work that shows none."""


def confirm(question: str, yes: bool) -> None:
    """Continues only after a yes. Without a terminal it needs --yes. RefusedError: a no, or nobody to ask."""
    if yes:
        return
    if not is_terminal(sys.stdin):
        raise RefusedError(f"{question} Nobody can be asked here: say --yes")
    if not click.confirm(question, default=False, err=True):
        raise RefusedError("nothing was changed")
