# SPDX-License-Identifier: MIT
"""A sample of classic.py: the C player against the model of the classic law, on random motion areas."""

from tests.models import classic


def test_classic_law_equals_the_model_of_the_page():
    assert not classic.compare(1, 120)
