# SPDX-License-Identifier: MIT
"""The PC's end of the robot's serial line: standard input and output, a pty, one TCP client, or all of them. Each receives what the robot
sends, and the robot receives what each sends."""

from __future__ import annotations

import os
import select
import socket
from collections.abc import Callable

from .options import Options
from .serial_port import SerialPort

LINE_BPS = 57600
STDIN, STDOUT = 0, 1
CLEAR_SCREEN = b"\x1b[2J"
BEGIN, END = 0x1E, ord("\n")  # of an answer to a program
BUSY = b"Somebody else is connected to this robot.\r\n"


def read(file: int) -> bytes | None:
    """Returns the available bytes; b"": the source has ended; None: nothing now."""
    try:
        return os.read(file, 1024)
    except BlockingIOError:
        return None
    except OSError:
        return b""


class Console:
    """typed: called with bytes from standard input; sent: with bytes from a port."""

    def __init__(self, options: Options, typed: Callable[[bytes], None], sent: Callable[[bytes], None]) -> None:
        """OSError: a port cannot be opened."""
        self._typed, self._sent = typed, sent
        self.stdout_ended = options.no_stdio
        self.stdin_ended = False
        self.reads_stdin = not options.no_stdio and options.script is None
        self.port = SerialPort(options.pty, LINE_BPS) if options.pty is not None else None
        self._listener = socket.create_server(("127.0.0.1", options.tcp), backlog=1) if options.tcp is not None else None
        self._client: socket.socket | None = None
        self._waiting: bytearray | None = None  # output for standard output while it is held
        self.draws = False  # the robot has sent an escape sequence: it draws a screen
        self.cleared = False  # the robot has cleared the screen and redraws it
        self._last = b""
        self._for_person = not options.no_stdio and os.isatty(STDOUT)
        self._answers = False  # an answer to a program has begun

    @property
    def tcp_port(self) -> int:
        return int(self._listener.getsockname()[1]) if self._listener else 0

    def close(self) -> None:
        if self.port:
            self.port.close()
        for connection in (self._client, self._listener):
            if connection:
                connection.close()

    def put(self, data: bytes) -> None:
        """Passes on bytes from the robot. Without a reader they are lost, as on a cable."""
        self.draws = self.draws or b"\x1b" in data
        self.cleared = self.cleared or CLEAR_SCREEN in self._last + data
        self._last = (self._last + data)[1 - len(CLEAR_SCREEN) :]
        shown = self._without_answers(data) if self._for_person else data
        if self._waiting is None:
            self.write_stdout(shown)
        else:
            self._waiting += shown
        if self.port:
            self.port.write(data)
        if self._client:
            try:
                self._client.send(data)
            except BlockingIOError:
                pass
            except OSError:
                self._drop_client()

    def _without_answers(self, data: bytes) -> bytes:
        """What a terminal shows: PROTOCOL.md says that bytes from 0x1E to LF are for a program, such as m512 on the pty."""
        shown = bytearray()
        for byte in data:
            self._answers = self._answers or byte == BEGIN
            if not self._answers:
                shown.append(byte)
            self._answers = self._answers and byte != END
        return bytes(shown)

    def write_stdout(self, data: bytes) -> None:
        while data and not self.stdout_ended:
            try:
                data = data[os.write(STDOUT, data) :]
            except BlockingIOError:  # another program made the terminal non-blocking
                select.select([], [STDOUT], [], 0.1)
            except OSError:
                self.stdout_ended = True

    def hold(self) -> None:
        """Holds back output to standard output until let_go()."""
        self._waiting = self._waiting or bytearray()

    def let_go(self) -> None:
        waiting, self._waiting = bytes(self._waiting or b""), None
        self.write_stdout(waiting)

    def _drop_client(self) -> None:
        if self._client:
            self._client.close()
        self._client = None

    def _take_client(self, listener: socket.socket) -> None:
        """Accepts one client at a time; a second one gets a message."""
        try:
            client = listener.accept()[0]
            client.setblocking(False)
            if not self._client:
                self._client = client
                return
            client.send(BUSY)
            client.close()
        except OSError:  # the client has already left
            pass

    def wait(self, seconds: float) -> None:
        """Waits for input for at most this time (0: only polls) and passes it on. Returns early after input."""
        stdin = STDIN if self.reads_stdin and not self.stdin_ended else None
        port = self.port.master if self.port else None
        sources = [source for source in (stdin, port, self._client, self._listener) if source is not None]
        ready = select.select(sources, [], [], max(seconds, 0))[0]
        if stdin in ready:
            data = read(STDIN)
            self.stdin_ended = data == b""
            self._typed(data or b"")
        if self.port and port in ready:
            self._sent(self.port.read())
        if self._client and self._client in ready:
            data = read(self._client.fileno())
            self._sent(data or b"")
            if data == b"":
                self._drop_client()
        if self._listener and self._listener in ready:
            self._take_client(self._listener)
