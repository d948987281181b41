# SPDX-License-Identifier: MIT
"""tools/dev/check_spm sees an SPM where it may not be, and misses none where it must be."""
import pathlib
import shutil
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[2] / "tools" / "dev" / "check_spm"
pytestmark = pytest.mark.skipif(not shutil.which("avr-gcc"), reason="avr-gcc is not installed")

PLAIN = "int main(void) { for (;;) { } }"
WITH_SPM = 'int main(void) { for (;;) { __asm__ volatile("spm"); } }'


def check(tmp_path, name, source):
    (tmp_path / "t.c").write_text(source)
    elf = tmp_path / f"{name}.elf"
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-o", elf, tmp_path / "t.c"], check=True)
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
