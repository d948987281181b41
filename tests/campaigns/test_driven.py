# SPDX-License-Identifier: MIT
"""The hand that steers a figure of eight: on a point that walks as it is steered, late and with a sway, and on one that is deaf."""

import math

import pytest

from body.trial import Look
from tests.campaigns.driven import TICKS_A_LINE, Eight, rounds

LINE_S = TICKS_A_LINE / 128


def ridden(full_mm=240.0, bias=0.0, late_lines=6, seconds=60.0, deaf=False):
    """(hand, track) of a point of 170 mm/s that turns with a radius of full_mm at blend 100, and by `bias` degrees/s beside that."""
    hand, track, waiting = Eight(), [], [0.0] * late_lines
    x = y = heading = 0.0
    for k in range(int(seconds / LINE_S)):
        sway = 6 * math.sin(2 * math.pi * k / 12)
        track.append(Look(k * LINE_S, x - sway * math.sin(heading), y + sway * math.cos(heading), math.degrees(heading), 1.0))
        wish = hand(track[-1])
        if wish is None:
            break
        assert -100 <= wish[0] <= 100 and wish[1:] == (100, 100)
        waiting.append(0.0 if deaf else wish[0])
        heading += (-waiting.pop(0) / 100 * 170 / full_mm + math.radians(bias)) * LINE_S
        x, y = x + 170 * math.cos(heading) * LINE_S, y + 170 * math.sin(heading) * LINE_S
    return hand, track


@pytest.mark.parametrize("bias", [0, 2, -2])
def test_eight_comes_round_both_ways_near_its_path(bias):
    hand, track = ridden(bias=bias)
    assert hand.done and hand.farthest_mm < 100
    assert rounds(track, (0, 250)) == pytest.approx(1, abs=0.1) and rounds(track, (0, -250)) == pytest.approx(-1, abs=0.1)
    assert rounds(track, (900, 0)) == pytest.approx(0, abs=0.1)


def test_eight_of_a_robot_that_does_not_listen_is_none():
    hand, track = ridden(deaf=True, bias=40)
    assert not (hand.done and rounds(track, (0, -250)) < -0.9)


def test_rounds_count_the_way_round():
    circle = [Look(0, math.cos(a / 20), math.sin(a / 20), 0, 1) for a in range(int(2 * 20 * 2 * math.pi) + 1)]
    assert rounds(circle, (0, 0)) == pytest.approx(2, abs=0.01) and rounds(circle[::-1], (0.5, 0)) == pytest.approx(-2, abs=0.02)
    assert rounds(circle, (3, 0)) == pytest.approx(0, abs=0.02)
