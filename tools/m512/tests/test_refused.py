# SPDX-License-Identifier: MIT
"""Command lines that mean nothing, or of which a word would be ignored, are refused with a sentence before anything is asked, started or
written."""

import shlex

import pytest

from m512.files.text import read_text

# exit code | what the sentence says, in parts | the words of the command line
REFUSED = """
2 | joint 1 has a position already | pose 1:512 1:600 -p peer://nobody
2 | joint 2 has a position already | pose 1..3:512 2:600 -p peer://nobody
2 | 2: say ID:POSITION, such as 2:600 | pose 2 600 -p peer://nobody
2 | 2: say ID:POSITION, such as 2:600 | aim 2 600 -p peer://nobody
2 | code moves 4 at once | aim 1..5:512 -p peer://nobody
2 | infdeg | swing 3 512 -p peer://nobody -- infdeg 2s
2 | nandeg | swing 3 512 -p peer://nobody -- nandeg 2s
2 | 1e9deg | swing 3 512 -p peer://nobody -- 1e9deg 2s
2 | 1.5 | swing 3 512 -p peer://nobody -- 1.5 2s
2 | -5 | swing 3 512 -p peer://nobody -- -5 2s
2 | 1_0 | swing 3 512 -p peer://nobody -- 1_0 2s
2 | infs | swing 3 512 -p peer://nobody -- 30deg infs
2 | nans | swing 3 512 -p peer://nobody -- 30deg nans
2 | 1e400s | swing 3 512 -p peer://nobody -- 30deg 1e400s
2 | s | swing 3 512 -p peer://nobody -- 30deg s
2 | --volts | pages x.bin time 3 --volts nan
2 | say one of the two | play wave --sim -p peer://nobody
2 | say one of the two | doctor --sim -p peer://nobody
2 | say one of the two | term --sim -p peer://nobody
2 | say one of the two | pages x.bin rename 3 new -o y.bin --in-place
2 | --motions is for --sim | term --motions x.bin -p peer://nobody
2 | --servos is for --sim | pose -p /dev/no_port --servos 1-3
2 | --image is for --sim | pose -p /dev/no_port --image play-cm2.hex
2 | --motions is for --sim | pose -p /dev/no_port --motions x.bin
2 | --image is for --sim or -p bus: | term -p /dev/no_port --image play
2 | --sim | put x.bin all --sim
2 | --json wants a file | convert x.bin --json
2 | --dry-run is for a file that is flashed | run --dry-run -p /dev/no_port
2 | --with-trim is for a file that is flashed | run --with-trim -p /dev/no_port
2 | --fast is for a file that is flashed | run --fast -p /dev/no_port
2 | --address is for a file that is flashed | run --address 0 -p /dev/no_port
2 | --damaged is for a file that is flashed | run --damaged keep -p /dev/no_port
2 | --address & 'E000' | flash x.bin --address E000 -p /dev/no_port
2 | --wait | backup new -p peer://nobody --wait -5
2 | --wait | backup new -p peer://nobody --wait nan
2 | --wait | backup new -p peer://nobody --wait inf
2 | --wait | backup new -p peer://nobody --wait 1e9
2 | 0..30 & 1-99 | play 1 --sim --servos 1-99
2 | 0..30 & none | play 1 --sim --servos ''
2 | 0..30 & 40:dx117 | play 1 --sim --servos 5,40:dx117
2 | 0..30 & 1-x | play 1 --sim --servos 1-x
2 | 0..30 & 9-3 | play 1 --sim --servos 9-3
4 | the suffix decides the format | get 1 -o x.foo -p /dev/no_port
4 | no page is called | pages x.bin show \u00b3
4 | cannot read & nothing | term -p /dev/no_port --send nothing
4 | not empty | backup full -p peer://nobody
4 | cannot make | backup x.bin/b -p peer://nobody
4 | is a folder; | convert full y.bin
4 | is a folder; | diff x.bin full/sub
4 | is a folder; | put full 3 -p /dev/no_port
4 | is a folder; name a file in it | convert x.bin full
4 | is a folder; name a file in it | convert x.bin full --force
4 | is a folder; name a file in it | pages x.bin delete 3 -o full
4 | is a folder; name a file in it | pages x.bin delete 3 -o full --force
6 | no such port | flash x.bin -p /dev/ttyNothing
6 | say socket://HOST:PORT | pose -p socket://127.0.0.1
6 | say socket://HOST:PORT | pose -p socket://127.0.0.1:99999
6 | say socket://HOST:PORT | pose -p socket://:4000
6 | say socket://HOST:PORT | pose -p socket://127.0.0.1:0
9 | no program for an adapter is called 'nonsense': --image play or edit | term -p bus:/dev/no_port --image nonsense
9 | no program for an adapter is called 'boot-cm5.hex': --image play or edit | term -p bus:/dev/no_port --image boot-cm5.hex
9 | no program for an adapter is called '': --image play or edit | term -p bus:/dev/no_port --image ''
"""
ROWS = [[part.strip() for part in row.split(" | ")] for row in REFUSED.strip().splitlines()]


@pytest.mark.parametrize("code, says, line", ROWS, ids=[line for _, _, line in ROWS])
def test_words_that_mean_nothing_are_refused(m512, tmp_path, monkeypatch, code, says, line):
    (tmp_path / "x.bin").write_bytes(read_text("motion512 1\npage 3 walk\n  step 50 | 1..18:400\n").to_bytes())
    (tmp_path / "full" / "sub" / "manifest.json").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("M512_CM5SIM", "/nowhere")
    before = sorted(tmp_path.rglob("*"))
    result = m512(*shlex.split(line), input="")
    assert result.exit_code == int(code), result.stderr
    assert all(part in result.stderr for part in says.split(" & ")), result.stderr
    assert sorted(tmp_path.rglob("*")) == before
