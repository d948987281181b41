# SPDX-License-Identifier: MIT
"""The least push is where a body of the test begins to fall; and the leaning body does lean, to the stated side."""

import math
import types

import pytest

from body.chance import NOMINAL
from body.physics import Physics
from motions import gait, margins


@pytest.fixture(name="felled_by")
def _felled_by(monkeypatch):
    """Makes bodies fall at a push of this size (0: without one). Returns a list that records each trial."""

    def set_up(newton_s):
        tried = []

        def try_motion(_image, _page, seconds, _robot, body, keys):
            tried.append((seconds, body.pushes, keys))
            fell = sum(push.newton_s for push in body.pushes) >= newton_s
            return types.SimpleNamespace(fell_s=seconds if fell else None)

        monkeypatch.setattr(margins, "try_motion", try_motion)
        return tried

    return set_up


@pytest.mark.parametrize("felled", [0.05, 0.3, 0.44, 0.88])
def test_the_least_push_is_where_it_begins_to_fall(felled_by, felled):
    tried = felled_by(felled)
    assert margins.least_push((b"", 20, NOMINAL, ((0, 1),), 3.0, 180)) == pytest.approx(felled, abs=0.015)
    assert all(push.at_s == 3.0 and push.towards == 180 for _, pushes, _ in tried for push in pushes) and tried[0][1] == ()
    assert all(seconds > 5 and keys == ((0, 1),) for seconds, _, keys in tried)


def test_a_robot_that_falls_by_itself_needs_no_push(felled_by):
    tried = felled_by(0.0)
    assert margins.least_push((b"", 20, NOMINAL, (), 3.0, 0)) == 0.0 and len(tried) == 1


@pytest.mark.parametrize("degrees", [3, -3])
def test_ankles_that_are_off_make_it_lean(degrees):
    robot, ready = margins.load("humanoid"), gait.stand(gait.numbers()["ready"])

    def lean(body):
        physics = Physics(robot, body)
        physics.stand(ready)
        trunk = physics.data.xmat[physics.root].reshape(3, 3)
        return math.degrees(math.atan2(trunk[0, 2], trunk[2, 2]))

    assert lean(margins.leaning(NOMINAL, degrees)) - lean(NOMINAL) == pytest.approx(degrees, abs=0.3)


def test_the_smaller_of_both_moments_counts_forward_and_backwards(monkeypatch):
    pushes = {(margins.FORWARD, at_s): 0.4 + at_s / 100 for at_s in margins.MOMENTS_S}
    pushes |= {(margins.BACKWARDS, at_s): 0.5 - at_s / 100 for at_s in margins.MOMENTS_S}
    monkeypatch.setattr(margins, "each", lambda _, items, *rest: [pushes[towards, at_s] for *_, at_s, towards in items])
    found = margins.margins("walk", gait.numbers())
    assert set(found) == {"nominal", "heavy rotors", "9.2 V", "legs differ", "stop", "curve"}
    for both in found.values():
        assert both == {
            margins.FORWARD: pytest.approx(0.4 + min(margins.MOMENTS_S) / 100),
            margins.BACKWARDS: pytest.approx(0.5 - max(margins.MOMENTS_S) / 100),
        }


def test_a_number_that_is_none_is_told():
    assert margins.change_of("height=118,ankle_slope=6") == {"height": 118.0, "ankle_slope": 6}
    with pytest.raises(margins.argparse.ArgumentTypeError, match="hight=118: give NAME=NUMBER; the names are ticks"):
        margins.change_of("hight=118")
    with pytest.raises(margins.argparse.ArgumentTypeError, match="lift=high: high is no float"):
        margins.change_of("lift=high")
