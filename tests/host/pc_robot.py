# SPDX-License-Identifier: MIT
"""Play or Edit as a program of this PC, with simulated servos behind an adapter (bad_adapter.py), for test_*.py.

The programs run in real time: every wait is for a text or a state, and times out only after minutes.
"""

import os
import pathlib
import re
import select
import signal
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
PROGRAMS = BUILD / "host" / "firmware"
CM5SIM = TOP / "tools" / "sim" / "cm5sim"
PATIENCE_S = 120
SYNC_WRITE, GOAL, READ = 0x83, 30, 2
LATE = b"The computer came 0.1 s late"  # the program has aborted its play, as it should


def program(image):
    return PROGRAMS / image / f"motion512-{image}"


class Disturbed(Exception):
    """Other load on this computer has held up the program, so the test has no result (conftest.py repeats it)."""


def until(condition, what):
    end = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        assert time.monotonic() < end, what() if callable(what) else what
        time.sleep(0.02)
    return found


class Robot:
    """Servos, adapter and program. Use as a context."""

    def __init__(self, folder, image="play", servos="1-18", motions=None, adapter=(), bus=(), arguments=()):
        self.folder, self.image = pathlib.Path(folder), image
        self.port, self.log = self.folder / "adapter", self.folder / "packets.txt"
        self.motions, self.arguments = motions, list(map(str, arguments))
        self.sim = self.start(CM5SIM, f"--bus-pty={self.folder / 'bus'}", "--servos", servos, *bus)
        until((self.folder / "bus").exists, "cm5sim made no port")
        self.adapter = self.start(sys.executable, TOP / "tests/host/bad_adapter.py", self.folder / "bus", self.port, "--log", self.log, *adapter)
        until(self.port.exists, "the adapter made no port")
        self.said, self.console, self.end, self.process = b"", b"", None, None

    @staticmethod
    def start(*command):
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        try:
            os.sched_setscheduler(process.pid, os.SCHED_RR, os.sched_param(2))  # as punctual as hardware, where permitted
        except PermissionError:
            pass
        return process

    def run(self, *more):
        """Starts the program and waits for the port of its console."""
        command = [program(self.image), "--robot", self.folder / "robot", "--pty", *self.arguments, *more]
        command += ["--motions", self.motions] if self.motions else []
        self.said, self.console = b"", b""
        self.process = self.start(*command, self.port)
        path = self.told(r"serial port: (\S+)")
        self.end = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        return self

    def told(self, pattern):
        """Waits for this on the program's standard error; returns the first group."""

        def look():
            if select.select([self.process.stderr], [], [], 0)[0]:
                self.said += os.read(self.process.stderr.fileno(), 65536)
            return re.search(pattern, self.said.decode())

        found = until(look, lambda: f"{pattern!r} was not told: {self.said!r}")
        return found[1] if found.re.groups else found[0]

    def send(self, text):
        os.write(self.end, text.encode())

    def take(self):
        try:
            self.console += os.read(self.end, 65536)
        except BlockingIOError:
            pass
        if LATE in self.console:
            raise Disturbed(self.console.decode())

    def expect(self, text, start=0):
        """Waits for a text after position `start`; returns the position after the text."""

        def look():
            self.take()
            at = self.console.find(text.encode(), start)
            return at >= 0 and at + len(text.encode())

        return until(look, lambda: f"{text!r} did not come: {self.console[start:]!r}")

    def ask(self, line):
        """Types a line into Play and returns its answer, up to the next prompt."""
        self.take()
        start = len(self.console)
        self.send(line + "\r")
        end = self.expect("\r\n] ", self.expect("\r\n", start))
        return self.console[start:end].decode().replace("\r\n", "\n").split("\n", 1)[1]

    def packets(self, instruction=None):
        """What the program has sent so far, as bytes."""
        lines = self.log.read_text().splitlines()
        sent = [bytes.fromhex(line[2:]) for line in lines if line.startswith("> ")]
        return [packet for packet in sent if instruction is None or packet[4] == instruction]

    def frames(self):
        """The goals of each frame sent, as a dict per frame."""
        goals = [packet[7:-1] for packet in self.packets(SYNC_WRITE) if packet[5] == GOAL]
        return [{data[at]: data[at + 1] | data[at + 2] << 8 for at in range(0, len(data), 3)} for data in goals]

    def was_late(self):
        """Whether adapter or servos were held up for longer than real ones take to answer."""
        return self.log.exists() and "late" in self.log.read_text().splitlines()

    def pull(self):
        self.adapter.send_signal(signal.SIGUSR1)
        until(lambda: not self.port.exists(), "the plug is still in")

    def plug(self):
        self.adapter.send_signal(signal.SIGUSR2)
        until(self.port.exists, "the plug is still out")

    def stop(self, number=signal.SIGINT):
        """Ends the program as Ctrl-C does; returns its exit code."""
        self.process.send_signal(number)

        def ended():
            self.take()
            return self.process.poll() is not None

        until(ended, lambda: f"the program goes on: {self.console!r}")
        self.said += self.process.stderr.read()
        os.close(self.end)
        self.end = None
        return self.process.returncode

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in (self.process, self.adapter, self.sim):
            if process is not None:
                if process.poll() is None:
                    process.kill()
                process.wait()
                process.stderr.close()
        if self.end is not None:
            os.close(self.end)
