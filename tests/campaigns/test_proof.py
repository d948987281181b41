# SPDX-License-Identifier: MIT
"""What the parts of tools/prove share. Pages: the short page is made from the heads of the others, never by hand. Whole runs: an
interrupted one resumes."""

import pytest

from tests.campaigns import proof


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


def test_a_row_is_the_head_of_its_page(pages, monkeypatch):
    put(pages, "7 states, 0 broken; 3 min")
    monkeypatch.setattr(proof, "JUDGED", {"other": (), "cuts": ()})
    proof.write_page()
    assert proof.PAGE.read_text().splitlines()[-1] == (
        "| [Cuts](proofs/cuts.md) | Nothing is lost. | 7 states, 0 broken | `tools/prove cuts` | abc |  |"
    )


def test_a_row_says_that_the_code_has_changed_since(pages):
    put({**pages, "code": "of another day"}, "7 states, 0 broken")
    assert proof.row_of("cuts").endswith("| older than the code |".replace("older", "\U0001f534 older"))


def test_what_is_broken_stands_in_the_row(pages):
    put(pages, "7 states, 1 broken", kept=False)
    assert "| **1 of 1 broken** |" in proof.row_of("cuts")


def test_the_page_of_this_tree_is_what_the_others_say():
    rows = [line for line in proof.PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| [")]
    assert rows == [proof.row_of(name) for name in proof.JUDGED] and len(rows) == len(list(proof.DETAILS.glob("*.md")))


def test_no_row_of_this_tree_is_broken():
    """A finding is fixed before its page lands. A page that is merely outdated says so itself."""
    assert [page.stem for page in proof.DETAILS.glob("*.md") if "**BROKEN**" in page.read_text(encoding="utf-8")] == []


def test_code_changes_with_what_runs_only(tmp_path, monkeypatch):
    monkeypatch.setattr(proof, "TOP", tmp_path)
    monkeypatch.setattr(proof, "git_files", lambda *_: [tmp_path / "motion.c"])
    said = []
    for written in ("int a; /* one */", "int  a;\n// two\n", "int b;"):
        (tmp_path / "motion.c").write_text(written)
        said.append(proof.code("power"))
    assert said[0] == said[1] != said[2]


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
