# SPDX-License-Identifier: MIT
"""tools/dev/check_documents finds all references that a reader cannot follow, and no others."""

import pathlib
import subprocess

import pytest

TOOL = pathlib.Path(__file__).resolve().parents[1] / "check_documents"


def check(root, files):
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    subprocess.run(["git", "init", "-q", root], check=True)
    done = subprocess.run([TOOL, root], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


@pytest.mark.parametrize(
    "name, text",
    [
        ("motion/law.c", "/* The law (player.md section 1). */\n"),
        ("tools/run", "#!/bin/sh\n# player.md\n"),
        ("README.md", "See `player.md`.\n"),
        ("README.md", "See [the player](motion/player.md).\n"),
        ("hal/README.md", "See hal/LAWS.md.\n"),  # it is in another folder
    ],
)
def test_a_document_that_is_not_there_is_named_with_its_place(tmp_path, name, text):
    code, printed = check(tmp_path, {"motion/LAWS.md": "", name: text})
    line = 2 if text.startswith("#!") else 1
    assert code == 1 and printed.startswith(f"{name}:{line}: ")


def test_one_of_two_documents_is_meant_by_its_path_only(tmp_path):
    files = {"firmware/edit/ORIGINAL.md": "", "firmware/boot/ORIGINAL.md": "", "tests/test.c": "/* ORIGINAL.md */\n"}
    assert check(tmp_path, files)[0] == 1
    assert check(tmp_path, {"tests/test.c": "/* edit/ORIGINAL.md */\n"})[0] == 0


@pytest.mark.parametrize(
    "name, text",
    [
        ("motion/law.c", "/* LAWS.md section 1 */\n"),
        ("tests/unit/test_law.c", "/* LAWS.md */\n"),  # the only one of this name
        ("motion/deep/law.c", "/* LAWS.md */\n"),  # in a folder above
        ("hal/README.md", "[laws](../motion/LAWS.md)\n"),
        ("hal/README.md", "<https://example.org/player.md>\n"),
        ("hal/README.md", "every `*.md`, and tests/NAME.md\n"),
        ("tests/test_x.py", '"""player.md"""\n'),
    ],
)
def test_what_a_reader_can_follow_and_what_is_no_reference_passes(tmp_path, name, text):
    assert check(tmp_path, {"motion/LAWS.md": "", name: text})[0] == 0
