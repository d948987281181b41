# SPDX-License-Identifier: MIT
"""The READMEs are true: a tested tour contains the session of the first screen, links and commands exist, and tools/README.md has a line
for everything in tools/."""

import pathlib
import re
import subprocess

import pytest

TOP = pathlib.Path(__file__).parents[3]
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


def entries(folder):
    """Names in a folder, without self-explanatory files and those that tools leave."""
    return {path.name for path in (TOP / folder).iterdir() if not path.name.startswith((".", "__"))} - {"CMakeLists.txt", "README.md"}


@pytest.mark.parametrize(
    "tool",
    [
        "demo",
        "test",
        "bench",
        "prove",
        "combine",
        "release",
        "sim/bench",
        "body/try",
        "body/picture",
        "dev/size_report",
        "dev/pack_texts",
        "dev/app_record",
        "dev/lint",
        "dev/build",
        "dev/cleanroom",
        "dev/setup",
        "dev/get_unity",
        "dev/check_layers",
        "dev/check_circles",
        "dev/check_images",
        "motions/gait.py",
        "visual/build",
        "visual/serve",
        "visual/test",
        "visual/board/get_simavr",
    ],
)
def test_tool_says_by_itself_what_it_does(tool, tmp_path):
    """Called as a person calls it, without the project's Python. Nothing is built, installed or written for it."""
    done = subprocess.run(
        [TOP / "tools" / tool, "--help"],
        capture_output=True,
        text=True,
        timeout=300,
        cwd=tmp_path,
        env={"PATH": "/usr/local/bin:/usr/bin:/bin"},
        check=False,
    )
    assert tool.rpartition("/")[2] in done.stdout and "==" not in done.stdout, done.stdout
    assert (done.returncode, done.stderr, list(tmp_path.iterdir())) == (0, "", [])


@pytest.mark.parametrize("folder,heading", [("tools/", "people run"), ("tools/dev/", "`dev/`")])
def test_tools_readme_has_one_row_for_everything(folder, heading):
    text = (TOP / "tools/README.md").read_text(encoding="utf-8")
    table = text[text.index(f"| {heading} |") :].split("\n\n")[0]
    rows = re.findall(r"^\| \[?`([\w.]+)/?`", table, re.M)
    assert len(rows) == len(set(rows))
    assert set(rows) - {"dev"} == entries(folder) - {"dev"}


def test_every_folder_of_the_top_is_in_the_readme():
    top = {path.name for path in TOP.iterdir() if path.is_dir() and not path.name.startswith(".")} - {"build"}
    assert [name for name in top if f"{name}/" not in README] == []


def test_nothing_that_was_built_is_in_the_repository():
    done = subprocess.run(["git", "-C", TOP, "ls-files", "-z"], capture_output=True, check=False)
    tracked = [TOP / name.decode() for name in done.stdout.split(b"\0") if name]
    if done.returncode:
        pytest.skip("this tree has no git history")
    programs = [path for path in tracked if path.is_file() and path.read_bytes()[:4] in (b"\x7fELF", b"\0asm")]
    assert len(tracked) > 500
    assert [str(path) for path in tracked if {"build", "node_modules", "__pycache__"} & set(path.relative_to(TOP).parts[:-1])] == []
    assert [str(path) for path in programs] == []
