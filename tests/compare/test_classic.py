# SPDX-License-Identifier: MIT
"""A sample of what classic.py compares at scale: C player and model of the classic law, on motion areas by chance."""
import classic


def test_classic_law_equals_the_model_of_the_page():
    readings, different = classic.compare(1, 500)
    assert not different
    assert readings < 60  # a reading is not to hide a difference


def test_a_player_that_errs_is_found(monkeypatch):
    """The comparison can fail: codes that arrive two calls late change what follows somewhere."""
    monkeypatch.setattr(classic, "AHEAD", 0)
    assert classic.compare(1, 120)[1]
