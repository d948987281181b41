# SPDX-License-Identifier: MIT
"""The readable text format of motions, for people and version control. See FORMAT.md."""

from m512.files.text.reader import read_text
from m512.files.text.writer import write_text

__all__ = ["read_text", "write_text"]
