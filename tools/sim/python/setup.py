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
LIBRARY = "host/tools/sim/libcm5sim.so"
DATA = [f"firmware/{kind}-{board}.hex" for kind in ("boot", "edit", "play", "monitor") for board in ("cm5", "cm2")] + ["motions/motions.bin"]
BUNDLED = ("libsimavr", "libelf")  # needed by the library, but not present on every computer
# The library links libsimavr (GPL-3) and libelf (LGPL-3 or GPL-2), so their terms and the source offer go into the wheel.
LICENCES = {"LICENSE.GPL-3": "/usr/share/common-licenses/GPL-3", "LICENSE.LGPL-3": "/usr/share/common-licenses/LGPL-3"}
OFFER = """\
libcm5sim.so links libsimavr and may be passed on under the GNU General Public License, version 3 only (LICENSE.GPL-3).
Its complete source is the repository of Motion512 and the source packages of the distribution that it was built on,
unchanged:

{sources}
Whoever passes on this wheel passes on this offer with it, and gives the source to anybody who asks.
The firmware images, the motions and the Python files are under the MIT licence (LICENSE.MIT).
"""
# Files of the source tree that --body runs, at the same paths under robot/.
BODY = ["tools/body/humanoid.xml", "tools/body/gp.xml"]
BODY += [str(path.relative_to(TOP)) for path in sorted((TOP / "tools/body/src/body").glob("*.py"))]


def version():
    return re.search(r"project\(motion512 VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class BuildWithRobot(build_py):
    """Adds robot/ to the Python files, with the contents of the build tree in the same folders."""

    def run(self):
        super().run()
        if self.editable_mode:  # it uses the build tree itself
            return
        missing = [name for name in (LIBRARY, *DATA) if not (BUILD / name).exists()]
        if missing:
            raise SystemExit(f"cm5sim: not built: {', '.join(missing)}. Build first: tools/dev/build")
        robot = pathlib.Path(self.build_lib) / "cm5sim" / "robot"
        for name in DATA:
            self.take(BUILD / name, robot / name)
        self.take(BUILD / LIBRARY, robot / LIBRARY, 0o755)
        subprocess.run(["strip", robot / LIBRARY], check=True)
        for name in BODY:
            self.take(TOP / name, robot / name)
        self.take(TOP / "LICENSE", robot / "LICENSE.MIT")
        for name, path in LICENCES.items():
            self.take(path, robot / name)
        sources = ""
        for name, path in needed_libraries(BUILD / LIBRARY):
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


def needed_libraries(library):
    """[(name, path)] of the shared libraries to put into the wheel."""
    found = re.findall(r"(\S+) => (\S+)", run("ldd", library))
    return [(name, os.path.realpath(path)) for name, path in found if name.startswith(BUNDLED)]


def distribution_package(path):
    """(package, source package, its version) of a system library."""
    said = run("dpkg-query", "-S", path)
    package = said.split(": ")[0].split(",")[0]
    source, packaged = run("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}", package).split()
    return package.split(":")[0], source, packaged


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class ForThisKindOfComputer(bdist_wheel):
    """Tags the wheel: any Python 3, this operating system and processor."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), distclass=WithLibrary, cmdclass={"build_py": BuildWithRobot, "bdist_wheel": ForThisKindOfComputer})
