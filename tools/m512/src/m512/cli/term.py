# SPDX-License-Identifier: MIT
"""`m512 term`: the terminal."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from m512 import ui
from m512.cli.board import FilePath, only_the_simulator, port_option, refuse_words
from m512.errors import MissingError


@click.command(
    epilog="""\b
Examples:
  m512 term                         the only port there is
  m512 term -p ttyUSB0 --log session.txt
  m512 term --list"""
)
@port_option
@click.option("--log", type=FilePath(), help="Write all that the board sends to this file.")
@click.option("--force", is_flag=True, help="Overwrite the file of --log.")
@click.option("--send", type=FilePath(), help="Send this file first (as typed; a line at a time).")
@click.option("--list", "listing", is_flag=True, help="List the ports and end.")
@click.option("--sim", is_flag=True, help="Start the simulator with Edit instead of using a port.")
@click.option("--motions", type=FilePath(), help="With --sim: motion file of any kind.")
@click.option("--image", default="edit-cm5.hex", show_default=True, help="With --sim or -p bus:...: the firmware.")
def term(port: str, log: Path | None, force: bool, send: Path | None, listing: bool, sim: bool, motions: Path | None, image: Any) -> None:
    """A terminal at 57,600 baud, good for Edit's full screen.

    Everything typed goes to the board, but for Ctrl-]: then h shows help, q quits, l calls the boot loader with '#',
    s sends a file, b a file as it is (binary), g switches logging. Any key ends a call or a sending.
    """
    from m512.board import ports
    from m512.board.bus import is_bus
    from m512.board.terminal import Terminal
    from m512.files import storage

    data = storage.read(send) if send else b""  # file errors are reported before the board is touched
    if log:
        storage.must_be_free(log, force)
    if listing:
        for device, text in ports.available():
            ui.show(f"{device}  {text}".rstrip())
        return
    if motions and not sim:
        raise click.UsageError("--motions is for --sim; a robot gets its motions with `m512 flash` or `put`")
    if sim:
        only_the_simulator()
        from m512.board.sim import Simulator

        with Simulator(image, motions) as simulator:
            Terminal(simulator.url, log, force=force).run(send, data)
        return
    if not is_bus(port):
        refuse_words({"image"}, "is for --sim or -p bus:...")
    program = next((name for name in ("play", "edit") if name in image), None)
    if not program:
        raise MissingError(f"no program for an adapter is called {image!r}: --image play or edit")
    Terminal(ports.pick(port), log, program, force).run(send, data)
