# SPDX-License-Identifier: MIT
"""A sample of classic.py: the C player against the model of the classic law, on random motion areas."""

from tests.models import classic


def test_classic_law_equals_the_model_of_the_page():
    readings, different = classic.compare(1, 120)
    assert not different
    assert readings < 15  # the open readings must not hide a difference
