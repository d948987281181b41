# SPDX-License-Identifier: MIT
"""The model of shaping against values worked out by hand and properties that the specification names."""

import random
from fractions import Fraction

import pytest

from tests.models import random_pages, shaping
from tests.models.classic_law import Page
from tests.models.shaping import Shape, exact_position, shaped_position

IMAGE = 65536


def area(**pages):
    """Returns a motion area from p3={"steps": [({joint: position}, pause, time)], "right": n, "schedule": s, ...}."""
    image = bytearray(IMAGE)
    for name, given in pages.items():
        page = bytearray(512)
        page[15], page[16], page[20], page[22] = 1, given.get("schedule", 10), len(given["steps"]), given.get("speed", 32)
        page[17], page[18] = given.get("right", 0), given.get("left", 0)
        for step in range(1, 8):
            pose, pause, time = given["steps"][step - 1] if step <= len(given["steps"]) else ({}, 0, 0)
            for joint in range(31):
                page[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = pose.get(joint, 0x4000).to_bytes(2, "little")
            page[64 * step + 62], page[64 * step + 63] = pause, time
        at = 512 * int(name[1:])
        image[at : at + 512] = random_pages.checksummed(page)
    return bytes(image)


WALK = area(
    p1={"steps": [({0: 500, 1: 500}, 0, 50)]},
    p3={"steps": [({0: 600, 1: 400, 2: 300}, 8, 64)], "right": 4, "left": 5},
    p4={"steps": [({0: 700, 2: 400}, 0, 10)]},
    p5={"steps": [({0: 100, 1: 401, 2: 301}, 0, 10), ({0: 1}, 0, 10)]},
)


@pytest.mark.parametrize(
    ("p", "q", "c", "blend", "amplitude", "expected"),
    [
        (600, None, None, 0, 100, 600),
        (600, 700, None, 50, 100, 650),
        (600, 700, None, -50, 100, 650),  # q is then the left partner's
        (600, 700, 500, 100, 50, 600),  # blend first: 700, then half the distance from 500
        (600, None, 500, 0, 150, 650),
        (900, None, 500, 0, 150, 1023),  # 1100
        (100, None, 500, 0, 150, 0),  # -100
        (513, None, 512, 0, 50, 513),  # 512.5: away from the centre
        (511, None, 512, 0, 50, 511),  # 511.5: away from the centre, the mirror image about 512
        (600, 601, None, 49, 100, 600),
        (600, 601, None, 51, 100, 601),
    ],
)
def test_position_by_hand(p, q, c, blend, amplitude, expected):
    assert shaped_position(p, q, c, blend, amplitude) == expected


def test_a_mirrored_motion_stays_mirrored():
    chance = random.Random(1)
    for _ in range(2000):
        p, q, c = (chance.randrange(1024) for _ in range(3))
        blend, amplitude = chance.randint(-100, 100), chance.randint(0, 150)
        assert shaped_position(1023 - p, 1023 - q, 1023 - c, -blend, amplitude) == 1023 - shaped_position(p, q, c, blend, amplitude)


def test_the_planned_position_is_the_nearest_to_the_exact_one():
    chance = random.Random(2)
    for _ in range(2000):
        given = [chance.randrange(1024) for _ in range(3)] + [chance.randint(-100, 100), chance.randint(0, 150)]
        exact = max(0, min(1023, exact_position(*given)))
        assert abs(shaped_position(*given) - exact) <= Fraction(1, 2)


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        (Shape(), {0: 600, 1: 400, 2: 300}),
        (Shape(blend=50), {0: 650, 1: 400, 2: 350}),  # joint 1 is not used in the partner
        (Shape(blend=-50), {0: 600, 1: 400, 2: 300}),  # the left partner has another number of steps
        (Shape(amplitude={0: 50, 2: 50}), {0: 550, 1: 400, 2: 300}),  # joint 2 is not used in the centre pose
        (Shape(amplitude={0: 50}, centre_page=9), {0: 600, 1: 400, 2: 300}),
    ],
)
def test_pose_by_hand(shape, expected):
    assert shaping.shaped_pose(WALK, 3, 1, shape) == expected


def test_a_damaged_partner_is_not_blended():
    image = bytearray(WALK)
    image[512 * 4 + 31] ^= 1
    assert shaping.shaped_pose(image, 3, 1, Shape(blend=50)) == {0: 600, 1: 400, 2: 300}


def test_top_speed_is_that_of_the_body_page():
    for volts, units_a_tick in (("12", 9.4), ("11.1", 8.7), ("9.6", 7.5)):
        assert abs(float(shaping.top_speed(Fraction(volts))) - units_a_tick) < 0.06


@pytest.mark.parametrize(
    ("rate", "longest", "step", "pause"),
    [
        (100, 0, 64, 8),
        (200, 0, 32, 4),
        (50, 0, 128, 16),
        (300, 0, Fraction(64, 3), Fraction(8, 3)),
        (400, 1000, Fraction(1000 * 1000, 8496), 2),  # 0.9 * 9.44 = 8.496 units a tick
        (100, 1000, 64, 8),  # nothing is set: no limit
    ],
)
def test_lengths_by_hand_in_time_base(rate, longest, step, pause):
    page, shape = Page(WALK, 3), Shape(rate=rate)
    assert (shaping.ideal_step(page, 1, longest, shape), shaping.ideal_pause(page, 1, shape)) == (step, pause)


def test_the_step_after_a_shaped_one_is_limited():
    assert shaping.ideal_step(Page(WALK, 3), 1, 1000, Shape(), after_shaped=True) == Fraction(1000 * 1000, 8496)


def test_lengths_by_hand_in_speed_base():
    page = Page(area(p2={"steps": [({0: 1}, 8, 64)], "schedule": 0, "speed": 16}), 2)
    assert shaping.ideal_step(page, 1, 240, Shape()) == Fraction(40 * 240 * 32, 3 * 64 * 16)
    assert shaping.ideal_pause(page, 1, Shape(rate=50)) == 32
