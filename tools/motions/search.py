#!/usr/bin/env -S sh -c 'exec "${0%/*}/../dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Finds the numbers of gait.json in physics, by CMA-ES (the library `cma`): walk, back, spin or side.

    tools/motions/search.py walk --generations 40        takes gait.json as the start, and writes it when it has found better
    tools/motions/search.py spin --target 36 --scheduler tcp://HOST:8786

A set of numbers is tried on the nominal body and on bodies by chance (tools/body) that are worse than real ones: servo zeros
1.7 times as wrong, a push every four seconds, a remote that turns and stops. On real ones a good gait falls too seldom to tell it
from a better one. What counts is falls, then how far the body tilts; less speed than the target, a wrong heading and
too much torque cost too. Every few generations the bodies change; those on which the best set fell stay. Needs
`tools/dev/setup physics search` and a build. The slopes (`slope`, `hip_slope`) stay as they are: try them one by one.
"""

import argparse
import json
import math
import pathlib
import random
from dataclasses import asdict, replace

from body.chance import random_body, with_zeros_of
from body.description import load
from body.trial import STOP, try_motion
from campaign import each
from m512.files.text import read_text
from motions import gait

HERE = pathlib.Path(__file__).resolve().parent

# Numbers that may vary, and their ranges.
RANGES = {
    "stride": (-50, 50),
    "side": (-5, 40),
    "turn": (-2, 20),
    "sway": (5, 40),
    "sway_lead": (-0.12, 0.15),
    "step_lead": (-0.1, 0.1),
    "swing": (0.28, 0.5),
    "lift": (6, 35),
    "square": (0.2, 1.2),
    "height": (104, 146),
    "lean": (-6, 18),
    "ahead": (-18, 20),
    "apart": (-8, 20),
    "spread": (-4, 16),
    "toes": (-8, 8),
    "arms": (0, 1.2),
}
FIXED = {"walk": ("side", "turn"), "back": ("side", "turn"), "spin": ("side",), "side": ("turn",)}
FIRST_PAGE = {"walk": 20, "back": 27, "spin": 32, "side": 34}
TARGETS = {"walk": 165.0, "back": 80.0, "spin": 36.0, "side": 60.0}  # mm/s, degrees/s
SECONDS, STOP_S, NOMINAL_S = 8.0, 5.8, 6.0
PUSHES = 2
ZEROS = 1.7  # factor on the zero errors of a random body
FALL = 100.0  # cost of an immediate fall, in degrees of tilt
TILT_RANK = 0.97  # quantile of the tilts of a trial that counts
MOST_UNITS_PER_TICK = 8  # of a single goal, in whole units; the mean is 90 % of what an AX-12 does at 11.1 V
MOST_NM = 0.4
UP, RIGHT = 1, 8
KEYS = {"walk": ((0, UP), (3, RIGHT), (5.2, UP))}  # the others continue without keys


def image_of(gaits):
    """The pages of these gaits as 65,536 bytes. ValueError: a foot is out of reach."""
    return read_text(gait.text(gaits), "walk.m512", HERE).to_bytes()


def short_of(kind, outcome, target):
    """Cost of the nominal body's deficits, in degrees of tilt."""
    ways = {"walk": outcome.forward_mm_s, "back": -outcome.forward_mm_s, "spin": -outcome.turn_deg_s, "side": -outcome.sideways_mm_s}
    astray = {
        "walk": 3 * abs(outcome.turn_deg_s),
        "back": 3 * abs(outcome.turn_deg_s),
        "side": 3 * abs(outcome.turn_deg_s) + abs(outcome.forward_mm_s),
        "spin": math.hypot(outcome.forward_mm_s, outcome.sideways_mm_s),
    }
    return (
        max(0.0, 1 - ways[kind] / target) * 120
        + max(0.0, astray[kind] - 1)
        + max(0.0, outcome.most_torque_nm - MOST_NM) * 100
        + max(0.0, outcome.most_units_per_tick - MOST_UNITS_PER_TICK) * 10
    )


def shaken(outcome):
    """Cost of a body's trial, in degrees of tilt."""
    if outcome.fell_s is not None:
        return FALL * (1 - 0.4 * min(1.0, outcome.fell_s / SECONDS))
    tilts = sorted(math.degrees(math.acos(min(1.0, look.upright))) for look in outcome.track)
    return tilts[int(TILT_RANK * len(tilts))]


def worse_body(robot, seed):
    body = random_body(robot, seed, seconds=STOP_S, pushes=PUSHES)
    return with_zeros_of(body, {servo: ZEROS * units for servo, units in body.zero_units.items()})


def trial(work):
    """(cost, bodies that fell) of one set of numbers: (kind, gaits, target, seeds)."""
    kind, gaits, target, seeds = work
    robot = load("humanoid")
    try:
        image = image_of(gaits)
    except ValueError:  # a foot is out of reach
        return 4 * FALL, ()
    outcome = try_motion(image, FIRST_PAGE[kind], NOMINAL_S, robot)
    if outcome.fell_s is not None:  # skips the other bodies
        return 3 * FALL, ()
    total, fell = 0.0, []
    for seed in seeds:
        keys = (*KEYS.get(kind, ()), (STOP_S, STOP))
        of_body = try_motion(image, FIRST_PAGE[kind], SECONDS, robot, worse_body(robot, seed), keys=keys)
        total += shaken(of_body)
        fell += [seed] if of_body.fell_s is not None else []
    return total / len(seeds) + short_of(kind, outcome, target), tuple(fell)


class Numbers:
    """Converts between a set of numbers and the optimiser's vector: each number is a logistic function within its range."""

    def __init__(self, kind, start):
        self.start = start
        self.names = [name for name in RANGES if name not in FIXED[kind]]

    def of(self, vector):
        values = {name: RANGES[name][0] + (RANGES[name][1] - RANGES[name][0]) / (1 + math.exp(-x)) for name, x in zip(self.names, vector)}
        return replace(self.start, **{name: round(value, 3) for name, value in values.items()})

    def vector(self):
        parts = [(getattr(self.start, name) - RANGES[name][0]) / (RANGES[name][1] - RANGES[name][0]) for name in self.names]
        return [math.log(part / (1 - part)) for part in (min(0.97, max(0.03, part)) for part in parts)]


def write(gaits, path):
    path.write_text(json.dumps({name: asdict(one) for name, one in gaits.items()}, indent=1) + "\n", encoding="utf-8")


def search(options):
    """Writes options.output whenever it finds better numbers than those at the start. Returns the best. Compares numbers on the same
    bodies: when these change, it tries the best so far again."""
    import cma

    gaits = gait.numbers()
    best, hard = gaits[options.kind], []
    space, chance = Numbers(options.kind, best), random.Random(options.seed)
    strategy = cma.CMAEvolutionStrategy(space.vector(), options.sigma, {"seed": options.seed, "popsize": options.population, "verbose": -9})
    for generation in range(options.generations):
        fresh = generation % options.keep == 0
        if fresh:
            seeds = (hard + [chance.randrange(1 << 30) for _ in range(options.bodies)])[: options.bodies]
        vectors = strategy.ask()
        tried = [space.of(vector) for vector in vectors] + ([best] if fresh else [])
        work = [(options.kind, gaits | {options.kind: one}, options.target, seeds) for one in tried]
        found = each(trial, work, f"generation {generation + 1}", options.jobs, options.scheduler)
        strategy.tell(vectors, [cost for cost, _ in found[: len(vectors)]])
        if fresh:
            least, hard = found[-1][0], list(found[-1][1])
        cost, fell = min(found[: len(vectors)])
        if cost < least:
            least, hard, best = cost, list(fell), tried[[of_one for of_one, _ in found].index(cost)]
            write(gaits | {options.kind: best}, options.output)
        hard = hard[: options.bodies // 2]
        print(f"generation {generation + 1}: cost {cost:.1f}, {len(fell)} of {len(seeds)} bodies fall; the best so far {least:.1f}", flush=True)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=list(TARGETS))
    parser.add_argument("--target", type=float, help="mm/s, or degrees/s for spin")
    parser.add_argument("--generations", type=int, default=40)
    parser.add_argument("--population", type=int, default=12)
    parser.add_argument("--bodies", type=int, default=20, help="by chance, besides the nominal one")
    parser.add_argument("--keep", type=int, default=4, help="generations that the same bodies stay")
    parser.add_argument("--sigma", type=float, default=0.3, help="how far it looks at first")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=pathlib.Path, default=HERE / "gait.json", metavar="FILE", help="default: gait.json")
    parser.add_argument("--jobs", type=int, help="processes at once (default: one a core)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask scheduler whose workers do it")
    options = parser.parse_args()
    options.target = TARGETS[options.kind] if options.target is None else options.target
    search(options)


if __name__ == "__main__":
    main()
