# SPDX-License-Identifier: MIT
"""The first screen of the README is true: its session is part of a tour that a test runs, its links and commands exist."""
import pathlib
import re

TOP = pathlib.Path(__file__).parents[2]
README = (TOP / "README.md").read_text(encoding="utf-8")


def test_session_is_part_of_the_tour_word_for_word():
    fenced = README.split("```")[1::2]
    session = next(block for block in fenced if "send " in block).lstrip("\n")
    assert session in (TOP / "tools/demo.d/edit.txt").read_text(encoding="utf-8")


def test_every_link_leads_somewhere():
    links = re.findall(r"\]\(([^)#]+)\)", README)
    assert len(links) > 10
    assert [link for link in links if not (TOP / link).exists()] == []


def test_commands_named_exist():
    names = set(re.findall(r"\btools/[a-z_]+\b", README))
    assert {"tools/demo", "tools/test"} <= names
    assert [name for name in names if not (TOP / name).exists()] == []
