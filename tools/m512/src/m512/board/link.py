# SPDX-License-Identifier: MIT
"""A line to a board: sends and receives bytes with time limits, on anything that pyserial can open (device, pty, socket:// URL).

Every fault of the line becomes a PortError that says what to check. Nothing here knows a protocol.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from m512.board.ports import IN_USE
from m512.errors import M512Error, NoAnswerError, PortError
from m512.signals import settle

if TYPE_CHECKING:
    from m512.board.bus import Program

BAUD = 57600
REPEAT = "repeat the command"


class Link:
    program: Program | None = None  # of a bus: word
    remedy = REPEAT  # what helps after an error, for its message; a command that cannot be repeated has another (kept.py)

    def __init__(self, url: str, image: str = "play"):
        """image: the program to run for a bus: word (bus.py)."""
        import serial

        from m512.board import bus

        self.url = url
        self.program, device = bus.start(url, image)
        try:
            self.port = serial.serial_for_url(device, baudrate=BAUD, timeout=0, write_timeout=20, exclusive=True)
            _keep_others_out(self.port)
        except Exception as error:  # a lost port raises SerialException, OSError, termios.error, ...
            refusal = self._refusal(PortError(explain(url, error)))
            self._end_program()
            raise refusal from None
        self.held = b""  # bytes read and put back
        if self.program:
            try:
                self.held = self._receive(4096, bus.START_SECONDS)  # the program has found its servos and sends its greeting
                self.program.tell()
            except PortError as error:
                refusal = self._refusal(error)
                self.close()
                raise refusal from None
            except BaseException:  # Ctrl-C as well
                self.close()
                raise

    def __enter__(self) -> Link:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_exc: object) -> None:
        """PortError: the adapter of a bus: word was unplugged meanwhile, which is the reason for any other error."""
        program = self.program
        self.close()
        if program and program.was_unplugged and (kind is None or issubclass(kind, M512Error)):
            raise PortError(
                f"the servo adapter of {self.url} was unplugged, which ends any motion. Check its plug and cable, then "
                f"`m512 torque on -p {self.url}`, then {self.remedy}"
            ) from None

    def close(self) -> None:
        _let_others_in(self.port)
        try:
            self.port.close()
        except Exception:  # a lost port may fail to close in many ways, and nothing can be done
            pass
        self._end_program()

    def _refusal(self, error: PortError) -> M512Error:
        return self.program.refusal(error) if self.program else error

    def _end_program(self) -> None:
        if self.program:
            self.program.close()
            self.program = None

    def now(self) -> float:
        """Current time in seconds, on the clock that this line's time limits use. Simulated lines have their own clock."""
        return time.monotonic()

    def sleep(self, seconds: float) -> None:
        time.sleep(seconds)

    def _lost(self, error: Exception) -> PortError:
        check = "See that its program runs and that no other one is connected to it" if "://" in self.url else "Check the cable"
        return PortError(f"the line to {self.url} broke ({error}). {check}; then {self.remedy}")

    def set_rate(self, rate: int) -> None:
        try:
            self.port.baudrate = rate
        except Exception as error:
            raise PortError(f"{self.url} cannot do {rate} baud: {error}") from None

    def write(self, data: bytes, wait: bool = True) -> None:
        """Sends bytes. With `wait` it returns after all of them have left this computer."""
        settle()
        try:
            self.port.write(data)
            if wait:
                self.port.flush()
        except Exception as error:  # a lost port raises SerialException, OSError, termios.error, ...
            raise self._lost(error) from None

    def _receive(self, limit: int, seconds: float) -> bytes:
        """Returns the bytes that the port has. If there are none, waits up to `seconds` for the first."""
        try:
            self.port.timeout = max(seconds, 0)
            first: bytes = self.port.read(1)
            if not first:
                return b""
            more = min(self.port.in_waiting, limit - 1)
            if more > 0:
                self.port.timeout = 0
                first += self.port.read(more)
        except Exception as error:  # a lost port raises SerialException, OSError, termios.error, ...
            raise self._lost(error) from None
        return first

    def read_some(self, seconds: float, limit: int = 4096) -> bytes:
        """Returns bytes as they arrive; empty if none arrives in time."""
        if self.held:
            out, self.held = self.held[:limit], self.held[limit:]
            return out
        return self._receive(limit, seconds)

    def read_until(self, end: bytes, seconds: float, what: str, limit: int = 1 << 20) -> bytes:
        """Reads up to and including `end`, for at most `seconds`. Keeps later bytes for the next read. NoAnswerError: no `end`."""
        out, until = self.look_for(end, seconds, limit)
        if not until:
            tail = out[-60:].decode("ascii", "replace").strip()
            raise NoAnswerError(f"no answer: {what}" + (f" (came: {tail!r})" if tail else ""))
        return out

    def look_for(self, end: bytes, seconds: float, limit: int = 1 << 20) -> tuple[bytes, bool]:
        """Like read_until, but returns (bytes read, whether `end` was found)."""
        out, searched, deadline = bytearray(), 0, self.now() + seconds
        while len(out) < limit:
            at = out.find(end, searched)
            if at >= 0:
                self.held = bytes(out[at + len(end) :]) + self.held
                return bytes(out[: at + len(end)]), True
            searched = max(0, len(out) + 1 - len(end))
            left = deadline - self.now()
            some = self.read_some(min(left, 0.25)) if left > 0 else b""
            if not some and left <= 0:
                break
            out += some
        return bytes(out), False

    def drain(self, quiet: float = 0.05, at_most: float = 2.0) -> bytes:
        """Reads until the line is silent for `quiet` seconds, for about `at_most` seconds."""
        out, deadline = bytearray(), self.now() + at_most
        while self.now() < deadline:
            some = self.read_some(quiet)
            if not some:
                break
            out += some
        return bytes(out)


def _keep_others_out(port: Any) -> None:
    """Keeps other programs from opening the device (POSIX; Windows always does). Some devices do not support it."""
    try:
        import fcntl
        import termios

        fcntl.ioctl(port.fileno(), termios.TIOCEXCL)
    except Exception:
        pass


def _let_others_in(port: Any) -> None:
    try:
        import fcntl
        import termios

        fcntl.ioctl(port.fileno(), termios.TIOCNXCL)
    except Exception:
        pass


def explain(url: str, error: Exception) -> str:
    """Why a port cannot be opened, and what to do about it."""
    text = str(error)
    if _names_no_socket(url):
        return f"{url}: say socket://HOST:PORT, such as socket://127.0.0.1:4000; a port is 1..65535"
    if "Permission" in text or "denied" in text.lower():
        return (
            f"{url}: no permission. On Linux add yourself to the group dialout "
            "(sudo adduser $USER dialout, then log in again); on Windows close other programs that use the port"
        )
    if "No such file" in text or "FileNotFound" in text or "could not find" in text.lower():
        return f"{url}: no such port. Is the adapter plugged in? `m512 doctor` lists the ports"
    if "Inappropriate ioctl" in text:
        return f"{url}: not a serial port"
    if "busy" in text.lower() or "lock" in text.lower():
        return f"{url}: in use by another program (a terminal, another m512?). End that first. {IN_USE}"
    if "refused" in text.lower():
        return f"{url}: nobody listens there"
    if "Name or service not known" in text or "getaddrinfo" in text:
        return f"{url}: no computer has this name (or this one is offline)"
    return f"{url}: cannot be opened ({text})"


def _names_no_socket(url: str) -> bool:
    try:
        return url.lower().startswith("socket:") and not (urlsplit(url).hostname and urlsplit(url).port)
    except ValueError:
        return True
