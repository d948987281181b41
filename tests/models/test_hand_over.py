# SPDX-License-Identifier: MIT
"""A sample of hand_over.py: a layer that comes and goes over a walk, and joints that change hands."""

import pytest

from tests.models import hand_over


@pytest.mark.parametrize("law", hand_over.LAWS)
@pytest.mark.parametrize("name", hand_over.LAYERS)
def test_joints_change_hands_at_the_approach_speed_and_nobody_else_notices(law, name):
    walks, found = hand_over.every_tick(law, name, ons=range(0, hand_over.CYCLE, 5), offs=(1, 31, 96))
    assert walks == 12 * 3 and not found, found[:3]


def test_pages_joints_and_moments_by_chance():
    assert not [said for said in map(hand_over.by_chance, range(25)) if said]


@pytest.mark.parametrize("seed", [522, 1357, 1808])
def test_a_joint_much_slower_than_its_owners_page_meets_it_all_the_same(seed):
    """The owner's motion passes the joint between two ticks and is never near it at a tick."""
    assert hand_over.by_chance(seed) is None
