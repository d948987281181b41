# SPDX-License-Identifier: MIT
"""Executes README.md: the motion in it, each command of "Without a robot", and the examples' command lines."""

import re
import shlex
import subprocess
import sys

import pytest
from conftest import REPO

from m512.cli import COMMANDS

README = (REPO / "tools" / "m512" / "README.md").read_text()


def section(title):
    return re.search(rf"^## {title}\n(.*?)(?=^## )", README, re.S | re.M).group(1)


def blocks(text):
    return re.findall(r"^```\n(.*?)^```", text, re.S | re.M)


def run_line(line, folder):
    words = shlex.split(line.replace("|| true", ""), comments=True)
    assert words[0] == "m512"
    return subprocess.run(
        [sys.executable, "-m", "m512"] + words[1:],
        cwd=folder,
        capture_output=True,
        text=True,
        env={"PATH": "", "HOME": str(folder), "M512_BUILD": str(REPO / "build")},
    )


def test_readme_without_a_robot(tmp_path):
    text, commands, simulated = blocks(section("Without a robot"))
    (tmp_path / "wave.m512").write_text(text)
    for line in commands.splitlines():
        result = run_line(line, tmp_path)
        assert result.returncode == 0 or "|| true" in line, (line, result.stderr)
        assert "Traceback" not in result.stderr
    for line in simulated.splitlines():
        result = run_line(line, tmp_path)
        assert result.returncode in (0, 3) and "Traceback" not in result.stderr, (line, result.stderr)


@pytest.mark.parametrize("name", COMMANDS)
def test_help_of_every_command_has_an_example(m512, name):
    result = m512(name, "--help")
    assert result.exit_code == 0 and "Example" in result.stdout and f"m512 {name}" in result.stdout


def test_help_lists_every_command():
    result = subprocess.run([sys.executable, "-m", "m512", "--help"], env={"PATH": ""}, capture_output=True, text=True)
    assert result.returncode == 0 and all(name in result.stdout for name in COMMANDS)


def test_table_of_commands_is_complete():
    table = section("Commands")
    assert all(f"`{name}`" in table for name in COMMANDS)


def test_help_does_not_import_what_it_does_not_need():
    code = "import sys; from m512.cli import main; main(['--help'], standalone_mode=False); print(sorted(sys.modules))"
    out = subprocess.run([sys.executable, "-c", code], env={"PATH": ""}, capture_output=True, text=True).stdout
    assert not re.search(r"'(serial|matplotlib|intelhex|numpy)'", out)


def test_help_has_the_exit_codes_of_the_readme(m512):
    table = README.partition("| code | meaning |")[2].partition("\n\n")[0]
    codes = re.findall(r"^\| (\d+) \|", table, re.M)
    told = " ".join(m512("--help").stdout.partition("Exit codes: ")[2].split())
    assert len(codes) >= 11 and [code for code in codes if not re.search(rf"(^|, ){code} [a-zA-Z]", told)] == []
