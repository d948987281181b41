# SPDX-License-Identifier: MIT
"""The command `try` refuses with a sentence what it cannot try, and plays nothing then."""

import os
import pathlib
import subprocess
import sys

import pytest

TRY = pathlib.Path(__file__).resolve().parents[1] / "try"


def refusal(*words, **environment):
    run = subprocess.run([sys.executable, str(TRY), *words], capture_output=True, text=True, check=False, env=dict(os.environ, **environment))
    assert run.returncode in (1, 2) and not run.stdout, run
    return run.stderr


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
def test_what_cannot_be_tried_is_refused(words, says):
    said = refusal("walk", *words)
    assert says in said and "Traceback" not in said


def test_without_a_build_only_the_missing_library_is_named(tmp_path):
    said = refusal("walk", M512_BUILD=str(tmp_path))
    assert said.startswith("try: ") and "libm512quick.so is missing" in said and said.count("\n") == 1
