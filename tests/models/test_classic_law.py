# SPDX-License-Identifier: MIT
"""The model of the classic law against what the original firmware sent (../golden), and the random cases against the model's sentences."""

import csv
import functools
import pathlib

import pytest

from tests.models import classic_law, random_pages, rules

HERE = pathlib.Path(__file__).parent
SETS = {path.stem: path for path in (HERE / "golden").glob("*.bin")}
FIRST, MOST = 1, 1500  # seeds that are tried until one shows a sentence broken


def recorded(name):
    with open(SETS[name].with_suffix(".csv"), encoding="ascii", newline="") as file:
        return [tuple(map(int, row)) for row in list(csv.reader(file))[1:]]


def played(name, model=classic_law):
    """The rows of the recording, by the model: ticks are counted from the first one with output."""
    play = model.ClassicPlay(SETS[name].read_bytes(), 1, 0x1FFE, {i: 512 for i in range(1, 13)})
    rows = [(tick, *goals) for tick, goals in enumerate(play.ticks(100_000)) if goals is not None]
    return [(row[0] - rows[0][0], *row[1:]) for row in rows], play.ended


def test_all_twelve_sets_are_there():
    assert len(SETS) == 12


@pytest.mark.parametrize("name", sorted(SETS))
def test_model_equals_the_original_in_every_sample(name):
    assert played(name) == (recorded(name), classic_law.DONE)


@functools.cache
def tried(seed):
    """A case and what comes of it by the model: the same for every sentence."""
    case = random_pages.case(seed, limit=400)
    return case, rules.outcome(case, classic_law)


@pytest.mark.parametrize(("sentence", "old", "new"), rules.RULES, ids=[rule[0] for rule in rules.RULES])
def test_random_cases_decide_each_sentence(sentence, old, new):
    """A player that breaks one sentence is told by some case among the first seeds."""
    model = rules.broken(old, new)
    for seed in range(FIRST, FIRST + MOST):
        case, outcome = tried(seed)
        if rules.outcome(case, model) != outcome:
            return
    pytest.fail(f"seeds {FIRST}..{FIRST + MOST - 1} say nothing about: {sentence}")


def test_a_case_is_the_same_for_the_same_seed():
    assert random_pages.case(7) == random_pages.case(7)
    assert random_pages.case(7) != random_pages.case(8)
