# SPDX-License-Identifier: MIT
"""The checks of the tree see a fault, in small trees with one: check_layers, check_circles, check_documents."""

import pathlib
import subprocess

import pytest

DEV = pathlib.Path(__file__).resolve().parents[1]
GOOD = {
    "motion/page.h": "#include <stdint.h>\n",
    "motion/page.c": '#include "page.h"\n/* LAWS.md section 1 */\nint page_sum(int x)\n{\n    return x;\n}\n',
    "motion/LAWS.md": "",
    "hal/flash.h": "#include <stdint.h>\n",
    "hal/avr/flash.c": '#include <avr/io.h>\n#include "flash.h"\n',
    "firmware/common/store.c": '#include "flash.h"\n#include "page.h"\nint store_look(int x)\n{\n    return page_sum(x);\n}\n',
    "firmware/edit/main.c": "int main(void)\n{\n    return screen_draw();\n}\n",
    "firmware/edit/screen.c": '/* cell_go */\nint screen_draw(void)\n{\n    return cell_text(0) + store_look("cell_go"[0]);\n}\n',
    "firmware/edit/cells.c": "static int draw(void)\n{\n    return 0;\n}\n\nint cell_text(int x)\n{\n    return x + draw();\n}\n",
}


def check(tree, which, files):
    for name, text in files.items():
        path = tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    subprocess.run(["git", "init", "-q", tree], check=True)
    done = subprocess.run([DEV / which, tree], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


@pytest.mark.parametrize("which", ["check_layers", "check_circles", "check_documents"])
def test_a_good_tree_passes_and_an_empty_one_does_not(tmp_path, which):
    assert check(tmp_path, which, GOOD)[0] == 0
    assert which == "check_documents" or check(tmp_path / "empty", which, {})[0] == 1


@pytest.mark.parametrize(
    "which, name, added, said",
    [
        ("check_layers", "motion/page.c", '#include "flash.h"', "motion may not include flash.h"),
        ("check_layers", "motion/page.c", "#include <stdio.h>", "not among the headers"),
        ("check_layers", "firmware/common/store.c", "#include <util/delay.h>", "belongs in"),
        ("check_layers", "firmware/common/store.c", "#ifdef __AVR__", "which machine"),
        ("check_circles", "firmware/edit/cells.c", "int cell_go(void)\n{\n    return screen_draw();\n}", "circle of cells.c, screen.c"),
        ("check_circles", "firmware/common/store.c", "int store_x(void)\n{\n    return main();\n}", "circle of main.c, screen.c, store.c"),
        ("check_circles", "hal/flash.h", '#include "bus.h"', "circle of bus.h, flash.h"),
        ("check_documents", "motion/page.c", "/* player.md */", "motion/page.c:"),
        ("check_documents", "README.md", "See [the player](motion/player.md).", "README.md:"),
    ],
)
def test_a_fault_is_named(tmp_path, which, name, added, said):
    files = {**GOOD, "hal/bus.h": '#include "flash.h"\n'}
    code, printed = check(tmp_path, which, {**files, name: files.get(name, "") + added + "\n"})
    assert code == 1 and said in printed, printed
