# SPDX-License-Identifier: MIT
"""tools/dev/check_images finds each thing that no image may contain, and nothing in a program without them."""

import pathlib
import re
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[3] / "tools" / "dev" / "check_images"

# v: unknown to the compiler, so that it computes nothing in advance.
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


def check_program(tmp_path, name, text, *options):
    source, elf = tmp_path / "t.c", tmp_path / f"{name}.elf"
    source.write_text(text)
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-w", *options, source, "-o", elf, "-lm"], check=True)
    return subprocess.run([TOOL, elf], capture_output=True, text=True)


def check(tmp_path, statement, *options):
    return check_program(tmp_path, "play-cm5", PROGRAM.replace("STATEMENT", statement), "-flto", *options)


def test_what_is_bounded_and_whole_passes(tmp_path):
    done = check(
        tmp_path,
        "memcpy(buffer, (const void *)v, 10); memmove(buffer + v, buffer, strlen(buffer)); v = strcmp(buffer, buffer + v); "
        "v = (int)(0.75 * 1024); v = (long)v * 3 / v",
    )
    assert done.returncode == 0 and "symbols\n" in done.stdout, done.stdout


def test_what_is_not_allowed_is_named(tmp_path):
    done = check(
        tmp_path,
        "*(char *volatile *)buffer = malloc(v); free((void *)v); v = *(char *)calloc(v, 2); v = v * 1.5; v = (float)v / 3 > 2; "
        'v = (long)((double)v / v); printf("%d", v); snprintf(buffer, 9, "%d", v); sscanf(buffer, "%d", &v); v = atoi(buffer); '
        "strcpy(buffer, (const char *)v); strcpy_P(buffer, (const char *)v); strcat(buffer, (const char *)v); "
        "jmp_buf j; if (setjmp(j)) longjmp(j, 1)",
    )
    assert done.returncode == 1 and "NOT ALLOWED: " in done.stdout, done.stdout
    for what, names in {
        "dynamic memory": "malloc free calloc",
        "floating point": "__mulsf3 __divsf3 __gtsf2 __fixsfsi",
        "formats": "printf snprintf sscanf atoi",
        "unbounded strings": "strcpy strcpy_P strcat",
        "long jumps": "setjmp longjmp",
    }.items():
        [said] = re.findall(rf"{what}: ([^;\n]*)", done.stdout)
        assert set(names.split()) <= set(said.split()), what


@pytest.mark.parametrize("statement", ["free((void *)v)", '__asm__ volatile("spm")'])
def test_an_image_without_symbols_is_refused(tmp_path, statement):
    done = check(tmp_path, statement, "-s")
    assert done.returncode == 1 and "no main among its symbols" in done.stdout


def test_a_program_for_tests_may_have_all_but_spm(tmp_path):
    assert check_program(tmp_path, "probe", PROGRAM.replace("STATEMENT", "free((void *)v)")).returncode == 0
    assert check_program(tmp_path, "probe", PROGRAM.replace("STATEMENT", '__asm__ volatile("spm")')).returncode == 1


def test_what_is_no_elf_file_is_refused(tmp_path):
    (tmp_path / "play-cm5.elf").write_text("nothing")
    done = subprocess.run([TOOL, tmp_path / "play-cm5.elf"], capture_output=True, text=True)
    assert done.returncode == 1 and "play-cm5.elf" in done.stdout and not done.stderr


# With -g, a newer assembler leaves a label before each line. It is still one function.
LOADER = """
void __attribute__((noinline, used)) NAME(volatile char *p)
{
    for (char i = 0; i < 9; i++) {
        *p = i;
        __asm__ volatile("spm");
        if (*p) {
            __asm__ volatile("spm");
        }
    }
}
int main(void) { for (;;) { NAME((char *)0x200); } }
"""


@pytest.mark.parametrize(
    "image, function, start, fault",
    [
        ("boot-cm5", "boot_write_page", 0x1E000, None),
        ("boot-cm5", "other", 0x1E000, "SPM elsewhere"),
        ("boot-cm5", "boot_write_page", 0, "SPM elsewhere"),
        ("play-cm5", "boot_write_page", 0, "SPM"),
    ],
)
def test_only_a_loader_has_spm_and_in_one_function_only(tmp_path, image, function, start, fault):
    done = check_program(tmp_path, image, LOADER.replace("NAME", function), "-g", f"-Wl,-Ttext={start:#x}")
    assert f"2 SPM in {function}" in done.stdout, done.stdout
    assert (done.returncode, fault and f"NOT ALLOWED: {fault}" in done.stdout) == (bool(fault), fault and True), done.stdout


def test_a_loader_without_spm_is_caught(tmp_path):
    done = check_program(tmp_path, "boot-cm5", "int main(void) { for (;;) { } }")
    assert done.returncode == 1 and "NOT ALLOWED: no SPM" in done.stdout
