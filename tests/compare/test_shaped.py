# SPDX-License-Identifier: MIT
"""A sample of what shaped.py compares at scale: shaped plays of the C player and the model of the page."""
import shaped


def test_shaped_steps_equal_the_model_of_the_page():
    assert not shaped.compare(1, 150)


def test_a_wrong_shape_is_found(monkeypatch):
    """The comparison can fail: amplitudes that the model is not told of."""
    real = shaped.apply
    monkeypatch.setattr(shaped, "apply", lambda shape, kind, *values: shape if kind == "amplitude" else real(shape, kind, *values))
    assert shaped.compare(1, 40)
