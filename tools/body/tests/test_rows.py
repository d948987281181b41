# SPDX-License-Identifier: MIT
"""A row of tests/proofs/ stays if it is not run again, even in a fresh clone, where build/prove/ is empty."""

import argparse
import pathlib
import re

import pytest

from tests.campaigns import physics, proof, shape

TOP = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(autouse=True)
def _fresh_clone(tmp_path, monkeypatch):
    monkeypatch.setattr(proof, "RESULTS", tmp_path / "build")
    monkeypatch.setattr(physics, "TRIED", tmp_path / "build" / "bodies.jsonl")
    monkeypatch.setattr(proof, "DETAILS", tmp_path)
    monkeypatch.setattr(proof, "commit", lambda: "0123456789")
    monkeypatch.setattr(proof, "code", lambda part: "abcdef")
    for name in ("shape", "physics"):
        (tmp_path / f"{name}.md").write_text((TOP / "tests" / "proofs" / f"{name}.md").read_text(encoding="utf-8"), encoding="utf-8")


def rows(name):
    return [line for line in (proof.DETAILS / f"{name}.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")][2:]


def run_shape(monkeypatch, **asked):
    """Runs tools/prove shape with rows that return one figure without any work."""
    for row in shape.ROWS:
        monkeypatch.setitem(shape.ROWS, row, lambda walk, seeds, options, row=row: [proof.Figure(f"{row} holds.", "new", "1 of 1", True)])
    options = {"only": None, "bodies": None, "seed_of": None, "hard": False, "sample": False, "seed": 1, "jobs": 1, "keep": True}
    shape.run(argparse.Namespace(**options | asked))


def test_a_row_of_shape_that_runs_alone_leaves_the_others(monkeypatch):
    before = rows("shape")
    run_shape(monkeypatch, only="cable")
    mark = "| `--only cable`, commit "
    assert [row for row in rows("shape") if mark not in row] == [row for row in before if mark not in row]
    assert [row for row in rows("shape") if mark in row] == ["| cable holds. | `--only cable`, commit 0123456789, code abcdef: new | 1 of 1 | kept |"]


def test_after_a_whole_run_of_shape_a_row_runs_alone(monkeypatch):
    run_shape(monkeypatch)
    run_shape(monkeypatch, only="eight")
    assert len(rows("shape")) == len(shape.ROWS) and "0123456789" in proof.row_of("shape")


def test_bodies_of_another_clone_stay_on_the_page():
    """--add-up where no body was tried: the rows of bodies are those of the page, with their commit."""
    library = physics.library_image()
    options = argparse.Namespace(sample=False, seed_of=None, add_up=True, jobs=1, first=1000, only=None, bodies=None, on_board=100)
    campaign, before = physics.Campaign(options, library), proof.commit_on_page("physics")
    found = physics.stand_figures(options, b"", library, campaign) + physics.board_figures(options, b"", library, campaign)
    made = proof.table([vars(figure) for figure in found])[2:]
    assert sum(figure.headline for figure in found) == 2  # the walk, on the PC and on the board
    assert [row.replace(f", commit {before}", "") for row in made] == [row for row in rows("physics") if ": it ends on its feet. |" in row]
    assert all(re.search(r", commit [0-9a-f]{10} \| ", row) for row in made)
