# SPDX-License-Identifier: MIT
"""Builds the wheel with the programs from the build tree (environment M512_BUILD, else build/ at the top). Programs for another computer
need a matching STRIP."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build")) / "host" / "firmware"


class BuildWithPrograms(build_py):
    def run(self):
        super().run()
        shutil.copyfile(TOP / "LICENSE", pathlib.Path(self.build_lib) / "motion512" / "LICENSE")
        for image in ("play", "edit"):
            source = BUILD / image / f"motion512-{image}"
            if not source.exists():
                raise SystemExit(f"motion512: {source} is not built (pyproject.toml says how)")
            target = pathlib.Path(self.build_lib) / "motion512" / source.name
            shutil.copyfile(source, target)
            target.chmod(0o755)
            subprocess.run([os.environ.get("STRIP", "strip"), target], check=True)


class ForTheProgramsComputer(bdist_wheel):
    """The wheel's tag: any Python 3, with the processor and the C library that the programs need."""

    def get_tag(self):
        programs = [(BUILD / image / f"motion512-{image}").read_bytes() for image in ("play", "edit")]
        machine = {62: "x86_64", 183: "aarch64"}.get(int.from_bytes(programs[0][18:20], "little"))  # e_machine of ELF
        minors = [int(minor) for program in programs for minor in re.findall(rb"GLIBC_2\.(\d+)", program)]
        known = machine and minors
        return ("py3", "none", f"manylinux_2_{max(minors)}_{machine}" if known else super().get_tag()[2])


class WithPrograms(Distribution):
    def has_ext_modules(self):
        return True


setup(version=re.search(r"project\(motion512 VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
      distclass=WithPrograms, cmdclass={"build_py": BuildWithPrograms, "bdist_wheel": ForTheProgramsComputer})
