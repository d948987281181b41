# SPDX-License-Identifier: MIT
"""A sample of what shaped.py and jumps.py compare at scale: shaped plays of the C player and the model of the page."""

import pytest

from tests.models import jumps, shaped


def test_shaped_steps_equal_the_model_of_the_page():
    assert not shaped.compare(1, 150)


def test_a_wrong_shape_is_found(monkeypatch):
    """The comparison can fail: amplitudes that the model is not told of."""
    real = shaped.apply
    monkeypatch.setattr(shaped, "apply", lambda shape, kind, *values: shape if kind == "amplitude" else real(shape, kind, *values))
    assert shaped.compare(1, 40)


@pytest.mark.parametrize("what", jumps.WHATS)
def test_a_walk_whose_shape_jumps_in_every_step_keeps_the_law(what):
    assert jumps.broken(what, 60)[0] is None


def test_a_change_of_speed_above_the_laws_is_found(monkeypatch):
    """Ramps that are longer than the page's make the bound smaller than what is played."""
    real = jumps.bound_of
    monkeypatch.setattr(jumps, "bound_of", lambda way, ticks, accel, *speeds: real(way, ticks, accel + 3, *speeds))
    assert "above the law's own" in jumps.broken("amplitude", 60)[0]
