# SPDX-License-Identifier: MIT
"""Every line of use that a tool's --help shows is one that the tool takes. (Those of m512 and of cm5sim are run: m512.examples, sim.readme.)"""

import pathlib
import re
import shlex
import subprocess

import pytest

TOP = pathlib.Path(__file__).resolve().parents[3]
# Runs a program up to the moment at which its words are understood.
PARSES = """
import argparse, runpy, sys
parse = argparse.ArgumentParser.parse_args
def only_parse(self, *words):
    parse(self, *words)
    print("understood")
    sys.exit()
argparse.ArgumentParser.parse_args = only_parse
sys.argv = sys.argv[1:]
sys.path.insert(0, sys.argv[0].rpartition("/")[0])
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def programs():
    """Programs in Python that people call by their path."""
    listed = subprocess.run(["git", "ls-files", "-s", "tools"], cwd=TOP, capture_output=True, text=True, check=True).stdout.splitlines()
    paths = [line.split("\t")[1] for line in listed if line.startswith("100755")]
    return [path for path in paths if re.search(r'^"""', (TOP / path).read_text(encoding="utf-8"), re.M)]


def uses():
    """(program, words) of the indented lines of its docstring; what is in brackets may be there, so it is."""
    for path in programs():
        text = re.search(r'^"""(.*?)"""', (TOP / path).read_text(encoding="utf-8"), re.M | re.S)[1]
        for words in re.findall(rf"^    {re.escape(path)}(| \S.*?)(?: {{3,}}.*)?$", text, re.M):
            if not re.search(r"\b[A-Z]{3,}\b|--help", words):  # FILE stands for any
                yield path, shlex.split(words.translate(str.maketrans("", "", "[]")))


USES = list(uses())


def test_there_are_some():
    assert {"tools/bench", "tools/prove"} <= {path for path, _ in USES}


@pytest.mark.parametrize("path, words", USES, ids=lambda value: value if isinstance(value, str) else " ".join(value) or "-")
def test_the_program_takes_it(path, words):
    done = subprocess.run([TOP / "tools/dev/python", "-c", PARSES, TOP / path, *words], cwd=TOP, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "understood\n"), done.stderr


def test_cleanroom_names_the_trials_that_there_are():
    head = (TOP / "tools/dev/cleanroom").read_text(encoding="utf-8").split("\nset -eu")[0]
    assert set(re.findall(r"^#     ([a-z]+) ", head, re.M)) == {trial.name for trial in (TOP / "tools/dev/cleanroom.d").iterdir()}
