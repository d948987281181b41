# SPDX-License-Identifier: MIT
"""Takes the compiled parts of the wheel from the build tree (environment M512_BUILD, else ../../../build)."""
import os
import pathlib
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[2]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
SIM = "host/tools/sim"
PROGRAMS = (f"{SIM}/cm5sim", f"{SIM}/libcm5sim.so", f"{SIM}/libcm5sim_body.so")
DATA = [f"firmware/{kind}-{board}.hex" for kind in ("boot", "edit", "play") for board in ("cm5", "cm2")] + ["motions/motions.bin"]
BUNDLED = ("libsimavr", "libelf")  # what the programs need and not every computer has
# Of the source tree, at the same places under robot/: what --plot and --body run.
SCRIPTS = ["tools/sim/cm5sim/plot_trace.py", "tools/sim/cm5sim/with_body.py", "tools/body/humanoid.xml", "tools/body/gp.xml"]
SCRIPTS += [str(path.relative_to(TOP)) for path in sorted((TOP / "tools/body/src/body").glob("*.py"))]
LICENCE = pathlib.Path("/usr/share/common-licenses/GPL-3")


def version():
    return re.search(r"project\(motion512 VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class BuildWithRobot(build_py):
    """Python files, and robot/ with what the build tree has, in the same folders."""

    def run(self):
        super().run()
        missing = [name for name in (*PROGRAMS, *DATA) if not (BUILD / name).exists()]
        if missing:
            raise SystemExit(f"cm5sim: not built: {', '.join(missing)}. Build first: tools/dev/build")
        robot = pathlib.Path(self.build_lib) / "cm5sim" / "robot"
        for name in DATA:
            self.take(BUILD / name, robot / name)
        for name in PROGRAMS:
            self.take(BUILD / name, robot / name, 0o755)
            subprocess.run(["strip", robot / name], check=True)
        for name in SCRIPTS:
            self.take(TOP / name, robot / name)
        self.take(TOP / "LICENSE", robot / "LICENSE.MIT")
        if LICENCE.exists():
            self.take(LICENCE, robot / "LICENSE.GPL-3")
        for name, path in needed_libraries(BUILD / PROGRAMS[0]):
            self.take(path, robot / "lib" / name)

    @staticmethod
    def take(source, target, mode=0o644):
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        target.chmod(mode)


def needed_libraries(program):
    """[(name, path)] of the shared libraries that go into the wheel."""
    said = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"(\S+) => (\S+)", said)
    return [(name, os.path.realpath(path)) for name, path in found if name.startswith(BUNDLED)]


class ForThisKindOfComputer(bdist_wheel):
    """Any Python 3, this operating system and processor."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithPrograms(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), distclass=WithPrograms, cmdclass={"build_py": BuildWithRobot, "bdist_wheel": ForThisKindOfComputer})
