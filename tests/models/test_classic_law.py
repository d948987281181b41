# SPDX-License-Identifier: MIT
"""The model of the classic law against recordings of the original firmware (golden/)."""

import csv
import pathlib

import pytest

from tests.models import classic_law

HERE = pathlib.Path(__file__).parent
SETS = {path.stem: path for path in (HERE / "golden").glob("*.bin")}


def recorded(name):
    with open(SETS[name].with_suffix(".csv"), encoding="ascii", newline="") as file:
        return [tuple(map(int, row)) for row in list(csv.reader(file))[1:]]


def played(name):
    """Returns the rows of the recording by the model, and how the play ended. Ticks count from the first output."""
    play = classic_law.ClassicPlay(SETS[name].read_bytes(), 1, 0x1FFE, {i: 512 for i in range(1, 13)})
    rows = [(tick, *goals) for tick, goals in enumerate(play.ticks(100_000)) if goals is not None]
    return [(row[0] - rows[0][0], *row[1:]) for row in rows], play.ended


def test_all_twelve_sets_are_there():
    assert len(SETS) == 12


@pytest.mark.parametrize("name", sorted(SETS))
def test_model_equals_the_original_in_every_sample(name):
    assert played(name) == (recorded(name), classic_law.DONE)
