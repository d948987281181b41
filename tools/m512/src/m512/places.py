# SPDX-License-Identifier: MIT
"""Where things lie that m512 uses and does not bring: in the source tree around this package, or in the wheel `cm5sim`."""
from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path
from typing import Optional


def source_tree() -> Optional[Path]:
    """The source tree that this package lies in, if it lies in one."""
    return next((folder for folder in Path(__file__).resolve().parents if (folder / "linker" / "memory_map.h").exists()), None)


def build_folder() -> Optional[Path]:
    """$M512_BUILD, or build/ of the source tree."""
    given, tree = os.environ.get("M512_BUILD"), source_tree()
    return Path(given) if given else tree / "build" if tree else None


def wheel_folder() -> Optional[Path]:
    """What the wheel cm5sim brings: firmware/, motions/, tools/body/; None if it is not installed."""
    spec = find_spec("cm5sim")
    folder = Path(spec.origin).parent / "robot" if spec and spec.origin else None
    return folder if folder and folder.exists() else None


def body_sources() -> Optional[Path]:
    """The folder of the Python package `body` (tools/body), which describes and draws the robot."""
    places = [folder / "tools" / "body" / "src" for folder in (source_tree(), wheel_folder()) if folder]
    return next((place for place in places if (place / "body").is_dir()), None)
