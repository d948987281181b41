# SPDX-License-Identifier: MIT
"""A campaign of bodies can be interrupted and run in parts (tests/campaigns/bodies.py): no body is lost or tried twice, and none counts for
a motion that it was not tried with."""

import argparse
import pathlib

import pytest

from m512.files.formats import load as load_motions
from motions import promises
from tests.campaigns import bodies, physics

TOP = pathlib.Path(__file__).resolve().parents[3]

BOW = promises.Stands("bow", 4)


@pytest.fixture(name="library")
def _library():
    return load_motions(TOP / "tools" / "motions" / "motions.m512")


def campaign(library, path, monkeypatch, first=1000, **options):
    monkeypatch.setattr(physics, "TRIED", path)
    asked = {"sample": False, "seed_of": None, "add_up": False, "jobs": 1, "first": first} | options
    return physics.Campaign(argparse.Namespace(**asked), library)


def odd_fall(item):
    _, seed = item
    return seed % 2 == 0, f"body {seed}"


def pulled_at_1003(item):
    if item[1] == 1003:
        raise KeyboardInterrupt
    return odd_fall(item)


def only_from_1003(item):
    assert item[1] >= 1003, "tried again"
    return odd_fall(item)


def never(item):
    raise AssertionError(f"body {item[1]} is tried")


def test_an_interrupted_campaign_goes_on_where_it_was(library, tmp_path, monkeypatch):
    path = tmp_path / "deep" / "bodies.jsonl"
    with pytest.raises(KeyboardInterrupt):
        campaign(library, path, monkeypatch).results(pulled_at_1003, BOW, 6)
    results = campaign(library, path, monkeypatch).results(only_from_1003, BOW, 6)
    assert results == {seed: (seed % 2 == 0, f"body {seed}") for seed in range(1000, 1006)}


def test_parts_are_added_up_without_seeds_that_motions_were_made_with(library, tmp_path, monkeypatch):
    path = tmp_path / "bodies.jsonl"
    for first in (1, 1000, 2000):
        campaign(library, path, monkeypatch, first).results(odd_fall, BOW, 2)
    assert sorted(campaign(library, path, monkeypatch, add_up=True).results(never, BOW, 100)) == [1000, 1001, 2000, 2001]


def test_a_torn_line_costs_one_body(tmp_path):
    path = tmp_path / "bodies.jsonl"
    first = bodies.Tried(path)
    first.add("k", 1, (True, "stands"))
    first.add("k", 2, (False, "fell"))
    path.write_bytes(path.read_bytes()[:-9])
    again = bodies.Tried(path)
    assert again.of("k") == {1: (True, "stands")}
    again.add("k", 3, (True, "stands"))
    assert bodies.Tried(path).of("k") == {1: (True, "stands"), 3: (True, "stands")}


def changed(library, page):
    library[page].set_word(0, 11, library[page].word(0, 11) + 1)
    library[page].seal()
    return library


def test_a_result_counts_for_its_motion_alone(library):
    """A walk can lead to its turns, but never to a bow."""
    walk = promises.STANDS[0]
    number = {name: promises.number_of(library, name) for name in ("walk", "turn_l2", "bow")}

    def key(promise=walk, where="player"):
        return bodies.key_of(library, number[promise.page], promise, promises.ROBOT, where)

    before, by_board, bow = key(), key(where="board"), key(BOW)
    changed(library, number["bow"])
    assert key() == before != by_board and key(BOW) != bow
    changed(library, number["turn_l2"])
    assert key() != before


def test_a_result_counts_for_its_version_of_physics_alone(library, monkeypatch):
    walk = promises.STANDS[0]
    keys = set()
    for version in ("1.0.0", "2.0.0"):
        monkeypatch.setattr("mujoco.__version__", version)
        keys.add(bodies.key_of(library, promises.number_of(library, "walk"), walk, promises.ROBOT, "player"))
    assert len(keys) == 2
