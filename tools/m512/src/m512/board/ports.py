# SPDX-License-Identifier: MIT
"""Serial ports: lists them, and decides whether a word names one. link.py opens them."""

from __future__ import annotations

import os
import re
import stat

from m512.errors import PortError

IN_USE = "If it is an m512 that waits for a play, Ctrl-C there stops the robot softly; or end it, then repeat this command"


def is_port(word: str) -> bool:
    """Whether a word means a port rather than a file: a device, COM3, a URL such as socket://host:port, or bus:DEVICE (bus.py)."""
    if re.match(r"(bus:.*|COM[0-9]+|[a-z0-9]+://.*)\Z", word, re.I) or word.startswith("\\\\.\\"):
        return True
    if re.match(r"/dev/(std(in|out|err)|fd/.*|null|zero|u?random|full)\Z", word):
        return False
    return is_device(word) or word.startswith("/dev/") and not os.path.exists(word)


def is_device(word: str) -> bool:
    """Whether this path is a character device."""
    try:
        return stat.S_ISCHR(os.stat(word).st_mode)
    except (OSError, ValueError):
        return False


def available() -> list[tuple[str, str]]:
    """(device, description) of the serial ports of this computer, USB adapters first."""
    from serial.tools import list_ports

    ports = [(port.device, port.description if port.description not in (None, "n/a") else "", port.vid is not None) for port in list_ports.comports()]
    return [(device, text) for device, text, _ in sorted(ports, key=lambda port: (not port[2], port[0]))]


def pick(word: str = "") -> str:
    """The port that a word means: a port itself, part of a name or description, or empty for the only port. PortError: none or several."""
    if word and is_port(word):
        return word
    ports = available()
    hits = [(device, text) for device, text in ports if word.lower() in f"{device} {text}".lower()]
    if len(hits) == 1:
        return hits[0][0]
    listed = "".join(f"\n  {device}  {text}" for device, text in ports)
    if word and not hits:
        if os.sep in word and os.path.exists(word) and not is_device(word):
            raise PortError(f"{word} is no serial port" + (f"; there are:{listed}" if ports else "; there are none"))
        hint = "" if os.sep in word else f" (a link or pty is named with its path: -p ./{word})"
        raise PortError(f"no serial port is called {word!r}{hint}" + (f"; there are:{listed}" if ports else "; there are none"))
    if not hits:
        raise PortError("no serial port found. Plug in the adapter, or name it (m512 ... --port /dev/ttyUSB0)")
    raise PortError(f"several serial ports; say which with --port:{listed}")
