# SPDX-License-Identifier: MIT
"""`m512 play`, `stop`, `pose`, `torque`, `get`, `put`: the commands for a running Play or Edit."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

import click

from m512 import ui
from m512.cli.board import FilePath, json_option, only_the_simulator, port_option, refuse_words
from m512.cli.files import page_moves, page_numbers
from m512.errors import BoardError, CancelledError, M512Error, NoAnswerError, PortError, RefusedError, WordError

if TYPE_CHECKING:
    from m512.board.client import Client

ID_MAX = 30
STOPPED = "stopped by Ctrl-C"


def _servos(_context: click.Context, _parameter: click.Parameter, text: str) -> str:
    """Checks --servos of the simulator: Play and Edit must be able to move them all. A model or rate may follow an ID."""
    for part in [] if text == "none" else text.split(","):
        ids = re.fullmatch("([0-9]{1,3})(?:-([0-9]{1,3}))?([:@].*)?", part)
        if not ids or not int(ids[1]) <= int(ids[2] or ids[1]) <= ID_MAX:
            raise click.BadParameter(f"{part!r}: servos have IDs 0..{ID_MAX}, as 5 or 1-18; `none` plugs none in")
    return text


def _ids(_context: click.Context, _parameter: click.Parameter, words: Sequence[str]) -> list[int]:
    from m512.files.text.words import joints_of

    try:
        return [joint for word in words for joint in joints_of(word, {})]
    except WordError as error:
        raise click.BadParameter(f"{error}; say IDs as 3, 1..6 or 1,3,5") from None


ids_argument = click.argument("ids", nargs=-1, callback=_ids)


def robot_options(function: Any) -> Any:
    for option in (
        click.option("--servos", default="1-18", callback=_servos, help="With --sim: the servos that are plugged in.", show_default=True),
        click.option("--image", default="play-cm5.hex", help="With --sim: the firmware.", show_default=True),
        click.option("--motions", type=FilePath(), help="With --sim: motion file of any kind."),
        click.option("--sim", is_flag=True, help="Start the simulator instead of using a port."),
        json_option,
        port_option,
    ):
        function = option(function)
    return function


def shape_options(function: Any) -> Any:
    for option in (
        click.option("--blend", type=click.IntRange(-100, 100), help="Percent towards the partner page: right 1.., left -1.."),
        click.option("--amplitude", type=click.IntRange(0, 150), help="Size in percent, about the centre page's pose."),
        click.option("--rate", type=click.IntRange(10, 400), help="Speed in percent, until changed."),
    ):
        function = option(function)
    return function


def apply(client: Client, rate: int | None, amplitude: int | None, blend: int | None) -> None:
    """Sends the values of shape_options that were given."""
    for word, value in (("rate", rate), ("amplitude", amplitude), ("blend", blend)):
        if value is not None:
            client.ask(f"{word} {value}")


@contextmanager
def robot(options: dict[str, Any], image: Any = "play") -> Iterator[Client]:
    """The Client for these options. Whatever was started for it ends with the block. image: the program to start for -p bus:..."""
    from m512.board import ports
    from m512.board.client import Client
    from m512.board.link import Link

    if options.get("motions") and not options["sim"]:
        raise click.UsageError("--motions is for --sim; a robot gets its motions with `m512 flash` or `put`")
    if not options["sim"]:
        refuse_words({"servos", "image"}, "is for --sim")
    if options["sim"]:
        only_the_simulator()
        from m512.board.sim import Simulator, meet

        with Simulator(options["image"], options["motions"], options["servos"]) as simulator, Link(simulator.url) as link:
            yield meet(link)
        return
    with Link(ports.pick(options["port"]), image=image) as link:
        try:
            client = Client(link)
        except NoAnswerError as error:
            from m512.board import loaders
            from m512.board.block import STAY

            if not loaders.at_prompt(link):
                raise NoAnswerError(f"{error} on {link.url} (m512 doctor looks why)") from None
            loaders.identify(link).leave(STAY)  # refuses an unsupported board
            raise NoAnswerError("the board waits in its boot loader: `m512 run` starts the application") from None
        yield client


def _report(client: Client, as_json: bool) -> dict[str, str]:
    from m512.board.client import shape_in_words

    state = client.where()
    if as_json:
        ui.show(in_json(shape_in_words(state)))
    return state


def in_json(fields: dict[str, str]) -> str:
    """Numbers as numbers. Lists of joints and bits stay text, also when they look like numbers."""
    return json.dumps(
        {word: int(text) if re.fullmatch("-?[0-9]+", text) and word not in ("aim", "faulty") else text for word, text in fields.items()}
    )


@click.command(
    epilog="""\b
Examples:
  m512 play walk_start
  m512 play 12 --code U --wait        until it ends; Ctrl-C stops softly, again: at once
  m512 play walk --rate 120 --blend -30   a fifth faster, a curve to the left
  m512 play wave --sim --motions library.m512 --wait"""
)
@click.argument("page")
@shape_options
@click.option("--code", "key", default="", help="Code of the call: a number, or keys such as U or L+B1.")
@click.option("--wait", is_flag=True, help="Follow the play until it ends.")
@robot_options
def play(page: str, rate: int | None, amplitude: int | None, blend: int | None, key: str | None, wait: bool, **options: Any) -> None:
    """Play a page of the board, by number or name."""
    from m512.files.text.words import Token
    from m512.files.text.words import code as parse

    try:
        code = parse(Token(key)) if key else 0
    except WordError as error:
        raise click.UsageError(str(error)) from None
    with robot(options) as client:
        number = client.motion(page)
        if (rate, amplitude, blend) != (None, None, None) and client.where()["state"] != "idle":  # it would change the one that plays
            raise BoardError("something plays on the robot: `m512 stop` first")
        apply(client, rate, amplitude, blend)
        is_ours = _is_ours(options)

        def start() -> None:
            client.play(number, code)
            ui.say(f"page {number} plays" + ("; waiting for its end, Ctrl-C stops it" if wait else ""))

        failed = _follow(client, start, wait or is_ours, is_ours)
        _report(client, options["as_json"])
    if failed:
        raise failed


def _is_ours(options: dict[str, Any]) -> bool:
    """Whether the robot's program was started for this command and ends with it."""
    from m512.board.bus import is_bus

    return bool(options["sim"]) or is_bus(options["port"] or "")


def _follow(client: Client, start: Callable[[], None], wait: bool, is_ours: bool) -> M512Error | None:
    """Starts a movement and, with `wait`, shows the state until the robot is idle. The first Ctrl-C stops, the second breaks, at any
    moment from the start on. Returns an error for that, and for a motion that the robot has broken off. Anything else that ends this
    program (a closed terminal window, or a pipe whose reader has gone) also stops the movement, because nobody can press Ctrl-C any
    more."""
    try:
        return _followed(client, start, wait)
    except (PortError, NoAnswerError) as error:
        if is_ours:
            raise
        raise type(error)(f"{error}. What plays on the robot goes on (m512 stop ends it)") from None


def broken_off(client: Client) -> BoardError | None:
    """The error for a motion that has ended, if the robot has broken it off."""
    why = client.why_broken_off()
    return BoardError(f"the robot has broken off the motion: {why}") if why else None


def _followed(client: Client, start: Callable[[], None], wait: bool) -> M512Error | None:
    before, asked, halt, started = None, 0, "", False
    while True:
        try:
            if halt:
                client.ask(halt)
                ui.say("stopping through the exit page; Ctrl-C again stops at once" if halt == "stop" else "stopping at once")
                halt = ""
            elif not started:
                start()
                started = True
                if not wait:
                    return None
            state = client.where()
            here = (state["state"], state["page"], state["repetition"])
            if here != before:
                ui.say(f"{state['state']}: page {state['page']}, repetition {state['repetition']}")
                before = here
            if state["state"] == "idle":
                return CancelledError(STOPPED) if asked else broken_off(client)
            if ui.is_unread():
                raise BrokenPipeError
            client.link.sleep(0.1)
        except (SystemExit, BrokenPipeError):
            client.ask("stop")
            raise
        except KeyboardInterrupt:
            asked += 1
            if asked > 2:
                raise CancelledError("ended by Ctrl-C before the board has answered: the robot may still move (m512 stop --now)") from None
            halt, started = "stop" if asked == 1 else "break", True


@click.command(
    epilog="""\b
Examples:
  m512 stop           softly, through the exit pages
  m512 stop --now     at once: all joints slow down to a stand, torque stays on"""
)
@click.option("--now", is_flag=True, help="Leave the page at once.")
@robot_options
def stop(now: bool, **options: Any) -> None:
    """Stop what is playing, whoever started it. While another m512 holds the port (`play --wait`), press Ctrl-C there instead."""
    with robot(options) as client:
        client.ask("break" if now else "stop")
        _report(client, options["as_json"])


@click.command(
    epilog="""\b
Examples:
  m512 pose                          where the joints are
  m512 pose --text                   as a line for a motion text
  m512 pose 1:512 2:300 --speed 30   move two joints, at 30 degrees/s"""
)
@click.argument("positions", nargs=-1, metavar="[ID:POSITION]...")
@click.option("--speed", default=60, show_default=True, metavar="DEG/S", type=click.IntRange(1, 360), help="Largest speed of a joint.")
@click.option("--text", "as_text", is_flag=True, help="As a step of the text format.")
@robot_options
def pose(positions: Sequence[str], speed: int, as_text: bool, **options: Any) -> None:
    """Show the pose of the robot, or move joints to positions (0..1023, or 30deg from the centre).

    The joints that move get torque. The others stay as they are, limp or holding.
    """
    wanted, failed = positions_of(positions), None
    with robot(options) as client:
        if wanted:
            must_be_there(client, wanted)

            def start() -> None:
                client.move(wanted, speed)
                ui.say("moving; waiting for the end")

            failed = _follow(client, start, True, _is_ours(options))
        found = client.pose()
    silent = [joint for joint, (at, _) in found.items() if at is None]
    if not found or as_text and len(silent) == len(found):
        raise BoardError("no servo answers; is their power on? m512 doctor looks")
    if options["as_json"]:
        ui.show(json.dumps({joint: {"position": at, "torque": on} for joint, (at, on) in found.items()}, indent=2))
    elif as_text:
        ui.show("step 1s | " + " ".join(f"{joint}:{at}" for joint, (at, _) in found.items() if at is not None))
        if silent:
            ui.say(f"note: no answer from servos {' '.join(map(str, silent))}: the step leaves them out")
    else:
        for joint, (at, on) in found.items():
            degrees = "" if at is None else f"{(at - 512) * 300 / 1024:+7.1f} deg"
            ui.show(f"ID {joint:2}  {'silent' if at is None else at:>6}  {degrees}  {'holds' if on else 'limp'}")
    if failed:
        raise failed


def must_be_there(client: Client, joints: Collection[int]) -> None:
    """BoardError if the robot does not have all of these joints."""
    missing = sorted(set(joints) - client.pose().keys())
    if missing:
        raise BoardError(f"no answer from servos {' '.join(map(str, missing))}: nothing was moved")


def positions_of(words: Sequence[str]) -> Any:
    """{ID: position} of words such as 1:512, 3..5:30deg."""
    from m512.files.text.words import joints_of, position

    out: dict[int, int] = {}
    for word in words:
        joints, colon, value = word.rpartition(":")
        try:
            if not colon:
                raise WordError(f"{word}: say ID:POSITION, such as 2:600 or 2:30deg")
            if re.fullmatch(r"[+-][0-9]*|\.", value):  # valid in a motion file only, relative to the step before
                raise WordError(f"{word}: a position is 0..1023, or an angle from the centre such as 30deg or -30deg")
            at = position(value, 0x4000, 1023)
            if at > 1023:
                raise WordError(f"{word}: a position is 0..1023")
            for joint in joints_of(joints, {}):
                if joint in out:
                    raise WordError(f"{word}: joint {joint} has a position already ({out[joint]})")
                out[joint] = at
        except WordError as error:
            raise click.UsageError(str(error)) from None
    return out


@click.command(
    epilog="""\b
Examples:
  m512 torque off          all joints go limp: hold the robot first
  m512 torque on 3 4 5
  m512 torque off 1..6"""
)
@click.argument("state", type=click.Choice(["on", "off"]))
@ids_argument
@robot_options
def torque(state: str, ids: list[int], **options: Any) -> None:
    """Switch the torque of all joints, or of some IDs. On holds the pose that the joints are in.

    A board moves nothing that was switched off until `torque on`. On -p bus:... each command starts the program anew, so there the next
    command that moves switches its joints on again.
    """
    from m512.board.bus import is_bus

    with robot(options) as client:
        client.torque(state == "on", ids)
        _report(client, options["as_json"])
    if state == "off" and is_bus(options["port"] or ""):
        ui.say("note: the next command that moves (play, pose ID:POSITION) switches its joints on again: each command starts the program anew")


@click.command(
    epilog="""\b
Examples:
  m512 get walk_start walk_loop -o walk.m512
  m512 get all -o robot.bin"""
)
@click.argument("pages", nargs=-1, required=True)
@click.option("-o", "--output", required=True, type=FilePath(), help="Motion file of any kind.")
@click.option("--force", is_flag=True, help="Overwrite the file.")
@robot_options
def get(pages: Sequence[str], output: Any, force: bool, **options: Any) -> None:
    """Read PAGES (numbers, names, ranges as 20..25, or `all`) from a running board into a file.

    `all` leaves out page 0, the robot's trim; `0 all` has it as well, and `m512 backup` keeps everything. An Intel HEX file holds these
    pages only; in other files the other pages are empty.
    """
    from m512.files import formats
    from m512.files.image import Image, is_erased
    from m512.files.wording import named_pages_text

    formats.must_be_writable(output, force)  # before a robot is contacted
    with robot(options) as client:
        numbers = page_numbers(pages, client)
        if "all" in pages and 0 in client.used() and 0 not in numbers:
            ui.say("note: page 0, the robot's trim, is left behind: `0 all` reads it as well")
        image = Image.empty(client.pages)
        with ui.phase("Reading") as progress:
            for done, number in enumerate(numbers):
                image[number] = client.page(number)
                progress(done + 1, len(numbers))
        damaged = {number: image[number].title for number in numbers if image[number].fault() and not is_erased(image[number])}
        if damaged:
            ui.say(f"note: damaged on the board, read as they are: {named_pages_text(damaged)}")
        image.given = set(numbers)  # flashing an Intel HEX file of them replaces no others
    for loss in formats.save(output, image, replace=force):
        ui.say(f"loss: {loss}")
    ui.say(f"{output}: pages {' '.join(map(str, numbers))}")
    if options["as_json"]:
        ui.show(json.dumps({"file": str(output), "pages": numbers}))


@click.command(
    epilog="""\b
Examples:
  m512 put library.m512 walk_loop         to the same number
  m512 put library.m512 wave:40 3         wave to number 40, page 3 to 3
  m512 put library.m512 1..9:60           pages 1 to 9 to 60 and on"""
)
@click.argument("source", type=FilePath())
@click.argument("pages", nargs=-1, required=True)
@click.option("--yes", is_flag=True, help="Do not ask before a page is lost.")
@click.option("--sim", is_flag=True, hidden=True)
@json_option
@port_option
def put(source: Path, pages: Sequence[str], yes: bool, **options: Any) -> None:
    """Save PAGES of a motion file to the board, one by one, while Edit runs there: 3, wave, 20..25, `all`, or wave:40 to number 40.

    `all` leaves out page 0, the robot's trim. It asks before it replaces a page that has another name or none, or is damaged. For many
    pages at once, or with Play, `m512 flash` is the way.
    """
    from m512.board.motions import save_pages
    from m512.files import conversion, formats
    from m512.files.image import Image
    from m512.pages import operations

    if options["sim"]:
        raise click.UsageError("the simulator forgets what is saved in it; `m512 play PAGE --sim --motions FILE` plays a file's pages")
    image = formats.load(source)
    conversion.must_be_10_bits(image, source)
    moves = page_moves(pages, image)
    goal = Image.empty(256)  # the board reports how many pages it has
    operations.place(goal, image, moves, replace=True)
    if goal[0].trim_problem():
        raise RefusedError(f"page 0 of {source}: {goal[0].trim_problem()}")
    with robot(options, image="edit") as client:
        titles = {number: "" if steps is None else name for number, (steps, name) in client.listed().items()}
        titles.update({target: goal[target].title for _, target in moves})
        for remark in operations.loose_links(image, moves, titles, client.pages):
            ui.say(f"note: {remark}")
        changed = save_pages(client, goal, [target for _, target in moves], lambda question: ui.confirm(question, yes))
    what = "page" if len(changed) == 1 else "pages"
    ui.say(f"saved: {what} {' '.join(map(str, changed)) or 'none, they were there already'}")
    if options["as_json"]:
        ui.show(json.dumps({"saved": changed}))
