# SPDX-License-Identifier: MIT
"""A board with a factory boot loader, the model of tests/campaigns/badlinks, at the end of a cable."""

from peer import APP, LoaderBoard
from pty_peer import PtyPeer
from virtual_peer import VirtualPeer

from tests.campaigns.badlinks.factory_model import BANNER, BOOT, PAGE, Board, Loader
from tests.campaigns.badlinks.wire import Conditions, Wire

PROMPTED = 2
OFF_S = 1.0  # from a reset to the prompt or the application


class Output:
    """What the loader has sent. The cable takes its time."""

    def __init__(self):
        self.data = b""

    def send(self, _now, data):
        self.data += data

    def take(self):
        data, self.data = self.data, b""
        return data


class FactoryBoard(LoaderBoard):
    """says: the banner, which contains the board's name."""

    def __init__(self, flash=None, state=PROMPTED, presses_mode=True, says=BANNER):
        self.loader = Loader(flash or b"\xff" * 0x20000, banner=says)
        self.flash, self.downloads, self.words = self.loader.flash, self.loader.downloads, self.loader.commands
        self.before = bytes(self.flash)
        self.to_board, self.to_pc = Wire(Conditions(late=0.0), 1), Output()
        self.chip, self.ahead = Board(self.loader, self.to_board, self.to_pc), 0.0
        super().__init__(state, presses_mode)

    @property
    def state(self):
        """APP, PROMPTED, or what else the loader does."""
        return {"application": APP, "prompt": PROMPTED}.get(self.loader.where, self.loader.where)

    @state.setter
    def state(self, state):
        """It was reset a while ago, and nobody has heard it since."""
        mode, self.eeprom[0xFFF] = self.eeprom[0xFFF], 0x11 if state == APP else 0xFF
        self.chip.reset()
        self.chip.advance_by(OFF_S)
        self.ahead += OFF_S
        self.eeprom[0xFFF] = mode
        self.to_pc.take()

    @property
    def eeprom(self):
        return self.loader.eeprom

    @eeprom.setter
    def eeprom(self, cells):
        self.loader.eeprom = cells

    def press_mode(self):
        self.app_heard.clear()
        self.chip.reset()

    def on_silence(self, _seconds):
        self.chip.advance(self.now() + self.ahead, stops=False)
        said = self.to_pc.take()
        if said:
            self.send(said)

    def on_byte(self, byte):
        if not self.before_the_loader(byte):
            self.to_board.send(self.chip.now, bytes([byte]))
            self.on_silence(0)

    @property
    def mails(self):
        """The motion pages that were written from the mailbox."""
        return [(page * PAGE - 0xE000) // 512 for _, page, how in self.loader.written if how == "mailbox" and page % 2 == 0]

    @property
    def hurt(self):
        """Damage that a careless PC tool would do."""
        return [why for _, why in self.loader.crashes] + [page for _, page, _ in self.loader.written if page >= BOOT // PAGE]


class FactoryPeer(FactoryBoard, VirtualPeer):
    pass


class FactoryPtyPeer(FactoryBoard, PtyPeer):
    pass
