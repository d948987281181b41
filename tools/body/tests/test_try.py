# SPDX-License-Identifier: MIT
"""The command `try` refuses with a sentence what it cannot try, and plays nothing then."""

import os
import pathlib
import runpy
import subprocess
import sys

import pytest

TRY = pathlib.Path(__file__).resolve().parents[1] / "try"


@pytest.mark.parametrize(
    "words, says",
    [
        (["--models", "9-18:foo"], "no servo model is called 'foo'"),
        (["--models", "18-9:ax18"], "18-9:ax18: give ID-ID:MODEL"),
        (["--models", "40-50:ax18"], "this body has no servo 40"),
        (["--seconds", "nan"], "nan: give seconds above 0"),
        (["--seconds", "inf"], "inf: give seconds above 0"),
        (["--seconds=-3"], "-3: give seconds above 0"),
        (["--seconds", "0"], "0: give seconds above 0"),
        (["--keys", "5:U", "1:stop"], "--keys: their seconds must ascend"),
        (["--keys", "nan:U"], "nan:U: give SECOND:KEYS"),
    ],
)
def test_what_cannot_be_tried_is_refused(monkeypatch, capsys, words, says):
    monkeypatch.setattr(sys, "argv", ["try", "walk", *words])
    with pytest.raises(SystemExit) as refused:
        runpy.run_path(str(TRY), run_name="__main__")
    told = capsys.readouterr()
    assert refused.value.code == 2 or str(refused.value.code).startswith("try: ")
    assert says in f"{told.err}{refused.value.code}" and not told.out


def test_without_a_build_only_the_missing_library_is_named(tmp_path):
    environment = {**os.environ, "M512_BUILD": str(tmp_path)}
    run = subprocess.run([sys.executable, str(TRY), "walk"], capture_output=True, text=True, check=False, env=environment)
    assert run.returncode == 1 and not run.stdout
    said = run.stderr
    assert said.startswith("try: ") and "libm512quick.so is missing" in said and said.count("\n") == 1
