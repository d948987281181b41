# SPDX-License-Identifier: MIT
"""The command line. Each command's module is imported when the command runs: `m512 --help` reads only this file."""

from __future__ import annotations

import signal
import sys
from typing import Any

import click

from m512 import __version__, signals

# name -> (module, first line of help). The order is the order of `m512 --help`.
COMMANDS = {
    "doctor": ("doctor", "Look at port, loader, image, servos and motions; say what to do."),
    "term": ("term", "A terminal, good for Edit's full screen."),
    "flash": ("board", "Write code or motions into the board and read them back."),
    "run": ("board", "The same, then start; without a file: start what is there."),
    "backup": ("board", "Read motions, EEPROM and application into a folder."),
    "restore": ("board", "Show what a backup would change, ask, and write it."),
    "play": ("robot", "Play a page of the board, or of the simulator."),
    "stop": ("robot", "Stop what is playing, softly or at once."),
    "shape": ("shape", "Speed, size and turn of the motion that plays."),
    "drive": ("shape", "Play a page and drive it by keys."),
    "layer": ("layers", "Play a second page over it, on joints of its own."),
    "aim": ("layers", "Bring joints to positions while everything else goes on."),
    "swing": ("layers", "Swing a joint to and fro, likewise."),
    "free": ("layers", "End aim and swing."),
    "pose": ("robot", "Show the pose, or move joints."),
    "torque": ("robot", "Switch torque on or off."),
    "get": ("robot", "Read pages from a running board into a file."),
    "put": ("robot", "Save pages of a file to the board, through Edit."),
    "convert": ("files", "Convert motions between image, Intel HEX, .mtn and text."),
    "pages": ("pages", "List, check, edit, merge and retime pages of a file or a board."),
    "diff": ("files", "Say in words how two motion files (or boards) differ."),
}


class LazyGroup(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, name: str) -> Any:
        if name not in COMMANDS:
            return None
        from importlib import import_module

        return getattr(import_module(f"m512.cli.{COMMANDS[name][0]}"), name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, text) for name, (_, text) in COMMANDS.items()])

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Reports every OSError in one sentence, wherever it occurs: a full disk behind --help, a name of 300 letters."""
        try:
            return super().main(*args, **kwargs)
        except OSError as error:
            from m512.errors import EXIT_BAD_FILE
            from m512.streams import end_results
            from m512.ui import say

            end_results()
            say(f"m512: {error.strerror or error}" + (f": {error.filename}" if error.filename else ""))
            sys.exit(EXIT_BAD_FILE)

    def invoke(self, ctx: click.Context) -> Any:
        from m512.errors import EXIT_CANCELLED, M512Error

        signals.end_with_exceptions()  # the simulator and a driven robot must not outlive this program
        try:
            return super().invoke(ctx)
        except M512Error as error:
            from m512.ui import say

            say(f"m512: {error}")
            sys.exit(error.exit_code)
        except (KeyboardInterrupt, click.Abort):
            click.echo("m512: stopped", err=True)
            sys.exit(EXIT_CANCELLED)
        except signals.SignalExit as end:
            if end.number == signal.SIGTERM:  # after SIGHUP there is no terminal to read it
                click.echo("m512: stopped by SIGTERM", err=True)
            raise
        except BrokenPipeError:  # the reader of the results has gone, as with `| head`: an early end, not a success
            from m512.streams import end_results

            end_results()
            sys.exit(128 + 13)


@click.group(
    cls=LazyGroup,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog="Exit codes: 0 done, 2 wrong command line, 3 differences or faults found, 4 bad file or empty page, 5 refused, "
    "6 port lost or not there, 7 no answer, 8 error answer of the board or a motion that it has broken off, 9 something not "
    "installed, 130 Ctrl-C, "
    "141 the reader of the results has gone (| head).",
)
@click.version_option(__version__, prog_name="m512")
def main() -> None:
    """Motions, firmware and terminal of CM-2/CM-5 robot controllers.

    \b
    Without a robot:  m512 convert walk.m512 walk.bin     m512 pages walk.bin list
    With a robot:     m512 term                           m512 flash play-cm5.hex
    """
