# SPDX-License-Identifier: MIT
"""The search for a gait writes only better numbers than those at the start. The test simulates optimiser and physics."""

import argparse
import json
import sys
import types

import pytest

from motions import gait, search

STRIDE = gait.numbers()["walk"].stride


class Strategy:
    """Asks for two sets of numbers per generation: the strides that the test names."""

    strides = []

    def __init__(self, start, sigma, options):
        self.waiting, self.told = [*Strategy.strides], []

    def ask(self):
        return [self.waiting.pop(0), self.waiting.pop(0)]

    def tell(self, vectors, costs):
        assert len(vectors) == len(costs) == 2


@pytest.fixture(name="run")
def _run(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "cma", types.SimpleNamespace(CMAEvolutionStrategy=Strategy))
    monkeypatch.setattr(search.Numbers, "of", lambda self, stride: search.replace(self.start, stride=stride))

    def run(strides, cost, keep=1):
        """cost(stride, bodies) -> (cost, bodies that fell). Returns the stride written; None: nothing was written."""
        Strategy.strides = strides
        monkeypatch.setattr(search, "each", lambda _, items, *rest: [cost(one["walk"].stride, seeds) for _, one, _, seeds in items])
        output = tmp_path / "gait.json"
        search.search(
            argparse.Namespace(
                kind="walk",
                seed=1,
                sigma=0.3,
                population=2,
                generations=len(strides) // 2,
                keep=keep,
                bodies=4,
                target=165.0,
                jobs=1,
                scheduler=None,
                output=output,
            )
        )
        return json.loads(output.read_text())["walk"]["stride"] if output.exists() else None

    return run


def test_nothing_is_written_when_nothing_better_is_found(run):
    assert run([20.0, 26.0, 19.0, 27.0], lambda stride, _: (abs(stride - STRIDE), ())) is None


def test_the_better_one_is_written(run):
    assert run([20.0, 30.0, 29.0, 40.0], lambda stride, _: (abs(stride - 30), ())) == 30.0


def test_luck_on_easy_bodies_does_not_count_on_the_next(run):
    """20 is best only on the first bodies; on the next ones it is worse than 25."""
    first = []

    def cost(stride, seeds):
        first[:] = first or seeds
        best = 20 if seeds == first else 25
        return abs(stride - best), ()

    assert run([20.0, 30.0, 25.0, 40.0], cost) == 25.0


def test_bodies_that_fell_stay_up_to_half(run):
    seen = []

    def cost(stride, seeds):
        seen.append(seeds)
        return abs(stride - STRIDE), tuple(seeds[-3:])

    run([20.0, 30.0, 20.0, 30.0], cost)
    before, after = seen[0], seen[-1]
    assert before != after and after[:2] == before[-3:][:2] and not set(after[2:]) & set(before)


@pytest.mark.parametrize("kind", list(search.TARGETS))
def test_the_search_begins_with_the_numbers_that_stand(kind):
    """A number outside its range would be changed before the search begins."""
    numbers = gait.numbers()[kind]
    space = search.Numbers(kind, numbers)
    assert vars(space.of(space.vector())) == pytest.approx(vars(numbers), abs=0.001)
