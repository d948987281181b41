# SPDX-License-Identifier: MIT
"""`m512 layer`, `aim`, `swing`, `free`: commands that move single joints on top of the motion that plays (Play)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from m512 import ui
from m512.cli.files import id_list
from m512.cli.robot import ID_MAX, ids_argument, in_json, must_be_there, positions_of, robot, robot_options
from m512.errors import BoardError

if TYPE_CHECKING:
    from m512.board.client import Client
    from m512.files.page import Page

SECOND_MS = 1000
AMPLITUDES = (0, 511)
AIMED_MOST = 4  # joints that code can move at the same time
APPROACH_SECONDS = 60.0


def must_last(what: str, options: dict[str, Any]) -> None:
    """RefusedError if the robot's program would end with this command."""
    from m512.board import bus

    bus.refuse_lasting(options["port"] or "", what)


def past_approach(client: Client) -> None:
    """Waits while the robot is on its way to a first pose, as right after `m512 play`: Play refuses layers, aims and swings then."""
    until = client.link.now() + APPROACH_SECONDS
    while client.where()["state"] in ("ready", "approach") and client.link.now() < until:
        client.link.sleep(0.1)


def show_shape(client: Client, as_json: bool) -> None:
    """Prints the current shape."""
    found = client.shape()
    if as_json:
        ui.show(in_json(found))
    else:
        ui.show("  ".join(f"{word} {value}" for word, value in found.items()))


@click.command(
    epilog="""\b
Examples:
  m512 layer wave_over                waves while the robot walks
  m512 layer wave --joints 1,3,5      of another page these joints alone
  m512 layer off                      its joints go back to the motion below"""
)
@click.argument("page", metavar="PAGE|off")
@click.option("--joints", help="IDs (1..6 or 1,3,5). Default: those that the page's first step uses.")
@robot_options
def layer(page: str, joints: Any, **options: Any) -> None:
    """Play a second PAGE over the one that plays, on joints of its own; all others go on as without it."""
    chosen = [] if joints is None else id_list(joints)
    if page == "off" and chosen:
        raise click.UsageError("--joints belongs to a page; `layer off` ends the whole layer")
    must_last("a layer", options)
    with robot(options) as client:
        number = "off" if page == "off" else client.motion(page)
        if page != "off":
            past_approach(client)
        client.ask(" ".join(map(str, ["layer", number, *chosen])))
        show_shape(client, options["as_json"])
        if chosen:
            _tell_resting(int(number), client.page(int(number)), chosen)


def _tell_resting(number: int, page: Page, joints: Sequence[int]) -> None:
    """A joint that the layer takes and its page never uses stands still, also in the middle of a walk."""
    from m512.files.page import is_used

    resting = [joint for joint in joints if not any(is_used(page.word(step, joint)) for step in page.poses(number))]
    if resting:
        ui.say(f"note: page {number} never moves joint {', '.join(map(str, resting))}: it stays where it is until `m512 layer off`")


@click.command(
    epilog="""\b
Examples:
  m512 aim 19:30deg                   the head looks to the left, also while the robot walks
  m512 aim 19:512 20:600 --speed 120"""
)
@click.argument("positions", nargs=-1, required=True, metavar="ID:POSITION...")
@click.option("--speed", metavar="DEG/S", type=click.IntRange(1, 360), help="Largest speed. Default: that of the approach.")
@robot_options
def aim(positions: Sequence[str], speed: int | None, **options: Any) -> None:
    """Bring joints to positions (0..1023, or 30deg from the centre) and hold them there, up to four, until `free`."""
    wanted = positions_of(positions)
    if len(wanted) > AIMED_MOST:
        raise click.UsageError(f"{len(wanted)} joints: code moves {AIMED_MOST} at once at most")
    must_last("an aim", options)
    with robot(options) as client:
        must_be_there(client, wanted)
        past_approach(client)
        held: list[int] = []
        for joint, at in wanted.items():
            try:
                client.ask(f"aim {joint} {at}" + (f" {speed}" if speed else ""))
            except BoardError as error:
                told = f". Code holds joint {', '.join(map(str, held))} now (`m512 free` ends that)" if held else ""
                raise BoardError(f"joint {joint}: {error}{told}", error.number) from None
            held.append(joint)
        show_shape(client, options["as_json"])


@click.command(
    epilog="""\b
Examples:
  m512 swing 19 512 30deg 4s          the head turns 30 degrees to either side, in four seconds
  m512 swing 20 512 60 2s --phase 90  begins where it is highest"""
)
@click.argument("joint", type=click.IntRange(0, ID_MAX), metavar="ID")
@click.argument("centre", metavar="CENTRE")
@click.argument("amplitude", metavar="AMPLITUDE")
@click.argument("period", metavar="PERIOD")
@click.option("--phase", type=click.IntRange(0, 359), default=0, metavar="DEG", help="Where in the sine it begins.")
@robot_options
def swing(joint: Any, centre: Any, amplitude: str, period: Any, phase: Any, **options: Any) -> None:
    """Swing a joint about CENTRE by AMPLITUDE (units, or 30deg), once in PERIOD (2s, 1500ms), until `free`."""
    (at,) = positions_of([f"{joint}:{centre}"]).values()
    line = f"swing {joint} {at} {_amplitude(amplitude)} {_milliseconds(period)}" + (f" {phase}" if phase else "")
    must_last("a swing", options)
    with robot(options) as client:
        past_approach(client)
        client.ask(line)
        show_shape(client, options["as_json"])


@click.command(
    epilog="""\b
Examples:
  m512 free              all joints that aim and swing move
  m512 free 19 20"""
)
@ids_argument
@robot_options
def free(ids: list[int], **options: Any) -> None:
    """End `aim` and `swing`: joints go back to the motion that plays, or stay where they are."""
    with robot(options) as client:
        client.ask(" ".join(map(str, ["free", *ids])))
        show_shape(client, options["as_json"])


def _amplitude(text: str) -> int:
    """Servo units, from text such as 30deg or 100."""
    found = re.fullmatch(r"([0-9]{1,9}(?:\.[0-9]{0,9})?)(deg)?", text)
    units = -1 if not found or not found.group(2) and "." in text else round(float(found.group(1)) * (1024 / 300 if found.group(2) else 1))
    if not AMPLITUDES[0] <= units <= AMPLITUDES[1]:
        raise click.UsageError(f"{text}: an amplitude is {AMPLITUDES[0]}..{AMPLITUDES[1]} servo units, or degrees as 30deg")
    return units


def _milliseconds(text: str) -> int:
    """Milliseconds, from text such as 2s or 1500ms."""
    found = re.fullmatch(r"([0-9]{1,9}(?:\.[0-9]{0,9})?)(ms|s)", text)
    if found:
        return round(float(found.group(1)) * (1 if found.group(2) == "ms" else SECOND_MS))
    raise click.UsageError(f"{text}: a period is seconds or milliseconds, such as 2s or 1500ms")
