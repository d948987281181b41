#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Lays a second page over a walk at every tick of it and takes it away again at every tick, and says what becomes of every joint.

    tests/models/hand_over.py [--laws exact classic] [--offs N] [--chance N]

Shown, by the page of the spec alone ("Layers", and the exact law's rules 2 and 3):
* the joints that the layer does not take have the goals of the walk without it, bit by bit;
* a joint that changes hands goes at the approach speed at most: however many ticks one looks at, never farther than that speed allows, until it has
  completed its new owner's first step and stands on that owner's way;
* from then on it lies between the way-points of its owner's step and goes at less than twice the mean speed of the step, so it does not leap;
* when the layer is over it goes back at that speed until it meets the walk, and has its goals from then on, bit by bit.
--offs: of every tick after the first of the layer (default: all). --chance: besides, so many walks with pages, joints and moments by chance.
"""

import argparse
import bisect
import ctypes
import random
import sys
from array import array
from dataclasses import dataclass

from m512.files.formats import load
from tests.models.played import CLASSIC, ENDED, EXACT, GOALS, JOINTS, STEP, TOP, library

ROBOT = sum(1 << joint for joint in (*range(1, 21),))
LAWS = {"exact": EXACT, "classic": CLASSIC}
UNITS_A_TICK = 1024 / 300 / 128  # units per tick for 1 degree/s
APPROACH_DEG_S = 60
WARM_UP, CYCLE = 96, 56  # ticks: the walk has begun its loop by then; the length of the loop, and the number of starts
DEPTH = 160  # the latest end of a layer in ticks after its start: more than two of its steps
SETTLES = 460  # ticks to return from the farthest position, plus the joint's next steps


@dataclass
class Run:
    """A recording. columns[joint][tick]: goals. steps, layer_steps: (first tick, page, step). layer_ended: last tick; None: cut off."""

    columns: list
    steps: list
    layer_steps: list
    layer_ended: int


class Walk:
    """A page of an image, played from its own first pose."""

    def __init__(self, image, page, law, pose, joints=ROBOT):
        self.image, self.page, self.law, self.joints, self.pose = bytes(image), page, law, joints, GOALS(*pose)

    def run(self, ticks, *actions):
        """Plays `ticks` ticks. actions: (tick, function); the function is called after that many ticks."""
        library.played_load(self.image)
        library.played_call(0)
        assert library.played_start(self.law, self.page, self.joints, self.pose) == 0
        goals, events, places = (ctypes.c_uint16 * (JOINTS * ticks))(), (ctypes.c_uint8 * (2 * ticks))(), (ctypes.c_uint8 * (4 * ticks))()
        made = 0
        for until, action in (*actions, (ticks, lambda: None)):
            library.played_run(made, until - made, ticks, goals, events, places)
            made = until
            action()
        flat = array("H", bytes(goals))
        begins = [
            [(tick, places[4 * tick + 2 * which], places[4 * tick + 2 * which + 1]) for tick in range(ticks) if events[2 * tick + which] & STEP]
            for which in (0, 1)
        ]
        ended = next((tick for tick in range(ticks) if events[2 * tick + 1] & ENDED), None)
        return Run([flat[joint * ticks : (joint + 1) * ticks] for joint in range(JOINTS)], *begins, ended)


def word(image, page, step, joint):
    at = 512 * page + 64 * step + 2 * joint
    return image[at] | image[at + 1] << 8


def step_ticks(image, page, step):
    """Returns the length of a step in time base without pauses; all pages here are so."""
    return image[512 * page + 64 * step + 63] * image[512 * page + 22] // 32


def bounded_until(row, begin, per_tick):
    """Returns the last tick up to which the joint keeps to the speed between any two ticks from `begin` on."""
    # row[b] - row[a] <= per_tick (b - a) + 1 for all a < b, in both directions: it is enough to keep the extreme lines.
    above = below = None
    for tick in range(begin, len(row)):
        up, down = row[tick] - per_tick * tick, row[tick] + per_tick * tick
        above, below = up if above is None else min(above, up), down if below is None else max(below, down)
        if up > above + 1.001 or down < below - 1.001:
            return tick - 1
    return len(row) - 1


def owned(row, steps, way_points, begin, end):
    """Returns what is wrong with a joint under its owner in ticks begin..end-1, or None: outside its range, or faster than twice the
    mean."""
    firsts = [step[0] for step in steps]
    for tick in range(begin, end):
        k = bisect.bisect_right(firsts, tick) - 1
        if k < 1 or k + 1 >= len(steps):
            continue
        low, high = sorted(way_points[k - 1 : k + 1])
        ticks = firsts[k + 1] - firsts[k]
        if not low <= row[tick] <= high:
            return f"tick {tick}: at {row[tick]}, beside its owner's way {low}..{high}"
        if abs(row[tick] - row[tick - 1]) > 2 * (high - low) / ticks + 2:
            return f"tick {tick}: {abs(row[tick] - row[tick - 1])} units in a tick of a step of {high - low} in {ticks}"
    return None


def first_step_behind(steps, tick):
    """Returns (first tick, tick after the last) of the first step that begins after this tick."""
    k = bisect.bisect_right([step[0] for step in steps], tick)
    return (steps[k][0], steps[k + 1][0]) if k + 1 < len(steps) else (None, None)


def check_hand_over(row, steps, at, end, per_tick):
    """Checks a joint that changes hands after tick `at`. Returns (fault or None, first tick at which it is no longer held back)."""
    free = bounded_until(row[:end], at, per_tick) + 1
    behind = first_step_behind(steps, at)[1]
    if free < end and (behind is None or free < behind):
        return f"tick {free}: faster than the approach in its new owner's first step, {row[free - 1]} -> {row[free]}", free
    return None, free


def check_return(row, source, at, end, per_tick):
    """Checks a joint that returns to the walk after tick `at`. Until it meets the walk without a layer it keeps to the speed; from then
    on it equals that walk. Returns the fault or None."""
    met = end = min(end, len(row), len(source))
    while met > at + 1 and row[met - 1] == source[met - 1]:
        met -= 1
    free = bounded_until(row[:met], at, per_tick) + 1
    if free < met:
        return f"tick {free}: faster than the approach, {row[free - 1]} -> {row[free]}"
    if met < end and abs(row[met] - row[met - 1]) > max(per_tick + 1, abs(source[met] - source[met - 1])):
        return f"tick {met}: leaps from {row[met - 1]} to the walk at {row[met]}"
    return None


def check(image, law, plain, run, joints, on, off, per_tick):
    """Checks a walk with a layer from after tick `on` to after tick `off` (None: it ended by itself). Returns the fault or None."""
    for joint in range(JOINTS):
        if joint not in joints and run.columns[joint] != plain.columns[joint]:
            return f"joint {joint} is no joint of the layer and goes otherwise"
    ended = off if off is not None else run.layer_ended
    for joint in joints:
        row = run.columns[joint]
        places = [word(image, page, step, joint) for _, page, step in run.layer_steps]
        last = run.layer_steps[-1]
        steps = [*run.layer_steps, (last[0] + step_ticks(image, *last[1:]), 0, 0)]
        wrong, free = check_hand_over(row, steps, on, ended + 1, per_tick)
        wrong = wrong or owned(row, steps, places, free, ended + 1)
        if wrong:
            return f"joint {joint}, to the layer: {wrong}"
        wrong = check_return(row, plain.columns[joint], ended, len(row), per_tick)
        if wrong:
            return f"joint {joint}, back to the walk: {wrong}"
        if row[-CYCLE // 2 :] != plain.columns[joint][-CYCLE // 2 :]:
            return f"joint {joint} does not come back to the walk"
    return None


def lay(walk, plain, page, joints, on, off, deg_s=APPROACH_DEG_S):
    """Plays one walk with a layer. Returns the fault or None."""

    def come():
        mask = sum(1 << joint for joint in joints)
        assert library.played_layer(page, mask, deg_s) == 0

    run = walk.run(len(plain.columns[0]), (on + 1, come), *([(off + 1, library.played_layer_off)] if off is not None else []))
    return check(walk.image, walk.law, plain, run, joints, on, off, deg_s * UNITS_A_TICK)


# --- our walk, every tick ---

LAYERS = {"wave_over": (1, 3, 5), "look": (19, 20)}


def every_tick(law, name, ons=range(CYCLE), offs=range(1, DEPTH)):
    """Plays our walk with one of our layers, which starts at tick WARM_UP + each of `ons`. Returns (walks, faults)."""
    made = load(TOP / "tools" / "motions" / "motions.m512")
    ready = made[made.find("ready")]
    pose = [ready.word(0, joint) if joint in range(1, 19) else 512 for joint in range(JOINTS)]
    walk = Walk(made.to_bytes(), made.find("walk"), LAWS[law], pose)
    ticks, found, walks = WARM_UP + CYCLE + DEPTH + SETTLES, [], 0
    plain = walk.run(ticks)
    for on in ons:
        for depth in offs:
            wrong = lay(walk, plain, made.find(name), LAYERS[name], WARM_UP + on, WARM_UP + on + depth)
            walks += 1
            if wrong:
                found.append(f"{law}, {name} from tick {WARM_UP + on} for {depth} ticks: {wrong}")
    return walks, found


# --- pages by chance ---


def sealed(page):
    page[31] = (0xFF - sum(page)) % 256
    return page


def page_by_chance(chance, steps, next_page, ticks, joints, spread):
    page = bytearray(512)
    page[15], page[16], page[20], page[22], page[24], page[25] = 1, 10, steps, 32, chance.choice((0, 2, 4, 8, 32)), next_page
    for step in range(1, 8):
        for joint in range(31):
            place = max(0, min(1023, 512 + chance.randint(-spread, spread))) if joint in joints else 0x4000
            page[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = place.to_bytes(2, "little")
        page[64 * step + 63] = chance.randint(*ticks)
    return sealed(page)


def by_chance(seed):
    """Plays a random walk with a random layer, joints and moments. Returns the fault or None."""
    chance = random.Random(f"hand_over {seed}")
    image, everybody = bytearray(65536), list(range(1, 21))
    image[512:1024] = page_by_chance(chance, chance.randint(2, 7), 1, (4, 20), everybody, 120)
    joints = sorted(chance.sample(everybody, chance.randint(1, 6)))
    ends = chance.random() < 0.4
    image[1024:1536] = page_by_chance(chance, chance.randint(1, 5), 0 if ends else 2, (4, 60), everybody, 250)
    law, deg_s = chance.choice(("exact", "exact", "classic")), chance.choice((20, 60, 60, 120))
    walk = Walk(image, 1, LAWS[law], [512] * JOINTS)
    on = chance.randrange(60, 200)
    off = None if ends else on + chance.randrange(1, 300)
    plain = walk.run(2400)
    wrong = lay(walk, plain, 2, joints, on, off, deg_s)
    return f"seed {seed}, {law}, {deg_s} degrees/s, joints {joints}, ticks {on} to {off}: {wrong}" if wrong else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--laws", nargs="+", choices=sorted(LAWS), default=sorted(LAWS))
    parser.add_argument("--offs", type=int, default=DEPTH - 1, metavar="N")
    parser.add_argument("--chance", type=int, default=1000, metavar="N")
    asked, bad = parser.parse_args(), []
    for law in asked.laws:
        for name in LAYERS:
            walks, found = every_tick(law, name, offs=random.Random(1).sample(range(1, DEPTH), asked.offs))
            print(f"{law}, {name}: {walks} walks, {len(found)} wrong" + "".join(f"\n  {said}" for said in found[:5]), flush=True)
            bad += found
    found = [said for said in map(by_chance, range(asked.chance)) if said]
    print(f"by chance: {asked.chance} walks, {len(found)} wrong" + "".join(f"\n  {said}" for said in found[:5]))
    return 1 if bad + found else 0


if __name__ == "__main__":
    sys.exit(main())
