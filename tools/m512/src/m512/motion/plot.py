# SPDX-License-Identifier: MIT
"""Draws joint angles and speeds over time: a page by both laws, told apart where they differ, or a recorded trace.

Needs matplotlib, which is imported only here.
"""
from __future__ import annotations

import csv
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

from m512.errors import FileError, MissingError, how_to_install
from m512.files import storage
from m512.files.image import Image
from m512.files.page import TICKS_PER_SECOND, Page
from m512.motion.player import CLASSIC, EXACT, play, pose_before

DEGREES_PER_UNIT = 300 / 1024
FIT = 6                      # samples on either side through which a parabola is laid to tell a speed
SAME_UNITS = 1               # two laws that are not further apart are drawn as one
LABEL_SHARE = 0.0075         # of the width: a letter of a step's label; labels that would touch are left out


@dataclass
class Curves:
    """Positions of joints over time; None: nothing was sent."""

    title: str
    seconds: List[float] = field(default_factory=list)
    joints: Dict[int, List[Optional[int]]] = field(default_factory=dict)     # those to be drawn
    robot: Dict[int, List[Optional[int]]] = field(default_factory=dict)      # all of them
    marks: List[Tuple[float, str]] = field(default_factory=list)
    names: Dict[int, str] = field(default_factory=dict)

    def label(self, joint: int) -> str:
        return f"{joint} {self.names[joint]}" if joint in self.names else f"ID {joint}"

    def moving(self) -> List[int]:
        return [j for j, values in self.joints.items() if len({v for v in values if v is not None}) > 1]


def of_page(image: Image, number: int, law: str, seconds: float, joints: Optional[Sequence[int]] = None) -> Curves:
    """A play that starts with the page, from the pose in which the page before or the approach leaves the joints, at
    most `seconds` long."""
    out = Curves(f"page {number} \"{image[number].title}\", {law} law", names=dict(image.joints))
    chosen = list(joints) if joints else [joint for joint in range(31) if not _is_filler(image[number], joint)]
    out.robot = {joint: [] for joint in range(31)}
    out.joints = {joint: out.robot[joint] for joint in chosen}
    before = None
    for tick in play(image, number, law, pose_before(image, number), int(seconds * TICKS_PER_SECOND)):
        out.seconds.append(tick.number / TICKS_PER_SECOND)
        if (tick.page, tick.step) != before:
            before = (tick.page, tick.step)
            out.marks.append((out.seconds[-1], f"{tick.page}.{tick.step}"))
        for joint, values in out.robot.items():
            values.append(tick.goals[joint] if tick.goals else values[-1] if values else None)
    if not out.seconds:
        raise FileError(f"page {number} plays nothing: {image[number].fault_text(image.kind) or 'it has no action'}")
    return out


def _is_filler(page: Page, joint: int) -> bool:
    """IDs 26..30 of RoboPlus pages hold 0 in every step and mean nothing."""
    return joint >= 26 and all(page.word(step, joint) == 0 for step in range(page.steps))


def of_trace(path: Path, joints: Optional[Sequence[int]] = None) -> Curves:
    """A CSV with a column tick and columns goalN, idN or jN, as cm5sim and the golden traces have."""
    out = Curves(path.name)
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise FileError(f"cannot read {path}: {error}") from None
    names = list(rows[0]) if rows else []
    columns = {}
    for name in names:
        for prefix in ("goal", "id", "j"):
            if name and name.startswith(prefix) and name[len(prefix):].isdigit():
                columns[int(name[len(prefix):])] = name
    if "tick" not in names or not columns:
        raise FileError(f"{path}: a trace has a column tick and columns goal1, goal2 ... (or id1, id2 ...)")
    out.robot = {joint: [] for joint in columns}
    out.joints = {joint: values for joint, values in out.robot.items() if not joints or joint in joints}
    try:
        for row in rows:
            out.seconds.append(int(row["tick"]) / TICKS_PER_SECOND)
            for joint, values in out.robot.items():
                text = row[columns[joint]]
                values.append(int(float(text)) if text else None)
    except (ValueError, TypeError):
        raise FileError(f"{path}: line {len(out.seconds) + 1} holds something else than numbers") from None
    return out


def speeds(seconds: Sequence[float], values: Sequence[Optional[int]], marks: Sequence[float] = ()) -> List[float]:
    """Degrees per second at each sample; 0 where nothing is known.

    Positions are whole units, so neighbouring samples say little: a unit a tick is 37 degrees/s. The slope is that of a parabola
    through the samples around, which a ramp of speed is; it does not reach across `marks`, where a step begins.
    """
    import numpy

    count = len(values)
    known = numpy.array([numpy.nan if value is None else value for value in values], dtype=float)
    ticks = numpy.round(numpy.array(seconds) * TICKS_PER_SECOND).astype(int)
    edges = [0, *(int(numpy.searchsorted(ticks, round(mark * TICKS_PER_SECOND))) for mark in marks if mark > seconds[0]), count]
    out = numpy.zeros(count)
    weights: Dict[Tuple[int, int], Any] = {}
    for low, high in zip(edges, edges[1:]):
        low = max(low - 1, 0)                     # the sample before is where the step begins
        for k in range(low, high):
            left, right = min(FIT, k - low), min(FIT, high - 1 - k)
            if left + right < 2:
                continue
            if (left, right) not in weights:
                at = numpy.arange(-left, right + 1)
                weights[left, right] = numpy.linalg.pinv(numpy.vander(at, 3))[1]
            out[k] = weights[left, right] @ known[k - left:k + right + 1]
    return list(numpy.nan_to_num(out) * DEGREES_PER_UNIT * TICKS_PER_SECOND)


def draw(sets: Sequence[Curves], output: Path, strip: Optional[Callable[[Any, Curves], None]] = None) -> int:
    """Angles above, speeds below; a second set is drawn dashed, where it differs. Returns the number of joints drawn.

    `strip(axis, curves)` fills a row above the angles, with the same time axis (strip.py: pictures of the robot's poses).
    """
    try:
        import matplotlib
    except ImportError:
        raise MissingError(f"drawing needs matplotlib: {how_to_install('matplotlib')}") from None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    if output.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise FileError(f"{output}: the suffix decides the kind: .png, .svg or .pdf")
    first, others = sets[0], sets[1:]
    moving = sorted({joint for curves in sets for joint in curves.moving()})
    ratios = ([0.45] if strip else []) + [1.0, 1.0]
    figure, axes = pyplot.subplots(len(ratios), 1, sharex=True, squeeze=False, figsize=(11, 4 * sum(ratios)), layout="constrained",
                                   gridspec_kw={"height_ratios": ratios})
    above, below = axes[-2][0], axes[-1][0]
    for joint, (colour, style) in zip(moving, _styles(len(moving))):
        _joint(above, below, first, joint, colour, style)
        for curves in others:
            _joint(above, below, curves, joint, colour, ":", first)
    _marks((above, below), first)
    axes[0][0].set_title(first.title + "".join(f"; dotted where different: {curves.title.rpartition(', ')[2]}" for curves in others))
    above.set_ylabel("degrees from the centre")
    below.set_ylabel("degrees/s")
    below.set_xlabel("s")
    if moving:
        figure.legend(*above.get_legend_handles_labels(), fontsize=8, loc="outside right upper", ncols=1 + (len(moving) > 24))
    if strip:
        figure.draw_without_rendering()      # settles where the axes are
        strip(axes[0][0], first)
    drawn = BytesIO()
    try:
        figure.savefig(drawn, format=output.suffix[1:].lower(), dpi=120,
                       metadata={"Date": None} if output.suffix.lower() == ".svg" else None)
    finally:
        pyplot.close(figure)
    storage.write(output, drawn.getvalue())
    return len(moving)


def _styles(count: int) -> List[Tuple[Any, str]]:
    """(colour, line style) of each joint: ten plain colours, then the same dashed, and so on."""
    from matplotlib import colormaps

    name, many = ("tab10", 10) if count <= 10 else ("tab20", 20)
    colours = [colormaps[name](k) for k in range(many)]
    lines = ("-", "--")
    return [(colours[k % len(colours)], lines[k // len(colours) % len(lines)]) for k in range(count)]


def _joint(above: Any, below: Any, curves: Curves, joint: int, colour: Any, style: str, other: Optional[Curves] = None) -> None:
    """A joint's two lines; with `other` only where it goes otherwise there."""
    values = curves.joints.get(joint)
    if not values:
        return
    shown = _different(values, other.joints.get(joint, [])) if other else [value is not None for value in values]
    angles = [(value - 512) * DEGREES_PER_UNIT if value is not None and here else float("nan") for value, here in zip(values, shown)]
    found = speeds(curves.seconds, values, [at for at, _ in curves.marks])
    above.plot(curves.seconds, angles, style, linewidth=1.3, color=colour, label=None if other else curves.label(joint))
    below.plot(curves.seconds, [speed if here else float("nan") for speed, here in zip(found, shown)], style, linewidth=1.0,
               color=colour)


def _different(values: Sequence[Optional[int]], others: Sequence[Optional[int]]) -> List[bool]:
    """Whether a joint is elsewhere, tick by tick."""
    out = []
    for k, value in enumerate(values):
        other = others[k] if k < len(others) else None
        out.append(value is not None and (other is None or abs(value - other) > SAME_UNITS))
    return out


def _marks(axes: Sequence[Any], curves: Curves) -> None:
    """Where steps begin; labels only as far apart as they can be read."""
    width, last = (curves.seconds[-1] - curves.seconds[0]) or 1.0, float("-inf")
    for at, text in curves.marks:
        for axis in axes:
            axis.axvline(at, color="0.85", linewidth=0.6, zorder=0)
        if (at - last) / width > LABEL_SHARE * (len(text) + 1):
            axes[0].annotate(text, (at, 1), (2, -2), xycoords=("data", "axes fraction"), textcoords="offset points", fontsize=7,
                             color="0.4", va="top")
            last = at


def of_page_by_both_laws(image: Image, number: int, seconds: float, joints: Optional[Sequence[int]]) -> List[Curves]:
    return [of_page(image, number, law, seconds, joints) for law in (EXACT, CLASSIC)]
