# SPDX-License-Identifier: MIT
"""A row of pictures of the robot above a plot: its pose at moments of the play, on the plot's time axis.

The robot is drawn by the package `body` of the source tree's tools/body, which the wheel cm5sim brings as well; without it there is no
row. Needs matplotlib and numpy, imported only here and in plot.py.
"""
from __future__ import annotations

import sys
from bisect import bisect_left
from collections import Counter
from typing import Any, Callable, Dict, List, Tuple

from m512.errors import FileError, MissingError, how_to_install
from m512.files.page import TICKS_PER_SECOND
from m512.motion.plot import Curves
from m512.places import body_sources

SHARE = 0.94                 # of the row's height: the tallest pose
GAP = 0.04                   # inches between two robots
CHOICE = 0.5                 # inches: of the ends of steps that are closer together, that is drawn which was drawn least
LOOKS = 120                  # ends of steps that are looked at, at most
FILL = 0.25                  # inches between the moments that are tried where no step ends


class Strip:
    """Draws the row: pass it to plot.draw(). body: a name in tools/body (humanoid, gp) or a file. MissingError: the package `body`
    is not here; FileError: there is no such body."""

    def __init__(self, body: str = "humanoid") -> None:
        folder = body_sources()
        if folder is None:
            raise MissingError("no pictures of the robot: they need its body, which the source tree and the wheel cm5sim have")
        if str(folder) not in sys.path:
            sys.path.append(str(folder))
        try:
            from body import description, picture
        except ImportError as error:
            raise MissingError(f"no pictures of the robot: {error} ({how_to_install('matplotlib')})") from None
        try:
            self.robot = description.load(body)
        except description.BodyError as error:
            raise FileError(str(error)) from None
        self.picture = picture

    def __call__(self, axis: Any, curves: Curves) -> None:
        """Fills the axis, whose place on the figure must be settled."""
        from matplotlib.transforms import Affine2D, ScaledTranslation

        axis.set_axis_off()
        axis.set_ylim(0, 1)
        to_inches = axis.figure.dpi_scale_trans
        row = _Row(axis, axis.get_window_extent().transformed(to_inches.inverted()), curves, lambda index: self._view(curves, index))
        for _, _, index in row.fill():
            here = ScaledTranslation(curves.seconds[index], 0, axis.transData)
            axis.add_collection(self.picture.polygons(row.views[index].parts, transform=Affine2D().scale(row.scale) + to_inches + here,
                                                      clip_on=False), autolim=False)
            axis.axvline(curves.seconds[index], ymax=0.02, color="0.4", linewidth=1.5, clip_on=False)

    def _view(self, curves: Curves, index: int) -> "_View":
        pose = {servo: curves.robot[servo][index] for servo in self.robot.servos if servo in curves.robot}
        return _View(self.picture.flat(self.picture.scene(self.robot, {servo: at for servo, at in pose.items() if at is not None})))


class _View:
    """A pose as flat polygons, mm about the middle of the trunk, and how far they reach."""

    def __init__(self, parts: List[Any]) -> None:
        import numpy

        corners = numpy.concatenate([corners for corners, _ in parts])
        self.parts = parts
        self.left, _ = corners.min(axis=0)
        self.right, self.high = corners.max(axis=0)


class _Views(Dict[int, _View]):
    """Views by sample, made when they are asked for."""

    def __init__(self, make: Callable[[int], _View]) -> None:
        super().__init__()
        self.make = make

    def __missing__(self, index: int) -> _View:
        self[index] = self.make(index)
        return self[index]


class _Row:
    """Which moments are drawn: robots stand where their moment is, and none before another. Lengths in inches."""

    def __init__(self, axis: Any, box: Any, curves: Curves, make: Callable[[int], _View]) -> None:
        self.curves, self.views, self.width = curves, _Views(make), box.width
        self.low, high = axis.get_xlim()
        self.a_second = box.width / (high - self.low)
        self.ends = _step_ends(curves)
        self.scale = SHARE * box.height / max(self.views[index].high for index, _ in self.ends)
        self.placed: List[Tuple[float, float, int]] = []     # left, right, sample

    def at(self, index: int) -> float:
        return (self.curves.seconds[index] - self.low) * self.a_second

    def span(self, index: int) -> Tuple[float, float]:
        view, at = self.views[index], self.at(index)
        return at + self.scale * view.left - GAP / 2, at + self.scale * view.right + GAP / 2

    def fits(self, index: int) -> bool:
        low, high = self.span(index)
        return low >= -GAP and high <= self.width + GAP and all(high <= left or low >= right for left, right, _ in self.placed)

    def fill(self) -> List[Tuple[float, float, int]]:
        """Ends of steps from left to right, then what fits between them. A walk repeats its steps about as often as robots find room:
        so that not the same step is drawn again and again, the one that was drawn least comes first."""
        drawn: Counter[str] = Counter()
        left = self.ends
        while left:
            left = [(index, label) for index, label in left if self.fits(index)]
            near = [(drawn[label], index, label) for index, label in left if self.at(index) <= self.at(left[0][0]) + CHOICE]
            if near:
                _, index, label = min(near)
                drawn[label] += 1
                self.placed.append((*self.span(index), index))
                left = [end for end in left if end[0] > index]
        stride = max(1, round(FILL / self.a_second * TICKS_PER_SECOND))
        for index in range(0, len(self.curves.seconds), stride):
            if self.fits(index):
                self.placed.append((*self.span(index), index))
        return self.placed


def _step_ends(curves: Curves) -> List[Tuple[int, str]]:
    """(sample, label) of the ends of steps and of the last sample; evenly thinned out where there are too many to look at."""
    begins = [at for at, _ in curves.marks]
    samples = [bisect_left(curves.seconds, at) - 1 for at in begins[1:]] + [len(curves.seconds) - 1]
    ends = [(index, label) for index, (_, label) in zip(samples, curves.marks or [(0, "")]) if index >= 0]
    return ends[::-(-len(ends) // LOOKS)]
