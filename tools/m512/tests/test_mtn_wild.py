# SPDX-License-Identifier: MIT
"""RoboPlus files as found on the internet, changed by editors, version control and newer tools. All files are made here."""

import random
from fractions import Fraction

import pytest
from mtn_files import ACCIDENTS, Block, blocks_by_chance, body, checksum, commas, made, page_bytes, step

from m512.errors import FileError
from m512.files import mtn
from m512.files.page import EMPTY
from tests.models import classic_law


def expected(blocks, full=True):
    return [EMPTY] + [page_bytes(block) for block in blocks] + [page_bytes(Block()) if full else EMPTY] * (255 - len(blocks))


def pages_of(image):
    return [bytes(page) for _, page in image.items()]


# Envelope


@pytest.mark.parametrize("accident", ACCIDENTS)
@pytest.mark.parametrize("with_commas", [False, True])
def test_every_accident_is_read_and_told(accident, with_commas):
    for seed, version in enumerate(["1.00", "1.01"]):
        blocks = blocks_by_chance(random.Random(seed))
        data = made(blocks, version=version, full=not seed)
        data = commas(data) if with_commas else data
        remark, happens = ACCIDENTS[accident]
        remark = remark if happens(data) != data else ""
        image = mtn.read(happens(data))
        if accident.startswith("edited by hand"):
            blocks[0].name = "HAND"
        assert pages_of(image) == expected(blocks, not seed), (accident, seed)
        assert [note for note in image.notes if "checksum" in note] == [note for note in image.notes if remark and remark in note]
        assert bool(remark) == any("checksum" in note for note in image.notes)


def test_a_checksum_that_looks_like_something_else_is_found():
    """The two bytes may themselves be blanks, line ends or letters."""
    special, seen = b"\n\r \0\x1apg", {}
    for name in (chr(first) * 3 + chr(second) * 10 for first in range(0x21, 0x7F) for second in range(0x21, 0x7F)):
        data = made([Block(name=name, steps=[step()])], full=False)
        if data[-1] in special and len(seen.setdefault(data[-1], [])) < 6:
            seen[data[-1]].append(data)
    assert sorted(seen) == sorted(special)
    for data in (data for files in seen.values() for data in files):
        for accident in ("nothing", "a line end behind the checksum", "the byte-order mark taken off", "CR LF"):
            image = mtn.read(ACCIDENTS[accident][1](data))
            assert not any("should be" in note or "no checksum" in note for note in image.notes), (data[-2:], accident)


@pytest.mark.parametrize("where", ["in a step", "behind page_begin", "in a name"])
def test_a_file_that_breaks_off_is_refused_with_the_place(where):
    data = made([Block(name="one", steps=[step()]), Block(name="twotwotwo", steps=[step()])], full=False)
    at = {"in a step": data.rindex(b"step=") + 30, "behind page_begin": data.rindex(b"page_begin") + 11, "in a name": data.index(b"twotwo") + 3}
    with pytest.raises(FileError, match=r"x\.mtn:\d+: page 2 has no end"):
        mtn.read(data[: at[where]], "x.mtn")
    with pytest.raises(FileError, match="no page ends in it"):
        mtn.read(data[:60], "x.mtn")


def test_few_pages_and_no_checksum_are_read_with_both_remarks():
    image = mtn.read(body([Block(name="one", steps=[step()])], full=False))
    assert bytes(image[1]) == page_bytes(Block(name="one", steps=[step()]))
    assert any("no checksum, so only you can tell whether it is complete: 1 page was read" in note for note in image.notes)
    assert any("1 of 255 pages" in note for note in image.notes)


def test_a_name_that_is_not_utf8_keeps_its_bytes():
    data = body([Block(name="@@", steps=[step()])]).replace(b"@@", b"\xbe\xc8\xb3\xe7")
    assert mtn.read(data + checksum(data))[1].name == b"\xbe\xc8\xb3\xe7"


def test_a_version_that_nobody_knows_is_read_like_the_newest():
    data = made([Block(steps=[step()])]).replace(b"version=1.01", b"version=1.05")
    image = mtn.read(data)
    assert bytes(image[1]) == page_bytes(Block(steps=[step()])) and any("version 1.05 is not known" in note for note in image.notes)


# Times: a unit is 8 ms, and other values are rounded to the nearest unit


@pytest.mark.parametrize("seconds", ["0.012", "0.0119", "0.0121", "0.30", "0.3", "1.999", "2.04", "0.0039", "0.0041", "0.5", "1.0005"])
def test_a_time_between_two_units_is_the_nearer_one(seconds):
    data = body([Block(steps=[step(512, 10, 50)])], full=False).replace(b"0.080 0.400", f"{seconds} {seconds}".encode())
    page = mtn.read(data + checksum(data))[1]
    for units in (page.pause(0), page.time(0)):
        assert abs(units * Fraction(8, 1000) - Fraction(seconds)) <= Fraction(4, 1000)


# Rates


@pytest.mark.parametrize(
    "rate, words",
    [
        ("2.7", "rate 2.7; it becomes 32 / 11 = 2.91"),
        ("3.0", "rate 3; it becomes 32 / 10 = 3.20"),
        ("1.0", None),
        ("1.5", None),
        ("2.9", None),
        ("0.5", None),
    ],
)
def test_a_rate_that_a_page_cannot_hold_is_told_with_both_numbers(rate, words):
    notes = mtn.read(made([Block(rate=rate, steps=[step()]), Block(rate=rate), Block(rate=rate, steps=[step()])])).notes
    assert [words in note and note.startswith("pages 1 and 3: ") for note in notes] == ([True] if words else [])


# 12 bits


def test_a_file_of_a_12_bit_robot_says_so_once(m512, tmp_path):
    (tmp_path / "x.mtn").write_bytes(made([Block(steps=[step(2048)])] * 60))
    result = m512("pages", tmp_path / "x.mtn", "check")
    assert result.stderr.count("looks like 12 bit") == 1 and "damaged" not in result.stdout
    result = m512("convert", tmp_path / "x.mtn", tmp_path / "x.bin", "--scale", "10")
    assert result.exit_code == 0 and (tmp_path / "x.bin").read_bytes()[512 + 64 + 2 :][:2] == b"\x00\x02"
    assert "looks like 12 bit: --bits 12 --scale 10" in m512("convert", tmp_path / "x.mtn", tmp_path / "y.bin", "--bits", "10").stderr


def test_one_position_beyond_the_range_names_its_line():
    with pytest.raises(FileError, match=r"x\.mtn:9: position 1500 of ID 3 is beyond 1023, like 1 of 18 in this file"):
        mtn.read(made([Block(steps=[step([512, 512, 512, 1500] + [512] * 22)])]), "x.mtn")


# More than seven steps


class LongPage(classic_law.Page):
    """A page with any number of steps for the model of the law: what RoboPlus would play."""

    def __init__(self, block, number):
        header = bytearray(page_bytes(Block(block.name, block.next, block.exit, block.repeat, block.rate, block.inertia, block.level)))
        rest = bytearray()
        for at, pause, time in block.steps:
            for joint in range(31):
                rest += (at[joint] if 1 <= joint <= 18 else 0x4000).to_bytes(2, "little")
            rest += bytes((pause, time))
        super().__init__(bytes(header[:64]), 0)
        self.raw, self.number, self.steps = bytes(header[:64]) + bytes(rest), number, len(block.steps)

    def refused(self):
        return not self.steps


def play(monkeypatch, start, make_page, stop):
    monkeypatch.setattr(classic_law, "Page", make_page)
    schedule = {} if stop is None else {stop: classic_law.STOP}
    return list(classic_law.ClassicPlay(b"", start, 0b1110, {1: 512, 2: 500, 3: 600}, schedule).ticks(3000))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("repeat", [1, 3])
def test_a_long_page_plays_as_one_page_would(monkeypatch, seed, repeat):
    """Tick by tick, also with a stop at any time, and with links from and to the page."""
    chance, real = random.Random(seed), classic_law.Page
    blocks = blocks_by_chance(chance, 4, 7)
    for number, block in enumerate(blocks):
        block.next, block.exit, block.repeat = chance.choice((0, 1, 2, 3)), chance.choice((0, 4)), chance.choice((1, 2))
        block.steps = [
            step([chance.randrange(1024) for _ in range(26)], chance.choice((0, 0, 3)), chance.randint(1, 20))
            for _ in range(chance.randint(1, 7) if number else chance.randint(8, 23))
        ]
    blocks[0].repeat = repeat
    image = mtn.read(made(blocks)).to_bytes()
    for stop in [None] + [chance.randrange(800) for _ in range(2)]:
        long = play(monkeypatch, 1, lambda _, number: LongPage(blocks[number - 1], number), stop)
        split = play(monkeypatch, 1, lambda _, number: real(image, number), stop)
        assert split == long, (seed, repeat, stop)


def test_a_long_page_is_told_in_words_and_keeps_all_steps():
    blocks = [Block("walk", 2, 3, steps=[step(500 + k) for k in range(15)]), Block("next", steps=[step()]), Block("exit", steps=[step()])]
    image = mtn.read(made(blocks))
    assert image.notes == ['page 1 "walk" has 15 steps, a page holds 7: continued in pages 4 and 5']
    assert [(image[n].next, image[n].exit, image[n].title, image[n].steps) for n in (1, 4, 5)] == [
        (4, 4, "walk", 7),
        (5, 5, "walk/2", 7),
        (2, 3, "walk/3", 1),
    ]
    assert [image[n].word(k, 1) for n in (1, 4, 5) for k in range(image[n].steps)] == [500 + k for k in range(15)]


def test_a_long_page_takes_no_page_that_is_used_or_linked_to():
    full = [Block("long", 200, 0, steps=[step()] * 8)] + [Block(f"p{n}", n + 1, n + 2, steps=[step()]) for n in range(2, 126)]
    image = mtn.read(made(full))
    assert image[1].next == 128 and image[128].next == 200  # 126 and 127 are link targets without content
    assert image[128].word(0, 1) == 512 and not image[126].steps


def test_a_long_page_without_room_is_refused_with_the_reason():
    with pytest.raises(
        FileError, match=r'page 1 "long" has 15 steps and is played 100 times\. A page holds 7; as linked pages it needs 299 more, and 254 are free'
    ):
        mtn.read(made([Block("long", repeat=100, steps=[step()] * 15)]))


def test_a_long_page_that_is_never_played_keeps_its_links():
    image = mtn.read(made([Block("off", 9, 8, repeat=0, steps=[step()] * 9)]))
    assert [(image[n].next, image[n].exit, image[n].repeat, image[n].steps) for n in (1, 2)] == [(9, 8, 0, 7), (9, 8, 0, 2)]
    assert "never played" in image.notes[0]


@pytest.mark.parametrize("last", [Block("wave"), Block(steps=[step()])], ids=["name", "steps"])
def test_a_page_beyond_255_is_refused_unless_it_is_empty(last):
    with pytest.raises(FileError, match="page 256 has no place: there are 255 pages"):
        mtn.read(made([Block()] * 255 + [last]))
    blocks = [Block("far", steps=[step()])] * 255
    assert pages_of(mtn.read(made([*blocks, Block()]))) == expected(blocks)


# Pages beyond the board


def test_pages_beyond_the_board_are_named_with_the_option_that_keeps_them(m512, tmp_path):
    blocks = [Block(f"m{n}" if n > 140 else "", 250 if n == 1 else 0, steps=[step()] if n in (1, 200, 250) else []) for n in range(1, 256)]
    (tmp_path / "x.mtn").write_bytes(made(blocks))
    result = m512("convert", tmp_path / "x.mtn", tmp_path / "y.bin")
    assert result.exit_code == 5 and not (tmp_path / "y.bin").exists() and result.stderr.count("\n") == 1
    assert "pages 141..255: no room among the 128 pages" in result.stderr and "--pages 256 keeps all" in result.stderr
    assert m512("convert", tmp_path / "x.mtn", tmp_path / "y.bin", "--pages", "256").exit_code == 0
    assert (tmp_path / "y.bin").read_bytes() == b"".join(expected(blocks))
    result = m512("convert", tmp_path / "x.mtn", tmp_path / "z.bin", "--pages", "128")
    assert result.exit_code == 0 and result.stderr.splitlines() == [
        "loss: pages 141..255: no room among 128 pages, left out",
        "loss: page 1: links to pages that are left out are now empty (next 250)",
    ]
    assert "all good" in m512("pages", tmp_path / "z.bin", "check").stdout


@pytest.mark.parametrize("suffix", ["hex", "bin", "m512"])
def test_pages_makes_of_a_mtn_the_file_that_convert_makes(m512, tmp_path, suffix):
    """FILES.md: a board of 128 pages takes pages 1..127. Its HEX is at 0x0E000, that of a CM-510 at 0x1E000."""
    blocks = [Block(f"m{n}", steps=[step()]) for n in range(1, 10)]
    (tmp_path / "x.mtn").write_bytes(made(blocks))
    done = m512("pages", tmp_path / "x.mtn", "rename", "3", "new", "-o", tmp_path / f"y.{suffix}")
    assert done.exit_code == 0, done.stderr
    blocks[2].name = "new"
    (tmp_path / "z.mtn").write_bytes(made(blocks))
    assert m512("convert", tmp_path / "z.mtn", tmp_path / f"z.{suffix}").exit_code == 0
    assert (tmp_path / f"y.{suffix}").read_bytes() == (tmp_path / f"z.{suffix}").read_bytes()


def test_pages_refuses_to_lose_pages_of_a_mtn_beyond_the_board(m512, tmp_path):
    (tmp_path / "x.mtn").write_bytes(made([Block("m1", steps=[step()])] + [Block()] * 198 + [Block("m200", steps=[step()])]))
    result = m512("pages", tmp_path / "x.mtn", "rename", "1", "new", "-o", tmp_path / "y.bin")
    assert result.exit_code == 5 and not (tmp_path / "y.bin").exists()
    assert 'page 200 "m200": no room among the 128 pages' in result.stderr and "m512 convert --only" in result.stderr
    assert m512("pages", tmp_path / "x.mtn", "rename", "1", "new", "-o", tmp_path / "y.mtn").exit_code == 0


# Combinations


@pytest.mark.parametrize("seed", range(12))
def test_combinations_by_chance(seed):
    chance = random.Random(seed)
    blocks = blocks_by_chance(chance, chance.choice((1, 20, 100)), chance.choice((7, 7, 17)))
    data = made(blocks, version=chance.choice(("1.00", "1.01")), full=chance.random() < 0.2)
    if chance.random() < 0.5:
        data = commas(data)
    accident = chance.choice(list(ACCIDENTS))
    remark, happens = ACCIDENTS[accident]
    if accident.startswith("edited by hand"):
        blocks[0].name = "HAND"
    try:
        image = mtn.read(happens(data))
    except FileError as error:
        assert "linked pages" in str(error) and any(len(block.steps) > 7 for block in blocks)
        return
    for number, block in enumerate(blocks, 1):
        if len(block.steps) <= 7 and block.steps:
            assert bytes(image[number]) == page_bytes(block), (accident, number)
        elif block.steps:
            assert [image[number].word(k, 1) for k in range(7)] == [at[1] for at, _, _ in block.steps[:7]]
            assert any(f"page {number} " in note and f"{len(block.steps)} steps" in note for note in image.notes)
    assert not remark or happens(data) == data or any(remark in note for note in image.notes)
