# SPDX-License-Identifier: MIT
"""Ties a program that m512 starts to m512: it ends with m512, also after `kill -9`."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from typing import Callable

SET_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of linux/prctl.h


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
