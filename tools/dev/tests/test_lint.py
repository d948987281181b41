# SPDX-License-Identifier: MIT
"""Which files `tools/dev/lint` passes to clang-tidy: a small git tree in which each checker only records its arguments."""

import json
import os
import pathlib
import shutil
import subprocess

import pytest

LINT = pathlib.Path(__file__).parents[1] / "lint"
ALL = ["hal/a.c", "motion/b.c", "motion/c.c"]


def git(tree, *words):
    identity = ["-c", "user.name=Test", "-c", "user.email=test@example.org"]
    return subprocess.run(["git", *identity, *words], cwd=tree, check=True, capture_output=True, text=True).stdout.strip()


def write(tree, name, text):
    (tree / name).parent.mkdir(parents=True, exist_ok=True)
    (tree / name).write_text(text)


@pytest.fixture
def tree(tmp_path):
    for name in [*ALL, "motion/b.h", ".clang-tidy", "firmware/readme", "linker/readme", "tests/readme"]:
        write(tmp_path, name, '#include "b.h"\n' if name == "motion/b.c" else "int x;\n")
    write(tmp_path, ".gitignore", "build\ntools\n")
    for name in ("build/bin/clang-tidy", "build/bin/cppcheck", "build/venv/bin/ruff", "build/venv/bin/mypy", "tools/visual/test"):
        write(tmp_path, name, f'#!/bin/sh\necho "$@" >> {tmp_path}/build/{pathlib.Path(name).name}.given\n')
        (tmp_path / name).chmod(0o755)
    (tmp_path / "tools/dev").mkdir()
    shutil.copy(LINT, tmp_path / "tools/dev/lint")
    write(tmp_path, "tools/program", "#!/usr/bin/python3\n")  # lint passes it to ruff by name
    commands = [{"file": str(tmp_path / name), "command": f"cc -c {name}", "directory": str(tmp_path)} for name in ALL]
    write(tmp_path, "build/host/compile_commands.json", json.dumps(commands, indent=2))
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-q", "-m", "base")
    return tmp_path


def lint(tree, *words):
    """Returns the finished process, and the files passed to clang-tidy."""
    given = tree / "build/clang-tidy.given"
    given.unlink(missing_ok=True)
    environment = {**os.environ, "PATH": f"{tree}/build/bin:{os.environ['PATH']}"}
    run = subprocess.run([tree / "tools/dev/lint", "--jobs", "1", *words], capture_output=True, text=True, env=environment)
    return run, [word for word in given.read_text().split() if word.endswith(".c")] if given.exists() else []


def test_everything_unless_asked_otherwise(tree):
    run, files = lint(tree)
    assert (run.returncode, files) == (0, ALL), run.stderr
    for checker in ("cppcheck", "ruff", "mypy", "test"):
        assert (tree / f"build/{checker}.given").exists()


def test_only_what_differs_also_what_git_does_not_know_yet(tree):
    assert lint(tree, "--changed", "HEAD")[1] == []
    git(tree, "rm", "-q", "--cached", "hal/a.c")
    git(tree, "commit", "-q", "-m", "a.c is nobody's")
    write(tree, "motion/c.c", "int y;\n")
    run, files = lint(tree, "--changed", "HEAD")
    assert (run.returncode, files) == (0, ["hal/a.c", "motion/c.c"]), run.stderr
    assert "2 files of 3" in run.stdout


def test_what_includes_a_header_that_differs(tree):
    write(tree, "motion/b.h", "int z;\n")
    assert lint(tree, "--changed", "HEAD")[1] == ["motion/b.c"]


def test_everything_when_the_rules_differ(tree):
    write(tree, ".clang-tidy", "int z;\n")
    assert lint(tree, "--changed", "HEAD")[1] == ALL


def test_the_base_is_where_the_branch_left_main(tree):
    git(tree, "branch", "-M", "main")
    assert lint(tree, "--changed")[1] == ALL  # ten commits ago there was nothing
    git(tree, "checkout", "-q", "-b", "own")
    write(tree, "motion/c.c", "int y;\n")
    git(tree, "commit", "-q", "-a", "-m", "mine")
    assert lint(tree, "--changed")[1] == ["motion/c.c"]


def test_nothing_to_check_by_mistake_is_a_failure(tree):
    run, files = lint(tree, "--changed", "nosuch")
    assert (run.returncode, files) == (2, []) and "nosuch" in run.stderr
    write(tree, "build/host/compile_commands.json", "[]")
    run, files = lint(tree, "--changed", "HEAD")
    assert (run.returncode, files) == (1, []) and "knows no file" in run.stderr
