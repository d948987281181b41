# SPDX-License-Identifier: MIT
"""The factory boot loader's protocol, written from its description: commands, texts, echo, download with all its faults.

Damage that a careless PC tool would do is done here too, and recorded in `hurt`: the loader's own section overwritten, a line of 80
characters ended by CR.
"""

from peer import APP, RESET, LoaderBoard
from pty_peer import PtyPeer
from virtual_peer import VirtualPeer

WINDOW, LED_TIME, SILENCE = 0.060, 0.100, 0.111
BANNER = b"\r\n\n SYSTEM O.K. (CM5 Boot loader V1.31)"
PROMPT = b"\r\n - "
SEPARATORS = bytes(range(0x20, 0x30)) + b"\t"
LEDS, PROMPTED, READY, LOADING, EEPROM_DATA = range(2, 7)


class FactoryBoard(LoaderBoard):
    """says: the banner, which contains the board's name."""

    def __init__(self, flash=None, state=PROMPTED, presses_mode=True, says=BANNER):
        self.says = says
        self.flash = bytearray(flash or b"\xff" * 0x20000)
        self.eeprom = bytearray(b"\xff" * 4096)
        self.eeprom[0xFFF] = 0x11
        self.before = bytes(self.flash)
        self.hurt, self.downloads, self.words, self.mails = [], [], [], []
        self.dump_at, self.page = 0, bytearray(256)
        self.dead_pages = set()  # flash that does not take the data
        super().__init__(state, presses_mode)

    # Start

    def press_mode(self):
        super().press_mode()
        if self.eeprom[0xFF4] == 0xAA:  # the mailbox
            at = 0xE000 + 512 * self.eeprom[0xFF5]
            self.flash[at : at + 512] = self.eeprom[0x800:0xA00]
            self.mails.append(self.eeprom[0xFF5])
            self.eeprom[0xFF4] = 0x55

    def on_silence(self, seconds):
        now = self.now()
        if self.state == RESET and now - self.since > WINDOW:
            stays = self.last == 0x23 or self.eeprom[0xFFF] == 0xFF
            self.state, self.since = (LEDS if stays else APP), now
        elif self.state == LEDS and now - self.since > LED_TIME:
            self.state = PROMPTED
            self.send(self.says + PROMPT)
            typed, self.line = bytes(self.line), bytearray()
            for byte in typed:
                self.on_byte(byte)
        elif self.state == LOADING and seconds > SILENCE:
            self._download_ends()

    def on_byte(self, byte):
        if self.before_the_loader(byte):
            return
        if self.state == LEDS:
            self.line.append(byte)
        elif self.state == PROMPTED:
            self._typed(byte)
        elif self.state in (READY, LOADING):
            self.state = LOADING
            self._downloaded(byte)
        elif self.state == EEPROM_DATA:
            self._eeprom_byte(byte)

    # Line

    def _typed(self, byte):
        if byte in (0x0D, 0x0A):
            if len(self.line) >= 80:
                self.hurt.append("80 characters and CR")
            line, self.line = bytes(self.line), bytearray()
            self._command(line)
            if self.state == PROMPTED:
                self.send(PROMPT)
        elif byte == 8:
            if self.line:
                self.line.pop()
                self.send(b"\x08 \x08")
        elif byte not in (0, 27):
            if len(self.line) < 80:
                self.line.append(byte)
                self.send(bytes([byte]))

    def _command(self, line):
        line = line.lstrip(b" ")
        words, word = [], bytearray()
        for byte in line + b" ":
            if byte in SEPARATORS:
                if word or byte == 0x2C:
                    words.append(bytes(word))
                word = bytearray()
            else:
                word.append(byte)
        if not words or not words[0]:
            return
        self.words.append(line)
        name, args = words[0].decode("latin-1").lower(), words[1:]
        handler = getattr(
            self,
            "_do_"
            + {
                "flash": "f",
                "eep": "e",
                "eeprom": "e",
                "l": "load",
                "ld": "load",
                "dn": "load",
                "down": "load",
                "g": "go",
                "application": "app",
                "system": "sys",
                "v": "verify",
            }.get(name, name),
            None,
        )
        if handler is None:
            self.send(b"\r\n Bad Command.('help' for instructions definition)")
        else:
            handler([self._number(arg) for arg in args])

    @staticmethod
    def _number(text):
        value = 0
        for char in text.upper():
            digit = char - 48 if char < 58 else char - 55
            value = (value * 16 + digit) & 0xFFFFFFFF
        return value

    def _dump(self, memory, args):
        if args:
            self.dump_at = args[0]
        self.dump_at %= len(memory)
        for _ in range(8):
            at = self.dump_at
            row = bytes(memory[(at + k) % len(memory)] for k in range(16))
            text = "".join(chr(b) if 0x20 <= b <= 0x7F else "." for b in row)
            self.send(f"\r\n {at:08X} : {''.join(f'{b:02X} ' for b in row)}{text}".encode("latin-1"))
            self.dump_at = (at + 16) % len(memory)
        self.send(b"\r\n")

    def _do_f(self, args):
        self._dump(self.flash, args)

    def _do_e(self, args):
        self._dump(self.eeprom, args)

    def _do_app(self, _):
        self.eeprom[0xFFF] = 0x11
        self.send(b"\r\n Boot to Application")

    def _do_sys(self, _):
        self.eeprom[0xFFF] = 0xFF
        self.send(b"\r\n Boot to System")

    def _do_go(self, args):
        self.send(f"\r\n Jump Address : 0x{(args or [0])[0]:08X}".encode())
        self.state = APP
        self.app_heard.clear()

    def _do_reset(self, _):
        self.press_mode()

    # Download

    def _do_load(self, args):
        self.address = args[0] if len(args) == 1 else 0
        self.received = bytearray()
        self.send(f"\r\n Write Address : {self.address:08X}\r\n Ready..".encode())
        self.state = READY

    def _downloaded(self, byte):
        self.received.append(byte)
        self.page[(len(self.received) - 1) % 256] = byte
        if len(self.received) % 256 == 0:
            self._write_page(self.address + len(self.received) - 1)

    def _write_page(self, last_address):
        base = last_address % 0x20000 // 256 * 256
        if base >= 0x1E000:
            self.hurt.append(f"own section at {base:X}")
        if base not in self.dead_pages:
            self.flash[base : base + 256] = self.page

    def _download_ends(self):
        size, total, last = len(self.received), sum(self.received[:-1]) & 0xFFFFFFFF, self.received[-1]
        if size % 256:
            self._write_page(self.address + size - 1)
        self.downloads.append((self.address, size))
        self.eeprom[0xFF6] = last
        self.eeprom[0xFF7:0xFFB] = total.to_bytes(4, "little")
        self.eeprom[0xFFB:0xFFF] = size.to_bytes(4, "little")
        self.state = PROMPTED
        self.send(
            (b"Success" if total & 0xFF == last else b"Error")
            + b"\r\n Rewriting:0X0000"
            + f"\r\n Size:0X{size:08X}  Checksum:{total & 0xFF:02X}-{last:02X}".encode()
            + PROMPT
        )

    # EEPROM

    def _do_eep_dn(self, args):
        if len(args) != 2:
            self.send(b"\r\n EEP_DN StartAddress, Length")
            return
        self.address, self.count = args[0] % 4096, args[1]
        self.received = bytearray()
        self.send(f"\r\n Write Address : {self.address:08X}\r\n Ready".encode())
        self.state = EEPROM_DATA

    def _eeprom_byte(self, byte):
        self.received.append(byte)
        if len(self.received) == self.count:
            for k, value in enumerate(self.received):
                self.eeprom[(self.address + k) % 4096] = value
            self.state = PROMPTED
            self.send(b"\r\n O.K." + PROMPT)


class FactoryPeer(FactoryBoard, VirtualPeer):
    pass


class FactoryPtyPeer(FactoryBoard, PtyPeer):
    pass
