# SPDX-License-Identifier: MIT
"""A sample of what classic.py compares at scale: C player and model of the classic law, on motion areas by chance."""

import dataclasses

from tests.models import classic


def test_classic_law_equals_the_model_of_the_page():
    readings, different = classic.compare(1, 500)
    assert not different
    assert readings < 60  # a reading is not to hide a difference


def test_a_player_that_errs_is_found(monkeypatch):
    """The comparison can fail: codes that arrive a tenth of a second late change what follows somewhere."""
    real = classic.play_in_c
    monkeypatch.setattr(
        classic,
        "play_in_c",
        lambda case: real(dataclasses.replace(case, schedule={tick + 13 if tick else 0: code for tick, code in case.schedule.items()})),
    )
    assert classic.compare(1, 120)[1]
