# SPDX-License-Identifier: MIT
"""A sample of what classic.py compares at scale: C player and model of the classic law, on motion areas by chance."""

from tests.models import classic


def test_classic_law_equals_the_model_of_the_page():
    readings, different = classic.compare(1, 120)
    assert not different
    assert readings < 15  # a reading is not to hide a difference
