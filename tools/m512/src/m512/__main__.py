# SPDX-License-Identifier: MIT
"""The program `m512`, also `python -m m512`: the command line, and signals before and after it."""

import signal
import sys


def main() -> None:
    """Runs the command line. Before the command begins and once it is done, a signal ends the program at once: an exception in the
    middle of an import, or of Python's own end, would be shown and could be lost."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from m512.signals import ENDING, settle

    try:
        from m512.streams import fill_closed

        fill_closed()
        from m512.cli import main as command_line

        try:
            command_line()
        finally:
            settle()
    except KeyboardInterrupt:
        print("m512: stopped", file=sys.stderr)
        sys.exit(130)
    finally:
        for number in ENDING:
            if signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, signal.SIG_DFL)


if __name__ == "__main__":
    main()
