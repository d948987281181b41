# SPDX-License-Identifier: MIT
"""Draws a trace: goal and present position of joints over time. One small diagram for each joint that moved or had a goal; lists the others
below. Needs matplotlib."""

from __future__ import annotations

import csv
import importlib.util
import pathlib

COLUMNS = 3
DEGREES_PER_UNIT = 300 / 1023
Joint = tuple[int, list["float | None"], list[float]]  # ID, goals (None: limp) and present positions


def read_trace(path: str) -> tuple[list[float], list[Joint]]:
    """Returns the time in s, and the joints in the order of the columns: two servos may have one ID."""
    times: list[float] = []
    with open(path, newline="", encoding="ascii") as file:
        rows = csv.reader(file)
        joints: list[Joint] = [(int(name[len("goal") :]), [], []) for name in next(rows) if name.startswith("goal")]
        for row in rows:
            times.append(float(row[1]) / 1000)
            for (_, goals, presents), goal, present in zip(joints, row[2::2], row[3::2]):
                goals.append(float(goal) if goal else None)
                presents.append(float(present))
    return times, joints


def is_active(goals: list[float | None], presents: list[float]) -> bool:
    return any(goal is not None for goal in goals) or max(presents) > min(presents)


def check(out: str) -> None:
    """OSError: no picture of this name can be made; its text says why."""
    if pathlib.Path(out).suffix not in (".svg", ".png"):
        raise OSError(f"{out}: the name must end in .svg or .png")
    if not importlib.util.find_spec("matplotlib"):
        raise OSError("no picture without matplotlib (pip install matplotlib)")
    with open(out, "ab"):  # keeps an older picture until the new one is drawn
        pass


def draw(path: str, out: str) -> None:
    """Draws the trace `path` as the picture `out`, which check() has passed. OSError: it cannot be written."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    times, joints = read_trace(path)
    active = [(number, goals, presents) for number, goals, presents in joints if times and is_active(goals, presents)]
    still = [number for number, goals, presents in joints if not (times and is_active(goals, presents))]
    columns = min(COLUMNS, max(1, len(active)))
    rows = max(1, -(-len(active) // columns))
    figure, axes = pyplot.subplots(rows, columns, figsize=(4.2 * columns, 1.7 * rows + 0.9), sharex=True, squeeze=False, layout="constrained")
    cells = list(axes.flat)
    for axis, (number, goals, presents) in zip(cells, active):
        axis.plot(times, [float("nan") if goal is None else goal for goal in goals], color="#d95f02", linewidth=0.9, label="goal")
        axis.plot(times, presents, color="#1b6ca8", linewidth=1.3, label="present")
        shown = presents + [goal for goal in goals if goal is not None]
        low, high = min(shown), max(shown)
        margin = max(10, (high - low) * 0.15)
        axis.set_ylim(low - margin, high + margin)
        axis.set_title(f"joint {number}", fontsize=8, loc="left", pad=2)
        axis.tick_params(labelsize=7)
        axis.grid(linewidth=0.3)
        degrees = axis.secondary_yaxis(
            "right", functions=(lambda unit: (unit - 512) * DEGREES_PER_UNIT, lambda degree: degree / DEGREES_PER_UNIT + 512)
        )
        degrees.tick_params(labelsize=6, colors="#777777")
    for axis in cells[len(active) :]:
        axis.set_visible(False)
    for axis in cells[max(0, len(active) - columns) : len(active)]:
        axis.set_xlabel("s", fontsize=8)
    if active:
        cells[0].legend(fontsize=6, loc="best")
    text = f"{pathlib.Path(out).stem}: servo units (left), degrees from 512 (right)"
    if still:
        text += f"\nstood still: {', '.join(map(str, still))}"
    figure.suptitle(text, fontsize=9)
    figure.savefig(out, dpi=110)
