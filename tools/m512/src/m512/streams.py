# SPDX-License-Identifier: MIT
"""Handling of a stream that nobody reads any more: `m512 ... | head`."""

import contextlib
import os
import sys
from typing import TextIO


def end_results() -> None:
    """Drops what stdout still buffers after it has refused a write."""
    drop(sys.stdout)


def drop(stream: TextIO) -> None:
    """Discards what the stream buffers and what follows. Otherwise the flush at exit would fail again, with a traceback."""
    with contextlib.suppress(OSError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
