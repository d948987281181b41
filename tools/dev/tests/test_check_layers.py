# SPDX-License-Identifier: MIT
"""Each rule of the layers is enforced: one small tree per rule, with one wrong line."""

import pathlib
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[3] / "tools" / "dev" / "check_layers"


def check(tree, files):
    for name, text in files.items():
        path = tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return subprocess.run([TOOL, tree], capture_output=True, text=True)


GOOD = {
    "motion/page.h": "#include <stdint.h>\n",
    "motion/page.c": '#include "page.h"\n#include "compiler.h"\n',
    "hal/flash.h": "#include <stdint.h>\n",
    "hal/compiler.h": "",
    "hal/avr/flash.c": '#include <avr/io.h>\n#include "flash.h"\n',
    "firmware/common/store.c": '#include "flash.h"\n#include "page.h"\n',
    "tools/sim/board/board.h": "",
    "tools/sim/board/machine/cpu.h": '#include <stdio.h>\n#include "board.h"\n',
    "tools/sim/board/parts/uart.h": '#include "cpu.h"\n',
    "tools/sim/board/api/board.c": '#include "uart.h"\n#include "cpu.h"\n',
}


def test_good_tree_passes(tmp_path):
    done = check(tmp_path, GOOD)
    assert done.returncode == 0, done.stdout
    assert "10 files" in done.stdout


@pytest.mark.parametrize(
    "name,line,reason",
    [
        ("motion/page.c", '#include "flash.h"', "motion may not include flash.h"),
        ("motion/page.c", "#include <avr/io.h>", "belongs in"),
        ("motion/page.c", "#include <stdio.h>", "not among the headers"),
        ("hal/flash.c", '#include "page.h"', "hal may not include page.h"),
        ("hal/flash.c", '#include "store.h"', "(of nowhere)"),
        ("firmware/common/store.c", "#include <util/delay.h>", "belongs in"),
        ("firmware/common/store.c", "#ifdef __AVR__", "which machine"),
        ("tools/sim/board/machine/cpu.c", '#include "uart.h"', "tools/sim/board/machine may not include uart.h"),
        ("tools/sim/board/board.h", '#include "cpu.h"', "tools/sim/board may not include cpu.h"),
        ("firmware/play/main.c", '#include "fake_flash.h"', "firmware/play may not include fake_flash.h"),
    ],
)
def test_broken_rule_is_named_with_file_and_line(tmp_path, name, line, reason):
    files = dict(GOOD)
    files["tests/fake/fake_flash.h"] = ""
    files[name] = "\n" + line + "\n"
    done = check(tmp_path, files)
    assert done.returncode == 1
    assert f"{name}:2: " in done.stdout and reason in done.stdout


def test_empty_tree_is_no_success(tmp_path):
    assert check(tmp_path, {}).returncode == 1
