# SPDX-License-Identifier: MIT
"""The command cm5sim: the simulated robot at a terminal, on ports, or under a script. `cm5sim --help` and ../../README.md say what it does."""

from __future__ import annotations

import signal
import sys
import threading
from typing import TYPE_CHECKING

from . import options as opt
from .options import Options

if TYPE_CHECKING:
    from .script import Script
    from .session import Session

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Stop:
    """Ends a run between two slices when a signal arrives. A thread waits for the signal, because an interrupted system call makes simavr's
    GDB server wait for a client forever."""

    def __init__(self) -> None:
        self.asked = False
        self._session: Session | None = None  # the running session
        self._lock = threading.Lock()  # prevents closing a session while the thread interrupts it
        signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
        threading.Thread(target=self._wait, daemon=True).start()

    def _wait(self) -> None:
        signal.sigwait(SIGNALS)
        self.asked = True
        self._interrupt()

    def _interrupt(self) -> None:
        with self._lock:
            if self._session and self.asked:
                self._session.interrupt()

    def begin(self, session: Session) -> None:
        """Lets a signal end this session, even one that arrived earlier."""
        with self._lock:
            self._session = session
        self._interrupt()

    def end(self) -> None:
        """Nothing interrupts the session after this: it may be closed."""
        with self._lock:
            self._session = None


def main() -> None:
    stop = Stop()
    try:
        sys.exit(run(opt.parse(sys.argv[1:]), stop))
    except OSError as error:
        from .files import reason

        print(f"cm5sim: {reason(error)}", file=sys.stderr)
        sys.exit(opt.EXIT_FILE)


def run(options: Options, stop: Stop) -> int:
    """Returns the exit code. OSError: a file or port cannot be used."""
    from .files import kept_files
    from .script import Script

    try:
        script = Script(options.script) if options.script else None
    except ValueError as mistakes:
        print(mistakes, file=sys.stderr)
        return opt.EXIT_USAGE
    with kept_files(options):
        if options.bus_pty is None:
            return run_board(options, stop, script)
        from . import bus

        return bus.main(options, lambda: stop.asked)


def run_board(options: Options, stop: Stop, script: Script | None) -> int:
    from .session import Session

    watch = None
    if options.body:
        from .in_body import Watch

        watch = Watch(options.body, options.view, [servo.id for servo in options.servos])
    session = Session(options, script, watch)
    opened = False
    try:
        session.open()
        opened = True
        stop.begin(session)
        session.run()
    finally:
        stop.end()
        session.close(opened)
    if watch:
        watch.report()
    return session.exit_code
