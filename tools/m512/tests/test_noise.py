# SPDX-License-Identifier: MIT
"""Whatever arrives on the line, the PC's side of each protocol ends with a result or one of our errors, in bounded time."""

import random

import pytest
from virtual_peer import VirtualLink

from m512.board.block import BlockLoader, frame
from m512.board.client import Client
from m512.crc16 import crc16
from m512.errors import M512Error
from m512.files.text import read_text
from tests.campaigns.noise import NoisyLink, survives


@pytest.mark.parametrize("times, gets_through", [(1, True), (2, True), (3, False)])
def test_noise_in_a_page_of_the_robot_is_found_by_its_crc(started, times, gets_through):
    """The line changes one digit into another, so the answer still looks like a complete page."""
    text = "motion512 1\npage 3 wave\n  step 50 | 1..18:500\n"
    play = started("play-cm5.hex", text=text)
    play.pass_time(1)
    with VirtualLink(play.path) as link:
        client, heard, changed = Client(link), bytearray(), []

        def garble(direction, _, byte):
            if direction == "<-":
                heard.append(byte)
                at = len(heard) - heard.rfind(b"@page 3 ")
                if byte == 0x0A:
                    heard.clear()
                elif b"@page 3 " in heard and at == 400 and len(changed) < times:
                    changed.append(byte)
                    return byte ^ 1 if byte not in b"9A" else byte - 1
            return byte

        play.garble = garble
        if gets_through:
            assert client.page(3) == read_text(text)[3]
        else:
            with pytest.raises(M512Error, match="page 3 came damaged, 3 times"):
                client.page(3)
        assert len(changed) == times


SEED = random.SystemRandom().randrange(1 << 30)


class Changes:
    """Replaces the byte at position `at`, counted from `word`, in the board's next answer, or loses it."""

    def __init__(self, peer, word):
        self.word, self.line, self.at, self.done = word, bytearray(), -1, True
        peer.garble = self

    def start(self, at, byte):
        self.line, self.at, self.byte, self.done = bytearray(), at, byte, False

    def __call__(self, direction, _, byte):
        if direction != "<-" or self.done:
            return byte
        self.line.append(byte)
        at = len(self.line) - 1 - self.line.rfind(b"\x1e" + self.word) if b"\x1e" + self.word in self.line else -1
        if at != self.at:
            return byte
        self.done = True
        return self.byte


def test_noise_in_the_list_of_pages_and_in_the_name_of_the_image_is_found(started):
    """Neither has a checksum. A page missing in the list would be overwritten, or left out of a copy."""
    text = "motion512 1\n" + "".join(f"page {page} name{page}\n  step 50 | 1:500\n" for page in (3, 4, 30, 127))
    play, chance = started("play-cm5.hex", text=text), random.Random(SEED)
    play.pass_time(1)
    with VirtualLink(play.path) as link:
        client = Client(link)
        truth, version, pages = client.list_pages(), client.version, client.pages
        assert list(truth) == [3, 4, 30, 127] and pages == 128
        changes = Changes(play, b"@list ")
        for at in chance.sample(range(7, 70), 12):
            changes.start(at, chance.choice([None, 0x20, 0x22, *b"0123456789:!ab"]))
            assert client.list_pages() == truth and changes.done, (SEED, at)
        changes = Changes(play, b"@ver ")
        for at in chance.sample(range(6, 110), 8):
            changes.start(at, chance.choice([None, 0x20, *b"=x"]))
            found = Client(link)
            assert found.pages == 128 and found.version["image"].isalpha() and changes.done, (SEED, at, found.version, version)


class PausingLink(NoisyLink):
    """Delivers the pieces one by one, with a silence after each."""

    def __init__(self, *pieces):
        super().__init__(pieces[0])
        self.pieces = list(pieces[1:])

    def _receive(self, limit, seconds):
        if not self.data:
            self.data = self.pieces.pop(0) if self.pieces else b""
            self.silent_s += 0.001
            return b""
        return super()._receive(limit, seconds)


def test_noise_answer_of_a_block_that_falls_silent_and_goes_on():
    answer = b"\x5a" + frame(1, 160, b"\0\2")[1:]
    for at in range(len(answer) + 1):
        for rest in (b"", b"\x5a", b"\0\0", b"\x5a\0", answer[at:], answer):
            survives(lambda pieces=(answer[:at], rest): BlockLoader(PausingLink(*pieces), "", 2, 0.002))


def test_a_request_that_the_board_refuses_because_bytes_were_lost_is_sent_again():
    """firmware/common/PROTOCOL.md, ERR 15: the board has not executed the request."""
    link = NoisyLink(b"\x1e@tor ERR 15 Bytes of this line were lost: nothing was done\r\n\x1e@torque OK\r\n")
    link_client = Client.__new__(Client)
    link_client.link, link_client.version, link_client.slack, link_client.said = link, {}, 0.0, b""
    assert link_client.ask("torque on") == ""


def test_a_late_second_answer_is_not_taken_for_the_next_page():
    """A line that stalled: m512 has asked twice, and the robot has answered twice."""
    pages = read_text("motion512 1\npage 4 four\n  step 50 | 1..18:500\npage 5 five\n  step 50 | 1..18:500\n")
    four, five = (b"\x1e@page %d %s %04X OK\r\n" % (n, pages[n].data.hex().encode(), crc16(pages[n].data)) for n in (4, 5))
    client = Client.__new__(Client)
    client.link, client.slack, client.said = NoisyLink(four + four + five), 0.0, b""
    assert [client.page(4), client.page(5)] == [pages[4], pages[5]]


GOOD = b"\x1e@where state=playing page=2 step=1 repetition=2 code=0 dv=96 missed=0 faulty=00000000 OK\r\n"


@pytest.mark.parametrize(
    "was, becomes",
    [(b"page=", b"paoe="), (b" repetition=", b" repetitiof="), (b"=playing", b"=pla\x10ing"), (b"dv=96", b"dv=9\x10"), (b"faulty=0", b"faulty=P")],
)
def test_where_the_robot_is_is_asked_again_when_its_answer_is_damaged(was, becomes):
    """This once caused a traceback of m512 play --wait while the robot continued."""
    client = Client.__new__(Client)
    client.version, client.slack, client.heard, client.said = {}, 0.0, b"", b""
    bad = GOOD.replace(was, becomes)
    assert bad != GOOD
    client.link = NoisyLink(bad + GOOD)
    assert client.where()["repetition"] == "2"
    client.link = NoisyLink(bad * 3)
    with pytest.raises(M512Error, match="damaged, 3 times"):
        client.where()
