# SPDX-License-Identifier: MIT
"""tools/dev/check_spm sees an SPM where it may not be, and misses none where it must be."""

import pathlib
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[3] / "tools" / "dev" / "check_spm"

PLAIN = "int main(void) { for (;;) { } }"
WITH_SPM = 'int main(void) { for (;;) { __asm__ volatile("spm"); } }'


def check(tmp_path, name, source, *options):
    (tmp_path / "t.c").write_text(source)
    elf = tmp_path / f"{name}.elf"
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-g", *options, "-o", elf, tmp_path / "t.c"], check=True)
    return subprocess.run([TOOL, elf], capture_output=True, text=True)


def test_an_application_without_spm_passes(tmp_path):
    result = check(tmp_path, "play-x", PLAIN)
    assert result.returncode == 0 and "0 SPM" in result.stdout


def test_an_application_with_spm_is_caught(tmp_path):
    result = check(tmp_path, "play-x", WITH_SPM)
    assert result.returncode == 1 and "1 SPM in main - NOT ALLOWED" in result.stdout


def test_a_loader_with_spm_outside_the_boot_section_is_caught(tmp_path):
    assert check(tmp_path, "boot-x", WITH_SPM).returncode == 1


def test_a_loader_without_spm_is_caught(tmp_path):
    result = check(tmp_path, "boot-x", PLAIN)
    assert result.returncode == 1 and "NONE FOUND" in result.stdout


# With -g a newer assembler leaves a label before each line: still one function.
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


@pytest.mark.parametrize("name, is_right", [("boot_write_page", True), ("other", False)])
def test_a_loader_may_have_spm_in_one_function_only(tmp_path, name, is_right):
    result = check(tmp_path, "boot-x", LOADER.replace("NAME", name), "-Wl,-Ttext=0x1E000")
    assert result.returncode == (not is_right) and f"2 SPM in {name}" in result.stdout, result.stdout


@pytest.mark.parametrize("source", [PLAIN, WITH_SPM])
def test_an_image_without_symbols_is_refused(tmp_path, source):
    result = check(tmp_path, "play-x", source, "-s")
    assert result.returncode == 1 and "no main among its symbols" in result.stdout


def test_what_is_no_elf_file_is_refused(tmp_path):
    (tmp_path / "play-x.elf").write_text("nothing")
    result = subprocess.run([TOOL, tmp_path / "play-x.elf"], capture_output=True, text=True)
    assert result.returncode == 1 and "play-x.elf" in result.stdout and not result.stderr
