# SPDX-License-Identifier: MIT
"""The command `cm5sim` of the wheel: starts the program that the wheel brings, with its images and libraries beside it."""

import os
import sys

from . import library


def main() -> None:
    """Does not return: the program takes this process over."""
    program = library.build_folder() / "host" / "tools" / "sim" / "cm5sim"
    if not program.exists():
        sys.exit(f"cm5sim: {program} is missing; in the source tree tools/demo builds it")
    environment = dict(os.environ, M512_BUILD=str(library.build_folder()))
    if library.ROBOT.exists():
        path = [str(library.ROBOT / "lib")] + [old for old in [environment.get("LD_LIBRARY_PATH")] if old]
        environment["LD_LIBRARY_PATH"] = os.pathsep.join(path)
        environment.setdefault("M512_PYTHON", sys.executable)
        scripts = library.ROBOT / "tools"
        environment.setdefault("M512_PLOT_SCRIPT", str(scripts / "sim" / "cm5sim" / "plot_trace.py"))
        environment.setdefault("M512_BODY_SCRIPT", str(scripts / "body" / "src" / "with_body.py"))  # as setup.py puts it
    os.execve(program, ["cm5sim", *sys.argv[1:]], environment)


if __name__ == "__main__":
    main()
