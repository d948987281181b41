# SPDX-License-Identifier: MIT
"""Our loader's command line and block protocol, written from its specification, on a line that can be disturbed."""

import binascii

from peer import APP, RESET, LoaderBoard
from pty_peer import PtyPeer
from virtual_peer import VirtualPeer

PROMPT = b"\r\n - "
PROMPTED, SESSION = range(2, 4)
SLOW, RATES = 57600, {34: 57600, 16: 117647}  # UBRR -> rate; the program on the PC calls 57,143 bit/s 57,600


def crc16(data):
    return binascii.crc_hqx(data, 0xFFFF)


class BlockBoard(LoaderBoard):
    def __init__(self, flash=None, board=1, state=PROMPTED, presses_mode=True):
        self.flash = bytearray(flash or b"\xff" * 0x20000)
        self.eeprom = bytearray(b"\xff" * 4096)
        self.board, self.frame = board, None
        self.writes, self.left = [], []
        self.broken_pages = set()  # the loader detects that they do not take the data
        self.forgetful_pages = set()  # the loader does not detect it
        self.rate = self.pc_rate = SLOW
        super().__init__(state, presses_mode)

    def set_rate(self, rate):
        self.pc_rate = rate

    def send(self, data):
        if self.rate == self.pc_rate:
            super().send(data)

    def press_mode(self):
        self.frame, self.rate = None, SLOW
        super().press_mode()

    def on_silence(self, seconds):
        if self.state == RESET and self.now() - self.since > 0.06:
            self.state = PROMPTED if self.last == 0x23 else APP
            if self.state == PROMPTED:
                self.send(b"\r\n\n SYSTEM O.K. (Motion512 Boot loader V1.00)" + PROMPT)
        if self.state == SESSION and self.frame and seconds > 0.1:
            self.frame = None
            self._answer(0, 0, 4)
        if self.state == SESSION and seconds > 4:
            self.state, self.frame, self.rate = PROMPTED, None, SLOW
            self.send(PROMPT)

    def on_byte(self, byte):
        if self.rate != self.pc_rate or self.before_the_loader(byte):
            return
        if self.state == SESSION or byte == 0xA5:
            self.state = SESSION
            self._frame_byte(byte)
        elif byte == 0x0D:
            line, self.line = bytes(self.line).strip(), bytearray()
            if line == b"id":
                self.send(b"\r\n ID Motion512 boot 1.00 " + {1: b"CM5", 2: b"CM2", 3: b"CM510"}[self.board] + b" api=1 app=none")
            elif line.strip(b"#"):
                self.send(b"\r\n Bad Command.(see 'help')")
            self.send(PROMPT)
        elif byte == 8:
            self.line[-1:] = b""
        else:
            self.line.append(byte)
            self.send(bytes([byte]))

    def _frame_byte(self, byte):
        if self.frame is None:
            if byte == 0xA5:
                self.frame = bytearray()
            return
        self.frame.append(byte)
        if len(self.frame) >= 3 and self.frame[2] > 129:
            self.frame = None
            self._answer(0, 0, 4)
        elif len(self.frame) >= 3 and len(self.frame) == 3 + 2 * self.frame[2] + 2:
            frame, self.frame = bytes(self.frame), None
            if crc16(frame[:-2]) != int.from_bytes(frame[-2:], "big"):
                self._answer(0, 0, 4)
            else:
                self._request(frame[0], frame[1], frame[3:-2])

    def _answer(self, command, number, status, data=b""):
        inner = bytes([command, number, len(data) // 2 + 1, status, 0]) + data
        self.send(b"\x5a" + inner + crc16(inner).to_bytes(2, "big"))

    def _request(self, command, number, body):
        first = int.from_bytes(body[:2], "little")
        count = int.from_bytes(body[2:4], "little")
        status, data = 2, b""
        if command == 1:
            status = 0
        elif command == 2 and first in RATES:
            self._answer(command, number, 0)
            self.rate = RATES[first]
            return
        elif command == 3:
            memory, at = (self.eeprom, first - 0x8100) if first >= 0x8100 else (self.flash, first)
            status, data = 0, bytes(memory[at * 256 : at * 256 + 256])
        elif command == 4 and first < 0x1E0 and len(body) == 258:
            same = self.flash[first * 256 : first * 256 + 256] == body[2:]
            status = 3 if first in self.broken_pages else 1 if same else 0
            if status == 0:
                self.flash[first * 256 : first * 256 + 256] = body[2:] if first not in self.forgetful_pages else bytes(256)
                self.writes.append(first)
        elif command == 5 and count <= 64 and first + count <= 512:
            status = 0
            for page in range(first, first + count):
                piece = bytes(self.flash[page * 256 : page * 256 + 256])
                data += crc16(piece).to_bytes(2, "little") + (sum(piece) & 0xFFFF).to_bytes(2, "little")
        elif command == 6 and count <= 32 and len(body) >= 4 + count:
            status = 0
            self.eeprom[first : first + count] = body[4 : 4 + count]
        elif command == 7:
            status = 0
            self.left.append(first)
            self._answer(command, number, status)
            self.rate = SLOW
            self.state = APP if first == 1 else PROMPTED
            if first == 2:
                self.press_mode()
            elif first == 0:
                self.send(PROMPT)
            return
        self._answer(command, number, status, data)


class BlockPeer(BlockBoard, VirtualPeer):
    pass


class BlockPtyPeer(BlockBoard, PtyPeer):
    pass
