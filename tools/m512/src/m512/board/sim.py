# SPDX-License-Identifier: MIT
"""Starts the simulator (cm5sim) on a port of its own, for commands with --sim.

The simulated board keeps real time if this PC is fast enough. On a busy PC it is late, so m512 waits for minutes before it gives up.

The search order for cm5sim: $M512_CM5SIM, the source tree that holds this package (if built), the folder of this Python interpreter
(`pip install cm5sim` puts it there, with firmware images and motions), the PATH.
"""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
from pathlib import Path

from m512 import ui
from m512.board import child
from m512.board.client import Client
from m512.board.link import Link
from m512.board.memory import BOARDS, Record
from m512.errors import FileError, MissingError, NoAnswerError
from m512.files.image import hex_segments
from m512.places import build_folder, source_tree, wheel_folder

START_SECONDS = 300.0
SOON = (0.6, 1.5, 4.0, 15.0)  # time limits in seconds of the first requests; the first is sent before the board listens
LATER = (60.0, 220.0)  # limits after a note to the user; all together five minutes
SLACK_SECONDS = 300.0


def find_cm5sim() -> Path:
    given, tree, build = os.environ.get("M512_CM5SIM"), source_tree(), build_folder()
    if given:
        if not Path(given).exists():
            raise MissingError(f"there is no simulator {given}, which M512_CM5SIM names")
        return Path(given)
    is_built = tree and build and (build / "host" / "tools" / "sim" / "libcm5sim.so").exists()
    if program := child.found("cm5sim", [tree / "tools" / "sim" / "cm5sim"] if tree and is_built else []):
        return program
    raise MissingError(
        "the simulator cm5sim is not here: install its wheel beside m512 (pip install cm5sim-....whl of a release, or "
        "tools/sim/python of a built source tree), or name the program in M512_CM5SIM"
    )


def find_image(name: str) -> Path:
    """A firmware image by path or by name. A name is searched next to the simulator in use, then in firmware/ of the build folder and of
    the simulator's wheel."""
    places = [Path(name)]
    try:
        beside = find_cm5sim().resolve().parent
        places += [beside / name, beside / "firmware" / name]
    except MissingError:
        pass
    for place in places + [folder / "firmware" / name for folder in (build_folder(), wheel_folder()) if folder]:
        if place.exists():
            return place
    raise MissingError(f"the firmware image {name} is neither here nor beside the simulator: build it (tools/demo does), or give its path (--image)")


def board_of(path: Path) -> str | None:
    """The board that one of our applications in Intel HEX is built for, or None if it has no record."""
    try:
        start, app = hex_segments(path.read_text(encoding="ascii"))[0]
    except (OSError, ValueError, IndexError, FileError):
        return None  # the simulator reports what is wrong with the file
    record = Record.of(app) if start == 0 else None
    return record.board if record and record.board in BOARDS.values() else None


def our_motions() -> Path | None:
    """The motion library of the build folder or of the simulator's wheel, or None."""
    places = [folder / "motions" / "motions.bin" for folder in (build_folder(), wheel_folder()) if folder]
    return next((place for place in places if place.exists()), None)


class Simulator:
    """cm5sim with its console on a pty, with our motions unless others are given. Use as a context manager; `url` is the port."""

    def __init__(self, image: str, motions: Path | None = None, servos: str = "1-18"):
        path = find_image(image)
        command = [str(find_cm5sim()), str(path), "--servos", servos, "--pty", "--no-stdio", "--realtime"]
        board = board_of(path)
        command += [f"--board={board}"] if board else []
        motions = motions or our_motions()
        # A file without a name: nothing is left of it, however this process ends.
        with tempfile.TemporaryFile() as area:
            if motions:
                area.write(self._fitting(motions))
                area.flush()
                command += ["--motions", f"/dev/fd/{area.fileno()}"]
            self.process = subprocess.Popen(
                command,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                pass_fds=(area.fileno(),),
                start_new_session=True,  # Ctrl-C reaches only m512, which stops the robot first
                preexec_fn=child.ending_with_this(signal.SIGKILL),
            )
        try:
            self.url = self._wait_for_port()
        except BaseException:
            self.close()
            raise

    @staticmethod
    def _fitting(motions: Path) -> bytes:
        """The motion area of a file. RefusedError for content that a board with 10 bits and 128 pages cannot play, as with a real board."""
        from m512.files import conversion, formats

        return conversion.for_board(formats.load(motions), motions)[0].to_bytes()

    def _wait_for_port(self) -> str:
        assert self.process.stdout is not None
        said, match = child.first_words(self.process.stdout, START_SECONDS)
        if match:
            return match[1]
        ended = self.process.poll() is not None
        raise MissingError(
            "the simulator did not start: "
            + (
                said.strip()
                or (f"it ended with exit code {self.process.returncode}" if ended else f"it named no port for {START_SECONDS / 60:.0f} minutes")
            )
        )

    def __enter__(self) -> Simulator:
        return self

    def __exit__(self, *_exc: object) -> None:
        self.close()

    def close(self) -> None:
        self.process.terminate()
        try:
            self.process.wait(5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        if self.process.stdout:
            self.process.stdout.close()


def meet(link: Link) -> Client:
    """The Client of a newly started simulated board. NoAnswerError after five minutes without an answer."""
    link.sleep(0.5)
    try:
        return Client(link, SOON, slack=SLACK_SECONDS)
    except NoAnswerError:
        ui.say("note: the simulated board has not answered yet; m512 waits for five minutes, Ctrl-C ends it")
    try:
        return Client(link, LATER, slack=SLACK_SECONDS)
    except NoAnswerError:
        raise NoAnswerError(
            "the simulated board has not answered for 5 minutes: is the image (--image) a Play or Edit? If it is, this PC is "
            "too busy: end other programs, then repeat the command"
        ) from None
