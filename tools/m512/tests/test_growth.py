# SPDX-License-Identifier: MIT
"""Readers take time in proportion to their input, of any kind, and the input is limited. Eight times the input takes about eight times
the user time (a quadratic reader: 64 times). Wall-clock time is not used."""

import resource
from pathlib import Path

import pytest
from mtn_files import Block, body, step

from m512.board.link import Link
from m512.errors import FileError, M512Error
from m512.files import formats, storage

TIMES, MOST = 8, 24
LEAST_SECONDS = 0.02  # of the larger input: a shorter time is too short to compare
PAGES = body([Block(name="x")], full=False)
HEAD, PAGE = PAGES[: PAGES.index(b"page_begin")], PAGES[PAGES.index(b"page_begin") :]
STEP = body([Block(steps=[step()])], full=False).split(b"\n")[-3] + b"\n"
TEXT = b"motion512 1\n"
ONE_STEP = TEXT + b"row 1\npose a | 1:5\npage 1\n  step 5 | "


def hex_lines(count):
    out = b""
    lines = []
    for k in range(count):
        if k % 4096 == 0:
            lines.append(_record(0, (k // 4096).to_bytes(2, "big"), 4))
        lines.append(_record(16 * k & 0xFFFF, b"12345678"))  # with gaps between them
    return out.join(lines) + b":00000001FF\n"


def _record(address, data, kind=0):
    line = bytes([len(data), address >> 8, address & 255, kind]) + data
    return b":" + line.hex().encode() + b"%02X\n" % (-sum(line) & 255)


FILES = {  # name -> (function that makes the input of a given size, initial size)
    "steps of one page.mtn": (lambda n: HEAD + PAGE.replace(b"page_end", STEP * n + b"page_end"), 800),
    "pages.mtn": (lambda n: HEAD + PAGE.replace(b"name=x", b"name=") * n, 600),
    "blank lines.mtn": (lambda n: PAGES + b"\n" * n, 100_000),
    "byte-order marks.mtn": (lambda n: b"\xef\xbb\xbf" * n + PAGES, 60_000),
    "carriage returns.mtn": (lambda n: HEAD + b"\r" * n + PAGE, 200_000),
    "digits.mtn": (lambda n: PAGES.replace(b" 1.0 ", b" 1." + b"0" * n + b" "), 400_000),
    "continued lines.m512": (lambda n: TEXT + b"\\\n" * n + b"page 1\n", 5_000),
    "a continued statement.m512": (lambda n: ONE_STEP + b"1:5 \\\n" * n + b"\n", 2_000),
    "a continued quote.m512": (lambda n: TEXT + b'page 1 "' + b"\\\n" * n + b'"\n', 10_000),
    "poses and rows.m512": (lambda n: ONE_STEP + b"@a 5 " * n + b"\n", 3_000),
    "joints.m512": (lambda n: ONE_STEP + b"1," * n + b"1:5\n", 10_000),
    "statements of a line.m512": (lambda n: TEXT + b"page 1\n" + b"speed 5;" * n + b"\n", 5_000),
    "raw bytes.m512": (lambda n: TEXT + b"raw 0 00\n" * n + b"page 1\n", 4_000),
    "links.m512": (lambda n: TEXT + b"next 1\n" * n + b"page 1\n", 6_000),
    "quotes.m512": (lambda n: TEXT + b"page 1 " + b'"a" ' * n, 10_000),
    "records.hex": (hex_lines, 1_500),
}


def seconds(read, data, times=1, tries=1):
    """User time, the best of these tries: the system's, for memory that is new to the process, grows by jumps. One of our errors is also a
    result."""
    best = float("inf")
    for _ in range(tries):
        begun = resource.getrusage(resource.RUSAGE_SELF).ru_utime
        for _ in range(times):
            try:
                read(data)
            except M512Error:
                pass
        best = min(best, (resource.getrusage(resource.RUSAGE_SELF).ru_utime - begun) / times)
    return best


def grows(read, make, count):
    """How much longer eight times the input takes. The minimum of up to three tries, because other programs disturb the measurement."""
    ratio = float("inf")
    for _ in range(3):
        ratio = min(ratio, _growth(read, make, count))
        if ratio < MOST:
            break
    return ratio


def _growth(read, make, count):
    larger = seconds(read, make(TIMES * count))
    while larger < LEAST_SECONDS:
        count *= 2
        larger = seconds(read, make(TIMES * count))
    # As long, because the system counts user time by its ticks. The best of three, because a time that is too long would hide a reader.
    return larger / seconds(read, make(count), TIMES, tries=3)


@pytest.mark.parametrize("name", FILES)
def test_a_reader_is_linear(name):
    def read(data):
        formats._image(formats.recognise(data, Path(name)), data, Path(name), None)  # without the limit on its size

    assert grows(read, *FILES[name]) < MOST


class TricklingLink(Link):
    """A board that sends the same byte one at a time."""

    def __init__(self, count):
        self.left, self.held, self.url = count, b"", "trickle"

    def now(self):
        return 0.0 if self.left else 1e9

    def _receive(self, limit, seconds):
        self.left -= 1
        return b"a" if self.left >= 0 else b""


@pytest.mark.parametrize("read", [lambda link: link.look_for(b"ab", 1.0), lambda link: link.drain(1, 1.0)])
def test_a_line_is_read_linearly(read):
    assert grows(lambda count: read(TricklingLink(count)), lambda count: count, 20_000) < MOST


# Limits


def test_a_file_that_is_too_large_is_refused_before_it_is_read_as_anything(m512, tmp_path):
    (tmp_path / "x.mtn").write_bytes(PAGES + b"\n" * (storage.MOST_BYTES - len(PAGES)))
    assert formats.load(tmp_path / "x.mtn")[1].title == "x"
    with open(tmp_path / "x.mtn", "ab") as file:
        file.write(b"\n")
    result = m512("pages", tmp_path / "x.mtn", "list")
    assert result.exit_code == 4 and "more than 4 MiB" in result.stderr and "x.mtn" in result.stderr
    with pytest.raises(FileError, match="more than 4 MiB"):
        formats.decode(bytes(storage.MOST_BYTES + 1), Path("x.bin"))


def test_includes_have_a_most_in_all(tmp_path):
    (tmp_path / "leaf.m512").write_text("motion512 1\n" + "#" * 10_000 + "\n")
    for level in range(5):
        below = "leaf" if not level else f"level{level - 1}"
        (tmp_path / f"level{level}.m512").write_text("motion512 1\n" + f'include "{below}.m512"\n' * 10)
    with pytest.raises(FileError, match="what is included has more than 4 MiB in all"):
        formats.load(tmp_path / "level4.m512")
    assert formats.load(tmp_path / "level1.m512").used() == []


def test_an_endless_file_for_the_terminal_is_refused(m512, tmp_path):
    from block_peer import BlockPtyPeer

    with BlockPtyPeer() as board:
        result = m512("term", "-p", board.path, "--send", "/dev/zero", input="")
        assert "more than 4 MiB" in result.stderr


@pytest.mark.parametrize(
    "text", ["speed " + "9" * 100_000, "next " + "x" * 100_000, 'page 2 "' + "\\x41" * 30_000 + '"', "step 1 | 1:" + "7" * 100_000]
)
def test_a_sentence_does_not_quote_a_whole_file(tmp_path, text):
    (tmp_path / "x.m512").write_text("motion512 1\npage 1\n" + text + "\n")
    with pytest.raises(FileError) as caught:
        formats.load(tmp_path / "x.m512")
    assert len(str(caught.value)) < 500
