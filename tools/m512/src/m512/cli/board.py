# SPDX-License-Identifier: MIT
"""`m512 flash`, `run`, `backup`, `restore`: the commands that use a boot loader."""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from m512 import ui
from m512.errors import FileError, NoAnswerError, RefusedError


class Finite(click.FloatRange):
    """A range that excludes nan."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        number = super().convert(value, param, ctx)
        if number != number:
            self.fail(f"{value!r} is no number", param, ctx)
        return number


class FilePath(click.Path):
    """The name of a file or folder. The code that opens it reports its errors. Path("") would mean the current folder."""

    def __init__(self, kind: type = Path):
        super().__init__(readable=False, path_type=kind)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("an empty name is no file", param, ctx)
        return super().convert(value, param, ctx)


def _named(context: click.Context, parameter: click.Parameter, port: str) -> str:
    """BadParameter: --port with an empty name, as from a variable that is not set. It would mean the only port."""
    if not port and context.get_parameter_source(parameter.name or "") is ParameterSource.COMMANDLINE:
        raise click.BadParameter("an empty name is no port; without --port it is the only one")
    return port


port_option = click.option(
    "-p",
    "--port",
    envvar="M512_PORT",
    default="",
    callback=_named,
    metavar="PORT",
    help="Serial port: device, part of its name, socket://host:port, or bus:DEVICE for servos on an adapter, without a board. Default: the only one.",
)
wait_option = click.option(
    "--wait", type=Finite(0, 3600), default=60.0, show_default=True, metavar="SECONDS", help="How long to wait for the MODE button."
)
board_option = click.option(
    "--board",
    type=click.Choice(["cm5", "cm2"]),
    callback=lambda _, __, value: value or "",
    help="Which board it is, if its boot loader does not say so (cm2: CM-2 and CM-2+).",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Result on stdout as JSON.")


def only_the_simulator() -> None:
    """UsageError if --sim and --port are both on the command line: one of them would be ignored. M512_PORT does not count."""
    if click.get_current_context().get_parameter_source("port") is ParameterSource.COMMANDLINE:
        raise click.UsageError("--sim starts a simulated robot, --port means a real one: say one of the two")


def refuse_words(names: set[str], why: str) -> None:
    """UsageError if one of these options is on the command line: it would be ignored."""
    context = click.get_current_context()
    for option in context.command.params:
        if option.name in names and context.get_parameter_source(option.name) is ParameterSource.COMMANDLINE:
            raise click.UsageError(f"{option.opts[0]} {why}")


def connect(port: str, wait: float, yes: bool, board: str) -> Any:
    """(link, loader) of the board on a port. A running Play or Edit is restarted; unsaved edits are lost only after a yes."""
    from m512.board import bus, loaders, ports
    from m512.board.link import Link

    bus.refuse(port)
    link = Link(ports.pick(port))
    try:
        loader = loaders.enter(link, ui.say, wait, lambda question: ui.confirm(question, yes), board)
    except BaseException:
        link.close()
        raise
    ui.say(f"{link.url}: {loader.name}" + (f" on a {loader.board}" if loader.board else ""))
    return link, loader


def number(context: click.Context, parameter: click.Parameter, value: Any) -> int | None:
    if value is None:
        return None
    try:
        return int(value, 0)
    except ValueError:
        raise click.BadParameter(f"{value!r} is no number: 57344 or 0xE000") from None


def flash_options(function: Any) -> Any:
    for option in (
        json_option,
        wait_option,
        board_option,
        port_option,
        click.option("--dry-run", is_flag=True, help="Look at the board, say what would be written, change nothing."),
        click.option(
            "--yes",
            is_flag=True,
            help="Do not ask: neither when Edit has edits that are not saved, nor when motions of the board become empty pages.",
        ),
        click.option(
            "--damaged",
            type=click.Choice(["ask", "keep"]),
            default="ask",
            help="Damaged pages in a motion file: refuse (ask) or flash them as they are.",
        ),
        click.option("--with-trim", is_flag=True, help="Overwrite page 0 even if the file has no trim in it."),
        click.option("--fast/--no-fast", default=False, help="Try 117,647 baud (our loader, good adapters)."),
        click.option("--address", callback=number, help="Where a raw binary goes, such as 0x0."),
    ):
        function = option(function)
    return function


def _flash(
    image: Any,
    address: int | None,
    fast: bool,
    with_trim: bool,
    damaged: str,
    dry_run: bool,
    yes: bool,
    port: str,
    board: str,
    wait: float,
    as_json: bool,
    start: bool,
) -> None:
    from m512.board import download, loaders, memory
    from m512.board.block import STAY, BlockLoader
    from m512.files.wording import counted

    plan = memory.plan(image, address, board, with_trim, damaged)
    for remark in plan.remarks:
        ui.say(f"note: {remark}")
    first, last = min(plan.pages) * 256, max(plan.pages) * 256 + 255
    what = str(plan.record) if plan.record else "an application" if plan.has_app else "motions"
    ui.say(f"{image.name}: {what}, {counted(len(plan.pages), 'flash page')} in 0x{first:05X}..0x{last:05X}")
    if dry_run:
        found = _look(plan, port, board)
        if as_json:
            parts = {"file": str(image), "holds": what, "pages": len(plan.pages), "first": first, "last": last, "notes": plan.remarks, "found": found}
            ui.show(json.dumps(parts, indent=2))
        return
    link, loader = connect(port, wait, yes, board)
    with link:
        with loaders.as_found(loader):
            todo = _agreed(loader, plan, yes)  # before the fast rate, which the loader ends during a question
            if fast and isinstance(loader, BlockLoader):
                loader.go_faster()
        report = download.download(loader, plan, ui.phase, todo)
        ui.say(str(report))
        if start:
            download.start(loader)
            ui.say("started")
        else:
            loader.leave(STAY)
            ui.say(loaders.WAITS)
        if as_json:
            ui.show(json.dumps(dict(report.as_dict(), loader=loader.name, board=loader.board, started=start)))


def _agreed(loader: Any, plan: Any, yes: bool) -> Any:
    """The flash pages to write. Asks first if motions of the board would be lost."""
    from m512.board import download, look
    from m512.files.wording import named_pages_text

    download.check_board(plan, loader)
    with ui.phase("Comparing") as progress:
        todo = loader.different(plan.pages, progress)
    lost = look.emptied(loader, plan, todo, ui.phase)
    if lost:
        ui.confirm(
            f"The file holds all pages of a board, and these are empty in it: {named_pages_text(lost)} would be lost "
            "(`m512 backup` keeps them; `m512 put` writes single pages). Go on?",
            yes,
        )
    return todo


def _look(plan: Any, port: str, board: str) -> list[str]:
    """Prints and returns what a plan would change on the board. The board keeps running."""
    from m512.board import bus, loaders, look, ports
    from m512.board.client import Client
    from m512.board.link import Link

    bus.refuse(port)
    with Link(ports.pick(port)) as link:
        try:
            client = Client(link)
        except NoAnswerError as error:
            if not loaders.at_prompt(link):
                raise NoAnswerError(f"{link.url}: no boot loader answers, and {error}: what is on the board is not known") from None
            found = look.through_loader(loaders.identify(link, board=board), plan, ui.phase)
        else:
            found = look.through_application(client, plan, ui.phase)
    for line in found:
        ui.say(line)
    return found


@click.command(
    epilog="""\b
Examples:
  m512 flash play-cm5.hex                 our application into the board
  m512 flash library.m512                 motions, from the text; also .bin .hex .mtn
  m512 flash walk.bin -p socket://host:4000 --json"""
)
@click.argument("image", type=FilePath())
@flash_options
def flash(image: Any, **options: Any) -> None:
    """Write code or motions into the board and read them back.

    Our boot loader and the factory's are told apart by themselves. Only pages that differ are sent, so a transfer that
    broke off goes on where it stopped. What would hurt is refused before anything is sent.
    """
    _flash(image, start=False, **options)


@click.command(
    epilog="""\b
Examples:
  m512 run play-cm5.hex     flash, then start
  m512 run                  start what is there"""
)
@click.argument("image", type=FilePath(), required=False)
@flash_options
def run(image: Any, **options: Any) -> None:
    """Write IMAGE as `m512 flash` does and start the application."""
    if image:
        _flash(image, start=True, **options)
        return
    from m512.board import download

    refuse_words({"dry_run", "with_trim", "fast", "address", "damaged"}, "is for a file that is flashed; here is none")
    link, loader = connect(options["port"], options["wait"], options["yes"], options["board"])
    with link:
        download.start(loader)
        ui.say("started")
        if options["as_json"]:
            ui.show(json.dumps({"loader": loader.name, "board": loader.board, "started": True}))


def _areas(text: str) -> list[str]:
    from m512.board.backup import AREAS

    areas = [area for area in text.split(",") if area]
    for area in areas or [text]:
        if area not in AREAS:
            raise click.UsageError(f"--what {area!r}: the areas are {', '.join(AREAS)}")
    return areas


@click.command(
    epilog="""\b
Examples:
  m512 backup                         all, into backup-DATE-TIME/
  m512 backup robot1 --what motions   the motions only"""
)
@click.argument("folder", type=FilePath(), required=False)
@click.option("--what", default="motions,eeprom,app", show_default=True, help="Areas to read.")
@click.option("--yes", is_flag=True, help="Do not ask when Edit has edits that are not saved.")
@port_option
@board_option
@wait_option
@json_option
def backup(folder: Path | None, what: str, yes: bool, port: str, board: str, wait: float, as_json: bool) -> None:
    """Read motions, EEPROM and application into FOLDER, with a manifest (date, board, CRCs)."""
    from m512.board import backup as backups
    from m512.board import loaders
    from m512.files import storage

    areas = _areas(what)
    numbered = folder is None  # two robots backed up in the same second get a folder each
    folder = folder or Path(datetime.now().strftime("backup-%Y%m%d-%H%M%S"))
    storage.must_take_files(folder, numbered)
    link, loader = connect(port, wait, yes, board)
    with link:
        with loaders.as_found(loader):
            made = backups.take(loader, folder, areas, ui.phase, numbered)
        ui.say(f"{made.folder}: " + ", ".join(f"{area} {len(made.data[area]):,} bytes" for area in areas))
        after = loaders.give_back(loader)
        if not loader.was_at_prompt:
            ui.say(after)
    if as_json:
        ui.show(json.dumps(made.manifest, indent=2))


@click.command(
    epilog="""\b
Examples:
  m512 restore backup-20260101-120000
  m512 restore robot1 --what motions --yes"""
)
@click.argument("folder", type=FilePath())
@click.option("--what", help="Areas to write (default: all of the backup).")
@click.option("--yes", is_flag=True, help="Do not ask.")
@port_option
@board_option
@wait_option
@json_option
def restore(folder: Path, what: str | None, yes: bool, port: str, board: str, wait: float, as_json: bool) -> None:
    """Show what a backup would change on the board, ask, and write it."""
    from m512.board import backup as backups
    from m512.board import download, loaders
    from m512.board.factory import FactoryLoader
    from m512.board.memory import Plan
    from m512.files.wording import counted

    wanted = None if what is None else _areas(what)
    saved = backups.load(folder, wanted)
    areas = list(saved.data) if wanted is None else wanted
    missing = [area for area in areas if area not in saved.data]
    if not areas:
        raise FileError(f"{folder} holds nothing to restore")
    if missing:
        raise RefusedError(f"the backup {folder} has no {', '.join(missing)}")
    link, loader = connect(port, wait, yes, board)
    with link:
        pages = backups.flash_pages(saved, areas)
        with loaders.as_found(loader):
            todo, cells, changes = _compare(loader, saved, areas, pages)
            if todo or cells:
                ui.confirm("Write this to the board?", yes)
        if todo:
            ui.say(str(download.download(loader, Plan(pages), ui.phase, todo)))
        if "eeprom" in areas and (todo or cells):
            shown = cells
            if todo:  # the factory's boot loader changes cells then: its mailbox, its note of the last download, and the boot mode
                cells = _eeprom_cells(loader, saved)
            if cells:
                with ui.phase("EEPROM") as progress:
                    backups.write_eeprom(loader, cells, progress)
                own = len(cells.keys() - shown.keys())
                ui.say(
                    f"{counted(len(cells), 'EEPROM cell')} written and read back"
                    + (f", {own} of them changed while flash was written" if own else "")
                )
            if isinstance(loader, FactoryLoader):
                loader.stays = False  # the boot mode is the backup's now
        if todo or cells:
            ui.say(loaders.restart(loader))
        else:
            ui.say("The board holds this already.")
            loaders.give_back(loader)
    if as_json:
        ui.show(json.dumps({"flash_pages": len(todo), "eeprom_cells": len(cells), "changes": [change.as_dict() for change in changes]}, indent=2))


def _eeprom_cells(loader: Any, saved: Any) -> dict[int, int]:
    """The EEPROM cells that differ from the backup now, with the backup's values."""
    from m512.board import backup as backups

    with ui.phase("Reading EEPROM") as progress:
        return backups.eeprom_changes(saved.data["eeprom"], loader.read_eeprom(progress=progress))


def _compare(loader: Any, saved: Any, areas: list[str], pages: Any) -> Any:
    """(flash pages that differ, EEPROM cells that differ, changes of motions). Also prints them."""
    from m512.board import backup as backups
    from m512.board.memory import FLASH_PAGE, MOTIONS, Record
    from m512.files.image import from_bytes
    from m512.files.wording import counted
    from m512.pages.difference import images

    record = Record.of(saved.data["app"]) if "app" in areas else None
    board = record.board if record else backups.board_of(saved)
    if "app" in areas and board and loader.board and board != loader.board:
        raise RefusedError(f"this backup's application is for a {board}, this board is a {loader.board}")
    with ui.phase("Comparing") as progress:
        todo = loader.different(pages, progress) if pages else []
    cells, changes = {}, []
    if "eeprom" in areas:
        cells = _eeprom_cells(loader, saved)
    in_motions = [n for n in todo if n * FLASH_PAGE >= MOTIONS[0]]
    if in_motions:
        with ui.phase("Reading") as progress:
            found = _motions_now(loader, saved.data["motions"], in_motions, progress)
        changes = images(from_bytes(found), from_bytes(saved.data["motions"]))
        for change in changes:
            ui.say(str(change))
    in_app = len(todo) - len(in_motions)
    if in_app:
        ui.say(
            f"application: {counted(in_app, 'flash page')} {'differs' if in_app == 1 else 'differ'}"
            + (f"; the backup holds {record}" if record else "")
        )
    if cells:
        ui.say(f"EEPROM: {counted(len(cells), 'cell')} {'differs' if len(cells) == 1 else 'differ'}")
    return todo, cells, changes


def _motions_now(loader: Any, saved: Any, pages: Any, progress: Any) -> bytes:
    """The board's motion area, read only where it differs from the backup."""
    from m512.board.memory import motion_area, motion_page_of
    from m512.files.page import PAGE_BYTES

    out = bytearray(saved)
    numbers = sorted({motion_page_of(n) for n in pages})
    for done, number in enumerate(numbers):
        out[PAGE_BYTES * number : PAGE_BYTES * (number + 1)] = loader.read(*motion_area(number))
        progress(done + 1, len(numbers))
    return bytes(out)
