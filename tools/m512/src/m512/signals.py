# SPDX-License-Identifier: MIT
"""The signals that end the program: SIGINT (Ctrl-C), SIGTERM, SIGHUP. Each becomes an exception in the main thread.

Python drops an exception out of a callback of its own, such as __del__, and the program would go on. Within an import an exception may
also become another one (before Python 3.12 a RuntimeError, out of __set_name__). So a signal during an import waits until
it is done, and one that is dropped all the same is raised again.
"""

from __future__ import annotations

import signal
import sys
import threading
from types import FrameType
from typing import Any

ENDING = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
AGAIN_S = 0.01

_again: list[threading.Timer] = []  # each raises its signal again


class SignalExit(SystemExit):
    """SIGTERM or SIGHUP: ends with 128 + its number, as in shells."""

    def __init__(self, number: int) -> None:
        super().__init__(128 + number)
        self.number = number


def _end(number: int, frame: FrameType | None) -> None:
    if _is_importing(frame):
        _raise_again(number)
    elif number == signal.SIGINT:
        raise KeyboardInterrupt
    else:
        raise SignalExit(number)


def _is_importing(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_globals.get("__name__") == "importlib._bootstrap":
            return True
        frame = frame.f_back
    return False


def _send(number: int) -> None:
    if hasattr(signal, "pthread_kill"):  # it also wakes a main thread that waits, as for an answer of the user
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        signal.raise_signal(number)


def _raise_again(number: int) -> None:
    again = threading.Timer(AGAIN_S, _send, (number,))
    again.daemon = True
    _again.append(again)
    again.start()


def _dropped(dropped: Any) -> None:
    if isinstance(dropped.exc_value, SignalExit):
        _raise_again(dropped.exc_value.number)  # here it would be dropped once more
    elif issubclass(dropped.exc_type, KeyboardInterrupt):
        _raise_again(signal.SIGINT)
    else:
        sys.__unraisablehook__(dropped)


def settle() -> None:
    """Call this before something is written, and at the end. A signal that waits or was dropped ends the program here."""
    for again in _again:
        again.join()


def end_with_exceptions() -> None:
    """From now on a signal raises KeyboardInterrupt or SignalExit. One that nohup has set to be ignored stays ignored."""
    sys.unraisablehook = _dropped
    for number in ENDING:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _end)
