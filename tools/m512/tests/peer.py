# SPDX-License-Identifier: MIT
"""A board at the end of a cable: bytes in, bytes out, silence, and a cable that can be pulled.

A board is a class with on_byte() and on_silence(), combined with one of two ends: VirtualPeer (virtual_peer.py, in virtual
time, for nearly every test) or PtyPeer (pty_peer.py, a real port). Its state (flash, EEPROM) outlives the cable.
"""


class Peer:
    """`path` names the port. The ends provide pull(), plug(), `plugged`, now() in seconds, and _to_pc(data)."""

    def __init__(self):
        self.cut_after = None  # bytes in both directions together before the cable is pulled
        self.garble = None  # function(direction, index, byte) -> byte or None (lost)
        self.moved = 0

    def _count(self, direction, byte):
        """Passes a byte through the cable. Returns what comes out at the other end, or None."""
        index, self.moved = self.moved, self.moved + 1
        if self.cut_after is not None and index >= self.cut_after:
            self.pull()
            return None
        return self.garble(direction, index, byte) if self.garble else byte

    def send(self, data):
        """Sends to the PC."""
        if self.garble is None:
            passes = data if self.cut_after is None else data[: max(self.cut_after - self.moved, 0)]
            self.moved += len(passes)
            if self.plugged:
                self._to_pc(passes)
                if len(passes) < len(data):
                    self._count("<-", data[len(passes)])
            return
        arrived = bytearray()
        for byte in data:
            byte = self._count("<-", byte) if self.plugged else None
            if byte is not None and self.plugged:
                arrived.append(byte)
        if self.plugged:
            self._to_pc(bytes(arrived))

    def on_byte(self, byte):
        raise NotImplementedError

    def on_silence(self, seconds):
        """Called often, with the time since the last byte arrived."""


APP, RESET = range(2)


class LoaderBoard:
    """The start-up of a board with a boot loader. An application runs (APP) until MODE is pressed (RESET). A simulated person presses it
    on receiving `##`, unless presses_mode is off. The loader's own states follow."""

    def __init__(self, state, presses_mode):
        self.state, self.presses_mode = state, presses_mode
        self.since, self.last = 0.0, 0  # time of the reset; the last byte after it
        self.line, self.app_heard = bytearray(), bytearray()
        super().__init__()

    def press_mode(self):
        self.state, self.since, self.last = RESET, self.now(), 0
        self.line.clear()
        self.send(b"\xff")

    def before_the_loader(self, byte):
        """Handles a byte that arrives before the loader accepts any. Returns whether it was one."""
        if self.state == APP:
            self.app_heard.append(byte)
            if self.presses_mode and self.app_heard.endswith(b"##"):
                self.app_heard.clear()
                self.press_mode()
            return True
        if self.state == RESET:
            self.last = byte
            return True
        return False
