# SPDX-License-Identifier: MIT
"""`m512 doctor`."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import click

from m512 import ui
from m512.cli.board import json_option, only_the_simulator, port_option
from m512.errors import EXIT_DIFFERENT

if TYPE_CHECKING:
    from m512.board.doctor import Finding


@click.command(
    epilog="""\b
Examples:
  m512 doctor
  m512 doctor -p /dev/ttyUSB0 --json
  m512 doctor -p bus:/dev/ttyUSB0           servos on an adapter, without a board
  m512 doctor -p bus:/dev/ttyUSB0 --mend    moves servos that have another rate to 1 Mbps"""
)
@port_option
@click.option("--sim", is_flag=True, help="Examine the simulator.")
@click.option("--mend", is_flag=True, help="With -p bus:...: give servos the rate, and a return delay that is too short its factory value.")
@json_option
def doctor(port: str, sim: bool, mend: bool, as_json: bool) -> None:
    """Look at port, boot loader, image, servos and motions, and say what is wrong and what to do.

    Nothing is written (but with --mend) and nothing moves. Exit code 3 when something is bad.
    """
    from m512.board.bus import is_bus
    from m512.board.doctor import BAD, examine

    def tell(finding: Finding) -> None:
        if not as_json:
            mark = {"ok": "ok  ", "look": "look", "bad": "BAD "}[finding.state]
            ui.show(f"{mark} {finding.what:11} {finding.text}")
            if finding.advice:
                ui.show(f"                 -> {finding.advice}")

    if mend and not is_bus(port):
        raise click.UsageError("--mend is for -p bus:...")
    if sim:
        only_the_simulator()
    if is_bus(port) and not sim:
        from m512.board import bus_doctor

        found = bus_doctor.examine(port, tell, mend)
    elif sim:
        from m512.board.sim import Simulator, meet

        with Simulator("play-cm5.hex") as simulator:
            found = examine(simulator.url, tell, meet)
    else:
        found = examine(port, tell)
    if as_json:
        ui.show(json.dumps([finding.as_dict() for finding in found], indent=2))
    raise SystemExit(EXIT_DIFFERENT if any(finding.state == BAD for finding in found) else 0)
