# SPDX-License-Identifier: MIT
"""A sample of shaped.py and jumps.py: shaped plays of the C player against the model of the specification."""

import pytest

from tests.models import jumps, shaped


def test_shaped_steps_equal_the_model_of_the_page():
    assert not shaped.compare(1, 40)


@pytest.mark.parametrize("what", jumps.WHATS)
def test_a_walk_whose_shape_jumps_in_every_step_keeps_the_law(what):
    assert jumps.broken(what, 60)[0] is None
