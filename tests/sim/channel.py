# SPDX-License-Identifier: MIT
"""The programs' channel as in PROTOCOL.md, for the tests: builds requests and separates answers from terminal output."""

from m512.crc16 import crc16

BEGIN = b"\x1e"
FLOW = bytes((0x11, 0x13))


def request(words):
    """The bytes of a request."""
    text = words.encode() + b" "
    return BEGIN + text + b"%04X\r" % crc16(text)


class Ear:
    """Splits the output of a board into `answers`, without their frame, and text for the terminal."""

    def __init__(self):
        self.answers, self._open = [], None

    def hear(self, data):
        """Returns the terminal's part of `data`."""
        shown = bytearray()
        for byte in data.translate(None, FLOW):
            if self._open is None and byte == BEGIN[0]:
                self._open = bytearray()
            elif self._open is None:
                shown.append(byte)
            elif byte == 0x0A:
                self.answers.append(self._open.removesuffix(b"\r").decode())
                self._open = None
            else:
                self._open.append(byte)
        return bytes(shown)
