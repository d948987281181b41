# SPDX-License-Identifier: MIT
"""A stream that nobody reads any more: `m512 ... | head`."""

import contextlib
import os
import sys
from typing import TextIO


def end_results() -> None:
    """After stdout has refused something: what still waits for it is dropped."""
    drop(sys.stdout)


def drop(stream: TextIO) -> None:
    """What waits for a stream that refuses it, and what comes, is lost: it would be refused again at the end, with a traceback."""
    with contextlib.suppress(OSError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
