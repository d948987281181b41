# SPDX-License-Identifier: MIT
"""Checks of the sources and of the shipped images that run nothing.

Every check is a command of its own (tools/dev/lint, check_layers, check_images, size_report) and a ctest with that name.
tools/dev/tests shows that each one fails when it must.
"""

import importlib.machinery
import importlib.util
import json
import re
import shlex
import subprocess
import sys

from tests.campaigns import proof

TITLE = "Static checks"
PROMISE = "No image can recurse, allocate, overflow its memory, or write flash outside the loader."
TOOLS = proof.TOP / "tools" / "dev"
IMAGES = sorted((proof.BUILD / "firmware").glob("*-cm?.elf"))
FIRMWARE = ("motion", "hal", "firmware")
ESCAPES = re.compile(r"NOLINT|cppcheck-suppress|#pragma GCC diagnostic")


def add_arguments(group):
    """This part has no options."""
    del group


def module_of(name, file):
    loader = importlib.machinery.SourceFileLoader(name, str(TOOLS / file))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


def tool(name):
    """Returns a command of tools/dev as a module."""
    sys.modules.setdefault("avr_elf", module_of("avr_elf", "avr_elf.py"))  # the command expects it in its own folder
    return module_of(name, name)


def command(*words):
    """Returns (passed, output)."""
    done = subprocess.run([str(word) for word in words], cwd=proof.TOP, capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def last_lines(text, count=3):
    """Returns the last lines of an output: they say what is wrong."""
    return "; ".join(text.strip().splitlines()[-count:])


def sources(*folders):
    """Returns the C files of these folders."""
    return [path for folder in folders for path in sorted((proof.TOP / folder).rglob("*.[ch]"))]


def lint_figure():
    """clang-tidy and cppcheck find nothing."""
    kept, text = command(TOOLS / "lint", "--deep")
    tidied = re.search(r"clang-tidy: (\d+) files", text)
    rules = command("clang-tidy", "--list-checks", f"--config-file={proof.TOP / '.clang-tidy'}")[1].count("\n    ")
    passed = len([path for path in sources(*FIRMWARE) if path.suffix == ".c"])
    escapes = sum(bool(ESCAPES.search(path.read_text(encoding="utf-8"))) for path in sources(*FIRMWARE, "tools/sim"))
    return proof.Figure(
        "clang-tidy and cppcheck find nothing",
        "tools/dev/lint --deep: mistakes, not style: bugprone, clang's analyzer (null, memory, "
        "dead stores, unreachable states), performance, redundant or misleading code, functions above 60 lines (.clang-tidy); "
        "cppcheck for an 8-bit machine (warnings, performance, portability)",
        f"{tidied[1] if tidied else 0} files against {rules} rules of clang-tidy, {passed} files of the images by cppcheck; "
        f"{escapes} files switch a rule off" + ("" if kept else f". Found: {last_lines(text)}"),
        kept and rules > 0,
    )


def layer_figure():
    """Includes point downwards only."""
    kept, text = command(TOOLS / "check_layers")
    return proof.Figure(
        "No part knows what lies above it, and registers are named in hal/avr and the loader only",
        "tools/dev/check_layers: every include of motion, hal, firmware and the fakes",
        last_lines(text),
        kept,
    )


def circle_figure():
    """No two files of an image depend on each other."""
    kept, text = command(TOOLS / "check_circles")
    return proof.Figure(
        "No two files of an image use each other, directly or through others",
        "tools/dev/check_circles: functions and variables of all files that are linked together",
        last_lines(text),
        kept,
    )


def spm_figure():
    """Only the loader can write flash."""
    tests = [path for path in sorted((proof.BUILD / "firmware" / "tests").glob("*.elf")) if path.stem not in ("factory", "mailbox")]
    kept, text = command(TOOLS / "check_images", *IMAGES, *tests)
    count = {name: int(number) for name, number in re.findall(r"(boot-\w+)\.elf: (\d+) SPM", text)}
    return proof.Figure(
        "Only the boot loader can write flash, in one function",
        "tools/dev/check_images: every SPM instruction in the disassembly of every image",
        f"{len(IMAGES) + len(tests)} images; "
        + ", ".join(f"{name}: {n}" for name, n in count.items())
        + " SPM, all in boot_write_page; none elsewhere"
        if kept
        else last_lines(text),
        kept,
    )


def symbol_figure():
    """No unbounded functions."""
    kept, text = command(TOOLS / "check_images", *IMAGES)
    total = sum(int(number) for number in re.findall(r"(\d+) symbols", text))
    return proof.Figure(
        "No image has dynamic memory, floating point, formats, jumps out of functions, or string functions without a bound",
        "tools/dev/check_images: the symbols of the linked images (malloc, __addsf3, printf, longjmp, strcpy, ...)",
        f"{len(IMAGES)} images, {total} symbols: none" if kept else last_lines(text),
        kept,
    )


def stack_figures():
    """Recursion, stack and budgets, from the compiler's output."""
    size = tool("size_report")
    reports = [size.report(elf) for elf in IMAGES]
    calls = sum(len(size.disassemble(elf, size.instructions(elf))) for elf in IMAGES)
    recursive = [f"{report.name}: {name}" for report in reports for name in report.recursive + report.not_understood]
    free = {report.name: size.RAM_BUDGET - report.ram - report.stack - report.interrupt for report in reports}
    flash = {report.name: report.flash_budget - report.flash for report in reports}
    over = [fault for report in reports for fault in report.broken if "flash" in fault]
    return [
        proof.Figure(
            "No function calls itself, directly or by others",
            "tools/dev/size_report: the graph of calls of the disassembly, calls by pointer included",
            f"{calls} functions" + (f"; {', '.join(recursive)}" if recursive else ": none"),
            not recursive,
        ),
        proof.Figure(
            "Variables, the deepest stack and an interrupt on top of it fit into the 4 KiB",
            "tools/dev/size_report: the frames and pushes that the compiler emitted, along the deepest path of calls; interrupts do not nest",
            "bytes free: " + ", ".join(f"{name} {n}" for name, n in free.items()),
            min(free.values()) > 0,
        ),
        proof.Figure(
            "Every image fits into the part of the flash that linker/memory_map.h gives it",
            "tools/dev/size_report, against budgets of 48 KiB for an application, 8 KiB for the loader",
            "bytes left of the budget: " + ", ".join(f"{name} {n}" for name, n in flash.items()),
            not over,
        ),
    ]


def compiler_figure():
    """No warning remains, and the important ones are enabled."""
    flags = (proof.TOP / "tools" / "dev" / "cmake" / "m512.cmake").read_text(encoding="utf-8")
    wanted = re.search(r"set\(M512_WARNINGS (.*?)\)", flags, re.S)[1].split()
    files = len(sources(*FIRMWARE, "tools/sim"))
    asked = [flag for flag in ("-Wall", "-Wextra", "-Werror", "-Wconversion", "-Wshadow") if flag not in wanted]
    return proof.Figure(
        "Every warning is an error, in both worlds",
        "the compilers' options (tools/dev/cmake/m512.cmake): avr-gcc for the images, gcc for the PC, which has the useful half of -Wconversion",
        f"{files} C files, {len(wanted) - 1} warnings" + (f"; not asked for: {' '.join(asked)}" if asked else ""),
        not asked,
    )


def array_figure():
    """No arrays of variable length: they would invalidate the stack figures."""
    listed = json.loads((proof.BUILD / "avr" / "compile_commands.json").read_text(encoding="utf-8"))
    # Sources with packed texts are compiled from below build/avr/firmware.
    folders = tuple(f"{folder}/" for folder in (*(proof.TOP / name for name in FIRMWARE), proof.BUILD / "avr" / "firmware"))
    of = {entry["file"]: entry for entry in listed if entry["file"].startswith(folders)}
    found = []
    for entry in of.values():
        words = shlex.split(entry["command"])
        words = words[: words.index("-o")] + ["-fsyntax-only", "-Werror=vla"] + words[words.index("-o") + 2 :]
        done = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True, check=False)
        found += [line for line in done.stderr.splitlines() if "error:" in line]
    return proof.Figure(
        "No array has a length that is only known while the program runs",
        "the compiler of the images, once more over every file, with -Werror=vla",
        f"{len(of)} files" + (f": {'; '.join(found[:3])}" if found else ": none"),
        not found and bool(of),
    )


def run(options):
    """Returns the figures. A sample leaves out those that are ctests of their own."""
    if not IMAGES:
        raise SystemExit("static: no images: build first (tools/dev/build)")
    figures = [compiler_figure(), *stack_figures()]
    if not options.sample:
        figures += [lint_figure(), layer_figure(), circle_figure(), spm_figure(), symbol_figure(), array_figure()]
    return figures
