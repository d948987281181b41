# SPDX-License-Identifier: MIT
"""Imports point downwards, also those only for types: no folder imports a higher one, and no modules import each other, not even
indirectly. README.md names the folders."""

import ast
import pathlib

import m512

TOP = pathlib.Path(m512.__file__).parent
LAYERS = ("files", "motion", "pages", "board", "cli")  # the lowest first


def module_name(path):
    return ".".join(("m512", *path.relative_to(TOP).with_suffix("").parts)).removesuffix(".__init__")


def imported(path, names):
    """The modules in `names` that a file imports."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            wanted = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            wanted = [f"{node.module}.{alias.name}" for alias in node.names]
            wanted = [name if name in names else node.module for name in wanted]
        else:
            continue
        yield from (name for name in wanted if name in names)


def imports():
    files = {module_name(path): path for path in TOP.rglob("*.py")}
    return {name: set(imported(path, files)) - {name} for name, path in files.items()}


def layer(name):
    """The layer of a module: its folder's; above all folders for __main__; below all folders for the modules next to them."""
    part = name.split(".")[1] if name.count(".") else ""
    return len(LAYERS) if part == "__main__" else LAYERS.index(part) if part in LAYERS else -1


def test_no_folder_imports_a_higher_one():
    graph = imports()
    assert len(graph) > 50 and any(graph.values())
    assert not [f"{name} imports {other}" for name, others in graph.items() for other in others if layer(other) > layer(name)]


def test_no_modules_import_each_other():
    graph = imports()
    reach = {name: set(others) for name, others in graph.items()}
    for middle in graph:
        for name in graph:
            if middle in reach[name]:
                reach[name] |= reach[middle]
    assert not sorted(name for name in graph if name in reach[name])
