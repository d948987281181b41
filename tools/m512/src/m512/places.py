# SPDX-License-Identifier: MIT
"""Locations of files that m512 uses but does not contain: the source tree around this package, or the wheel `cm5sim`."""

from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path


def source_tree() -> Path | None:
    """The source tree that contains this package, or None."""
    return next((folder for folder in Path(__file__).resolve().parents if (folder / "linker" / "memory_map.h").exists()), None)


def build_folder() -> Path | None:
    """$M512_BUILD, or build/ of the source tree."""
    given, tree = os.environ.get("M512_BUILD"), source_tree()
    return Path(given) if given else tree / "build" if tree else None


def wheel_folder() -> Path | None:
    """The content of the wheel cm5sim (firmware/, motions/, tools/body/), or None if it is not installed."""
    spec = find_spec("cm5sim")
    folder = Path(spec.origin).parent / "robot" if spec and spec.origin else None
    return folder if folder and folder.exists() else None
