#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Plays the library's walk by the C player (exact law) while what shapes it jumps in every step, and says what becomes of it.

    tests/models/jumps.py [--steps N]     rate 50 <-> 200 %, amplitude 0 <-> 120 %, blend -100 <-> 100 %, all three, and each by chance

Shown: every step ends on the way-points of the model (tests/models/shaping.py), no joint passes one, no tick is idle, and no joint changes its
speed in a tick by more than the law does for these shaped steps. That bound is worked out here from the page of the spec (exact law, rule 2),
with the lengths that the steps had; 2 units are what rounding three positions to whole units can add. Exit code 1 when one is broken.
"""

import argparse
import itertools
import random
import sys
from fractions import Fraction

from m512.files.formats import load
from tests.models import shaping
from tests.models.played import EXACT, JOINTS, STEP, TOP, Played
from tests.models.shaped import Check

WALK = "walk"
ROBOT = sum(1 << joint for joint in range(1, 19))
ROUNDING = 2
VOLTS_DV = 111
TICKS_A_STEP = 14  # about
JUMPS = {"rate": (50, 200), "amplitude": (0, 120), "blend": (-100, 100)}


def jump(kind, value):
    """Returns a change in the form that Played.shape takes."""
    return (kind, value, ROBOT) if kind == "amplitude" else (kind, value)


def jumps_of(what, seed):
    """Yields for each step a list of changes to make after its first tick, without end."""
    chance = random.Random(f"jumps {what} {seed}")
    kinds = list(JUMPS) if what in ("all", "chance") else [what]
    for k in itertools.count(1):
        yield [
            jump(kind, chance.choice((*JUMPS[kind], (JUMPS[kind][0] + JUMPS[kind][1]) // 2)) if what == "chance" else JUMPS[kind][k % 2])
            for kind in kinds
            if what != "chance" or chance.random() < 0.6
        ]


def way_point_speeds(way, ticks, after_way, after_ticks):
    """Returns the (least, most) possible speed at the end of a step. The law plans with the next step's ideal length, within one tick of
    its real length."""
    if way * after_way <= 0:
        return 0, 0
    return tuple(min(Fraction(abs(way), ticks), Fraction(abs(after_way), max(1, after_ticks + by))) for by in (1, -1))


def bound_of(way, ticks, accel, before, after):
    """Returns the largest change of speed in a tick of a step, by rule 2: A ticks from the speed before to v, A from v to the speed
    after."""
    ramp, most = min(accel, ticks // 2), Fraction(0)
    for w0, w1 in itertools.product(before, after):
        cruise = (abs(way) - (w0 + w1) * Fraction(ramp, 2)) / (ticks - ramp) if ticks > ramp else Fraction(abs(way), ticks)
        most = max(most, max(abs(cruise - w0), abs(cruise - w1)) / max(ramp, 1))
    return most


def speed_changes(check, accel):
    """Returns (largest change of speed in a tick, largest excess over its step's bound). The last two steps are left out."""
    steps = [(begin, goals) for _, begin, goals in check.steps]
    largest, excess = 0, Fraction(-99)
    for joint in range(1, 19):
        ways = [after[1][joint] - now[1][joint] for now, after in zip(steps, steps[1:])]
        ticks = [after[0] - now[0] for now, after in zip(steps, steps[1:])]
        ends = [(0, 0)] + [way_point_speeds(*step) for step in zip(ways, ticks, ways[1:], ticks[1:])]
        bounds = [bound_of(way, count, accel, before, after) for way, count, before, after in zip(ways, ticks, ends, ends[1:])]
        row = [steps[0][1][joint]] * 2 + [goals[joint] for goals in check.ticks]
        for k, bound in enumerate(bounds):
            beside = max(bounds[max(0, k - 1) : k + 1])  # its first tick also belongs to the step before
            for tick in range(steps[k][0], steps[k + 1][0]):
                change = abs(row[tick + 2] - 2 * row[tick + 1] + row[tick])
                largest = max(largest, change)
                excess = max(excess, change - (beside if tick == steps[k][0] else bound))
    return largest, excess


def broken(what, steps, seed=1):
    """Plays about `steps` steps. Returns (fault or None, measurement)."""
    library = load(TOP / "tools" / "motions" / "motions.m512")
    image, page = library.to_bytes(), library.find(WALK)
    pose = [library[page].word(0, joint) if ROBOT >> joint & 1 else 512 for joint in range(JOINTS)]
    play = Played(image, page, EXACT, ROBOT, dict(enumerate(pose)), shape=[("reset",), ("centre", library.find("ready")), ("voltage", VOLTS_DV)])
    check, changes = Check(image, pose), jumps_of(what, seed)
    shape = shaping.Shape(centre_page=library.find("ready"), volts=Fraction(VOLTS_DV, 10))
    wrong = check.follow(play, shape, lambda events: next(changes) if events & STEP else [], limit=steps * TICKS_A_STEP)
    idle = sum(goals is None for goals in check.ticks)
    if wrong or idle:
        return wrong or f"{idle} idle ticks", ""
    largest, excess = speed_changes(check, library[page].accel)
    said = (
        f"{len(check.steps)} steps: 0 past a way-point, 0 idle ticks, largest change of speed {largest} units a tick, "
        f"{float(ROUNDING - excess):.2f} below the bound"
    )
    return (None if excess < ROUNDING else f"a change of speed is {float(excess):.2f} above the law's own"), said


WHATS = (*JUMPS, "all", "chance")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=1000, metavar="N", help="of the walk, about (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    asked, found = parser.parse_args(), 0
    for what in WHATS:
        wrong, said = broken(what, asked.steps, asked.seed)
        found += wrong is not None
        print(f"{what}: {wrong or said}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
