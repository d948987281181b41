# SPDX-License-Identifier: MIT
"""`-p bus:/dev/ttyUSB0`: servos on a USB adapter of this computer, without a board. Play or Edit runs here as a program (hal/host). Its
console takes the place of a board's line.

The search order for the programs: $M512_PROGRAMS, the build folder of a source tree, the folder of this Python interpreter
(`pip install motion512`), the PATH. The robot's persistent data is in its own folder: $M512_ROBOT, or the programs' default.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import threading
from pathlib import Path
from typing import IO

from m512 import ui
from m512.board import child
from m512.board.ports import IN_USE
from m512.errors import EXIT_BAD_FILE, FileError, M512Error, MissingError, PortError, RefusedError
from m512.places import build_folder

PREFIX = "bus:"
PLAY_RATE = 1_000_000  # of bus:DEVICE without a rate
RATES = range(9600, 3_000_001)  # of the programs' --rate
START_SECONDS = 120.0  # the search for servos takes up to 10 s; a busy computer needs more
END_SECONDS = 30.0
LAST_SECONDS = 2.0  # from the end of a program's console to the end of the program
FILE_BYTES = {"pages.bin": 131072, "journal.bin": 8192, "eeprom.bin": 4096}  # of the robot's folder (hal/host/README.md)
NO_LOADER = (
    "servos on an adapter have no board with a boot loader. Motions go there with `m512 put FILE all -p bus:...`; "
    "what the robot keeps are the files of its folder (hal/host/README.md)"
)


def is_bus(word: str) -> bool:
    return word.startswith(PREFIX)


def refuse(word: str) -> None:
    """RefusedError on a bus: word, for commands that need a boot loader."""
    if is_bus(word):
        raise RefusedError(f"{word}: {NO_LOADER}")


def refuse_lasting(word: str, what: str) -> None:
    """RefusedError on a bus: word, for commands whose effect ends with the program: they would have no visible effect."""
    if is_bus(word):
        raise RefusedError(
            f"{what} lasts as long as the program behind {word}, and that ends with this command: "
            f"type it in `m512 term -p {word} --image play`, or drive a play with `m512 drive`"
        )


def parts(word: str) -> tuple[str, int]:
    """(device, rate) of bus:DEVICE or bus:DEVICE@RATE. PortError: no such word, or no rate of an adapter."""
    match = re.fullmatch(r"bus:(?P<device>[^@]+)(@(?P<rate>\d+))?", word)
    if not match:
        raise PortError(f"{word}: say bus:DEVICE or bus:DEVICE@RATE, such as bus:/dev/ttyUSB0")
    rate = int(match["rate"] or PLAY_RATE)
    if rate not in RATES:
        raise PortError(f"{word}: the rate is {RATES[0]}..{RATES[-1]}")
    return match["device"], rate


def find_program(image: str) -> Path:
    name = f"motion512-{image}"
    given, build = os.environ.get("M512_PROGRAMS"), build_folder()
    places = [Path(given) / name] if given else []
    places += [build / "host" / "firmware" / image / name] if build else []
    if program := child.found(name, places):
        return program
    raise MissingError(
        f"the program {name} is not here: install the wheel motion512 of a release (Linux), build it from the sources "
        "(cmake --preset host), or name its folder in M512_PROGRAMS"
    )


def wrong_file() -> Path | None:
    """The file of the robot's folder that the programs refuse for its size, if there is one."""
    data, home = os.environ.get("XDG_DATA_HOME", ""), os.environ.get("HOME", "")
    data = data if data.startswith("/") else f"{home}/.local/share"
    folder = os.environ.get("M512_ROBOT") or f"{data}/motion512"
    for name, size in FILE_BYTES.items():
        path = os.path.join(folder, name)
        if os.path.isfile(path) and os.path.getsize(path) != size:
            return Path(path)
    return None


def _holder(path: str) -> str:
    """The program that has locked a file or folder, as " (NAME, process PID)", where Linux tells it, else an empty text."""
    try:
        inode = os.stat(path).st_ino
        holder = re.search(rf"FLOCK .* (\d+) \S+:{inode} ", Path("/proc/locks").read_text())
        name = Path(f"/proc/{holder[1]}/comm").read_text(errors="replace").strip() if holder else ""  # Linux may cut it inside a letter
        return f" ({name}, process {holder[1]})" if holder else ""
    except OSError:
        return ""


class Program:
    """Play or Edit on an adapter. `console` is the port to talk to. Other output of the program is shown as notes. `was_unplugged`: the
    program has reported that the adapter is gone; certain after close()."""

    def __init__(self, word: str, image: str):
        device, rate = parts(word)
        command = [str(find_program(image)), "--pty", "--rate", str(rate)]
        if os.environ.get("M512_ROBOT"):
            command += ["--robot", os.environ["M512_ROBOT"]]
        self.word = word
        # A session of its own: Ctrl-C reaches only m512, which ends the program after its own last request.
        self.process = subprocess.Popen(
            command + [device],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,
            preexec_fn=child.ending_with_this(signal.SIGTERM),  # brings the robot to a halt
        )
        assert self.process.stderr is not None
        self.errors: IO[bytes] = self.process.stderr
        self.said, self.was_unplugged = "", False
        try:
            self.console = self._wait_for_console()
        except BaseException:  # Ctrl-C as well: a program left behind would keep the adapter and the robot's folder
            self.close()
            raise

    def tell(self) -> None:
        """Shows from now on what the program writes. Before, it may be the reason why the program ends."""
        self.reader = threading.Thread(target=self._tell, daemon=True)
        self.reader.start()

    def _wait_for_console(self) -> str:
        self.said, match = child.first_words(self.errors, START_SECONDS)
        if not match:
            raise self._refusal()
        self.said = self.said.replace(match[0], "")
        return match[1]

    def refusal(self, error: PortError) -> M512Error:
        """The reason of a program that has ended since it opened its console, else `error`. Not after tell()."""
        try:
            self.process.wait(LAST_SECONDS)
        except subprocess.TimeoutExpired:
            return error
        self.said += self.errors.read().decode("utf-8", "replace")
        return self._refusal()

    def _refusal(self) -> M512Error:
        """The error for a program that ended by itself."""
        self.close()
        text = self._in_our_words(self.said.strip().splitlines()[-1]) if self.said.strip() else "the program did not start"
        in_use = re.match(r"(.+): in use by another program", text)
        if in_use:
            return PortError(f"{text}{_holder(in_use[1])}. {IN_USE}")
        return FileError(text) if self.process.returncode == EXIT_BAD_FILE else PortError(text)

    def _in_our_words(self, line: str) -> str:
        """A line of the program, with its options replaced by m512's equivalents."""
        text = re.sub(r"^motion512-\w+: ", "", line)
        text = text.replace("--off, or m512 torque off", f"m512 torque off -p {self.word}")
        text = re.sub("(say )?`on`", f"`m512 torque on -p {self.word}` (in `m512 term`: on)", text)
        return text.replace("with --robot", "in M512_ROBOT").replace("--robot", "M512_ROBOT")

    def _tell(self) -> None:
        """Shows what the program writes, line by line, until it ends."""
        rest = self.said
        while True:
            *lines, rest = rest.replace("\r", "\n").split("\n")
            for line in lines:
                self.was_unplugged |= "the servo adapter" in line and "is gone" in line
                text = self._in_our_words(line.strip())
                if text:
                    ui.say(f"note: {text}")
            some = os.read(self.errors.fileno(), 4096).decode("utf-8", "replace")
            if not some:
                return
            rest += some

    def close(self) -> None:
        """Ends the program, which first brings the robot to a halt."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.wait(END_SECONDS)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        if hasattr(self, "reader"):
            self.reader.join(END_SECONDS)
        self.errors.close()


def start(url: str, image: str) -> tuple[Program | None, str]:
    """(program, its console) for a bus: word, (None, url) for any other port."""
    if not is_bus(url):
        return None, url
    program = Program(url, image)
    return program, program.console
