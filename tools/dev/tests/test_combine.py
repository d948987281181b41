# SPDX-License-Identifier: MIT
"""tools/combine: one image of loader, application and motions; and what tools/dev/app_record refuses."""

import pathlib
import subprocess
import sys

import intelhex
import pytest

TOOLS = pathlib.Path(__file__).parents[3] / "tools"


def hex_file(path, address, data):
    contents = intelhex.IntelHex()
    contents.frombytes(data, address)
    contents.write_hex_file(str(path))
    return path


def combine(*arguments):
    return subprocess.run([sys.executable, TOOLS / "combine", *arguments], capture_output=True, text=True)


def test_the_parts_are_in_their_places(tmp_path):
    boot = hex_file(tmp_path / "boot.hex", 0x1E000, b"B" * 8192)
    app = hex_file(tmp_path / "app.hex", 0, b"A" * 1000)
    motions = tmp_path / "motions.bin"
    motions.write_bytes(b"M" * 65536)
    out = tmp_path / "all.hex"
    result = combine(out, boot, app, "--motions", motions)
    assert result.returncode == 0, result.stderr
    whole = intelhex.IntelHex(str(out))
    assert whole.tobinstr(0, 999) == b"A" * 1000 and 1000 not in whole.addresses()
    assert whole.tobinstr(0xE000, 0x1DFFF) == b"M" * 65536
    assert whole.tobinstr(0x1E000, 0x1FFFF) == b"B" * 8192
    assert len(whole) == 1000 + 65536 + 8192


@pytest.mark.parametrize("address, length", [(0, 100), (0x1DFFF, 100), (0x1FFFF, 2)])
def test_a_loader_outside_its_section_is_refused(tmp_path, address, length):
    boot = hex_file(tmp_path / "boot.hex", address, b"B" * length)
    assert combine(tmp_path / "out.hex", boot).returncode == 2


def test_an_application_too_long_is_refused(tmp_path):
    boot = hex_file(tmp_path / "boot.hex", 0x1E000, b"B" * 100)
    app = hex_file(tmp_path / "app.hex", 0, b"A" * (0xE000 + 1))
    assert combine(tmp_path / "out.hex", boot, app).returncode == 2


@pytest.mark.parametrize("length", [512, 65535, 65537])
def test_motions_of_another_size_are_refused(tmp_path, length):
    boot = hex_file(tmp_path / "boot.hex", 0x1E000, b"B" * 100)
    motions = tmp_path / "motions.bin"
    motions.write_bytes(b"M" * length)
    assert combine(tmp_path / "out.hex", boot, "--motions", motions).returncode == 2


@pytest.mark.parametrize(
    "arguments, missing",
    [(["app", "--board", "cm5", "--kind", "play", "--version", "1.2.3"], "no record at 0x8C"), (["boot"], "no table for applications at 0x1FFE0")],
)
def test_an_image_that_has_nothing_to_fill_in_is_refused(tmp_path, arguments, missing):
    (tmp_path / "t.c").write_text("int main(void) { for (;;) { } }")
    elf = tmp_path / "t.elf"
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", tmp_path / "t.c", "-o", elf], check=True)
    before = elf.read_bytes()
    done = subprocess.run([sys.executable, TOOLS / "dev" / "app_record", *arguments, elf], capture_output=True, text=True)
    assert done.returncode == 1 and missing in done.stderr and "Traceback" not in done.stderr
    assert elf.read_bytes() == before
