# SPDX-License-Identifier: MIT
"""Each kind of circle is found and named, in small trees with one circle or none."""

import importlib.machinery
import importlib.util
import pathlib

import pytest

TOOL = str(pathlib.Path(__file__).parents[3] / "tools" / "dev" / "check_circles")
LOADER = importlib.machinery.SourceFileLoader("check_circles", TOOL)
check_circles = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_circles", LOADER))
LOADER.exec_module(check_circles)

GOOD = {
    "firmware/edit/main.c": "int main(void)\n{\n    return screen_draw();\n}\n",
    "firmware/edit/screen.c": "int screen_draw(void)\n{\n    return cell_text(0) + text_put('x');\n}\n",
    "firmware/edit/cells.c": "static int draw(void)\n{\n    return 0;\n}\n\nint cell_text(int x)\n{\n    return x + draw();\n}\n",
    "firmware/common/text.c": "int text_put(char c)\n{\n    return c;\n}\n",
    "hal/bus.c": "int bus_check(void)\n{\n    return 0;\n}\n",
}


def check(tree, files):
    for name, text in files.items():
        path = tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return check_circles.look(tree)


def test_a_tree_without_circles_passes(tmp_path):
    assert check(tmp_path, GOOD) == ([], 5)


@pytest.mark.parametrize(
    "name,added,circle,closing",
    [
        (
            "firmware/edit/cells.c",
            "int cell_go(void)\n{\n    return screen_draw();\n}\n",
            "edit: circle of cells.c, screen.c",
            "cells.c uses screen_draw of screen.c",
        ),
        (
            "firmware/common/text.c",
            "int text_go(void)\n{\n    return screen_draw();\n}\n",
            "edit: circle of screen.c, text.c",
            "text.c uses screen_draw of screen.c",
        ),
        # through three files
        (
            "firmware/common/text.c",
            "int text_x(void)\n{\n    return main();\n}\n",
            "edit: circle of main.c, screen.c, text.c",
            "text.c uses main of main.c",
        ),
        # a variable also closes a circle, and so does a function whose head has an attribute or several lines
        ("firmware/edit/screen.c", "uint8_t the_rows[3];\nint cell_rows(void)\n{\n    return 0;\n}\n", None, None),
        (
            "firmware/edit/cells.c",
            "const screen_t *cell_of(int a,\n                        int b) NOINLINE\n{\n    return screen_draw;\n}\n",
            "edit: circle of cells.c, screen.c",
            "cells.c uses screen_draw of screen.c",
        ),
    ],
)
def test_a_circle_is_named_with_what_closes_it(tmp_path, name, added, circle, closing):
    files = dict(GOOD)
    files[name] += "\n" + added
    if circle is None:
        circle, closing = "edit: circle of cells.c, screen.c", "cells.c uses the_rows of screen.c"
        files["firmware/edit/cells.c"] += "\nint cell_row(int y)\n{\n    return the_rows[y];\n}\n"
    found, _ = check(tmp_path, files)
    assert circle in found and f"    {closing}" in found


def test_headers_that_include_each_other_are_a_circle(tmp_path):
    found, _ = check(tmp_path, {**GOOD, "hal/bus.h": '#include "dxl.h"\n', "hal/dxl.h": '#include "hal/bus.h"\n'})
    assert "hal: circle of bus.h, dxl.h" in found


@pytest.mark.parametrize(
    "harmless",
    [
        "/* as in screen_draw */\n",
        "// screen_draw\n",
        'static const char *name = "screen_draw";\n',
        "/* one\n * screen_draw */\n",
        "int my_screen_draw_too;\n",
    ],
)
def test_a_name_in_a_comment_or_text_is_no_use(tmp_path, harmless):
    files = dict(GOOD)
    files["firmware/edit/cells.c"] += harmless
    assert check(tmp_path, files)[0] == []


def test_the_parts_of_main_are_handed_down(tmp_path):
    files = dict(GOOD)
    files["firmware/edit/main.c"] = "uint8_t the_pages;\n\n" + files["firmware/edit/main.c"]
    files["firmware/edit/cells.c"] += "\nint cell_page(void)\n{\n    return the_pages;\n}\n"
    assert check(tmp_path, files)[0] == []


def test_empty_tree_is_no_success(tmp_path, monkeypatch):
    assert check(tmp_path, {}) == ([], 0)
    monkeypatch.setattr("sys.argv", ["check_circles", str(tmp_path)])
    assert check_circles.main() == 1
