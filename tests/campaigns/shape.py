# SPDX-License-Identifier: MIT
"""The shipped Play image on the simulated board walks a body in MuJoCo. `@drive` changes the motion twenty times a second, as a joystick
would. The bodies are random: friction 0.5..1.1, 9.6..12 V, masses +-15 %, joints off by 1.5 units, a floor tilted by up to 2 degrees,
varied servo friction and rotor. With --hard they are those of the part physics, whose servo zeros are off by a degree as well.
Physics is a model, and no real robot has walked our motions yet."""

import functools
import random

from body.chance import NOMINAL, body_of_the_bench, random_body
from body.description import load
from body.trial import pace
from motions import promises
from tests.campaigns import proof
from tests.campaigns.driven import Eight, Stick, drive, rounds

TITLE = "Driven motions in physics"
PROMISE = "A walk stays a walk while its speed, size and direction change, while a second page plays over it, and when the cable is pulled."

HEAD = load("humanoid", head=True)
CYCLE_S = 56 / 128  # of the walk at rate 100 (walk_r and walk_l)
SEGMENT_S, SETTLES_S = 12, 5  # duration of each value; figures use only the time after SETTLES_S
VALUES = {"rate": (50, 75, 100, 125, 150), "amplitude": (0, 30, 60, 90, 120), "blend": (-100, -50, 0, 50, 100)}
STRAIGHT = {"blend": 0, "rate": 100, "amplitude": 100}
BODIES = 10
TOO_LONG_S = 20  # after the last line: one second until the watchdog acts, the exit page, and a margin


def add_arguments(group):
    group.add_argument("--only", choices=sorted(ROWS), help="this row alone")
    group.add_argument("--bodies", type=int, metavar="N", help=f"bodies by chance for each row (default: {BODIES})")
    group.add_argument("--seed-of", type=int, metavar="SEED", help="repeat this body alone; 0 is the nominal one")
    group.add_argument("--hard", action="store_true", help="bodies whose servo zeros are off, too")


def body_of(seed, robot, hard=False):
    """Returns the body for a seed. Seed 0 is the nominal body."""
    return (random_body if hard else body_of_the_bench)(robot, seed) if seed else NOMINAL


class Walk:
    """The library's walk, driven by `hand`. Is pickled for each job."""

    def __init__(self, hard):
        self.hard, self.image = hard, promises.IMAGE
        self.page, self.ready = promises.LIBRARY.find("walk"), promises.LIBRARY.find("ready")

    def driven(self, seed, seconds, hand, **how):
        robot = how.pop("robot", promises.ROBOT)
        return drive(self.image, self.page, self.ready, seconds, hand, robot, body_of(seed, robot, self.hard), **how)


# --- one value after another ---


def order_by_chance(kind, seed):
    """Returns the values in this body's random order."""
    values = list(VALUES[kind])
    random.Random(f"order {kind} {seed}").shuffle(values)
    return values


def swept(walk, kind, seed):
    """Returns (message if the robot fell, {value: (mm/s, mm per cycle, degrees per cycle)})."""
    order = order_by_chance(kind, seed)
    stick = Stick(**STRAIGHT | {kind: order[0]})

    def hand(seen):
        wish = STRAIGHT | {kind: order[min(int(seen.time_s / SEGMENT_S), len(order) - 1)]}
        return stick.towards(wish["blend"], wish["rate"], wish["amplitude"])

    outcome = walk.driven(seed, SEGMENT_S * len(order), hand)
    figures = {}
    for k, value in enumerate(order):
        looks = [seen for seen in outcome.track if k * SEGMENT_S + SETTLES_S <= seen.time_s < (k + 1) * SEGMENT_S]
        forward, _, turn = pace(looks)
        cycle_s = CYCLE_S * 100 / (value if kind == "rate" else 100)
        figures[value] = forward, forward * cycle_s, turn * cycle_s
    return None if outcome.fell_s is None else outcome.said(), figures


LOOKS_AT = {"rate": (0, "mm/s", 1), "amplitude": (1, "mm a cycle", 1), "blend": (2, "degrees a cycle", -1)}


def sweep_figures(walk, kind, seeds, options):
    seeds = [0, *[seed for seed in seeds if seed]]
    results = proof.each(functools.partial(swept, walk, kind), seeds, kind, options.jobs)
    fallen = [(seed, said) for seed, (said, _) in zip(seeds, results) if said]
    which, unit, sign = LOOKS_AT[kind]
    means = [sum(figures[value][which] for _, figures in results) / len(results) for value in VALUES[kind]]
    steady = [
        all(sign * low[which] < sign * high[which] for low, high in zip(row, row[1:]))
        for row in ([figures[value] for value in VALUES[kind]] for _, figures in results)
    ]
    lowest, highest = VALUES[kind][0], VALUES[kind][-1]
    how = f"60 s on the nominal body and {len(seeds) - 1} by chance, a value for {SEGMENT_S} s, in any order; the stick goes 50 % a second"
    values = ", ".join(f"{value}: {mean:.0f}" for value, mean in zip(VALUES[kind], means))
    return [
        proof.Figure(f"{kind} {lowest}..{highest} %: no fall.", how, f"{len(fallen)} of {len(seeds)} fall" + told(fallen), not fallen),
        proof.Figure(
            f"More {kind}, more {unit}.",
            how,
            f"mean {unit} at {values}; rises without a break on {sum(steady)} of {len(seeds)} "
            "bodies, on the nominal one too" + ("" if steady[0] else ": NO"),
            steady[0] and all(sign * a < sign * b for a, b in zip(means, means[1:])),
        ),
    ]


def told(bad):
    """Returns the bodies that broke a promise, and how the first of them failed: ", seeds 3, 5; the first: ..."."""
    return f", seeds {', '.join(str(seed) for seed, _ in bad)}; the first: {bad[0][1]}" if bad else ""


# --- all values at once, and a pulled cable ---


def joyridden(walk, seed):
    """Changes all three values at any moment, then pulls the cable. Returns (kept, message)."""
    chance, stick, wish, until = random.Random(f"joyride {seed}"), Stick(), [0, 100, 100], [0.0]
    pulled_s = chance.uniform(6, 14)

    def hand(seen):
        if seen.time_s >= pulled_s:
            return None
        if seen.time_s >= until[0]:
            until[0] = seen.time_s + chance.uniform(0.1, 2)
            wish[:] = chance.randint(-100, 100), chance.randint(50, 150), chance.randint(0, 120)
        return stick.towards(*wish)

    outcome = walk.driven(seed, pulled_s + TOO_LONG_S, hand)
    return outcome.ended and outcome.on_feet and outcome.fell_s is None, outcome.said() + ("" if outcome.ended else ", still walking")


def cable_figures(walk, seeds, options):
    results = proof.each(functools.partial(joyridden, walk), seeds, "cable", options.jobs)
    bad = [(seed, said) for seed, (kept, said) in zip(seeds, results) if not kept]
    return [
        proof.Figure(
            "The cable is pulled while the robot is driven: it ends its walk on its feet.",
            f"{len(results)} bodies by chance; blend, rate 50..150 and amplitude 0..120 change together for 6 to 14 s, then nothing comes any more",
            f"{len(results) - len(bad)} of {len(results)}" + told(bad),
            not bad,
        )
    ]


# --- the figure of eight ---


def rode_eight(walk, seed):
    hand = Eight()
    outcome = walk.driven(seed, 90, hand)
    left, right = (rounds(outcome.track, (0, side * hand.radius)) for side in (1, -1))
    eight = left > 0.9 and right < -0.9
    said = outcome.said() + f", {left:.1f} and {right:.1f} times round, at most {hand.farthest_mm:.0f} mm beside its path"
    return outcome.ended and outcome.on_feet and eight, said, hand.farthest_mm


def eight_figures(walk, seeds, options):
    results = proof.each(functools.partial(rode_eight, walk), seeds, "figure of eight", options.jobs)
    bad = [(seed, said) for seed, (kept, said, _) in zip(seeds, results) if not kept]
    beside = sorted(farthest for _, _, farthest in results)
    return [
        proof.Figure(
            "A figure of eight of 1 m by `@drive` alone, without a fall.",
            f"{len(results)} bodies by chance; who steers sees where the robot is; once round the middle of each circle",
            f"{len(results) - len(bad)} of {len(results)}; half of them stay within {beside[(len(beside) - 1) // 2]:.0f} mm of the "
            f"path, the worst within {beside[-1]:.0f}" + told(bad),
            not bad,
        )
    ]


# --- a second page over the walk ---

LAYERS = {"wave_over": (1, 3, 5), "look": (19, 20)}
WALK_S = 14


def laid_over(walk, numbers, item):
    """Returns (kept, message): compares the walk with a page layered over it to the same walk without."""
    name, seed = item
    robot, chance = HEAD if name == "look" else promises.ROBOT, random.Random(f"layer {name} {seed}")
    on_s, off_s = chance.uniform(1, 4), chance.uniform(8, 11)

    def walked(first, second):
        lines = [(on_s, first), (off_s, second), (WALK_S - 2, "stop")]
        return walk.driven(
            seed, WALK_S + TOO_LONG_S, lambda seen: lines.pop(0)[1] if lines and seen.time_s >= lines[0][0] else None, robot=robot, keep_goals=True
        )

    plain, laid = walked("version", "version"), walked(f"layer {numbers[name]}", "layer off")
    own = LAYERS[name]
    same = [{joint: goal for joint, goal in goals.items() if joint not in own} for goals in plain.goals] == [
        {joint: goal for joint, goal in goals.items() if joint not in own} for goals in laid.goals
    ]
    moved = any(len({goals.get(joint) for goals in laid.goals} - {None}) > 20 for joint in own)
    kept = laid.ended and laid.on_feet and laid.fell_s is None and same and moved
    return kept, laid.said() + ("" if same else ", other joints went otherwise") + ("" if moved else ", its own joints did not move")


def layer_figures(walk, seeds, options, name):
    numbers = {page: promises.LIBRARY.find(page) for page in LAYERS}
    results = proof.each(functools.partial(laid_over, walk, numbers), [(name, seed) for seed in seeds], name, options.jobs)
    bad = [(seed, said) for seed, (kept, said) in zip(seeds, results) if not kept]
    return [
        proof.Figure(
            f"Walking and `{name}`: no fall, and the goals of all joints but {', '.join(map(str, LAYERS[name]))} are those of the walk alone, "
            "bit by bit.",
            f"{len(results)} bodies by chance; the page comes and goes at any moment",
            f"{len(results) - len(bad)} of {len(results)}" + told(bad),
            not bad,
        )
    ]


ROWS = {
    **{kind: functools.partial(lambda kind, walk, seeds, options: sweep_figures(walk, kind, seeds, options), kind) for kind in VALUES},
    "cable": cable_figures,
    "eight": eight_figures,
    **{name: functools.partial(lambda name, walk, seeds, options: layer_figures(walk, seeds, options, name), name) for name in LAYERS},
}


SAMPLE = {"cable": 1, "look": 1}  # rows of a sample and their number of bodies; tests/models has samples of the other rows


def run(options):
    walk, figures = Walk(options.hard), []
    for row, make in ROWS.items():
        if options.only not in (None, row) or (options.sample and row not in SAMPLE):
            continue
        count = options.bodies or (SAMPLE[row] if options.sample else BODIES)
        seeds = [options.seed_of] if options.seed_of is not None else list(range(options.seed, options.seed + count))
        figures += make(walk, seeds, options)
    if options.only or options.bodies or options.seed_of is not None or options.hard:
        options.keep = False  # a partial run
    return figures
