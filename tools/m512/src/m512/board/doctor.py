# SPDX-License-Identifier: MIT
"""Examines everything between this PC and the servos, from near to far. Reports what is wrong and what to do.

It writes nothing to the board and moves nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Callable

from m512.board.client import OLDER, Client
from m512.errors import M512Error, NoAnswerError, RefusedError
from m512.files.wording import counted, ranges

if TYPE_CHECKING:
    from m512.board.link import Link

OK, WARN, BAD = "ok", "look", "bad"
Add = Callable[..., None]  # takes the arguments of Finding()
LOW_BATTERY_DV = 96  # 9.6 V: below this without load, a pack is nearly empty


@dataclass
class Finding:
    what: str
    state: str
    text: str
    advice: str = ""

    def as_dict(self) -> dict[str, str]:
        return {key: value for key, value in asdict(self).items() if value}


def examine(word: str, tell: Callable[[Finding], None], meet: Callable[..., Client] = Client) -> list[Finding]:
    """Returns all findings; each also goes to `tell` at once. `word`: the port, or empty for the only one. meet: makes the Client of a
    line (sim.meet for a simulated board)."""
    out: list[Finding] = []

    def add(*parts: str) -> None:
        out.append(Finding(*parts))
        tell(out[-1])

    _libraries(add)
    url = _port(word, add)
    if url:
        _board(url, add, meet)
    return out


def _libraries(add: Add) -> None:
    add(
        "python",
        OK if sys.version_info >= (3, 9) else BAD,
        "Python " + sys.version.split()[0],
        "" if sys.version_info >= (3, 9) else "m512 needs Python 3.9 or later",
    )
    from m512.board.sim import find_cm5sim

    try:
        add("simulator", OK, str(find_cm5sim()))
    except M512Error as error:
        add("simulator", WARN, "not installed; only --sim needs it", str(error).partition(": ")[2])


def _port(word: str, add: Add) -> str | None:
    from m512.board import ports

    found = ports.available()
    add(
        "ports",
        OK if found or word else BAD,
        ", ".join(device for device, _ in found) or "none found",
        "" if found or word else "plug in the USB adapter; on Linux look at `dmesg | tail`",
    )
    url = ""
    try:
        url = ports.pick(word)
        from m512.board.link import Link

        Link(url).close()
    except M512Error as error:
        if found or word:
            first = str(error).splitlines()[0].removesuffix("; there are:")  # the line above lists them
            add("port", BAD, first, "-p takes one of the ports above" if found and word and not url else "")
        return None
    add("port", OK, f"{url} opens")
    return url


def _board(url: str, add: Add, meet: Callable[..., Client]) -> None:
    from m512.board.link import Link

    with Link(url) as link:
        try:
            client = meet(link)
        except NoAnswerError as error:
            _loader(link, add, str(error))
            return
        except RefusedError as error:
            add("board", WARN, *str(error).split(": ", 1))
            return
        except M512Error as error:
            add("board", BAD, str(error))
            return
        version = client.version
        add("image", OK, f"{version.get('image', '?')} {version.get('version', '')} on a {version.get('board', '?')}")
        for look in (_robot, _servos, _motions):
            try:
                look(client, add)
            except M512Error as error:
                add(look.__name__.strip("_"), BAD, str(error), "repeat; if it stays, restart the controller (MODE)")


def _loader(link: Link, add: Add, why: str) -> None:
    """`why`: the error of a board on which neither Play nor Edit has answered."""
    from m512.board import download, loaders

    is_there = loaders.at_prompt(link)
    if not is_there:
        with suppress(NoAnswerError):
            loaders.end_session(link)
            is_there = True
    if is_there:
        try:
            loader = loaders.identify(link)
        except M512Error as error:
            advice = "" if isinstance(error, RefusedError) else "press MODE and run m512 doctor again"
            add("loader", BAD, str(error), advice)
            return
        version = getattr(loader, "version", "")
        add("loader", OK, f"{loader.name} {version}".strip() + (f" on a {loader.board}" if loader.board else ""))
        state = loader.app_state() if hasattr(loader, "app_state") else ""
        if state in download.UNFIT:
            add("application", BAD, f"application: {state}", download.FLASH_ONE)
        else:
            add("application", WARN, "the board waits in its boot loader" + (f"; application: {state}" if state else ""), "m512 run starts it")
        if hasattr(loader, "app_state"):
            loader.leave()
        return
    heard = link.drain(0.3, 1.0)
    if why.startswith(OLDER):
        add("board", BAD, *OLDER.split(". ", 1))
        return
    add(
        "board",
        BAD,
        f"{counted(len(heard), 'byte')} came, but nobody answers as Play, Edit or a boot loader" if heard else "silence",
        "is the controller on, and the cable in the socket for the PC? Then press MODE while `m512 term` runs: one byte "
        "0xFF must come. A program of this PC behind a link (--pty, --tcp) looks for its servos first, for up to 10 s. "
        "With the factory's firmware, `m512 flash` works all the same. After an interrupted `m512 flash` wait 10 s. A Play with the setting "
        "`fast 1` answers a terminal at 115,200 only; there `settings fast 0` and a restart bring m512 back",
    )


def _robot(client: Client, add: Add) -> None:
    state = client.where()
    volts = int(state.get("dv", "0"))
    if volts:
        add("battery", WARN if volts < LOW_BATTERY_DV else OK, f"{volts / 10:.1f} V", "charge it soon" if volts < LOW_BATTERY_DV else "")
    missed = int(state.get("missed", "0"))
    if missed and client.version.get("image") == "play":  # Edit misses ticks only while it draws its screen and nothing moves
        add("ticks", WARN, f"{missed} ticks of motion were missed since the start", "motions are not quite smooth")
    faulty = int(state.get("faulty", "0"), 16)
    if faulty:
        ids = " ".join(str(joint) for joint in range(31) if faulty >> joint & 1)
        reason = "Edit's screen in `m512 term` says the reason" if client.can_save else "type `faults` in `m512 term` for the reason"
        add("faults", BAD, f"servos with a fault: {ids}", f"{reason}; let hot ones cool down, then `m512 torque on`")


def _servos(client: Client, add: Add) -> None:
    for _ in range(4):  # shortly after its start the board has not read all servos yet
        pose = client.pose()
        if pose and all(at is not None for at, _ in pose.values()):
            break
        client.link.sleep(0.4)
    if not pose:
        add(
            "servos",
            BAD,
            "no servo answers",
            "is the battery connected (USB does not feed servos) and the bus cable plugged in? "
            "New DX servos talk slowly: Play's `servos` names them, `fast` of the monitor image moves them to 1 Mbps",
        )
        return
    silent = [joint for joint, (at, _) in pose.items() if at is None]
    limp = [joint for joint, (_, on) in pose.items() if not on]
    add(
        "servos",
        BAD if silent else OK,
        f"{counted(len(pose), 'servo')}, IDs {_ranges(pose)}"
        + (f"; silent now: {_ranges(silent)}" if silent else "")
        + (f"; limp: {_ranges(limp)}" if limp else ""),
        "check the cable before the first silent one" if silent else "",
    )


def _motions(client: Client, add: Add) -> None:
    pages = client.list_pages()
    good = [n for n, (steps, _) in pages.items() if steps]
    damaged = [n for n, (steps, _) in pages.items() if steps is None]
    if damaged:
        add("pages", BAD, "damaged: " + " ".join(f"{n} ({pages[n][1]})" for n in damaged), "flash your motions again, or repair the pages in Edit")
    add("motions", OK if good else WARN, f"{counted(len(good), 'page')} with an action", "" if good else "flash some: m512 flash library.m512")


def _ranges(numbers: Iterable[int]) -> str:
    return " ".join(ranges(numbers)) or "none"
