# SPDX-License-Identifier: MIT
"""Draws joint angles and speeds over time: a page by both laws side by side, or a recorded trace.

Needs matplotlib (pip install "m512[plot]"), which is imported only here.
"""
from __future__ import annotations

import csv
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

from m512.errors import FileError, MissingError
from m512.files import storage
from m512.files.image import Image
from m512.files.page import TICKS_PER_SECOND, Page
from m512.motion.player import CLASSIC, EXACT, end_pose_before, play

DEGREES_PER_UNIT = 300 / 1024
MAX_JOINTS_IN_LEGEND = 20


@dataclass
class Curves:
    """Positions of joints over time; None: nothing was sent."""

    title: str
    seconds: List[float] = field(default_factory=list)
    joints: Dict[int, List[Optional[int]]] = field(default_factory=dict)
    marks: List[Tuple[float, str]] = field(default_factory=list)

    def moving(self) -> List[int]:
        return [j for j, values in self.joints.items() if len({v for v in values if v is not None}) > 1]


def of_page(image: Image, number: int, law: str, seconds: float, joints: Optional[Sequence[int]] = None) -> Curves:
    """A play that starts with the page, from the pose in which the page before would have left the joints (or the
    middle), at most `seconds` long."""
    out = Curves(f"page {number} \"{image[number].title}\", {law} law")
    chosen = list(joints) if joints else [joint for joint in range(31) if not _is_filler(image[number], joint)]
    out.joints = {joint: [] for joint in chosen}
    before = None
    for tick in play(image, number, law, end_pose_before(image, number), int(seconds * TICKS_PER_SECOND)):
        out.seconds.append(tick.number / TICKS_PER_SECOND)
        if (tick.page, tick.step) != before:
            before = (tick.page, tick.step)
            out.marks.append((out.seconds[-1], f"{tick.page}.{tick.step}"))
        for joint in chosen:
            values = out.joints[joint]
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
    chosen = [joint for joint in columns if not joints or joint in joints]
    try:
        for row in rows:
            out.seconds.append(int(row["tick"]) / TICKS_PER_SECOND)
            for joint in chosen:
                text = row[columns[joint]]
                out.joints.setdefault(joint, []).append(int(float(text)) if text else None)
    except (ValueError, TypeError):
        raise FileError(f"{path}: line {len(out.seconds) + 1} holds something else than numbers") from None
    return out


def speeds(seconds: Sequence[float], values: Sequence[Optional[int]]) -> List[float]:
    """Degrees per second between neighbouring samples; 0 where nothing is known."""
    out = [0.0]
    for k in range(1, len(values)):
        a, b, dt = values[k - 1], values[k], seconds[k] - seconds[k - 1]
        out.append((b - a) * DEGREES_PER_UNIT / dt if a is not None and b is not None and dt > 0 else 0.0)
    return out


def draw(sets: Sequence[Curves], output: Path) -> int:
    """Angles above, speeds below, one column for each set; returns the number of joints drawn."""
    try:
        import matplotlib
    except ImportError:
        raise MissingError("drawing needs matplotlib: pip install \"m512[plot]\" (or pipx inject m512 matplotlib)") from None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    if output.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise FileError(f"{output}: the suffix decides the kind: .png, .svg or .pdf")
    moving = sorted({joint for curves in sets for joint in curves.moving()})
    figure, axes = pyplot.subplots(2, len(sets), sharex="col", sharey="row", squeeze=False,
                                   figsize=(7 * len(sets) + 1, 7), layout="constrained")
    for column, curves in enumerate(sets):
        above, below = axes[0][column], axes[1][column]
        above.set_title(curves.title)
        for joint in moving:
            values = curves.joints.get(joint)
            if not values:
                continue
            angles = [float("nan") if v is None else (v - 512) * DEGREES_PER_UNIT for v in values]
            line, = above.plot(curves.seconds, angles, linewidth=1.2, label=f"ID {joint}")
            below.plot(curves.seconds, speeds(curves.seconds, values), linewidth=0.9, color=line.get_color())
        for at, text in curves.marks:
            for axis in (above, below):
                axis.axvline(at, color="0.85", linewidth=0.6, zorder=0)
            above.annotate(text, (at, 1), xycoords=("data", "axes fraction"), fontsize=6, color="0.4", va="top")
        below.set_xlabel("s")
    axes[0][0].set_ylabel("degrees from the centre")
    axes[1][0].set_ylabel("degrees/s")
    if 0 < len(moving) <= MAX_JOINTS_IN_LEGEND:
        axes[0][-1].legend(fontsize=7, ncols=2, loc="upper right")
    drawn = BytesIO()
    try:
        figure.savefig(drawn, format=output.suffix[1:].lower(), dpi=120,
                       metadata={"Date": None} if output.suffix.lower() == ".svg" else None)
    finally:
        pyplot.close(figure)
    storage.write(output, drawn.getvalue())
    return len(moving)


def of_page_by_both_laws(image: Image, number: int, seconds: float, joints: Optional[Sequence[int]]) -> List[Curves]:
    return [of_page(image, number, law, seconds, joints) for law in (CLASSIC, EXACT)]
