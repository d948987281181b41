# SPDX-License-Identifier: MIT
"""Gets into a board's boot loader, and identifies the loader and the board.

Play or Edit? ---- yes --> @reset, then '#' (asks first when edits would be lost)
   | no, or it cannot
prompt there? ---- yes --> identify
   | no
in an interrupted session of ours? --> HELLO
   | no
Play or Edit by now? -- yes --> as above: the board had just been restarted
   | no
ask for the MODE button, '#' every 25 ms until the banner comes; now and then: Play or Edit?
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Callable, Union

from click import Abort

from m512.board import banner, mailbox
from m512.board.block import IDENTITY, RESET, STAY, BlockLoader
from m512.board.client import BEGIN, FLOW, Client, framed
from m512.board.factory import FactoryLoader
from m512.board.factory_line import BOOT_MODE, KNOCK, PROMPT
from m512.board.link import Link
from m512.errors import M512Error, NoAnswerError, PortError, RefusedError

May = Callable[[str], None]
Loader = Union[BlockLoader, FactoryLoader]
BANNER = b"SYSTEM O.K."
WAITS = "The board waits in its boot loader; `m512 run` starts the application."
HASH_SECONDS = 0.025  # the loader's window after a start is 60 ms
HASHES_MOST = 2100  # together with everything else sent blindly, less than factory_flash.BLIND_MOST
KNOCK_SECONDS = 1.5
IDENTIFY_TRIES = 6
WAIT_SECONDS = 60.0
RESTART_SECONDS = 3.0  # limit after a requested restart
ASK_EVERY = 4.0  # seconds between two questions whether Play or Edit answers
ASK_QUIET = 0.4  # no '#' after the question: Play and Edit execute it after 250 ms without a byte
ANSWER = BEGIN + b"@ver image="
BANNER_IN_FLASH = (0x1F780, 0x1F880)  # of "CM5 Boot loader V1.31", the known version (boot/ORIGINAL.md, 7b)


def at_prompt(link: Link) -> bool:
    """Whether a loader answers at its prompt.

    A factory loader may be in a download that another program left open. It then takes the knock as data, which it writes where that
    download's bytes would have gone. The pause after the knock ends the download.
    """
    link.drain(0.02, 0.3)
    for _ in range(2):
        link.write(KNOCK)
        came, prompt = link.look_for(PROMPT, KNOCK_SECONDS)
        if prompt:
            link.drain(0.03)
            return True
        if came.strip(b"\x00\x08 "):  # something else answers
            return False
    return False


def end_session(link: Link) -> None:
    """Brings our loader to its prompt out of the session that an interrupted transfer has left open. NoAnswerError: there is none."""
    BlockLoader(link, tries=1, seconds=0.4).leave()


def identify(link: Link, started: bytes = b"", board: str = "") -> Loader:
    """The loader at the prompt. It is asked in plain text first: the factory loader would take a frame for typed text.
    started: its output since its start, if received. board: the board according to the user (banner.py).
    """
    text, not_known = b"", 0
    for _ in range(IDENTIFY_TRIES):
        link.drain(0.05)
        link.write(b"id\r")
        text, ended = link.look_for(PROMPT, KNOCK_SECONDS)
        ours = IDENTITY.search(text.decode("ascii", "replace"))
        if ours:
            banner.board_of(ours.group(2), board)
            return BlockLoader(link, ours.group())
        # Twice, and with the right echo: our loader says the same after a command that the line has damaged.
        not_known += text.lstrip().startswith(b"id\r\n Bad Command")
        if not_known == 2:
            return _factory(link, started, board)
        if not ended:
            break
    if not text:
        raise NoAnswerError("the boot loader stopped answering. Press MODE, then repeat the command")
    raise NoAnswerError(f"a boot loader that this program does not know answered {text[-60:]!r}. Is this the right port?")


def _factory(link: Link, started: bytes, board: str) -> FactoryLoader:
    """A factory loader on a supported board. If its banner was not received, the banner is read from where the known version keeps it. A
    loader of another version is restarted to send its banner again."""
    loader = FactoryLoader(link)
    name = banner.name_in(started) or banner.name_in(loader.read(*BANNER_IN_FLASH))
    if not name:
        loader.enter("reset")
        said = call_by_hash(link, RESTART_SECONDS)
        if said is None:
            raise NoAnswerError(
                "the boot loader was restarted to say which board it is on, and did not come back. Repeat the command, and press MODE when it asks"
            )
        name = banner.name_in(said)
    loader.board = banner.board_of(name, board)
    mailbox.empty(loader)
    return loader


def call_by_hash(link: Link, seconds: float, asks: bool = False) -> bytes | None:
    """Sends '#' until a loader shows its banner, then clears the loader's line. Returns the loader's output, or None if there is no loader.

    A loader sends 0xFF when it starts and then listens for 60 ms. After HASHES_MOST '#' to an unknown listener, more are sent only
    after that 0xFF. asks: asks now and then whether Play or Edit answers, and returns what came, with ANSWER in it, when one does.
    """
    deadline, came, after_ff, sent = link.now() + seconds, b"", 0, 0
    ask_at, hash_at = link.now() + ASK_EVERY, 0.0
    while link.now() < deadline:
        if asks and link.now() >= ask_at and not after_ff and sent < HASHES_MOST:
            link.write(framed("ver"))
            sent += len(framed("ver"))
            ask_at, hash_at = link.now() + ASK_EVERY, link.now() + ASK_QUIET
        # A few '#' after the 0xFF of a start are enough; more would only fill the loader's line.
        if after_ff < 8 and (0 < after_ff or sent < HASHES_MOST and link.now() >= hash_at):
            link.write(b"#")
            sent, hash_at = sent + 1, link.now() + HASH_SECONDS / 2  # none for an echo
        some = link.read_some(HASH_SECONDS)
        came = (came + some)[-4096:]
        if BANNER in came or PROMPT in came:  # a prompt without a banner: an interrupted session of ours has ended
            came += link.look_for(PROMPT, 0.3)[0]
            link.drain(0.1, 1.0)
            link.write(KNOCK)
            return came if link.look_for(PROMPT, KNOCK_SECONDS)[1] else None
        if ANSWER in came.translate(None, FLOW):
            link.drain(0.1, 1.0)
            return came
        after_ff = after_ff + 1 if came.endswith(b"\xff") or (after_ff and not some) else 0
        if after_ff > 30:  # nothing follows the 0xFF for a while: it was something else
            after_ff = 0
            came = b""
    return None


def refuse(question: str) -> None:
    """The answer when nobody can be asked: raises RefusedError."""
    raise RefusedError(f"{question} Nobody was asked")


def enter(link: Link, say: Callable[[str], None], seconds: float = WAIT_SECONDS, may: May = refuse, board: str = "") -> Loader:
    """The board's loader, ready for work. `say` tells the user what to do. `may` asks a question and raises RefusedError when the answer
    is no. board: the board according to the user. RefusedError also for an unsupported board."""
    said = _restarted(link, say, may)
    if said is None:
        if at_prompt(link):
            loader = identify(link, board=board)
            loader.was_at_prompt = True
            return loader
        try:
            end_session(link)
            return identify(link, board=board)
        except NoAnswerError:
            pass
        said = _restarted(link, say, may)  # a board that somebody had just restarted did not listen yet
    if said is not None:
        return identify(link, said, board)
    say(f"Press the MODE button of the controller (reset). Waiting for its boot loader, up to {seconds:.0f} s; Ctrl-C gives up.")
    awaited = _awaited(link, say, seconds, may, board)
    if awaited is None:
        raise NoAnswerError(
            f"no boot loader answered within {seconds:.0f} s. Is the controller on, the cable in its PC "
            "socket, and this the right port? (m512 doctor looks at each)"
        )
    return awaited


def _restarted(link: Link, say: Callable[[str], None], may: May) -> bytes | None:
    """The loader's output after a restart by Play or Edit. None: neither runs, or no loader came."""
    return call_by_hash(link, RESTART_SECONDS) if reset_by_application(link, say, may) else None


def _awaited(link: Link, say: Callable[[str], None], seconds: float, may: May, board: str) -> Loader | None:
    """The loader after somebody has pressed MODE, or after Play or Edit has begun to answer and restarted. None: neither. A second press
    of MODE may take a loader away while it is being identified."""
    deadline, failure = link.now() + seconds, None
    while link.now() < deadline:
        said = call_by_hash(link, deadline - link.now(), asks=True)
        if said is not None and ANSWER in said.translate(None, FLOW):
            said = _restarted(link, say, may)
        if said is None:
            continue
        try:
            return identify(link, said, board)
        except NoAnswerError as error:
            if failure:
                raise
            failure = error
            say("A boot loader began to answer and stopped. If MODE was pressed twice, press it once more.")
    if failure:
        raise failure
    return None


def give_back(loader: Loader) -> str:
    """Leaves the board as enter() found it: at the loader's prompt, or restarted. Returns a sentence for the user about what it does now."""
    if loader.was_at_prompt:
        loader.leave(STAY)
        return WAITS
    return restart(loader)


def restart(loader: Loader) -> str:
    """Resets the board. Returns a sentence for the user about what it does now."""
    restores_mode = isinstance(loader, FactoryLoader) and loader.stays and loader.mode_before != 0xFF
    stays = not restores_mode and loader.read_eeprom(BOOT_MODE, BOOT_MODE + 1) == b"\xff"
    loader.leave(RESET)
    return WAITS if stays else "The controller restarts."


@contextmanager
def as_found(loader: Loader) -> Iterator[None]:
    """Leaves the board as it was found when something ends the block early: an error, a no, Ctrl-C, SIGTERM. Not after a
    PortError."""
    try:
        yield
    except PortError:
        raise
    except (M512Error, KeyboardInterrupt, SystemExit, Abort):
        loader.leave(STAY if loader.was_at_prompt else RESET)
        raise


def reset_by_application(link: Link, say: Callable[[str], None], may: May = refuse) -> bool:
    """Asks Play or Edit to restart the controller. Returns False if neither answers. `may` is asked when edits would be lost."""
    try:
        client = Client(link, (0.9,))
    except NoAnswerError:
        return False
    where = client.where()
    if where["state"] != "idle":
        raise RefusedError("something plays on the robot: `m512 stop` first")
    if int(where.get("layer", "0")) or int(where.get("aim", "0"), 16):
        raise RefusedError("`m512 layer`, `aim` or `swing` moves or holds joints of the robot: `m512 stop` first")
    if client.has_edits():
        may("Edit holds a page with edits that are not saved; restarting loses them. Go on?")
    link.write(framed("reset") + b"\r")  # does not wait for the answer: the loader's window opens soon
    return True
