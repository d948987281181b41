# SPDX-License-Identifier: MIT
"""Tests the exact law against its defining properties."""

import pytest
from chance import given, settings
from hypothesis import strategies as st

from m512.files.image import Image
from m512.files.page import Page
from m512.motion.player import page_seconds, play


def one_page(steps, time=64, accel=32, speed=32, next_=0, repeat=1, schedule=0x0A, pauses=()):
    image = Image.empty()
    page = image[1]
    page.steps, page.accel, page.speed, page.next, page.repeat, page.schedule = (len(steps), accel, speed, next_, repeat, schedule)
    for k, target in enumerate(steps):
        page.set_time(k, time if isinstance(time, int) else time[k])
        page.set_pause(k, pauses[k] if k < len(pauses) else 0)
        for joint, word in target.items() if isinstance(target, dict) else {1: target}.items():
            page.set_word(k, joint, word)
    page.seal()
    return image


def goals(image, joint=1, **more):
    return [tick.goals[joint] if tick.goals else None for tick in play(image, 1, **more)]


def test_player_exact_step_of_one_and_two_ticks():
    assert goals(one_page([600], time=1)) == [600]
    assert goals(one_page([612], time=2)) == [562, 612]
    assert goals(one_page([613], time=2)) == [563, 613] and goals(one_page([411], time=2)) == [461, 411]  # 50.5 away


def test_player_exact_carries_fractions_of_a_tick():
    # 7 steps of 10 at page speed 35: 10.9375 ticks each, 76.56 together.
    assert len(goals(one_page([600, 500] * 3 + [512], time=10, speed=35))) in (76, 77)


def test_player_exact_pause_is_silent_and_scales_with_time_base():
    out = goals(one_page([600, 512], time=4, pauses=[8], speed=64))
    assert len(out) == 8 + 16 + 8 and out[8:24] == [None] * 16


def test_player_speed_base_length():
    # 90 units at 64 * 0.01875 units/tick: 40 * 90 / (3 * 64) = 18.75 ticks.
    assert len(goals(one_page([602], time=64, schedule=0))) in (18, 19)


def test_player_unused_joint_keeps_its_target():
    image = one_page([{1: 600, 2: 700}, {1: 500}, {1: 512, 2: 512}], time=8)
    out = goals(image, joint=2)
    assert out[7:16] == [700] * 9 and out[-1] == 512


def test_player_repeat_and_link():
    image = one_page([600, 512], time=4, repeat=3, next_=1)
    assert len(goals(image, limit=100)) == 100
    image = one_page([600, 512], time=4, repeat=3, next_=2)
    image[2] = one_page([550], time=5)[1]
    out = goals(image, limit=100)
    assert len(out) == 3 * 8 + 5 and out[-1] == 550


def test_player_damaged_page_ends_the_play():
    image = one_page([600], time=4, next_=2)
    image[2].data[100] ^= 1
    assert len(goals(image)) == 4


page_recipe = st.tuples(st.lists(st.integers(0, 1023), min_size=1, max_size=7), st.integers(1, 80), st.integers(0, 60), st.integers(8, 90))


@settings(max_examples=40)
@given(page_recipe)
def test_player_exact_never_passes_a_way_point_and_ends_on_target(recipe):
    steps, time, accel, speed = recipe
    before, at = 512, 0
    ticks = list(play(one_page(steps, time, accel, speed), 1))
    for k, target in enumerate(steps):
        part = [tick.goals[1] for tick in ticks if tick.step == k + 1]
        assert part[-1] == target
        assert all(min(before, target) <= p <= max(before, target) for p in part)
        before, at = target, at + len(part)
    ideal = len(steps) * max(1, time * speed / 32)
    assert abs(len(ticks) - ideal) <= 1 or time * speed < 32


@settings(max_examples=20)
@given(page_recipe)
def test_player_exact_mirrors(recipe):
    steps, time, accel, speed = recipe
    ours = goals(one_page(steps, time, accel, speed), pose=[512] * 31)
    mirror = goals(one_page([1023 - p for p in steps], time, accel, speed), pose=[511] * 31)
    assert [1023 - p for p in ours] == mirror


def test_page_seconds():
    image = one_page([600, 500], time=64, pauses=[64], speed=64)
    assert page_seconds(image[1]) == pytest.approx((64 + 64 + 64) * 2 / 128)
    assert page_seconds(Page()) == 0


def test_a_step_is_cut_to_256_s():
    """PAGE_FORMAT.md. Here 1024 units at the slowest speed there is would take 6,820 s."""
    assert page_seconds(one_page([0, 1023], time=1, speed=1, schedule=0)[1]) == pytest.approx(2 * 32_767 / 128)
