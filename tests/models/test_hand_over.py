# SPDX-License-Identifier: MIT
"""A sample of what hand_over.py asks at every tick: a layer that comes and goes over a walk, and joints that change hands."""

import pytest

from tests.models import hand_over


@pytest.mark.parametrize("law", hand_over.LAWS)
@pytest.mark.parametrize("name", hand_over.LAYERS)
def test_joints_change_hands_at_the_approach_speed_and_nobody_else_notices(law, name):
    walks, found = hand_over.every_tick(law, name, offs=(1, 5, 31, 54, 95, 96, 127))
    assert walks == 7 * hand_over.CYCLE and not found, found[:3]


def test_pages_joints_and_moments_by_chance():
    assert not [said for said in map(hand_over.by_chance, range(100)) if said]


@pytest.mark.parametrize("seed", [522, 1357, 1808])
def test_a_joint_much_slower_than_its_owners_page_meets_it_all_the_same(seed):
    """What the owner asks for comes past it between two ticks, and never near it at one."""
    assert hand_over.by_chance(seed) is None


@pytest.mark.parametrize("law", hand_over.LAWS)
def test_a_hand_over_that_is_too_fast_is_found(monkeypatch, law):
    monkeypatch.setattr(hand_over, "UNITS_A_TICK", 0.97 * hand_over.UNITS_A_TICK)
    assert all(
        "faster than the approach" in said or "beside its owner's way" in said for said in hand_over.every_tick(law, "wave_over", [3], [40, 140])[1]
    )
    assert hand_over.every_tick(law, "wave_over", [3], [40, 140])[1]


def test_a_walk_that_the_layer_disturbs_is_found(monkeypatch):
    real = hand_over.check
    monkeypatch.setattr(hand_over, "check", lambda image, law, plain, run, joints, *rest: real(image, law, plain, run, joints[1:], *rest))
    assert "goes otherwise" in hand_over.every_tick("exact", "wave_over", [3], [40])[1][0]
