# SPDX-License-Identifier: MIT
"""`m512 convert --only`: from a requested page, links and codes lead to the same pages as before, whatever their numbers."""

import json
import random
import re

import pytest
from mtn_files import Block, made, step

from m512.errors import RefusedError
from m512.files import formats
from m512.files.image import Image
from m512.files.page import Page
from m512.pages.excerpt import excerpt

LABELS = ("next", "exit", "link1_page", "link2_page", "blend_right", "blend_left")
SEED = 20261125


def by_chance(chance, pages=256, used=230, links=1.0):
    """Pages with unique names at random places, with links to anywhere: to each other, to empty pages, beyond the end."""
    image = Image.empty(pages)
    for number in chance.sample(range(1, pages), used):
        page = Page()
        page.name, page.steps, page.code = f"p{number}".encode(), chance.randint(1, 7), chance.randrange(256)
        page.link1_code, page.link2_code = chance.randrange(256), chance.randrange(256)
        for joint in range(1, 19):
            page.set_word(0, joint, chance.randrange(1024))
        for label in LABELS:
            if chance.random() < links:
                setattr(page, label, chance.choice((0, number, chance.randrange(256))))
        image[number] = page.seal()
    return image


def walk(image, number, labels):
    """The pages along these links; ends at a page without steps."""
    out = []
    for label in labels:
        page = image[number] if 0 < number < image.end else Page()
        if not page.steps:
            return out
        out.append((page.name, page.code, page.link1_code, page.link2_code, bytes(page.data[32:])))
        number = getattr(page, label)
    return out


@pytest.mark.parametrize("seed", range(SEED, SEED + 30))
def test_every_walk_meets_the_same_pages(seed):
    chance = random.Random(seed)
    image = by_chance(chance, used=chance.choice((60, 120, 230)), links=chance.choice((0.05, 0.1, 0.2)))
    wanted = chance.sample(image.used(), chance.randint(1, 50))
    part = excerpt(image, wanted, 128)
    assert part.image.end == 128 and all(not page.fault() for _, page in part.image.items())
    for _ in range(300):
        start, labels = chance.choice(wanted), chance.choices(LABELS, k=12)
        assert walk(part.image, part.moved[start], labels) == walk(image, start, labels), (seed, start, labels)
    assert all(part.moved[n] == n for n in part.moved if n < 128)  # pages that fit keep their numbers
    assert sorted(part.left) == sorted(set(image.used()) - set(part.moved))
    assert len(part.image.used()) == len(part.moved)
    ended = {(new, getattr(image[old], label)) for old, new in part.moved.items() for label in LABELS if not getattr(part.image[new], label)}
    assert {(int(loss.split()[1]), int(re.search(r" (\d+) becomes none", loss)[1])) for loss in part.losses} == {
        (new, target) for new, target in ended if target
    }


def test_what_leads_everywhere_is_refused_with_the_figures():
    with pytest.raises(RefusedError, match=r"these are 200 pages, and there is room for 127"):
        image = by_chance(random.Random(SEED), used=200, links=0)
        numbers = image.used()
        for here, there in zip(numbers, numbers[1:]):
            image[here].next = there
            image[here].seal()
        excerpt(image, numbers[:1], 128)


def test_a_damaged_page_stays_byte_for_byte_and_its_links_are_not_followed():
    image = by_chance(random.Random(SEED), used=0)
    image[200].steps, image[200].next = 1, 201
    image[201].steps = 1
    image[201].seal()
    part = excerpt(image, [200], 128)
    assert part.moved == {200: 1} and part.image[1] == image[200] and part.left == [201]


@pytest.mark.parametrize("words", [["--only", "200", "--pages", "128"], ["--joints", "1..2"], ["--pages", "128"], ["--bits", "12", "--scale", "10"]])
@pytest.mark.parametrize("damage", ["position", "steps"])
def test_what_is_called_kept_byte_for_byte_is(m512, tmp_path, words, damage):
    """A position of 1500 is damage in a file of 10 bits, though not in one of 12."""
    image, number = Image.empty(256), 1 if words == ["--pages", "128"] else 200
    for page in (image[2], image[number]):
        page.steps = 1
        for joint in range(1, 19):
            page.set_word(0, joint, 512)
    if damage == "steps":
        image[number].steps = 9
    else:
        image[number].set_word(0, 1, 5000 if "--scale" in words else 1500)
    image[number].next = 201
    image[number].seal(), image[2].seal()
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", *words)
    assert result.exit_code == 0, result.stderr
    pages = [bytes(page) for page in formats.load(tmp_path / "y.bin", 10).pages]
    if "--scale" in words and damage == "position":
        assert "kept byte for byte" not in result.stderr and "are now unused" in result.stderr
    else:
        assert "damaged, kept byte for byte" in result.stderr and bytes(image[number]) in pages, result.stderr


def test_a_page_whose_damage_is_in_the_joints_left_out_is_mended(m512, tmp_path):
    image = Image.empty()
    image[1].steps = 1
    image[1].set_word(0, 1, 512)
    image[1].set_word(0, 25, 1500)
    image[1].set_time(0, 50)
    image[1].seal()
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--bits", "10", "--joints", "1..18")
    assert result.exit_code == 0 and "damaged" not in result.stderr, result.stderr
    assert m512("pages", tmp_path / "y.bin", "check").exit_code == 0


def test_a_roboplus_file_of_240_pages(m512, tmp_path):
    blocks = [Block(f"m{n}", next=(n + 1 if n % 4 else 0), exit=250 if n in (1, 201) else 0, steps=[step()]) for n in range(1, 242)]
    (tmp_path / "x.mtn").write_bytes(made(blocks))
    refused = m512("convert", tmp_path / "x.mtn", tmp_path / "y.bin")
    assert refused.exit_code == 5 and "--only NAME" in refused.stderr
    result = m512("convert", tmp_path / "x.mtn", tmp_path / "y.bin", "--only", "m201", "--only", "9..10")
    assert result.exit_code == 0, result.stderr
    assert result.stderr.splitlines() == [
        'note: pages 11 "m11", 12 "m12", 202 "m202", 203 "m203" and 204 "m204": taken too, because what was asked for leads there',
        "note: renumbered: pages 201..204 become 1..4",
        "note: pages 1..8, 13..200 and 205..241: left out",
        'loss: page 1 "m201": exit 250 becomes none, because page 250 holds no motion',
    ]
    listed = json.loads(m512("pages", tmp_path / "y.bin", "list", "--json").stdout)
    assert [row["page"] for row in listed] == [1, 2, 3, 4, 9, 10, 11, 12]
    report = json.loads(m512("convert", tmp_path / "x.mtn", tmp_path / "z.m512", "--only", "m201", "--json").stdout)
    assert report["moved"] == {"201": 1, "202": 2, "203": 3, "204": 4} and len(report["left"]) == 237
    assert m512("pages", tmp_path / "y.bin", "check").exit_code == 0
    for word in ("m9999", "300..310", "9..8"):
        bad = m512("convert", tmp_path / "x.mtn", tmp_path / "no.bin", "--only", word)
        assert bad.exit_code in (2, 4) and word in bad.stderr and not (tmp_path / "no.bin").exists()
