# SPDX-License-Identifier: MIT
"""Goal and present position of every servo by tick, as CSV (tick,ms,goal1,present1,goal2,present2,...): one row for each 1/128 s of
simulated time. The goal of a limp servo is empty. plot.py draws it."""

from __future__ import annotations

import os
import tempfile

from . import plot
from .files import naming
from .library import CYCLES_PER_MS
from .servo import Servos


class Trace:
    """path: the file; None: a temporary file, only to be drawn."""

    def __init__(self, servos: Servos, path: str | None, picture: str | None) -> None:
        """OSError: the file cannot be written, or no picture can be made."""
        if picture:
            plot.check(picture)
        self._servos, self._picture = servos, picture
        self._temporary = not path
        self._file = open(path, "w", encoding="ascii") if path else tempfile.NamedTemporaryFile("w", suffix=".csv", delete=False)
        self._count = len(servos)  # servos added later are left out
        self._file.write("tick,ms" + "".join(f",goal{servo},present{servo}" for servo in servos.ids) + "\n")

    def row(self, tick: int, now: int) -> None:
        cells = [f",{goal:.0f},{present:.0f}" if goal >= 0 else f",,{present:.0f}" for goal, present in self._servos.row(self._count)]
        with naming(self._file.name):
            self._file.write(f"{tick},{now / CYCLES_PER_MS:.3f}{''.join(cells)}\n")

    def close(self) -> None:
        """Draws the picture. OSError: the trace could not be written, or no picture was made."""
        try:
            with naming(self._file.name):
                self._file.close()
            if self._picture:
                self._draw(self._picture)
        finally:
            if self._temporary:
                os.unlink(self._file.name)

    def _draw(self, picture: str) -> None:
        try:
            plot.draw(self._file.name, picture)
        except Exception as error:  # matplotlib raises many kinds
            raise OSError(f"{picture}: {getattr(error, 'strerror', None) or error}") from error
