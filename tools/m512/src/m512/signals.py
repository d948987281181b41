# SPDX-License-Identifier: MIT
"""The signals that end the program: SIGINT (Ctrl-C), SIGTERM, SIGHUP. Each becomes an exception in the main thread.

Python drops an exception out of a callback of its own, such as one behind an import or __del__, and the program would go on. So
imports are done with signals held back, and what is dropped all the same is raised again.
"""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

ENDING = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
AGAIN_S = 0.01

_dropped: list[threading.Timer] = []  # each raises its signal again


class SignalExit(SystemExit):
    """SIGTERM or SIGHUP: ends with 128 + its number, as in shells."""

    def __init__(self, number: int) -> None:
        super().__init__(128 + number)
        self.number = number


def _end(number: int, _: Any) -> None:
    raise SignalExit(number)


def _raise_again(dropped: Any) -> None:
    if isinstance(dropped.exc_value, SignalExit):
        number = dropped.exc_value.number
    elif issubclass(dropped.exc_type, KeyboardInterrupt):
        number = signal.SIGINT
    else:
        sys.__unraisablehook__(dropped)
        return
    again = threading.Timer(AGAIN_S, signal.raise_signal, (number,))  # here it would be dropped once more
    again.daemon = True
    _dropped.append(again)
    again.start()


def settle() -> None:
    """Call this before something is written, and at the end. A signal that Python has dropped ends the program here."""
    for again in _dropped:
        again.join()


def end_with_exceptions() -> None:
    """From now on a signal raises KeyboardInterrupt or SignalExit. One that nohup has set to be ignored stays ignored."""
    sys.unraisablehook = _raise_again
    for number in ENDING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler if number == signal.SIGINT else _end)


@contextmanager
def held_back() -> Iterator[None]:
    """Signals in the block act behind it. Not on Windows."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
