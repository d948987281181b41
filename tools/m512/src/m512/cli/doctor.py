# SPDX-License-Identifier: MIT
"""`m512 doctor`."""
from __future__ import annotations

import json

import click

from m512 import ui
from m512.cli.board import json_option, port_option
from m512.errors import EXIT_DIFFERENT


@click.command(epilog="""\b
Examples:
  m512 doctor
  m512 doctor -p /dev/ttyUSB0 --json""")
@port_option
@click.option("--sim", is_flag=True, help="Examine the simulator.")
@json_option
def doctor(port, sim, as_json):
    """Look at port, boot loader, image, servos and motions, and say what is wrong and what to do.

    Nothing is written and nothing moves. Exit code 3 when something is bad.
    """
    from m512.board.doctor import BAD, examine

    def tell(finding):
        if not as_json:
            mark = {"ok": "ok  ", "look": "look", "bad": "BAD "}[finding.state]
            ui.show(f"{mark} {finding.what:11} {finding.text}")
            if finding.advice:
                ui.show(f"                 -> {finding.advice}")

    if sim:
        from m512.board.sim import Simulator, meet

        with Simulator(["play-cm5.hex"]) as simulator:
            found = examine(simulator.url, tell, meet)
    else:
        found = examine(port, tell)
    if as_json:
        ui.show(json.dumps([finding.as_dict() for finding in found], indent=2))
    raise SystemExit(EXIT_DIFFERENT if any(finding.state == BAD for finding in found) else 0)
