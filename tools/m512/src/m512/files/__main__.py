# SPDX-License-Identifier: MIT
"""python -m m512.files SOURCE TARGET: like `m512 convert`, with Python's standard library only.

So the first build of the motion library needs no Python package. An invalid source prints one sentence and exits with code 1.
"""

import sys
from pathlib import Path

from m512.errors import M512Error
from m512.files import formats

if __name__ == "__main__":
    try:
        formats.save(Path(sys.argv[2]), formats.load(Path(sys.argv[1])), replace=True)
    except M512Error as error:
        sys.exit(f"m512: {error}")
