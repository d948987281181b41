# SPDX-License-Identifier: MIT
"""Motion pages, firmware images and controllers of the CM-2/CM-5 family, from a PC.

This file imports nothing, so that `m512 --help` stays quick.
"""

__version__ = "1.0.0"  # must equal the version in CMakeLists.txt; a test compares
