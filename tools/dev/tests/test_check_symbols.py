# SPDX-License-Identifier: MIT
"""tools/dev/check_symbols finds each thing that no image may hold, and nothing in a program without them."""

import pathlib
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[3] / "tools" / "dev" / "check_symbols"

# v: what the compiler cannot know, so that nothing is computed ahead.
PROGRAM = """
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <avr/pgmspace.h>
volatile int v;
volatile char sink;
char buffer[64];
int main(void) { STATEMENT; for (;;) { sink = buffer[v]; } }
"""


def check(tmp_path, statement, *options):
    source, elf = tmp_path / "t.c", tmp_path / "play-x.elf"
    source.write_text(PROGRAM.replace("STATEMENT", statement))
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-w", "-flto", *options, source, "-o", elf, "-lm"], check=True)
    return subprocess.run([TOOL, elf], capture_output=True, text=True)


@pytest.mark.parametrize(
    "statement",
    [
        "memcpy(buffer, (const void *)v, 10)",
        "memmove(buffer + v, buffer, strlen(buffer))",
        "v = strcmp(buffer, buffer + v)",
        "v = (int)(0.75 * 1024)",
        "v = (long)v * 3 / v",
    ],
)
def test_what_is_bounded_and_whole_passes(tmp_path, statement):
    done = check(tmp_path, statement)
    assert done.returncode == 0, done.stdout
    assert "symbols\n" in done.stdout


@pytest.mark.parametrize(
    "what, statement",
    [
        ("dynamic memory: ", "*(char *volatile *)buffer = malloc(v)"),
        ("dynamic memory: ", "free((void *)v)"),
        ("dynamic memory: ", "v = *(char *)calloc(v, 2)"),
        ("floating point: ", "v = v * 1.5"),
        ("floating point: ", "v = (float)v / 3 > 2"),
        ("floating point: ", "v = (long)((double)v / v)"),
        ("formats: ", 'printf("%d", v)'),
        ("formats: ", 'snprintf(buffer, 9, "%d", v)'),
        ("formats: ", 'sscanf(buffer, "%d", &v)'),
        ("formats: ", "v = atoi(buffer)"),
        ("unbounded strings: ", "strcpy(buffer, (const char *)v)"),
        ("unbounded strings: ", "strcpy_P(buffer, (const char *)v)"),
        ("unbounded strings: ", "strcat(buffer, (const char *)v)"),
        ("long jumps: ", "jmp_buf j; if (setjmp(j)) longjmp(j, 1)"),
    ],
)
def test_what_is_not_allowed_is_named(tmp_path, what, statement):
    done = check(tmp_path, statement)
    assert done.returncode == 1, done.stdout
    assert "NOT ALLOWED: " in done.stdout and what in done.stdout


def test_an_image_without_symbols_is_refused(tmp_path):
    done = check(tmp_path, "free((void *)v)", "-s")
    assert done.returncode == 1 and "no main among its symbols" in done.stdout
