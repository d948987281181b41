# SPDX-License-Identifier: MIT
"""Reads and writes RoboPlus Motion 1.x `.mtn` text files, versions 1.00 and 1.01.

envelope: byte-order mark, line ends, checksum. reader: the text. long_pages: pages with more than seven steps. writer: output and its
losses. The reader puts its assumptions into Image.notes, as sentences for the user.
"""

from m512.files.mtn.envelope import BOM, file_checksum, first_change
from m512.files.mtn.reader import read
from m512.files.mtn.writer import rate_of, write

__all__ = ["BOM", "file_checksum", "first_change", "rate_of", "read", "write"]
