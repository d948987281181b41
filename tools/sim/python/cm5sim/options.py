# SPDX-License-Identifier: MIT
"""The command line of cm5sim. `cm5sim --help` explains each option, ../../README.md adds examples."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from typing import Any, NamedTuple, NoReturn

from . import library, words
from .servo import FAULTS, MODELS

EXIT_GOOD, EXIT_EXPECTATION, EXIT_USAGE, EXIT_VIOLATION, EXIT_FILE = range(5)
NEVER = 1 << 63

ABOUT = "The robot on your desk: a CM-5 or CM-2 controller board and its servos, simulated as strictly as the real ones."
MORE = """\
Keys in the terminal: everything goes to the robot (Ctrl-C too), but Ctrl-] leaves, and Ctrl-T is the prefix of the robot's own
knobs: Ctrl-T ? lists them, Ctrl-T r turns the keyboard into an RC-100.

Examples:
  cm5sim play-cm5.hex                          the robot on this terminal
  cm5sim edit-cm5.hex --pty=robot              on a serial port for other programs
  cm5sim play-cm5.hex --motions walk.bin --rc  with a remote control
  cm5sim play-cm5.hex --motions walk.bin --script walk.txt --plot walk.svg
  cm5sim --bus-pty --servos 1-3                servos alone, for PC programs with a Dynamixel library
  cm5sim boot-cm5.hex --flash robot.bin --eeprom robot.eep --pty    keeps what is written

Exit codes: 0 good, 1 an expectation of the script failed, 2 wrong usage or script, 3 the firmware did what the chip or the board
does not allow, 4 a file or port could not be used."""
LINKS = ("--pty", "--tcp", "--bus-pty", "--gdb")  # their argument is optional and follows "="


class ServoPlan(NamedTuple):
    id: int
    model: str
    rate: int


class Options(argparse.Namespace):
    """Parsed options. Those of LINKS are None without the option, "" without its argument."""

    images: list[str]
    board: str
    servos: list[ServoPlan]
    fault: list[tuple[int, str]]
    allow: list[str]
    motions: str | None
    body: str | None
    view: bool
    seed: int
    flash: str | None
    eeprom: str | None
    servo_eeprom: str | None
    pty: str | None
    bus_pty: str | None
    tcp: int | None
    gdb: int | None
    no_stdio: bool
    rc: bool
    script: str | None
    time: int
    pace: str
    quiet: bool
    trace: str | None
    plot: str | None
    summary: bool

    def kept(self) -> list[str]:
        """The files that are kept from run to run."""
        return [path for path in (self.flash, self.eeprom, self.servo_eeprom) if path]


def checked(parse: Callable[[str], Any], what: str) -> Callable[[str], Any]:
    """Makes an argparse type from a parser that returns None for wrong text. {} in `what` stands for the text."""

    def check(text: str) -> Any:
        value = parse(text)
        if value is None:
            raise argparse.ArgumentTypeError(what.format(text))
        return value

    return check


def servo_list(text: str) -> list[ServoPlan]:
    """ "1-18,20:dx117@57142": each part is ID[-ID][:model][@rate]."""

    def wrong(what: str) -> NoReturn:
        raise argparse.ArgumentTypeError(f'{what}: "{text}"')

    plans: list[ServoPlan] = []
    for part in [] if text == "none" else text.split(","):
        names, _, rate = part.partition("@")
        ids, _, model = names.partition(":")
        first, _, last = ids.partition("-")
        low, high = words.number(first, 0, 253), words.number(last or first, 0, 253)
        if low is None or high is None or high < low:
            wrong("IDs are 0..253, as 5 or 1-18")
        if (model or "ax12") not in MODELS:
            wrong(f"models are {', '.join(MODELS[:-1])} and {MODELS[-1]}")
        bps = words.number(rate, 7843, 2000000) if rate else MODEL_RATES.get(model, 1000000)
        if bps is None:
            wrong("rates are 7843..2000000")
        plans += [ServoPlan(servo, model or "ax12", bps) for servo in range(low, high + 1)]
    return plans


MODEL_RATES = {"dx117": 57142}


def _fault(text: str) -> tuple[int, str] | None:
    servo, _, name = text.partition(":")
    number = words.number(servo, 0, 253)
    return (number, name.replace("_", "-")) if number is not None and name.replace("_", "-") in FAULTS else None


def _violation(text: str) -> str | None:
    return text if library.load().violation_find(text.encode()) else None


def _port(default: int) -> Callable[[str], Any]:
    return checked(lambda text: words.number(text, 1, 65535) if text else default, 'ports are 1..65535, not "{}"')


class Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_USAGE, f"cm5sim: {message.replace('argument ', '', 1)}\nTry `cm5sim --help' for more information.\n")


class Version(argparse.Action):
    """Looks up the version only on request: it takes longer than all the rest."""

    def __call__(self, *_: object) -> None:
        from importlib.metadata import PackageNotFoundError, version

        try:
            number = version("cm5sim")
        except PackageNotFoundError:
            number = "of a source tree"
        print(f"cm5sim {number} (Motion512)")
        raise SystemExit(EXIT_GOOD)


def _parser() -> Parser:
    parser = Parser("cm5sim", description=ABOUT, epilog=MORE, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("images", nargs="*", metavar="IMAGE", help="Firmware: .hex, .elf or .bin; looked for in build/firmware as well")
    parser.add_argument("--version", "-V", action=Version, nargs=0, help="Print the version")

    add = parser.add_argument_group("The robot").add_argument
    cm = checked(lambda text: text if text in ("cm5", "cm2") else None, 'cm5 or cm2, not "{}"')
    add("--board", metavar="cm5|cm2", default="cm5", type=cm, help="Controller board (default cm5)")
    add("--servos", metavar="LIST", default="1-18", type=servo_list,
        help="IDs: 1-18 (default), 1,2,7-9, none; 20:dx117 is a DX-117 at 57,142 bps, 5@117647 another rate")  # fmt: skip
    add("--motions", metavar="FILE", help="Motion area: 65,536 bytes (.bin) or Intel HEX; not over a --flash file that exists")
    add("--fault", metavar="ID:NAME", action="append", default=[], type=checked(_fault, 'no such fault (give ID:NAME, see --help): "{}"'),
        help=f"Faulty servo: {', '.join(FAULTS)}")  # fmt: skip
    add("--body", metavar="NAME", help="A body in physics (MuJoCo): humanoid, gp, or a file; tells falls, way, heading. "
        "A hand holds it until its knees have moved and stand still")  # fmt: skip
    add("--view", action="store_true", help="With --body: shows it in MuJoCo's viewer (needs a display)")
    seed = checked(lambda text: words.number(text, 0, 0x7FFFFFFF), 'a number from 0 to 2147483647, not "{}"')
    add("--seed", metavar="N", default=1, type=seed, help="What is in the SRAM at power-on (default 1)")
    add("--flash", metavar="FILE", help="Flash (131,072 bytes): read at the start if it exists, written at the end")
    add("--eeprom", metavar="FILE", help="EEPROM (4,096 bytes), likewise")
    add("--servo-eeprom", metavar="FILE", help="EEPROM areas of the servos, likewise")

    add = parser.add_argument_group("Ways in (this terminal or standard input is always one, but for --no-stdio)").add_argument
    add("--pty", metavar="[=LINK]", help="Serial port of the PC; prints its path, LINK is made to point at it")
    add("--tcp", metavar="[=PORT]", type=_port(0), help="The same on 127.0.0.1:PORT (none: a free one is printed)")
    add("--no-stdio", action="store_true", help="No console on standard input and output")
    add("--rc", action="store_true", help="Keys are the buttons of an RC-100 from the start")
    add("--bus-pty", metavar="[=LINK]", help="No board: the servo bus alone on a serial port, in real time")

    add = parser.add_argument_group("The run").add_argument
    add("--script", metavar="FILE", help="Timed actions and expectations (see README.md); the run ends with it")
    add("--time", metavar="T", default=NEVER, type=checked(words.duration, 'a time like 10s or 500ms: "{}"'),
        help="End after this simulated time (500ms, 10s, 2min)")  # fmt: skip
    add("--realtime", dest="pace", action="store_const", const="real", default="", help="As fast as the real robot (default without a script)")
    add("--fast", dest="pace", action="store_const", const="fast", help="As fast as this PC can (default with a script)")
    add("--quiet", "-q", action="store_true", help="No messages but errors")

    add = parser.add_argument_group("Looking inside").add_argument
    add("--trace", metavar="FILE", help="CSV: goal and present position of every servo, 128 rows a second")
    add("--plot", metavar="FILE", help="Joints over time as .svg or .png (needs matplotlib)")
    add("--summary", action="store_true", help="At the end: simulated and real time, CPU load, stack headroom, serial counters")
    add("--gdb", metavar="[=PORT]", type=_port(1234), help="Wait for avr-gdb on port PORT (default 1234) of 127.0.0.1")
    add("--allow", metavar="KIND", action="append", default=[], type=checked(_violation, 'no such violation: "{}"'),
        help="Do not stop at this violation")  # fmt: skip
    return parser


OF_A_BOARD = ("motions", "flash", "eeprom", "gdb", "rc", "allow", "summary")


def _refuse_shared_files(parser: argparse.ArgumentParser, options: Options) -> None:
    """Ends the process if a file that the run writes is one that it reads, or writes for another option."""
    read = [("the image", name) for name in options.images] + [("--script", options.script), ("--motions", options.motions)]
    written = [(f"--{name.replace('_', '-')}", getattr(options, name)) for name in ("flash", "eeprom", "servo_eeprom", "trace", "plot")]
    users: dict[str, str] = {}
    for user, path in read + written:
        if not path or (os.path.exists(path) and not os.path.isfile(path)):  # /dev/null may serve twice
            continue
        other = users.setdefault(os.path.realpath(path), user)
        if other != user and (user, path) in written:
            parser.error(f"{other} and {user} need a file each, not both {path}")


def parse(arguments: list[str]) -> Options:
    """Parses the command line. Prints an error and ends the process if something is wrong."""
    parser = _parser()
    options = parser.parse_intermixed_args([f"{word}=" if word in LINKS else word for word in arguments], namespace=Options())
    on_console = options.pty is not None or options.tcp is not None
    if options.bus_pty is not None and (options.images or options.script or on_console):
        parser.error("--bus-pty runs the servos alone: no images, script or console with it")
    if options.bus_pty is not None and (of_board := [name for name in OF_A_BOARD if getattr(options, name) not in (None, False, [])]):
        parser.error(f"--bus-pty runs the servos alone: --{of_board[0]} is for a board")
    if options.bus_pty is None and not options.images and options.flash is None:
        parser.error("no image given (for example play-cm5.hex); --help shows examples")
    if (options.body and options.bus_pty is not None) or (options.view and not options.body):
        parser.error("--view shows the --body, and --body needs a board (no --bus-pty)")
    for name in ("flash", "eeprom", "servo_eeprom"):
        path = getattr(options, name)
        if path and os.path.islink(path):  # the file that it leads to is read, locked and replaced, and the link stays
            setattr(options, name, os.path.realpath(path))
    _refuse_shared_files(parser, options)
    if options.no_stdio and not on_console and not options.script and options.bus_pty is None and options.time == NEVER:
        parser.error("--no-stdio without --pty, --tcp, --script or --time would run for ever, unseen")
    return options
