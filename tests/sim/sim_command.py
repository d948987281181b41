# SPDX-License-Identifier: MIT
"""Starts the command cm5sim for tests and communicates with it."""

import os
import pathlib
import re
import select
import signal
import subprocess
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
CM5SIM = TOP / "tools" / "sim" / "cm5sim"
ROBOT = BUILD / "firmware" / "tests" / "robot.hex"  # tests/sim/robot/robot.c


def run(*arguments, stdin=b"", timeout=300):
    """Runs to the end. Returns CompletedProcess with bytes."""
    return subprocess.run([CM5SIM, *map(str, arguments)], input=stdin, capture_output=True, timeout=timeout, check=False)


class Running:
    """A run that continues until it is stopped; its messages name its ports."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([CM5SIM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.messages = b""

    def message(self, pattern, seconds=300):
        """Waits for a message. Returns its first group."""
        end = time.monotonic() + seconds
        while not (match := re.search(pattern, self.messages.decode())):
            left = end - time.monotonic()
            readable, _, _ = select.select([self.process.stderr], [], [], max(0, left))
            chunk = os.read(self.process.stderr.fileno(), 4096) if readable else b""
            if not chunk:
                raise AssertionError(f"{pattern!r} was not said; cm5sim said {self.messages!r}")
            self.messages += chunk
        return match[1]

    def stop(self, number=signal.SIGINT, seconds=300):
        """Sends a signal and returns the exit code."""
        self.process.send_signal(number)
        return self.process.wait(seconds)

    def cpu_seconds(self):
        """CPU time used so far."""
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(") ", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()


def play(tmp_path, text, *arguments):
    """Runs a script."""
    path = tmp_path / "script.txt"
    path.write_text(text)
    return run(ROBOT, "--script", path, *arguments)
