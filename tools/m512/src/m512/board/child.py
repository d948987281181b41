# SPDX-License-Identifier: MIT
"""Programs that m512 starts: where they are, their first words, and that they end with m512, also after `kill -9`."""

from __future__ import annotations

import ctypes
import os
import re
import select
import shutil
import signal
import sys
import time
from pathlib import Path
from typing import IO, Callable

SET_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of linux/prctl.h


def found(name: str, places: list[Path]) -> Path | None:
    """A program in one of these places, beside this Python interpreter or on the PATH."""
    on_path = shutil.which(name)
    places = [*places, Path(sys.executable).with_name(name)] + ([Path(on_path)] if on_path else [])
    return next((place for place in places if place.exists()), None)


def first_words(output: IO[bytes], seconds: float) -> tuple[str, re.Match[str] | None]:
    """What a program writes until it names its serial port, and the match of that. None: it has closed its output, or the time is over."""
    said, deadline = "", time.monotonic() + seconds
    while time.monotonic() < deadline:
        if select.select([output], [], [], 0.1)[0]:
            some = os.read(output.fileno(), 4096).decode("utf-8", "replace")
            said += some
            match = re.search(r"[^\n]*serial port: (\S+)\s", said)
            if match or not some:
                return said, match
    return said, None


def ending_with_this(number: signal.Signals) -> Callable[[], None] | None:
    """For preexec_fn: Linux sends the child this signal when this process has ended. None on other systems."""
    if sys.platform != "linux":
        return None
    libc, parent = ctypes.CDLL(None), os.getpid()

    def tie() -> None:
        libc.prctl(SET_PARENT_DEATH_SIGNAL, number)
        if os.getppid() != parent:  # it has ended already, and no signal will come
            os._exit(1)

    return tie
