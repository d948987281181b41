#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a trace of cm5sim: joints over time, goal and present position.

    plot_trace.py TRACE.csv OUT.svg|OUT.png [--joints 1,3,5]

One small diagram for each joint that moved or had a goal; the others are listed below. Needs matplotlib.
"""

import argparse
import csv
import pathlib
import re
import sys

COLUMNS = 3
DEGREES_PER_UNIT = 300 / 1023


def read_trace(path):
    """Returns the time in s and {ID: (goals, presents)}; a limp servo's goal is None."""
    with open(path, newline="", encoding="ascii") as file:
        rows = csv.reader(file)
        head = next(rows, [])
        ids = [int(match[1]) for name in head if (match := re.fullmatch(r"goal(\d+)", name))]
        if head[:2] != ["tick", "ms"] or len(head) != 2 + 2 * len(ids):
            sys.exit(f"plot_trace: {path} is not a trace of cm5sim")
        times, joints = [], {number: ([], []) for number in ids}
        for row in rows:
            times.append(float(row[1]) / 1000)
            for index, number in enumerate(ids):
                goal, present = row[2 + 2 * index : 4 + 2 * index]
                joints[number][0].append(float(goal) if goal else None)
                joints[number][1].append(float(present))
    return times, joints


def is_active(goals, presents):
    return any(goal is not None for goal in goals) or max(presents) > min(presents)


def draw(times, joints, title, out):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    active = [number for number in joints if times and is_active(*joints[number])]
    still = [number for number in joints if number not in active]
    columns = min(COLUMNS, max(1, len(active)))
    rows = max(1, -(-len(active) // columns))
    figure, axes = pyplot.subplots(rows, columns, figsize=(4.2 * columns, 1.7 * rows + 0.9), sharex=True, squeeze=False, layout="constrained")
    cells = list(axes.flat)
    for axis, number in zip(cells, active):
        goals, presents = joints[number]
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
    text = f"{title}: servo units (left), degrees from 512 (right)"
    if still:
        text += f"\nstood still: {', '.join(map(str, still))}"
    figure.suptitle(text, fontsize=9)
    figure.savefig(out, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("trace")
    parser.add_argument("out", help="file name ending in .svg or .png")
    parser.add_argument("--joints", help="only these IDs, as 1,3,5")
    arguments = parser.parse_args()
    if pathlib.Path(arguments.out).suffix not in (".svg", ".png"):
        sys.exit(f"plot_trace: {arguments.out}: the name must end in .svg or .png")
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        sys.exit(f"plot_trace: no picture without matplotlib ({sys.executable} -m pip install matplotlib)")
    times, joints = read_trace(arguments.trace)
    if arguments.joints:
        wanted = {int(text) for text in arguments.joints.split(",")}
        joints = {number: joint for number, joint in joints.items() if number in wanted}
    draw(times, joints, pathlib.Path(arguments.out).stem, arguments.out)


if __name__ == "__main__":
    main()
