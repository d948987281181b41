# SPDX-License-Identifier: MIT
"""`python -m m512`."""

from m512.cli import main

main()
