# SPDX-License-Identifier: MIT
"""The peer on a pty itself: a cable that is pulled and plugged while its thread is between two of its own steps."""

import os
import time

from pty_peer import PtyPeer


class Replugged(PtyPeer):
    """Plugs once between the moment at which something is there to read and the reading."""

    spare, heard = None, b""

    def on_byte(self, byte):
        self.heard += bytes([byte])

    def _wait(self):
        super()._wait()
        if self.spare is not None:
            os.close(self.spare)  # a lower number becomes free, so that the new files have other numbers
            self.plug()
            self.spare = None  # whoever waits for this finds the new path


def test_peer_hears_the_cable_that_was_plugged_while_it_read():
    spare = os.open(os.devnull, os.O_RDONLY)
    with Replugged() as peer:
        path, peer.spare = peer.path, spare
        deadline = time.monotonic() + 300
        while peer.spare is not None and time.monotonic() < deadline:
            time.sleep(0.001)
        assert peer.spare is None, path
        pc = os.open(peer.path, os.O_RDWR | os.O_NOCTTY)
        os.write(pc, b"hello")
        while peer.heard != b"hello" and time.monotonic() < deadline:
            time.sleep(0.001)
        os.close(pc)
        assert peer.heard == b"hello"
