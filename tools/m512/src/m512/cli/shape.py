# SPDX-License-Identifier: MIT
"""`m512 shape`, `drive`: change the speed, size and turn of the motion that plays."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import click

from m512 import ui
from m512.cli.layers import must_last, show_shape
from m512.cli.robot import STOPPED, apply, broken_off, robot, robot_options, shape_options
from m512.errors import CancelledError, NoAnswerError, PortError
from m512.streams import is_terminal

if TYPE_CHECKING:
    from m512.board.driving import Keys, Stick


@click.command(
    epilog="""\b
Examples:
  m512 shape                          what is in force
  m512 shape --rate 120 --blend -30   a fifth faster, a curve to the left
  m512 shape --reset                  everything as stored"""
)
@shape_options
@click.option("--reset", is_flag=True, help="Everything as stored on the board.")
@robot_options
def shape(rate: int | None, amplitude: int | None, blend: int | None, reset: bool, **options: Any) -> None:
    """Show or change the speed, size and turn of the motion that plays (Play)."""
    if reset or (rate, amplitude, blend) != (None, None, None):
        must_last("a shape", options)
    with robot(options) as client:
        if reset:
            client.ask("shape reset")
        apply(client, rate, amplitude, blend)
        show_shape(client, options["as_json"])


@click.command(
    epilog="""\b
Examples:
  m512 drive walk                keys of the terminal; keep a or d (or an arrow) pressed to steer
  m512 drive walk --layer wave_over       f lays a second page over it: it waves while it walks"""
)
@click.argument("page")
@click.option("--layer", "laid", metavar="PAGE", help="Key f lays this page over the walk.")
@robot_options
def drive(page: str, laid: Any, **options: Any) -> None:
    """Play PAGE and drive it: a joystick at 20 lines a second.

    When the cable is lost or m512 ends, the board stops the play through its exit page.
    """
    from m512.board import driving

    with robot(options) as client:
        client.shape()  # Edit refuses this; it would play the page but could not be driven
        number, second = client.motion(page), client.motion(laid) if laid else 0
        with _keys() as keys:

            def begin() -> None:
                try:
                    client.play(number)
                except (NoAnswerError, PortError) as error:
                    raise type(error)(f"{error}. If page {number} plays, it goes on (m512 stop ends it)") from None
                ui.say(f"page {number} plays. {driving.Keys.HELP}")
                if second:
                    ui.say(f"f lays page {second} over it")

            stick = driving.drive(client, keys, client.link, _tell, second, begin)
        failed = CancelledError(STOPPED) if stick.cancelled else None if stick.done else broken_off(client)
    ui.say("\nstopping" if stick.done else "")
    if failed:
        raise failed


def _tell(stick: Stick) -> None:
    click.echo(f"\r{stick.line()}  {stick.said}   ", err=True, nl=False)


@contextmanager
def _keys() -> Iterator[Keys]:
    """Keys as they are pressed, without Enter."""
    import _thread
    import io
    import sys
    import threading

    from serial.tools.miniterm import Console

    from m512.board.driving import Keys
    from m512.errors import RefusedError

    if not is_terminal(sys.stdin):
        raise RefusedError("driving by keys needs a terminal")
    console, keys = Console(), Keys()
    if isinstance(sys.stdin, io.TextIOWrapper):
        sys.stdin.reconfigure(errors="replace")  # a terminal set to Latin-1 sends bytes that are no UTF-8
    console.setup()

    def read() -> None:
        why, is_cancelled = "", False
        try:
            for key in iter(console.getkey, ""):
                if key == "\x03" and is_cancelled:  # the first one may await an answer of the board
                    _thread.interrupt_main()
                is_cancelled |= key == "\x03"
                keys.press(key)
        except Exception as error:  # whatever it is, no key can stop the robot any more
            why = f" ({error})"
        keys.press(" ")
        ui.say(f"\nthe keyboard has ended{why}")

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    try:
        yield keys
    finally:
        with suppress(Exception):  # a terminal that is gone cannot be set back
            console.cleanup()
