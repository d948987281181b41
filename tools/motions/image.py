#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the image of a motion library: image.py SOURCE.m512 OUT.bin

The same bytes as `m512 convert`, with nothing but Python's own library, so that a first `tools/demo` installs no Python
package. Exits 1 with one sentence when the text is wrong.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "m512" / "src"))
from m512.files import formats  # noqa: E402  (the path comes first)
from m512.errors import M512Error  # noqa: E402

if __name__ == "__main__":
    try:
        formats.save(Path(sys.argv[2]), formats.load(Path(sys.argv[1])))
    except M512Error as error:
        sys.exit(f"image: {error}")
