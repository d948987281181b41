# SPDX-License-Identifier: MIT
"""`m512 plot`."""
from __future__ import annotations

from pathlib import Path

import click

from m512 import ui
from m512.cli.files import id_list
from m512.errors import MissingError, RefusedError


@click.command(epilog="""\b
Examples:
  m512 plot library.m512 walk_loop -o walk.png         both laws, the robot's poses above them
  m512 plot lib.bin 12 -o arms.svg --joints 1..6 --law exact
  m512 plot trace.csv -o trace.png                     recorded by cm5sim --trace""")
@click.argument("source", type=click.Path(path_type=Path))
@click.argument("page", required=False)
@click.option("-o", "--output", required=True, type=click.Path(path_type=Path), help=".png, .svg or .pdf")
@click.option("--force", is_flag=True, help="Overwrite the file.")
@click.option("--law", type=click.Choice(["both", "exact", "classic"]), default="both", show_default=True)
@click.option("--joints", help="IDs to draw (1..6 or 1,3,5). Default: all that move.")
@click.option("--seconds", default=10.0, show_default=True, type=click.FloatRange(0.1, 600), help="Longest time drawn.")
@click.option("--bits", type=click.Choice(["10", "12"]), help="Resolution of an image (default: what its positions look like).")
@click.option("--body", default="humanoid", show_default=True,
              help="Whose poses are drawn above: humanoid, gp, a body file, or none.")
def plot(source, page, output, force, law, joints, seconds, bits, body):
    """Draw joint angles and speeds over time: of a PAGE of a motion file, or of a recorded trace (CSV).

    Above them stand pictures of the robot in its poses.
    """
    from m512.files import formats, scale12, storage
    from m512.motion import plot as drawing

    if storage.exists(output) and not force:
        raise RefusedError(f"{output} is there already (--force overwrites it)")
    chosen = id_list(joints) if joints else None
    if page is None:
        sets = [drawing.of_trace(source, chosen)]
    else:
        image = formats.load(source, bits and int(bits))
        if image.bits == 12:
            image, _ = scale12.scaled(image, 10)
        number = image.find(page)
        sets = drawing.of_page_by_both_laws(image, number, seconds, chosen) if law == "both" else \
            [drawing.of_page(image, number, law, seconds, chosen)]
    count = drawing.draw(sets, output, _strip(body))
    ui.say(f"{output}: {count} joints, {max(len(curves.seconds) for curves in sets)} samples")


def _strip(body):
    """The row of pictures, or None where there is none, which is told."""
    from m512.motion.strip import Strip

    if body == "none":
        return None
    try:
        return Strip(body)
    except MissingError as error:
        ui.say(f"note: {error}")
        return None
