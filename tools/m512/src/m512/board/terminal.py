# SPDX-License-Identifier: MIT
"""A raw terminal. One thread copies from the keyboard to the board, one from the board to the screen. Ctrl-] is the only reserved key.

A third thread calls the loader and sends files. Any key ends that before it goes to the board itself: a `stop` must not wait.
"""

from __future__ import annotations

import io
import re
import sys
import threading
import time
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any, BinaryIO, Callable

from m512 import ui
from m512.board.bus import NO_LOADER
from m512.board.client import Client
from m512.board.factory_line import PROMPT
from m512.board.link import Link
from m512.board.loaders import BANNER
from m512.errors import FileError, M512Error
from m512.files import storage
from m512.streams import is_terminal

KEY = "\x1d"  # Ctrl-]
HELP = """
 Ctrl-] h   this help              Ctrl-] q  quit
 Ctrl-] l   call the boot loader: press MODE, '#' is sent until it answers
 Ctrl-] s   send a text file, a line at a time    Ctrl-] b  send a file as it is
 Ctrl-] g   log to a file, on and off             Ctrl-] Ctrl-]  send Ctrl-]
 Any key ends the call or the sending.
"""
CALL_SECONDS = 30
PIPE_QUIET = 0.3  # silence that ends an answer when lines come from a pipe
HELD_SECONDS = 10  # how long the board may hold a file back by XOFF: saving takes less than a second
LINE_SECONDS = 2.0  # how long the board may take to answer a line of a file
LINE_BYTES = 512  # longest line of a text; it takes 0.09 s
HEARD_BYTES = 64
XON, XOFF = 0x11, 0x13
HIDDEN = (XON, XOFF, 0xFF)  # flow control, and the byte that a controller sends at its start


class Terminal:
    def __init__(self, url: str, log: Path | None = None, image: str = "edit", force: bool = False):
        self.log: BinaryIO | None = None
        self.log_lock = threading.Lock()  # one thread writes it, the other opens and closes it
        self.running, self.held = True, False
        self.trouble: Exception | None = None  # what has ended the terminal
        self.heard_at, self.heard = 0.0, b""  # the last that came
        self.work: threading.Thread | None = None  # calls the loader or sends a file
        self.work_ends = ""  # why it ends before its time
        self.link = Link(url, image=image)
        if log:
            try:
                self._open_log(log, force)
            except M512Error:
                self.link.close()
                raise

    def _open_log(self, path: Path, force: bool = False) -> None:
        """M512Error: no new file can be made there, or `force` is given and the old one not to be replaced (storage.write)."""
        log, losses = storage.begin(path, force)
        self.log = log
        for loss in losses:
            self._say(f"loss: {loss}")

    def _to_log(self, data: bytes) -> None:
        try:
            with self.log_lock:
                if self.log:
                    self.log.write(data)
                    self.log.flush()
        except OSError as error:
            self._close_log()
            self._say(f"the log ends here: {error.strerror}")

    def _close_log(self) -> None:
        with self.log_lock:
            log, self.log = self.log, None
        if log:
            with suppress(OSError):  # every write was flushed, and one that failed was told
                log.close()

    def run(self, send: Path | None = None, data: bytes = b"") -> None:
        """data: the content of the file `send`. It goes to the board first, line by line. FileError: standard output is
        closed."""
        if sys.stdout is None:
            raise FileError("standard output is closed: nothing would be seen of the board")
        if not is_terminal(sys.stdin):
            self._run_plain(data)
            return
        from serial.tools.miniterm import Console

        console = Console()
        if isinstance(sys.stdin, io.TextIOWrapper):
            sys.stdin.reconfigure(errors="replace")  # a terminal set to Latin-1 sends bytes that are no UTF-8
        self._say(f"{self.link.url}, 57600 8N1. Ctrl-] h for help, Ctrl-] q to quit.")
        console.setup()
        try:
            self._begin_reading(console)
            if send:
                self._begin(lambda: self._send_lines(send, data))
            self._keys(console)
        finally:
            self._end("the terminal ends")
            console.cleanup()
            self._end_reading()
            self.link.close()
            self._close_log()
        if self.trouble:
            raise self.trouble

    def _run_plain(self, data: bytes) -> None:
        """For standard input that is not a terminal: sends each line after the answer to the line before, and copies the answers to
        standard output."""
        try:
            for line in chain(data.decode("utf-8", "replace").splitlines(), sys.stdin or ()):
                self.link.write(line.rstrip("\r\n").encode("utf-8", "replace") + b"\r")
                answer = self.link.drain(PIPE_QUIET, LINE_SECONDS)
                sys.stdout.buffer.write(bytes(b for b in answer if b not in HIDDEN))
                sys.stdout.buffer.flush()
                self._to_log(answer)
            if self.link.program and self._has_edits():
                ui.say("note: Edit's page had edits that were not saved; they are lost. End the lines with `save`")
        finally:
            self.link.close()
            self._close_log()

    @staticmethod
    def _say(text: str) -> None:
        sys.stderr.write("\r\n-- " + text.replace("\n", "\r\n") + "\r\n")
        sys.stderr.flush()

    def _begin_reading(self, console: Any) -> None:
        self.running = True
        self.reader = threading.Thread(target=self._read, args=(console,), daemon=True)
        self.reader.start()

    def _end_reading(self) -> None:
        self.running = False
        self.reader.join(1)

    def _read(self, console: Any) -> None:
        """Copies what the board sends to the screen, unchanged."""
        while self.running:
            try:
                data = self.link.read_some(0.1)
            except M512Error as error:
                self._lost(error)
                return
            if not data:
                continue
            self.heard_at, self.heard = time.monotonic(), (self.heard + data)[-HEARD_BYTES:]
            self.held = data.rfind(XOFF) > data.rfind(XON) if XOFF in data or XON in data else self.held
            self._to_log(data)
            try:
                console.write_bytes(bytes(b for b in data if b not in HIDDEN))
            except OSError as error:  # a full disk, or a pipe whose reader has gone
                self._lost(error, f"nothing that the board sends can be shown any more: {error.strerror}")
                return

    def _lost(self, error: Exception, why: str = "") -> None:
        self.trouble, self.work_ends, self.running = error, why or "the line broke", False
        self._say(f"{why or error} (press a key)")

    def _begin(self, work: Callable[[], None]) -> None:
        """Starts work that sends. It ends soon after work_ends is set."""

        def whole() -> None:
            try:
                work()
            except M512Error as error:
                self._lost(error)

        self.work_ends, self.work = "", threading.Thread(target=whole, daemon=True)
        self.work.start()

    def _end(self, why: str) -> None:
        if self.work:
            self.work_ends = self.work_ends or why
            self.work.join()
            self.work = None

    def _keys(self, console: Any) -> None:
        while self.running:
            try:
                key = console.getkey()
            except KeyboardInterrupt:
                key = "\x03"
            if not self.running or key == "":
                return
            self._end("a key was pressed")
            if key != KEY:
                # The keyboard sends LF for Enter on POSIX; boards want CR.
                self.link.write(("\r" if key == "\n" else key).encode("utf-8", "replace"), wait=False)
            elif not self._own(console):
                return

    def _own(self, console: Any) -> bool:
        """Acts on the key after Ctrl-]. Returns False for quit."""
        key = console.getkey().lower()
        if key == "q":
            return not self._may_quit(console)
        if key == KEY:
            self.link.write(KEY.encode())
        elif key == "l" and self.link.program:
            self._say(NO_LOADER)
        elif key == "l":
            self._say(f"Press MODE; '#' is sent for {CALL_SECONDS} s, or until you press a key")
            self._begin(self._call)
        elif key in "sb":
            name = self._ask(console, "file: ")
            if name:
                self._send(Path(name), self._send_lines if key == "s" else self._send_pieces)
        elif key == "g":
            self._toggle_log(console)
        else:
            self._say(HELP)
        return True

    def _has_edits(self) -> bool:
        try:
            return Client(self.link).has_edits()
        except M512Error:  # an answer that does not come keeps nobody here
            return False

    def _may_quit(self, console: Any) -> bool:
        """Asks if edits would be lost: the program for an adapter ends with the terminal, but a board's Edit goes on."""
        if not self.link.program:
            return True
        self._end_reading()
        if self._has_edits():
            self._say("Edit ends with this terminal, and its page has edits that are not saved. q again: lose them; any other key: go on")
            if console.getkey().lower() != "q":
                self._begin_reading(console)
                return False
        return True

    def _call(self) -> None:
        until, more = time.monotonic() + CALL_SECONDS, 3
        self.heard = b""
        while not self.work_ends and time.monotonic() < until and more:
            self.link.write(b"#")
            time.sleep(0.015)
            # A loader sends 0xFF when it starts, then its text; an application may echo. Three more '#' fit into the loader's window of
            # 60 ms, and the last byte in it must be a '#'.
            more -= any(sign in self.heard for sign in (b"\xff", BANNER, PROMPT))
        if self.work_ends:
            self._say(f"the call has ended: {self.work_ends}")
        else:
            time.sleep(0.35)
            if more:
                self._say(f"no boot loader has answered in {CALL_SECONDS} s")
        self.link.write(b"\x08\r")  # so that no '#' stands before what is typed next

    def _toggle_log(self, console: Any) -> None:
        if self.log:
            self._close_log()
            self._say("log closed")
            return
        name = self._ask(console, "log to: ")
        if name:
            try:
                storage.must_be_free(Path(name), False)
                self._open_log(Path(name))
            except M512Error as error:
                self._say(str(error).replace(" (--force overwrites it)", "; name another file"))

    def _ask(self, console: Any, prompt: str) -> str:
        sys.stderr.write("\r\n-- " + prompt)
        sys.stderr.flush()
        out = ""
        while True:
            key = console.getkey()
            if key in "\r\n":
                sys.stderr.write("\r\n")
                return out.strip()
            if key in ("\x1b", "\x03"):
                return ""
            if key in ("\x7f", "\x08"):
                out = out[:-1]
                sys.stderr.write("\b \b")
            elif key >= " ":
                out += key
                sys.stderr.write(key)
            sys.stderr.flush()

    # Files

    def _send(self, path: Path, how: Callable[[Path, bytes], None]) -> None:
        try:
            data = storage.read(path)
        except FileError as error:
            self._say(str(error))
        else:
            self._begin(lambda: how(path, data))

    def _send_lines(self, path: Path, data: bytes) -> None:
        """After each line waits until the board has answered and is quiet. Waits for XON after XOFF, but not for ever: it may be lost. Refuses
        long lines: a key could not end them before they have left."""
        lines = data.replace(b"\r\n", b"\n").split(b"\n")
        for number, line in enumerate(lines, 1):
            if len(line) > LINE_BYTES:
                self._say(f"{path} was not sent: its line {number} has {len(line):,} bytes, so it is no text. Ctrl-] b sends a file as it is")
                return
        for number, line in enumerate(lines, 1):
            until = time.monotonic() + HELD_SECONDS
            while self.held and not self.work_ends:
                time.sleep(0.01)
                if time.monotonic() > until:
                    self.held = False  # the next try does not wait for the lost one
                    self.work_ends = f"the board has said XOFF and no XON for {HELD_SECONDS} s"
            if self.work_ends:
                self._say(f"line {number} of {path} and all after it were not sent: {self.work_ends}")
                return
            sent = time.monotonic()
            self.link.write(line + b"\r")
            while time.monotonic() - sent < LINE_SECONDS and not self.work_ends:
                time.sleep(0.02)
                if self.heard_at > sent and time.monotonic() - self.heard_at > 0.06:
                    break
        self._say(f"{path} sent")

    def _send_pieces(self, path: Path, data: bytes) -> None:
        """A line at a time, or 512 bytes of what has none. So a text that is ended by a key leaves no half line on the board."""
        sent = 0
        for piece in re.findall(rb"[^\r\n]{0,511}[\r\n]|[^\r\n]{1,512}", data):
            if self.work_ends:
                self._say(f"the first {sent:,} of {len(data):,} bytes of {path} were sent: {self.work_ends}")
                return
            self.link.write(piece)
            sent += len(piece)
        self._say(f"{path} sent, {sent:,} bytes")
