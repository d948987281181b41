# SPDX-License-Identifier: MIT
"""`m512 pages FILE ACTION`: shows and changes pages."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from functools import cached_property, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from m512 import ui
from m512.cli.board import FilePath, Finite, board_option
from m512.cli.files import PAGE_NUMBER, page_moves, page_numbers
from m512.errors import EXIT_DIFFERENT, EmptyPageError, FileError, WordError
from m512.files import conversion, formats, selection, storage
from m512.files.page import Page
from m512.files.wording import field_text

if TYPE_CHECKING:
    from m512.files.image import Image


class Source:
    """The file or board that an action works on. It is read on first use."""

    def __init__(self, word: str, bits: int | None, which_board: str = ""):
        self.word, self.bits, self.which_board = word, bits, which_board
        self.goes_back = False  # the result is written to where it comes from

    @cached_property
    def board(self) -> bool:
        from m512.board.ports import is_port

        return is_port(self.word)

    @cached_property
    def image(self) -> Any:
        if self.board:
            from m512.board.motions import read_motions

            image = read_motions(self.word, self.which_board, self.goes_back)
            self.found = image.copy()
            return image
        if Path(self.word).is_dir():
            raise FileError(f"{self.word} is a folder; the motions of a backup are its file motions.bin")
        image = formats.load(Path(self.word), self.bits)
        for note in image.notes:
            ui.say(f"note: {note}")
        return image

    def store(self, remarks: Iterable[str], output: Any, force: bool, in_place: bool, yes: bool, other: tuple[Image, Path] | None = None) -> None:
        """Writes the changed image to `output`, or else back to its file or board. force: `output` may be replaced. other: a second file
        that the motions come from, read and by name."""
        for remark in remarks:
            ui.say(f"note: {remark}")
        target = output or ("" if self.board else self.word)
        for image, source in ((self.image, Path(self.word)), *([other] if other else [])):
            if target:
                formats.keep_text(image, source, Path(target))
        if output:
            fitted, lost = conversion.fitted(self.image, None, Path(output))
            for loss in lost + formats.save(Path(output), fitted, replace=force):
                ui.say(f"loss: {loss}")
        elif self.board:
            self._to_board(yes)
        else:
            self._to_file()

    def _to_file(self) -> None:
        """Writes the image back to its file."""
        path = Path(self.word)
        data, losses = formats.encode(path, self.image, self.image.form)
        if self.image.form == formats.MTN and not storage.is_stream(path):
            formats.keep_mtn(path, self.bits, losses)
        for loss in losses + storage.write(path, data, replace=True):
            ui.say(f"loss: {loss}")

    def _to_board(self, yes: bool) -> None:
        """Shows the changes, asks, writes."""
        from m512.board.motions import write_motions
        from m512.pages import difference

        changes = difference.images(self.found, self.image)
        for line in difference.lines(changes):
            ui.say(line)
        if not changes:
            ui.say("The board holds this already.")
            return
        ui.confirm("Write this to the board?", yes)
        write_motions(self.word, self.found, self.image, self.which_board)


def changes(function: Any) -> Any:
    """Decorator with the options of actions that change pages. Checks the destination before a file or board is read."""

    @wraps(function)
    def action(source: Source, **options: Any) -> None:
        if options["output"] and options["in_place"]:
            raise click.UsageError("-o FILE or --in-place: say one of the two")
        if not (options["output"] or options["in_place"] or source.board):
            raise click.UsageError("say where the result goes: -o FILE, or --in-place")
        source.goes_back = not options["output"]
        if options["output"]:
            formats.must_be_writable(Path(options["output"]), options["force"])
        elif not source.board:
            storage.keep_backup(Path(source.word))
        try:
            function(source, **options)
        except WordError as error:
            raise click.UsageError(str(error)) from None

    changing = click.option("-o", "--output", type=FilePath(), help="Write the result here.")(action)
    changing = click.option("--in-place", is_flag=True, help="Write the result back to the file.")(changing)
    changing = click.option("--force", is_flag=True, help="Overwrite the file of -o.")(changing)
    changing = click.option("--yes", is_flag=True, help="Write to a board without asking.")(changing)
    return click.pass_obj(changing)


replacing = click.option("--replace", is_flag=True, help="Overwrite a page that is not empty.")


class Actions(click.Group):
    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Finds the action. A question for help is answered also where the file or the action is missing or in the other's place."""
        source = ctx.params["source"]
        if args[0] not in self.commands and not set(args).isdisjoint(ctx.help_option_names):
            asked = [word for word in (source, *args) if word in self.commands]
            if asked:
                return super().resolve_command(ctx, [asked[0], "--help"])
            click.echo(ctx.get_help())
            ctx.exit()
        if source in self.commands and args[0] not in self.commands:
            ctx.fail(f"the file comes first: m512 pages {args[0]} {source}")
        return super().resolve_command(ctx, args)


@click.group(
    cls=Actions,
    epilog="""\b
Examples:
  m512 pages lib.bin list
  m512 pages lib.bin show walk_loop
  m512 pages lib.bin merge other.mtn 3 5:20 -o new.bin
  m512 pages /dev/ttyUSB0 list --json""",
)
@click.argument("source", metavar="FILE|PORT", type=FilePath(str))
@click.option("--bits", type=click.Choice(["10", "12"]), help="Resolution of an image file (default: what its positions look like).")
@board_option
@click.pass_context
def pages(context: click.Context, source: str, bits: str | None, board: str) -> None:
    """List, check, edit, merge, mirror and retime the pages of a motion file, or of a board on a PORT.

    Pages are given by number, name or range (20..25: those of them that are not empty). Actions that change something want -o FILE or --in-place.
    """
    context.obj = Source(source, int(bits) if bits else None, board)


@pages.command("list", epilog="Example: m512 pages lib.bin list --all")
@click.option("--all", "everything", is_flag=True, help="Empty and erased pages too.")
@click.option("--json", "as_json", is_flag=True, help="Result on stdout as JSON.")
@click.pass_obj
def list_(source: Source, everything: bool, as_json: bool) -> None:
    """Number, name, steps, play time, links and codes of all pages."""
    from m512.pages.listing import describe, table

    used = set(source.image.used())
    rows = [describe(source.image, n, page) for n, page in source.image.items() if everything or n in used]
    ui.show(json.dumps(rows, indent=2) if as_json else table(rows))


@pages.command(epilog="Example: m512 pages lib.bin show walk_loop")
@click.argument("page", nargs=-1, required=True)
@click.pass_obj
def show(source: Source, page: Sequence[str]) -> None:
    """Print pages in the text format."""
    from m512.files.text.writer import Style, is_motion, page_text, raw_text

    style = Style(source.image)
    for number in page_numbers(page, source.image):
        writer = page_text if is_motion(source.image[number], source.image) else raw_text
        ui.show(writer(source.image[number], (number, number), style))


@pages.command(epilog="Example: m512 pages lib.bin check || echo look at it")
@click.option("--json", "as_json", is_flag=True, help="Result on stdout as JSON.")
@click.pass_obj
def check(source: Source, as_json: bool) -> None:
    """Say what is wrong: damaged pages, links to nothing, steps without time. Exit code 3 when something is."""
    from m512.files.wording import Findings
    from m512.pages import operations

    found, remarks = operations.check(source.image), operations.remarks(source.image)
    if as_json:
        ui.show(json.dumps([{"page": n, "problem": text} for n, text in found] + [{"page": n, "note": text} for n, text in remarks], indent=2))
    else:
        for number, text in found:
            title = source.image[number].title
            ui.show(f"page {number}" + (f' "{title}"' if title else "") + f": {text}")
        notes = Findings()
        for number, text in remarks:
            notes.add(number, source.image[number].title, text)
        for line in notes.lines():
            ui.say(f"note: {line}")
        if not found:
            used = len(source.image.used())
            ui.show(f"{used} {'page' if used == 1 else 'pages'} in use, all good")
    raise SystemExit(EXIT_DIFFERENT if found else 0)


@pages.command(epilog="Example: m512 pages lib.bin rename 12 walk_loop --in-place")
@click.argument("page")
@click.argument("name")
@changes
def rename(source: Source, page: str, name: str, **where: Any) -> None:
    """Give a page another name."""
    from m512.pages import operations

    source.store(operations.rename(source.image, source.image.find(page), name), **where)


@pages.command(epilog="Example: m512 pages lib.bin copy 12 40 --in-place")
@click.argument("page")
@click.argument("target", type=PAGE_NUMBER)
@replacing
@changes
def copy(source: Source, page: str, target: Any, replace: bool, **where: Any) -> None:
    """Copy a page to another number."""
    from m512.pages import operations

    source.store(operations.copy(source.image, source.image.find(page), target, replace), **where)


@pages.command(epilog="Example: m512 pages lib.bin delete 15 old_wave --in-place")
@click.argument("page", nargs=-1, required=True)
@changes
def delete(source: Source, page: Sequence[str], **where: Any) -> None:
    """Make pages empty; says which pages still link to them, and which hold nothing."""
    from m512.pages import operations

    numbers: list[int] = []
    empty: list[str] = []
    for word in page:
        try:
            numbers += page_numbers([word], source.image)
        except EmptyPageError as error:  # as it is to be: a write that broke off has not come that far
            empty.append(str(error))
    if not numbers:
        raise EmptyPageError("; ".join(empty))
    source.store(empty + operations.delete(source.image, numbers), **where)


@pages.command(epilog="Example: m512 pages lib.bin renumber walk_loop 30 --in-place")
@click.argument("page")
@click.argument("target", type=PAGE_NUMBER)
@click.option("--swap", is_flag=True, help="Exchange with a page that is there.")
@changes
def renumber(source: Source, page: str, target: Any, swap: bool, **where: Any) -> None:
    """Move a page to another number; all links follow."""
    from m512.pages import operations

    source.store(operations.renumber(source.image, source.image.find(page), target, swap), **where)


@pages.command(epilog="Example: m512 pages lib.bin extract walk_start walk_loop walk_end -o walk.m512")
@click.argument("page", nargs=-1, required=True)
@changes
def extract(source: Source, page: Sequence[str], **where: Any) -> None:
    """Keep these pages only, at their numbers."""
    numbers, remarks = set(page_numbers(page, source.image)), []
    if 0 not in numbers and source.image.first == 0 and any(source.image[0].trims()):
        remarks.append("page 0, the robot's trim, is left behind: extract 0 as well keeps it")
    if source.image.given is not None:
        source.image.given = source.image.given & numbers
    for number, here in source.image.items():
        if number not in numbers:
            source.image[number] = Page()
        else:
            remarks += [
                f'page {number} "{here.title}": {field_text(link)} {getattr(here, link)} is left behind'
                for link in Page.LINKS + Page.PARTNERS
                if getattr(here, link) not in numbers | {0}
            ]
    source.store(remarks, **where)


@pages.command(
    epilog="""\b
Examples:
  m512 pages lib.bin merge other.mtn all -o new.bin
  m512 pages lib.bin merge other.bin 3 wave:20 -o new.bin"""
)
@click.argument("other", type=FilePath())
@click.argument("page", nargs=-1, required=True)
@replacing
@changes
def merge(source: Source, other: Path, page: Sequence[str], replace: bool, **where: Any) -> None:
    """Take pages from OTHER: `3` or `3..9` to their own numbers, `3:20` or `wave:20` to number 20, `all` that are not empty,
    without page 0, the trim.

    Links among the pages taken follow them.
    """
    from m512.pages import operations

    image = formats.load(other, source.bits)
    moves = page_moves(page, image)
    operations.place(source.image, image, moves, replace)
    titles = {number: source.image[number].title for number in source.image.used()}
    source.store(operations.loose_links(image, moves, titles, source.image.end), **where, other=(image, other))


@pages.command(epilog="Example: m512 pages lib.bin mirror kick_left 41 --in-place")
@click.argument("page")
@click.argument("target", type=PAGE_NUMBER, required=False)
@click.option(
    "--pairs",
    default="1-2,3-4,5-6,7-8,9-10,11-12,13-14,15-16,17-18",
    show_default=True,
    help="Joints that change places; a single one is turned round.",
)
@replacing
@changes
def mirror(source: Source, page: str, target: Any, pairs: Any, replace: bool, **where: Any) -> None:
    """Left for right: paired joints change places, position p becomes 1024 - p."""
    from m512.files.text.words import joint_pairs
    from m512.pages import operations

    table = joint_pairs(pairs.replace(" ", ",").split(","), {})
    source.store(operations.mirror(source.image, source.image.find(page), table, target, replace), **where)


@pages.command(epilog="Example: m512 pages lib.bin retime bow 1.5 --in-place   (takes half as long again)")
@click.argument("page")
@click.argument("factor", type=float)
@changes
def retime(source: Source, page: str, factor: float, **where: Any) -> None:
    """Make a page take FACTOR times as long (step times, pauses, ramp)."""
    from m512.pages import operations

    source.store(operations.retime(source.image, source.image.find(page), factor), **where)


@pages.command(epilog="Example: m512 pages lib.bin time walk_start --volts 11.1")
@click.argument("page")
@click.option("--volts", type=Finite(6, 16), default=9.6, show_default=True, help="Supply of the servos.")
@click.option("--json", "as_json", is_flag=True, help="Result on stdout as JSON.")
@click.pass_obj
def time(source: Source, page: str, volts: float, as_json: bool) -> None:
    """Play time of a page and of the chain of pages that follows it, and where it is too fast for an AX-12."""
    from m512.motion import speed
    from m512.pages import operations

    number = selection.holding(page, source.image)
    if not source.image[number].is_playable and not source.image[number].fault(source.image.kind):
        raise EmptyPageError(f"page {number} has no action: there is nothing to play")
    parts, end = operations.chain(source.image, number)
    fast = speed.too_fast(source.image, number, volts)
    total = sum(seconds for _, _, seconds in parts)
    looked = speed.looked(total, end)
    if as_json:
        ui.show(
            json.dumps(
                {
                    "pages": [{"page": n, "repeat": r, "seconds": round(s, 4)} for n, r, s in parts],
                    "seconds": round(total, 4),
                    "end": end,
                    "volts": volts,
                    "looked_at_s": round(looked, 4),
                    "too_fast": [{"page": f.page, "step": f.step, "joint": f.joint, "degrees_s": round(f.degrees_s)} for f in fast],
                },
                indent=2,
            )
        )
        return
    for number, repeat, seconds in parts:
        times = f" ({repeat} times)" if repeat != 1 else ""
        ui.show(f"page {number:3} {source.image[number].title:13} {seconds:8.3f} s{times}")
    ui.show(f"{'all':22} {total:8.3f} s, {end}")
    for part in fast:
        ui.show(
            f"page {part.page:3} step {part.step}: too fast at {volts:g} V: joint {part.joint} is asked for "
            f"{part.degrees_s:.0f} degrees/s, an unloaded AX-12 does {speed.no_load_degrees_s(volts):.0f}"
        )
    if looked == speed.LOOKED_SECONDS:
        ui.show(f"for joints that are too fast, only the first {looked:.0f} s were looked at")
