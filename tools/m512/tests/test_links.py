# SPDX-License-Identifier: MIT
"""Flashing through a factory loader over bad lines, in simulated time: the reported cases. `tools/prove links` runs thousands of
schedules."""

import random

import pytest

from m512.board import download, loaders, typed
from m512.board.client import Client
from m512.board.factory import FactoryLoader
from m512.board.factory_flash import BLIND_MOST, LAST_START
from m512.board.memory import Plan
from m512.errors import CancelledError, M512Error, NoAnswerError
from tests.campaigns.badlinks import runs
from tests.campaigns.badlinks.factory_model import Board, Loader
from tests.campaigns.badlinks.line import CANCELLED, KILLED, Killed, Line
from tests.campaigns.badlinks.wire import Conditions, wires

GOOD = Conditions()


class Bench:
    """A board with a model of the factory loader at its prompt, and a line to it."""

    def __init__(self, conditions=GOOD, ends=None):
        self.loader = Loader(random.Random(1).randbytes(0x20000))
        self.loader.eeprom[0xFFF] = 0xFF
        self.before = bytes(self.loader.flash)
        self.wires = wires(conditions, 1)
        self.board = Board(self.loader, *self.wires)
        self.board.advance_by(1 + 30 * conditions.late)
        self.wires[1].waiting.clear()
        self.line = Line(self.board, *self.wires, ends)

    def say(self, text, seconds=1.0):
        self.line.write(text)
        self.line.sleep(seconds)
        out, self.line.held = self.line.held, b""
        return out

    def changed(self):
        return sorted({at // 256 for at in range(0x20000) if self.loader.flash[at] != self.before[at]})


def motion_pages(*numbers):
    chance = random.Random(5)
    return {(0xE000 + 512 * number) // 256 + half: chance.randbytes(256) for number in numbers for half in (0, 1)}


@pytest.mark.parametrize("speed", [1.0, 0.43, 0.05])
def test_slow_line_as_reported(speed):
    bench, pages = Bench(Conditions("slow", speed=speed)), motion_pages(3, 115, 127)
    loader = FactoryLoader(bench.line)
    loader.write(pages)
    assert bench.changed() == sorted(pages) and not bench.loader.crashes
    assert all(bench.loader.flash[256 * page :][:256] == data for page, data in pages.items())


def test_nothing_but_announced_bytes_while_a_download_may_be_open():
    """The report never comes. After `load` only the page has been sent."""
    bench, pages = Bench(), motion_pages(3)
    loader, sent = FactoryLoader(bench.line), []
    write = bench.line.write

    def deaf(data, wait=True):
        sent.append(data)
        write(data, wait)
        if len(data) > 20 and bench.loader.where in ("ready", "loading"):
            bench.wires[1].cut()

    bench.line.write = deaf
    with pytest.raises(M512Error, match="may still wait.*Type nothing into a terminal.*unharmed"):
        loader.write(pages)
    behind = b"".join(sent[sent.index(b"load e600") + 2 :])
    data = pages[0xE6]
    assert len(behind) <= 256 and behind.lstrip(b"\0") in data


def test_page_below_the_reserve_takes_255_bytes_too_many():
    """Its last download is one byte, so up to a page of surplus bytes stays in that page."""
    pages = motion_pages(115)
    last = max(pages)
    assert (last + 1) * 256 == LAST_START
    bench = Bench()
    loader, write = FactoryLoader(bench.line), bench.line.write

    def doubled(data, wait=True):
        write(data + b"#" * 255 if len(data) == 1 and bench.loader.where == "ready" else data, wait)

    bench.line.write = doubled
    with pytest.raises(M512Error):
        loader.write(pages)
    assert set(bench.changed()) <= set(pages)


def test_a_page_that_doubled_bytes_have_changed_is_read_back_though_it_needed_no_writing():
    bench, pages = Bench(), motion_pages(3)
    first, second = sorted(pages)
    bench.loader.flash[second * 256 : second * 256 + 256] = pages[second]
    loader, write, doubled = FactoryLoader(bench.line), bench.line.write, []

    def double(data, wait=True):
        is_data = bench.loader.where == "ready" and not doubled
        write(data * 2 if is_data else data, wait)
        if is_data:
            doubled.append(data)

    bench.line.write = double
    loader.write({first: pages[first]}, around=pages)
    assert doubled and bench.loader.flash[first * 256 : second * 256 + 256] == pages[first] + pages[second]


@pytest.mark.parametrize(
    "text, expected",
    [
        (b"abc\rdef", []),
        (b"l\r", [1]),
        (b"xyz l 5\r", [7]),
        (b"a\x01b\n", [3]),
        (b"x" * 80 + b"\r", [80]),
        (b"\0" * 200 + b"\r", []),
        (b"\0l\0\r", [3]),
        (b"DOWN,5\rx", [6]),
        (b"lx\rld\r", [5]),
        (b"lo\x08\r", [3]),
    ],
)
def test_typed_text_is_cut_before_the_line_end_that_would_do_harm(text, expected):
    assert typed.cuts(text) == expected


def test_what_is_sent_blindly_cannot_reach_the_loader():
    """Nobody answers for two minutes, neither an application nor a loader. Each byte may be doubled, after a page of a download that
    somebody else left open."""
    bench = Bench()
    bench.loader.eeprom[0xFFF] = 0x11
    bench.say(b"reset\r")
    assert bench.loader.where == "application"
    before = bench.line.sent
    with pytest.raises(NoAnswerError):
        Client(bench.line)
    with pytest.raises(NoAnswerError, match="no boot loader answered"):
        loaders.enter(bench.line, lambda text: None, 120.0)
    sent = bench.line.sent - before
    assert 1000 < sent <= BLIND_MOST and LAST_START + 2 * (256 + sent) <= 0x1E000


def test_open_download_below_the_reserve_survives_a_minute_of_knocking():
    bench = Bench()
    bench.say(b"load %x\r" % (LAST_START - 256), 0.2)
    loaders.enter(bench.line, lambda text: None, 60.0)
    assert set(bench.changed()) <= {(LAST_START - 256) // 256}


@pytest.mark.parametrize("fault", ["a pause", "a line end that comes twice"])
@pytest.mark.parametrize("seed", range(8))
def test_fault_anywhere_in_a_page_that_reads_like_commands(seed, fault):
    """After the pause the loader takes the rest of the data as typed text; all of the data, if the end of `load` comes twice and they come
    late."""
    chance = random.Random(seed)
    pages = {0x30 + k: runs.contents(chance, 256) for k in range(6)}
    bench = Bench()
    loader, write = FactoryLoader(bench.line), bench.line.write

    def hold():
        bench.wires[0].sent_until = bench.board.now + 0.5

    def paused(data, wait=True):
        at = chance.randrange(len(data)) if bench.loader.where == "ready" and chance.random() < 0.3 else 0
        write(data[:at], wait)
        if at:
            hold()
        write(data[at:], wait)

    def twice(data, wait=True):
        is_end = data == b"\r" and chance.random() < 0.3
        write(data * 2 if is_end else data, wait)
        if is_end:
            hold()

    bench.line.write = paused if fault == "a pause" else twice
    try:
        loader.write(pages)
    except M512Error:
        pass
    bench.board.advance_by(5)
    assert set(bench.changed()) <= set(pages) and not bench.loader.crashes


@pytest.mark.parametrize("kind, error", [(CANCELLED, CancelledError), (KILLED, Killed)])
def test_cancelled_in_a_download_says_how_things_stand(kind, error):
    bench, pages = Bench(), motion_pages(3)
    loader = loaders.enter(bench.line, lambda text: None)
    write = bench.line.write

    def stop(data, wait=True):
        if bench.loader.where == "ready":
            bench.line.end_at, bench.line.end_kind = bench.board.now, kind
        write(data, wait)

    bench.line.write = stop
    with pytest.raises(error) as caught:
        download.download(loader, Plan(pages), runs.phase)
    sent = bench.line.sent
    bench.board.advance_by(5)
    assert bench.line.sent == sent and set(bench.changed()) <= set(pages)
    if kind == CANCELLED:
        assert "may still wait" in str(caught.value) and caught.value.exit_code == 130
