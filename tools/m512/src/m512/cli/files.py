# SPDX-License-Identifier: MIT
"""`m512 convert` and `m512 diff`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import click

from m512 import ui
from m512.cli.board import FilePath, board_option
from m512.errors import EXIT_DIFFERENT, FileError, WordError
from m512.files import conversion, formats, selection

if TYPE_CHECKING:
    from m512.files.image import Image


class PageNumber(click.ParamType):  # type: ignore[type-arg]  # generic from click 8.2 on
    """A page number and nothing else: int() would also accept 1_0 and digits of other scripts."""

    name = "number"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        number = value if isinstance(value, int) else selection.page_number(value)
        if number is None or number > selection.NUMBER_MOST:
            self.fail(f"{value!r} is no page number (0..{selection.NUMBER_MOST})", param, ctx)
        return number


PAGE_NUMBER = PageNumber()


def page_numbers(words: Sequence[str], pages: Any) -> Any:
    """The page numbers that arguments mean, in a file or on a board (files/selection.py)."""
    return _meant(selection.numbers, words, pages)


def page_moves(words: Sequence[str], pages: Any) -> Any:
    """[(source number, target number)] of arguments such as 3, wave:40, 20..25:60, all."""
    return _meant(selection.moves, words, pages)


def _meant(parse: Callable[..., Any], words: Sequence[str], pages: Any) -> Any:
    try:
        return parse(words, pages)
    except WordError as error:
        raise click.UsageError(str(error)) from None


def id_list(text: str) -> list[int]:
    """The IDs in the option --joints."""
    from m512.files.text.words import joints_of

    try:
        return joints_of(text.replace(" ", ","), {})
    except WordError as error:
        raise click.UsageError(f"--joints: {error}") from None


@click.command(
    epilog="""\b
Examples:
  m512 convert walk.m512 walk.bin           text to a 64 KiB image
  m512 convert robot.mtn robot.hex          RoboPlus to Intel HEX at 0x0E000
  m512 convert op3.bin op3.m512 --bits 12   12-bit image to text, as it is
  m512 convert op3.bin cm5.bin --bits 12 --scale 10 --joints 1..20
                                            scaled from 12 to 10 bits, with a report
  m512 convert large.mtn small.bin --only walk --only 20..25
                                            these pages and all that they lead to, renumbered to fit"""
)
@click.argument("source", type=FilePath())
@click.argument("target", type=FilePath(), default="-")
@click.option("--bits", type=click.Choice(["10", "12"]), help="Resolution of SOURCE (default: what its positions look like).")
@click.option("--scale", type=click.Choice(["10", "12"]), help="Scale positions to this resolution.")
@click.option("--joints", help="Keep these IDs (1..20 or 1,3,5) and set all others unused.")
@click.option("--pages", "count", type=click.Choice(["128", "256"]), help="Pages of the result (default: as SOURCE; 128 for a .mtn).")
@click.option("--only", multiple=True, metavar="NAME|RANGE", help="Take this page, or these, and all that they lead to; again for more.")
@click.option(
    "--damaged",
    type=click.Choice(["ask", "keep", "drop"]),
    default="keep",
    help="Damaged pages: keep byte for byte, replace by empty ones, or refuse to go on.",
    show_default=True,
)
@click.option("--force", is_flag=True, help="Overwrite TARGET.")
@click.option("--json", "as_json", is_flag=True, help="Report on stdout as JSON.")
def convert(
    source: Path, target: Path, bits: str | None, scale: Any, joints: Any, count: int | None, only: Any, damaged: str, force: bool, as_json: bool
) -> None:
    """Convert the motions in SOURCE to TARGET.

    Without a TARGET, or with -, the text goes to standard output; a SOURCE of - is standard input. For git:
    git config diff.motions.textconv "m512 convert", and *.bin diff=motions in .gitattributes.

    The suffix of TARGET decides: .bin (raw image), .hex (Intel HEX), .mtn (RoboPlus), .m512 (text).
    SOURCE is recognised by its contents. All losses are listed; a conversion that loses nothing says nothing. Pages of yours
    are left out only when an option says so; --only says which were.
    """
    formats.must_be_writable(target, force)
    if as_json and str(target) in ("-", "/dev/stdout"):
        raise click.UsageError("--json wants a file as TARGET: standard output has the motions")
    image = formats.load(source, int(bits) if bits else None)
    formats.keep_text(image, source, target)
    notes, losses = list(image.notes), []
    moved, left = {}, []
    if only:
        from m512.pages.excerpt import excerpt

        whole, wanted = image, page_numbers(only, image)
        part = excerpt(whole, wanted, count and int(count) or conversion.fitting(whole, target))
        image, moved, left = part.image, part.moved, part.left
        notes += part.notes(whole, wanted)
        losses += part.losses
    if joints is not None or scale:
        from m512.files import scale12
    if joints is not None:
        losses += scale12.keep_joints(image, id_list(joints), scaled_later=bool(scale) and int(scale) != image.bits)
    if scale:
        if not bits and image.form in (formats.BINARY, formats.HEX):
            scale12.must_be_clear(image, source)
    if scale and int(scale) == image.bits:
        notes.append(f"nothing is scaled: the positions have {scale} bits already")
    elif scale:
        notes = [note.replace(f"; {scale12.HINT}", "") for note in notes]
        image, report = scale12.scaled(image, int(scale))
        losses += report
    bad = conversion.treat_damaged(image, source, damaged, notes, count and int(count) or conversion.fitting(image, target))
    image, lost = conversion.fitted(image, count and int(count), target)
    losses += lost
    losses += formats.save(target, image, replace=force)
    if as_json:
        ui.show(
            json.dumps(
                {
                    "source": str(source),
                    "target": str(target),
                    "pages": len(image.pages),
                    "bits": image.bits,
                    "damaged": bad,
                    "notes": notes,
                    "losses": losses,
                    "moved": moved,
                    "left": left,
                },
                indent=2,
            )
        )
        return
    for note in notes:
        ui.say(f"note: {note}")
    for loss in losses:
        ui.say(f"loss: {loss}")


def _motions_of(word: str, bits: int | None, board: str) -> Image:
    """The motions of a file, of a backup folder, or of a board."""
    from m512.board.ports import is_port

    if is_port(word):
        from m512.board.motions import read_motions

        return read_motions(word, board)
    if Path(word).is_dir():
        from m512.board import backup
        from m512.files import image

        saved = backup.load(Path(word), ["motions"])
        if "motions" not in saved.data:
            raise FileError(f"the backup {word} has no motions")
        return image.from_bytes(saved.data["motions"])
    return formats.load(Path(word), bits)


@click.command(
    epilog="""\b
Examples:
  m512 diff old.bin new.bin
  m512 diff walk.m512 backup-20260101-120000     a backup's folder
  m512 diff /dev/ttyUSB0 walk.m512 --json        the board, with Play or Edit or a loader"""
)
@click.argument("first", type=FilePath(str))
@click.argument("second", type=FilePath(str))
@click.option("--bits", type=click.Choice(["10", "12"]), help="Resolution of images (default: what the positions look like).")
@board_option
@click.option("--json", "as_json", is_flag=True, help="Result on stdout as JSON.")
def diff(first: str, second: str, bits: str | None, board: str, as_json: bool) -> None:
    """Say in words how the motions in FIRST and SECOND differ: which page, which step, which joint, from, to.

    Each is a motion file, the folder of a backup, or the port of a board. Exit code 0 when they are equal, 3 when they differ."""
    from m512.board.ports import is_port
    from m512.pages import difference

    here, there = (_motions_of(word, int(bits) if bits else None, board) for word in (first, second))
    if bits or here.bits != there.bits:
        for word, image in ((first, here), (second, there)):
            for note in image.notes:
                ui.say(f"note: {word}: {note}")
    if here.bits != there.bits:
        ui.say(f"note: {first} has positions of {here.bits} bits and {second} of {there.bits}: scale one of them first (m512 convert --scale)")
    found = difference.images(here, there)
    if is_port(first) or is_port(second):  # a running board does not send its empty pages
        found = [change for change in found if change.what != difference.BOTH_EMPTY]
    if as_json:
        ui.show(json.dumps([change.as_dict() for change in found], indent=2))
    else:
        for line in difference.lines(found):
            ui.show(line)
    raise SystemExit(EXIT_DIFFERENT if found else 0)
