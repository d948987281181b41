# SPDX-License-Identifier: MIT
"""Whether the user can see how to leave cm5sim when the robot fills the terminal: Edit on a terminal emulator (pyte)."""

import os
import re
import signal
import subprocess
import sys
import time

import pexpect
import pyte
import pytest

from m512.files.image import from_bytes
from tests.sim.sim_command import BUILD, CM5SIM

MOTIONS = BUILD / "motions" / "motions.bin"
PATIENCE_S = 240
HINT = "Ctrl-] ends the simulator"


class Seen:
    """cm5sim on a terminal of this size, and its screen."""

    def __init__(self, rows, columns, tmp_path, *options, term="xterm"):
        self.screen = pyte.Screen(columns, rows)
        self.stream, self.raw = pyte.ByteStream(self.screen), b""
        self.screen.write_process_input = lambda answer: self.child.send(answer)
        eeprom = tmp_path / "robot.eep"
        eeprom.write_bytes(b"\xff" * 4095 + b"\x11")  # the loader starts the application
        self.child = pexpect.spawn(
            str(CM5SIM),
            ["boot-cm5.hex", "edit-cm5.hex", "--motions", str(MOTIONS), "--eeprom", str(eeprom), *options],
            dimensions=(rows, columns),
            timeout=PATIENCE_S,
            env={**os.environ, "TERM": term},
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.child.close(force=True)

    def until(self, holds):
        """Reads until the condition holds."""
        end = time.monotonic() + PATIENCE_S
        while not holds():
            assert time.monotonic() < end, "\n".join(self.screen.display)
            try:
                heard = self.child.read_nonblocking(4096, 0.1)
            except pexpect.TIMEOUT:
                continue
            self.raw += heard
            self.stream.feed(heard)

    def shows(self, text, row=None):
        rows = self.screen.display if row is None else [self.screen.display[row - 1]]
        return any(text in line for line in rows)

    def leave(self):
        self.child.send("\x1d")
        self.raw += self.child.read()


@pytest.mark.parametrize("rows, columns", [(24, 80), (40, 100)])
def test_way_out_stands_on_the_screen_of_edit_and_in_the_title(tmp_path, rows, columns):
    with Seen(rows, columns, tmp_path) as seen:
        seen.until(
            lambda: (
                seen.shows(HINT, rows)
                and seen.shows("Arrows move, HELP explains, EXIT leaves", min(rows, 35))
                and "Ctrl-] ends it" in seen.screen.title
                and (seen.screen.cursor.x, seen.screen.cursor.y) == (19, 0)
            )
        )  # cursor position set by Edit
        seen.child.send("page 3\r")
        seen.until(lambda: seen.shows("wave"))
        if rows > 35:
            assert seen.shows(HINT, rows)  # it stays below Edit's screen
        else:
            assert not seen.shows(HINT)  # Edit has overwritten it
            seen.child.send("exit\r")  # a user who tries to leave this way sees it again
            seen.until(lambda: seen.shows(HINT, rows))
        seen.leave()
        assert seen.raw.count(b"\x1b[22;2t") == 1 and seen.raw.count(b"\x1b[23;2t") == 1  # the previous title is restored


def test_way_out_is_told_to_who_presses_ctrl_c_once(tmp_path):
    with Seen(24, 80, tmp_path) as seen:
        seen.until(lambda: seen.shows("HELP explains"))
        seen.child.send("\x03")
        seen.until(lambda: seen.shows("Ctrl-C goes to the robot. Ctrl-] ends the simulator"))
        seen.until(lambda: b"\x1b[?1049l" in seen.raw)  # it disappears by itself, and the robot's screen is back
        seen.child.send("\x03page 3\r")
        seen.until(lambda: seen.shows("wave"))
        assert seen.raw.count(b"Ctrl-C goes to the robot") == 1


def test_console_of_linux_gets_no_title_that_it_would_print(tmp_path):
    with Seen(24, 80, tmp_path, term="linux") as seen:
        seen.until(lambda: seen.shows(HINT, 24))
        seen.leave()
        assert b"\x1b]" not in seen.raw and b"\x1b[22;2t" not in seen.raw


def test_first_wave_of_help_opens_a_page_that_is_empty_in_our_library(tmp_path):
    with Seen(24, 80, tmp_path) as seen:
        seen.until(lambda: seen.shows("HELP explains"))
        seen.child.send("help\r")
        seen.until(lambda: seen.shows("-- more"))
        number = re.search(r"page (\d+) +opens an empty page", "\n".join(seen.screen.display))[1]
    assert from_bytes(MOTIONS.read_bytes())[int(number)].is_empty


def test_what_was_saved_is_kept_when_the_terminal_window_is_closed(tmp_path):
    flash = tmp_path / "robot.flash"
    with Seen(36, 80, tmp_path, "--flash", str(flash)) as seen:
        seen.until(lambda: seen.shows("HELP explains"))
        seen.child.send("page 5\r")
        seen.until(lambda: seen.shows("Number:0005"))
        seen.child.send("name closed\r")
        seen.until(lambda: seen.shows("* unsaved"))
        seen.child.send("save\r")
        seen.until(lambda: not seen.shows("* unsaved"))
        with open(os.devnull, "r+b") as nothing:
            os.dup2(nothing.fileno(), seen.child.child_fd)  # closes the window: input and output end, the kernel sends SIGHUP
        end = time.monotonic() + PATIENCE_S
        while not flash.exists():
            assert time.monotonic() < end, "nothing was kept"
            time.sleep(0.1)
    assert from_bytes(flash.read_bytes()[0xE000:0x1E000])[5].name == b"closed"


def test_answers_to_a_program_on_the_pty_stay_off_the_screen(tmp_path):
    link = tmp_path / "port"
    with Seen(36, 80, tmp_path, f"--pty={link}") as seen:
        seen.until(lambda: seen.shows("HELP explains"))
        with subprocess.Popen([sys.executable, "-m", "m512", "pose", "--text", "-p", str(link)], stdout=subprocess.DEVNULL) as m512:
            seen.until(lambda: m512.poll() is not None)
        seen.child.send("goto 3 3\r")
        seen.until(lambda: seen.shows("goto 3 3"))
    assert m512.returncode == 0
    assert b"\x1e" not in seen.raw and not seen.shows("@")


SLOW_THREAD = """
import time
from cm5sim import board, command
stop, close = board.Board.stop, board.Board.close
board.Board.stop = lambda self: (time.sleep(0.5), stop(self))
board.Board.close = lambda self: (close(self), time.sleep(1))
command.main()
"""


def test_signal_waits_for_no_board_that_is_closed_under_it():
    """The thread that handles the signal was delayed while the run ended, and stopped a board that was already freed."""
    command = [sys.executable, "-c", SLOW_THREAD, str(BUILD / "firmware" / "play-cm5.hex")]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        assert process.stdout.read(1)
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
