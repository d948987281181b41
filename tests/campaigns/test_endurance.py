# SPDX-License-Identifier: MIT
"""The judge of the journal's wear (tests/campaigns/endurance.py), with erases written down from the page of firmware/common/journal.h: ten slots of
three flash pages, two of data and the record's; each save takes the next slot, and leaves data that are there already as they are."""

import pytest

from tests.campaigns.endurance import SLOT_PAGES, SLOTS, wears_evenly

NEVER, ONCE, TWICE, THRICE = ([times] * 3 for times in range(4))


def slots(*erases):
    """The erases of all flash pages, in the order of the flash."""
    return [times for slot in erases for times in slot]


EVEN = {
    "no save": slots(*[NEVER] * 10),
    "one save": slots(ONCE, *[NEVER] * 9),
    "once around": slots(*[ONCE] * 10),
    "thirteen saves": slots(*[TWICE] * 3, *[ONCE] * 7),
    "thirteen saves that began at slot 8": slots(TWICE, *[ONCE] * 7, *[TWICE] * 2),
    "the second half of a page was there already": slots([2, 1, 2], *[TWICE] * 9),
    "the same page at each turn": slots(*[[1, 1, 25]] * 10),
}
UNEVEN = {
    "always the same slot": slots([10, 10, 10], *[NEVER] * 9),
    "a slot that is left out": slots(*[TWICE] * 4, NEVER, *[TWICE] * 5),
    "the last slot is never reached": slots(*[THRICE] * 9, NEVER),
    "to and fro between two slots": slots([5, 5, 5], [5, 5, 5], *[NEVER] * 8),
    "data that are erased twice in a save": slots(*[ONCE] * 6, [2, 1, 1], *[ONCE] * 3),
    "second halves that are erased without a record": slots(*[ONCE] * 9, [1, 2, 1]),
    "one slot two turns ahead, its data spared": slots([0, 0, 3], *[ONCE] * 9),
}


def test_the_lists_have_the_shape_of_the_journal():
    assert (SLOTS, SLOT_PAGES) == (10, 3)
    assert {len(erases) for erases in (*EVEN.values(), *UNEVEN.values())} == {30}


@pytest.mark.parametrize("erases", EVEN.values(), ids=EVEN)
def test_wear_by_turns_is_even(erases):
    assert wears_evenly(erases)


@pytest.mark.parametrize("erases", UNEVEN.values(), ids=UNEVEN)
def test_other_wear_is_not(erases):
    assert not wears_evenly(erases)
