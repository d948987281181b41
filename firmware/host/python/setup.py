# SPDX-License-Identifier: MIT
"""Takes the programs from the build tree (environment M512_BUILD, else build/ at the top)."""
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
            subprocess.run(["strip", target], check=True)


class ForThisKindOfComputer(bdist_wheel):
    """Any Python 3, this operating system and processor."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithPrograms(Distribution):
    def has_ext_modules(self):
        return True


setup(version=re.search(r"project\(motion512 VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
      distclass=WithPrograms, cmdclass={"build_py": BuildWithPrograms, "bdist_wheel": ForThisKindOfComputer})
