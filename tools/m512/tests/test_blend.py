# SPDX-License-Identifier: MIT
"""Blend partners (bytes 17 and 18) in text, list, check, diff and conversions; two motions merged by joints."""

import random

import pytest

from m512.errors import RefusedError
from m512.files import formats
from m512.files.image import Image, from_bytes
from m512.files.page import STEPS, Page
from m512.files.text import read_text, write_text
from m512.motion.player import play
from m512.pages import difference, operations, overlay

TEXT = """motion512 1
page 5 walk
  next self
  blend right turn_r
  blend left 7
  step 32 | 1:500
page 6 turn_r
  step 32 | 1:510
page 7 turn_l
  step 32 | 1:490
"""


def test_blend_partners_are_bytes_17_and_18():
    image = read_text(TEXT)
    assert image[5].data[17] == 6 and image[5].data[18] == 7 and not image[5].fault()
    text = write_text(image)
    assert "blend right turn_r" in text and "raw 17" not in text and read_text(text).to_bytes() == image.to_bytes()


def test_blend_partners_are_listed_told_apart_and_kept(m512, tmp_path):
    (tmp_path / "x.m512").write_text(TEXT)
    assert "right 6  left 7" in m512("pages", tmp_path / "x.m512", "list").stdout
    assert m512("pages", tmp_path / "x.m512", "check").exit_code == 0
    image = read_text(TEXT)
    other = from_bytes(image.to_bytes())
    other[5].blend_right = 0
    other[5].seal()
    assert [str(change) for change in difference.images(image, other)] == ['page 5 "walk": blend partner to the right 6 -> 0']
    formats.save(tmp_path / "x.csv", image, 5)
    assert formats.load(tmp_path / "x.csv")[5] == image[5]
    assert any("blend partners are left out" in loss for loss in formats.save(tmp_path / "x.mtn", image))


def test_blend_partners_follow_pages_that_move():
    image = read_text(TEXT)
    operations.renumber(image, 6, 40)
    assert image[5].blend_right == 40 and image[5].blend_left == 7
    assert "links to page 40 (blend_right)" in " ".join(operations.delete(image, [40]))


def test_check_names_partners_that_cannot_be_blended():
    found = operations.check(read_text(TEXT.replace("page 7 turn_l\n", "page 7 turn_l\n  step 9 | 1:1\n")))
    assert found == [(5, "blend left: page 7 has 2 steps and this one 1; it is not blended")]
    image = read_text(TEXT)
    operations.delete(image, [6])
    assert operations.check(image) == [(5, "blend right leads to page 6, which is damaged or has no action")]


# Merged by joints

LEGS_AND_ARMS = """motion512 1
page 1 step
  exit stand
  accel 0
  step 100 | 11:600 12:400
  step 100 | 11:500 12:500
page 2 wave
  accel 0
  step 40 pause 20 | 1:300
  step 60 | 1:500 11:9
page 3 stand
  step 10 | 1..18:512
"""


def goals(image, number, joints):
    """{tick: {joint: goal}} of a play by the exact law, with what is held."""
    out, now = {}, {}
    for tick in play(image, number, [512] * 31, 128 * 200):
        now = {joint: tick.goals[joint] for joint in joints} if tick.goals else now
        out[tick.number + 1] = now
    return out


def test_combine_interleaves_the_steps_of_both():
    """By hand: legs at ticks 100 and 200; arms at 40, a pause to 60, and 120. Both stand in their first pose at the start."""
    image = read_text(LEGS_AND_ARMS)
    said = overlay.combine(image, 1, image, 2, [1], 20)
    page = image[20]
    assert [(page.time(k), page.pause(k)) for k in range(page.steps)] == [(40, 20), (40, 0), (20, 0), (80, 0)]
    assert [page.word(k, 1) for k in range(4)] == [300, 433, 500, 500]  # 40 of 60 ticks from 300 to 500
    assert [page.word(k, 11) for k in range(4)] == [600, 600, 580, 500]  # 20 of 100 ticks from 600 to 500
    assert page.exit == 3 and page.next == 0 and page.name == b"step"
    assert said == ["the other ends after 0.938 s of 1.562 s and holds its last pose"]


def test_combine_goes_on_with_a_base_that_goes_round():
    image = read_text(LEGS_AND_ARMS.replace("exit stand", "exit stand; next self"))
    said = overlay.combine(image, 1, image, 2, [1], 20)
    assert image[20].next == 1 and 'page 20 goes on with page 1 "step"' in said
    longer = read_text(LEGS_AND_ARMS.replace("exit stand", "exit stand; next self").replace("step 60 |", "step 200 |"))
    overlay.combine(longer, 1, longer, 2, [1], 20)
    total, number = 0, 20
    while number != 1:
        total += sum(longer[number].time(k) + longer[number].pause(k) for k in range(longer[number].steps))
        number = longer[number].next
    assert total == 400  # two rounds of 200 ticks, for 260 of the arms


@pytest.mark.parametrize("seed", range(20))
def test_combine_meets_every_way_point_of_both_at_its_tick(seed):
    """Played by the exact law, whose steps end on their targets: merged and apart, at the ticks where a step of one ends."""
    chance, image = random.Random(seed), Image.empty()
    for first, joints in ((1, (11, 12, 13)), (10, (1, 2))):
        for number in range(first, first + chance.randrange(1, 4)):
            page = Page()
            page.steps, page.speed, page.repeat = chance.randrange(1, STEPS + 1), chance.choice((32, 32, 16, 48)), chance.choice((1, 1, 2))
            for step in range(page.steps):
                page.set_time(step, chance.randrange(8, 256))
                page.set_pause(step, chance.choice((0, 0, chance.randrange(60))))
                for joint in joints:
                    if step == 0 or chance.random() < 0.8:
                        page.set_word(step, joint, chance.randrange(1024))
            image[number] = page
            if number > first:
                image[number - 1].next = number
                image[number - 1].seal()
            image[number].seal()
    overlay.combine(image, 1, image, 10, (1, 2), 30)
    merged = goals(image, 30, (1, 2, 11, 12, 13))
    for first, joints in ((1, (11, 12, 13)), (10, (1, 2))):
        line = overlay.line_of(image, first, joints)
        alone = goals(image, first, joints)
        assert max(alone) == line.length
        for tick in line.ticks:
            assert {joint: merged[tick][joint] for joint in joints} == alone[tick], tick
    assert max(merged) == max(max(goals(image, 1, (11,))), max(goals(image, 10, (1,))))


def test_combine_needs_room():
    image = read_text(LEGS_AND_ARMS)
    for number in range(21, 128):
        image[number] = image[3]
    image[1].repeat = 5
    image[1].seal()
    with pytest.raises(RefusedError, match="need 2 pages"):
        overlay.combine(image, 1, image, 2, [1], 20)
