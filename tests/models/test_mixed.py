# SPDX-License-Identifier: MIT
"""A sample of mixed.py."""

from tests.models import mixed


def test_everything_at_once_by_chance():
    assert not mixed.objections(1, 50)
