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
# The programs link libsimavr (GPL-3) and libelf (LGPL-3 or GPL-2): their terms and their source go with them.
LICENCES = {"LICENSE.GPL-3": "/usr/share/common-licenses/GPL-3", "LICENSE.LGPL-3": "/usr/share/common-licenses/LGPL-3"}
OFFER = """\
cm5sim, libcm5sim.so and libcm5sim_body.so link libsimavr and may be passed on under the GNU General Public License,
version 3 only (LICENSE.GPL-3). Their complete source is the repository of Motion512 and the source packages of the
distribution that they were built on, unchanged:

{sources}
Whoever passes on this wheel passes on this offer with it, and gives the source to anybody who asks.
The firmware images, the motions and the Python files are under the MIT licence (LICENSE.MIT).
"""
# Of the source tree, at the same places under robot/: what --plot and --body run.
SCRIPTS = ["tools/sim/cm5sim/plot_trace.py", "tools/body/humanoid.xml", "tools/body/gp.xml"]
SCRIPTS += [str(path.relative_to(TOP)) for path in sorted((TOP / "tools/body/src/body").glob("*.py"))]
# Beside the package `body`: Python looks for packages first where the script is that it runs.
WITH_BODY = "tools/body/src/with_body.py"


def version():
    return re.search(r"project\(motion512 VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class BuildWithRobot(build_py):
    """Python files, and robot/ with what the build tree has, in the same folders."""

    def run(self):
        super().run()
        if self.editable_mode:  # the build tree itself is used
            return
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
        self.take(TOP / "tools/sim/cm5sim/with_body.py", robot / WITH_BODY)
        self.take(TOP / "LICENSE", robot / "LICENSE.MIT")
        for name, path in LICENCES.items():
            self.take(path, robot / name)
        sources = ""
        for name, path in needed_libraries(BUILD / PROGRAMS[0]):
            self.take(path, robot / "lib" / name)
            package, source, packaged = distribution_package(path)
            self.take(f"/usr/share/doc/{package}/copyright", robot / "lib" / f"{name}.copyright")
            sources += f"    lib/{name}: source package {source} {packaged}; notices in lib/{name}.copyright\n"
        (robot / "SOURCE_OFFER.txt").write_text(OFFER.format(sources=sources), encoding="utf-8")

    @staticmethod
    def take(source, target, mode=0o644):
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        target.chmod(mode)


def needed_libraries(program):
    """[(name, path)] of the shared libraries that go into the wheel."""
    found = re.findall(r"(\S+) => (\S+)", run("ldd", program))
    return [(name, os.path.realpath(path)) for name, path in found if name.startswith(BUNDLED)]


def distribution_package(path):
    """(package, source package, its version) that a library of the system came with."""
    said = run("dpkg-query", "-S", path)
    package = said.split(": ")[0].split(",")[0]
    source, packaged = run("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}", package).split()
    return package.split(":")[0], source, packaged


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class ForThisKindOfComputer(bdist_wheel):
    """Any Python 3, this operating system and processor."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithPrograms(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), distclass=WithPrograms, cmdclass={"build_py": BuildWithRobot, "bdist_wheel": ForThisKindOfComputer})
