# SPDX-License-Identifier: MIT
"""Tests the peer on a pty: a cable that is pulled and plugged in between two steps of its thread."""

import os
import time

from pty_peer import PtyPeer


class Replugged(PtyPeer):
    """Replugs the cable once, between the moment when data may be there and the read."""

    spare, heard = None, b""

    def on_byte(self, byte):
        self.heard += bytes([byte])

    def _wait(self):
        super()._wait()
        if self.spare is not None:
            os.close(self.spare)  # frees a lower number, so that the new files get other numbers
            self.plug()
            self.spare = None  # the waiting test now finds the new path


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
