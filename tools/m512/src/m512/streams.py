# SPDX-License-Identifier: MIT
"""Standard streams that nobody reads any more (`m512 ... | head`) or that are closed (`2>&-`)."""

from __future__ import annotations

import contextlib
import os
import select
import stat
import sys
from typing import TextIO


def fill_closed() -> None:
    """Opens a descriptor that is closed, on nothing. Otherwise the next file that is opened would become that stream. sys.stdin and
    sys.stdout stay None."""
    while (number := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(number, True)
    os.close(number)
    if sys.stderr is None:
        sys.stderr = os.fdopen(2, "w", closefd=False)


def is_terminal(stream: TextIO | None) -> bool:
    """False also for a closed stream."""
    return stream is not None and stream.isatty()


def reader_has_gone(stream: TextIO | None) -> bool:
    """Whether the stream is a pipe whose reader has gone. False where this cannot be told: another system, another kind of stream."""
    try:
        number = stream.fileno() if stream else -1
        if number < 0 or not stat.S_ISFIFO(os.fstat(number).st_mode) or not hasattr(select, "poll"):
            return False
        poll = select.poll()
        poll.register(number, 0)
        return any(event & select.POLLERR for _, event in poll.poll(0))
    except (OSError, ValueError):
        return False


def end_results() -> None:
    """Drops what stdout still buffers after it has refused a write."""
    drop(sys.stdout)


def drop(stream: TextIO) -> None:
    """Discards what the stream buffers and what follows. Otherwise the flush at exit would fail again, with a traceback."""
    with contextlib.suppress(OSError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
