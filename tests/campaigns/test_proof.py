# SPDX-License-Identifier: MIT
"""What the parts of tools/prove share. Pages: the short page is made from the heads of the others, never by hand. Whole runs: an
interrupted one resumes."""

import pathlib
import re

import pytest

from tests.campaigns import proof
from tests.models.played import Played

TOP = pathlib.Path(__file__).resolve().parents[2]

PARTS = re.search(r"PARTS = \[\s*name\s+for name in \((.*?)\)", (TOP / "tools" / "prove").read_text(encoding="utf-8"))[1].replace('"', "").split(", ")


@pytest.fixture
def pages(tmp_path, monkeypatch):
    """Redirects the pages to an empty folder. Returns the head of a part."""
    monkeypatch.setattr(proof, "DETAILS", tmp_path / "proofs")
    monkeypatch.setattr(proof, "PAGE", tmp_path / "PROOFS.md")
    monkeypatch.setattr(proof, "commit", lambda: "0123456789")
    return {
        "title": "Cuts",
        "promise": "Nothing is lost.",
        "about": "How, at `length`; by hand.",
        "command": "tools/prove cuts",
        "commit": "abc",
        "code": proof.code("cuts"),
    }


def figures(*measured, kept=True):
    return [proof.Figure(f"promise {text}", "how", text, kept, headline=True) for text in measured]


def put(part, *measured, **options):
    proof.write_details("cuts", {**part, "figures": [vars(figure) for figure in figures(*measured, **options)]})


def test_a_row_is_the_head_of_its_page(pages):
    put(pages, "7 states, 0 broken; 3 min")
    proof.write_page(["other", "cuts"])
    assert proof.PAGE.read_text().splitlines()[-1] == (
        "| [Cuts](proofs/cuts.md) | Nothing is lost. | 7 states, 0 broken | `tools/prove cuts` | abc |  |"
    )


def test_a_row_says_that_the_code_has_changed_since(pages):
    put({**pages, "code": "of another day"}, "7 states, 0 broken")
    assert proof.row_of("cuts").endswith("| older than the code |".replace("older", "\U0001f534 older"))


def test_what_is_broken_stands_in_the_row(pages):
    put(pages, "7 states, 1 broken", kept=False)
    assert "| **1 of 1 broken** |" in proof.row_of("cuts")


def test_a_sample_is_noted_beside_the_whole_run_once(pages):
    put(pages, "7 states, 0 broken")
    proof.note_sample("cuts", figures("2 states, 0 broken"))
    proof.note_sample("cuts", figures("3 states, 0 broken"))
    assert proof.row_of("cuts").endswith("| 7 states, 0 broken | `tools/prove cuts` | abc; a sample again at 0123456789: 3 states, 0 broken |  |")
    assert "2 states" not in (proof.DETAILS / "cuts.md").read_text()


def test_a_whole_run_takes_the_place_of_the_samples(pages):
    put(pages, "7 states, 0 broken")
    proof.note_sample("cuts", figures("2 states, 0 broken"))
    put(pages, "8 states, 0 broken")
    assert proof.row_of("cuts").endswith("| 8 states, 0 broken | `tools/prove cuts` | abc |  |")


def test_the_page_of_this_tree_is_what_the_others_say():
    rows = [line for line in proof.PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| [")]
    assert rows == [proof.row_of(name) for name in PARTS if (proof.DETAILS / f"{name}.md").exists()]
    assert len(rows) == len(list(proof.DETAILS.glob("*.md")))


def test_no_row_of_this_tree_is_broken():
    """A finding is fixed before its page lands. A page that is merely outdated says so itself."""
    assert [page.stem for page in proof.DETAILS.glob("*.md") if "**BROKEN**" in page.read_text(encoding="utf-8")] == []


@pytest.mark.parametrize(
    ("name", "text", "same", "other"),
    [
        ("motion.c", "int a; /* one */", "int  a;\n// two\n", "int b;"),
        (
            "gait.py",
            "def f():\n    return '# no'\n",
            'def f():  # says no\n    """One\n    two."""\n\n    return \'# no\'\n',
            "def f():\n    return '# yes'\n",
        ),
        ("gait.py", "if a:\n    b()\nc()\n", "if a:\n    # twice\n    b()\nc()", "if a:\n    b()\n    c()\n"),
    ],
)
def test_code_changes_with_what_runs_only(tmp_path, monkeypatch, name, text, same, other):
    monkeypatch.setattr(proof, "TOP", tmp_path)
    monkeypatch.setattr(proof, "git_files", lambda *_: [tmp_path / name])
    said = []
    for written in (text, same, other):
        (tmp_path / name).write_text(written)
        said.append(proof.code("power"))
    assert said[0] == said[1] != said[2]


def test_physics_is_older_when_one_goal_of_our_motions_is_another(monkeypatch):
    assert proof.is_current("physics") == (not proof.row_of("physics").endswith("older than the code |"))
    before, goals_of_player = proof.code("physics"), Played.goals
    made = []

    def goals():
        made.append(goals_of_player())
        return [made[-1][0] ^ (len(made) % 20000 == 0), *made[-1][1:]]

    monkeypatch.setattr(Played, "goals", staticmethod(goals))
    assert proof.code("physics") != before and len(made) > 20000
    assert proof.row_of("physics").endswith("older than the code |")


ODD = [proof.Figure("a | b\nc", "`x | y`: how", "1; 2 |", True), proof.Figure("| d", "by\nhand |", "3 \\", False)]


def test_figures_come_back_from_a_page(pages):
    put(pages, "7 states, 0 broken")
    proof.write_details("cuts", {**pages, "figures": [vars(figure) for figure in ODD]})
    proof.note_sample("cuts", figures("2 states, 0 broken"))
    back = proof.figures_on_page("cuts")
    assert proof.table(back) == proof.table([vars(figure) for figure in ODD])
    assert [figure["kept"] for figure in back] == [True, False] and back[1]["measured"] == "3 \\"
    assert proof.figures_on_page("other") == []


def test_figures_come_back_from_the_pages_of_this_tree():
    for name in (name for name in PARTS if (proof.DETAILS / f"{name}.md").exists()):
        rows = [line for line in (proof.DETAILS / f"{name}.md").read_text(encoding="utf-8").splitlines() if line.startswith("|")]
        assert proof.table(proof.figures_on_page(name)) == rows and len(rows) > 2


@pytest.fixture
def calls(tmp_path, monkeypatch):
    """Returns the items worked on. each() runs in this process; its third item fails once."""
    made = []

    def each(work, items, what, jobs, done):
        for item in items:
            made.append(item)
            if made == [1, 2, 3]:
                raise KeyboardInterrupt
            done(item, work(item))

    monkeypatch.setattr(proof, "RESULTS", tmp_path)
    monkeypatch.setattr(proof, "commit", lambda: "0123456789")
    monkeypatch.setattr(proof, "each", each)
    with pytest.raises(KeyboardInterrupt):
        proof.Kept("cuts").each(lambda item: [item, "fine"], [1, 2, 3, 4], "items", 1)
    return made


def again(**options):
    return proof.Kept("cuts", **options).each(lambda item: [item, "fine"], [1, 2, 3, 4], "items", 1)


def test_an_interrupted_run_goes_on_where_it_was(calls):
    assert again() == [[number, "fine"] for number in (1, 2, 3, 4)]
    assert calls == [1, 2, 3, 3, 4]


@pytest.mark.parametrize("commit", ["123456789a", "0123456789 and changes", "no commit"])
def test_another_tree_begins_anew(calls, monkeypatch, commit):
    monkeypatch.setattr(proof, "commit", lambda: commit)
    again()
    assert calls == [1, 2, 3, 1, 2, 3, 4]


def test_a_run_that_ends_is_forgotten(calls):
    kept = proof.Kept("cuts")
    kept.each(lambda item: [item, "fine"], [1, 2, 3, 4], "items", 1)
    kept.finish()
    again()
    assert calls == [1, 2, 3, 3, 4, 1, 2, 3, 4]


def test_a_piece_of_the_work_keeps_and_takes_nothing(calls):
    again(is_whole=False)
    assert calls == [1, 2, 3, 1, 2, 3, 4]
