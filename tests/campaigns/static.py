# SPDX-License-Identifier: MIT
"""Checks of the sources and of the shipped images that run nothing.

Every check is a command of its own (tools/dev/lint, check_layers, check_images, size_report) and a ctest with that name.
tools/dev/tests shows that each one fails when it must.
"""

import json
import shlex
import subprocess

from tests.campaigns import proof

TITLE = "Static checks"
PROMISE = "No image can recurse, allocate, overflow its memory, or write flash outside the loader."
TOOLS = proof.TOP / "tools" / "dev"
IMAGES = sorted((proof.BUILD / "firmware").glob("*-cm?.elf"))
FIRMWARE = ("motion", "hal", "firmware")


def add_arguments(group):
    """This part has no options."""
    del group


def checked(promise, how, *command):
    """Returns the figure of a command of tools/dev; `measured` is the end of what it prints."""
    done = subprocess.run([str(word) for word in (TOOLS / command[0], *command[1:])], cwd=proof.TOP, capture_output=True, text=True, check=False)
    return proof.Figure(
        promise, f"tools/dev/{command[0]}: {how}", "; ".join((done.stdout + done.stderr).strip().splitlines()[-3:]), not done.returncode
    )


def memory_figure():
    """Recursion, stack and budgets."""
    return checked(
        "No function calls itself, and variables, the deepest stack and an interrupt on top of it fit into the 4 KiB; every image fits into the "
        "part of the flash that linker/memory_map.h gives it",
        "the graph of calls of the disassembly, calls by pointer included; the frames and pushes that the compiler emitted, along the deepest "
        "path of calls; interrupts do not nest; 48 KiB for an application, 8 KiB for the loader",
        "size_report",
        *IMAGES,
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
    if options.sample:
        return [memory_figure()]
    tests = [path for path in sorted((proof.BUILD / "firmware" / "tests").glob("*.elf")) if path.stem not in ("factory", "mailbox")]
    return [
        memory_figure(),
        checked(
            "clang-tidy and cppcheck find nothing",
            "mistakes, not style: bugprone, clang's analyzer (null, memory, dead stores, unreachable states), performance, redundant or misleading "
            "code, functions above 60 lines (.clang-tidy); cppcheck for an 8-bit machine (warnings, performance, portability)",
            "lint",
            "--deep",
        ),
        checked(
            "No part knows what lies above it, and registers are named in hal/avr and the loader only",
            "every include of motion, hal, firmware and the fakes",
            "check_layers",
        ),
        checked(
            "No two files of an image use each other, directly or through others",
            "functions and variables of all files that are linked together",
            "check_circles",
        ),
        checked(
            "Only the boot loader can write flash, in one function; no image has dynamic memory, floating point, formats, jumps out of functions, or "
            "string functions without a bound",
            "every SPM instruction in the disassembly of every image, and the symbols of the linked images (malloc, __addsf3, printf, longjmp, ...)",
            "check_images",
            *IMAGES,
            *tests,
        ),
        array_figure(),
    ]
