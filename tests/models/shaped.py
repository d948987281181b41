#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Compares shaped plays of the C player (exact law) with the model of the page (tests/models/shaping.py), on motion areas by chance.

    tests/models/shaped.py [--first SEED] [--count N]     2,000 areas by default; exit code 1 when one differs

What is set changes at any tick. The model says for every step where each joint ends and how long the step ideally is; the player
says when it looked at the step, so the model is asked with what was in force then. Equal means: at a step's last tick every joint of the step stands
on the model's position, every step has its length to one tick, no joint leaves the way between two way-points, no tick is idle.
"""

import argparse
import itertools
import random
import sys
from fractions import Fraction

from tests.models import classic_law, shaping
from tests.models.played import ENDED, EXACT, JOINTS, OUTPUT, STEP, Played

ALL = 0x7FFFFFFF
LIMIT = 1500
LOOK_AHEAD = 7  # a step is looked at up to 6 ticks before the previous one begins; a setting made after a tick counts from the next


def page_by_chance(chance, steps, pages):
    page = bytearray(512)
    page[15], page[16] = chance.choice((1, 1, 2)), chance.choice((0x0A, 0x0A, 0))
    page[17], page[18] = chance.choice((0, *pages)), chance.choice((0, *pages))
    page[20], page[22], page[24] = steps, chance.choice((32, 32, 20, 64)), chance.choice((0, 2, 4, 8, 32))
    page[25] = chance.choice(pages)
    for step in range(1, steps + 1):
        for joint in range(31):
            word = 0x4000 if chance.random() < 0.1 else chance.randrange(1024) if chance.random() < 0.3 else 512 + chance.randint(-90, 90)
            page[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = word.to_bytes(2, "little")
        page[64 * step + 62], page[64 * step + 63] = chance.choice((0, 0, 0, 3, 17)), chance.randint(6, 60)
    page[31] = (0xFF - sum(page)) % 256
    return page


def area_by_chance(chance):
    image, pages = bytearray(65536), chance.sample(range(1, 128), 4)
    steps = chance.randint(1, 7)
    for number in pages:
        image[512 * number : 512 * number + 512] = page_by_chance(chance, steps if chance.random() < 0.8 else chance.randint(1, 7), pages)
    if chance.random() < 0.1:
        image[512 * pages[-1] + 100] ^= 1  # damaged: cannot be a partner, and a play ends there
    return bytes(image), pages


def change_by_chance(chance, pages):
    """Returns a call of Played.shape; apply() makes the same change to the model."""
    kind = chance.choice(("rate", "amplitude", "blend", "centre", "reset", "voltage"))
    if kind == "rate":
        return kind, chance.choice((10, 50, 75, 100, 130, 200, 400))
    if kind == "amplitude":
        return kind, chance.choice((0, 1, 60, 100, 120, 150)), chance.choice((ALL, chance.randrange(1, ALL)))
    if kind == "blend":
        return kind, chance.choice((-100, -37, 0, 1, 50, 100))
    if kind == "centre":
        return kind, chance.choice((*pages, 0))
    return (kind,) if kind == "reset" else (kind, chance.choice((96, 111, 120)))


def apply(shape, kind, *values):
    """Returns the model's Shape after a change, as a new object."""
    made = shaping.Shape(shape.blend, dict(shape.amplitude), shape.rate, shape.centre_page, shape.volts)
    if kind == "amplitude":
        made.amplitude.update({j: values[0] for j in range(JOINTS) if values[1] >> j & 1})
    elif kind == "reset":
        made.blend, made.amplitude, made.rate = 0, {}, 100
    else:
        setattr(
            made,
            {"rate": "rate", "blend": "blend", "centre": "centre_page", "voltage": "volts"}[kind],
            Fraction(values[0], 10) if kind == "voltage" else values[0],
        )
    return made


def model_pose(image, place, shape):
    """Returns the shaped pose. Centre page 0 means that nothing is scaled."""
    if shape.centre_page == 0:
        scaled = shaping.Shape(shape.blend, {}, shape.rate, place[0], shape.volts)
        page = classic_law.Page(image, place[0])
        other = shaping.partner(image, page, shape.blend)
        return {
            j: shaping.shaped_position(
                page.word(place[1], j),
                None if other is None or not shaping.used(other.word(place[1], j)) else other.word(place[1], j),
                None,
                scaled.blend,
                100,
            )
            for j in range(JOINTS)
            if shaping.used(page.word(place[1], j))
        }
    return shaping.shaped_pose(image, place[0], place[1], shape)


class Check:
    """Follows a play tick by tick and checks it."""

    def __init__(self, image, pose):
        self.image, self.target = image, list(pose)
        self.steps = []  # (page and step, first tick, goals before it)
        self.ticks = []  # goals of each tick; None: no output
        self.shapes = []  # the shape in force at each tick
        self.shaped_before = {False}  # whether the last step may have been a shaped one
        self.before = list(pose)
        self.trace = []  # goals of the running step, tick by tick; None: no output

    def candidates(self, tick, begun_at):
        """Returns the shapes of which one was in force when the step was looked at. begun_at: LOOK_AHEAD ticks before the start of the
        step before."""
        seen = []
        for shape in self.shapes[max(0, begun_at) : tick + 1]:
            if shape not in seen:
                seen.append(shape)
        return seen

    def step_ends(self, place, ticks, goals, shapes):
        """Compares the end of a step with the model. Returns the fault or None."""
        page, found, fitting = classic_law.Page(self.image, place[0]), [], set()
        for shape, after_shaped in itertools.product(shapes, self.shaped_before):
            pose = model_pose(self.image, place, shape)
            wrong = [f"joint {j} at {goals[j]}, model {to}" for j, to in pose.items() if goals[j] != to]
            longest = max((abs(to - self.target[j]) for j, to in pose.items()), default=0)
            ideal = max(shaping.ideal_step(page, place[1], longest, shape, after_shaped), Fraction(1)) + shaping.ideal_pause(page, place[1], shape)
            slack = Fraction(2) + (ideal / 60 if shape.is_set() or after_shaped else 0)  # the top speed is kept to 1/16 unit per tick
            if not wrong and abs(ticks - ideal) > slack:
                wrong = [f"{ticks} ticks, model {float(ideal):.2f}"]
            wrong = wrong or self.on_the_way(pose, ideal - shaping.ideal_pause(page, place[1], shape))
            if wrong:
                found.append(wrong[0])
            else:
                fitting.add(shape.is_set())
        self.shaped_before = fitting
        return None if fitting else f"page {place[0]} step {place[1]}: {found}"

    def on_the_way(self, pose, ideal):
        """Checks that no joint passes the way-points on either side of the step, and that no tick is idle."""
        wrong = [
            f"joint {j} passes its way-point: {row[j]}"
            for row in self.trace
            if row
            for j, to in pose.items()
            if not min(self.target[j], to) <= row[j] <= max(self.target[j], to)
        ]
        if sum(row is not None for row in self.trace) < int(ideal) - 1:
            wrong.append(f"idle ticks: {sum(row is None for row in self.trace)}")
        return wrong

    def follow(self, play, shape, changes, limit=LIMIT):
        """Plays on, tick by tick. Returns the fault or None. changes(events) returns the changes to make after this tick, as
        Played.shape takes them."""
        for tick in range(limit):
            self.shapes.append(shape)
            events = play.tick()
            goals = play.goals()
            if events & STEP or events & ENDED:
                if self.steps and not (events & ENDED and not events & STEP and events & OUTPUT):
                    place, begun = self.steps[-1][:2]
                    since = self.steps[-2][1] - LOOK_AHEAD if len(self.steps) > 1 else 0
                    wrong = self.step_ends(place, tick - begun, self.before, self.candidates(tick, since))
                    if wrong:
                        return f"tick {tick}: {wrong}"
                    self.target, self.trace = list(self.before), []
                if events & STEP:
                    self.steps.append((play.place(), tick, list(self.before)))
            self.before = list(goals)
            self.trace.append(self.before if events & OUTPUT else None)
            self.ticks.append(self.trace[-1])
            if events & ENDED:
                break
            for change in changes(events):
                play.shape(*change)
                shape = apply(shape, *change)
        return None


def first_difference(seed):
    """Returns the fault or None."""
    chance = random.Random(seed)
    image, pages = area_by_chance(chance)
    pose = [chance.randrange(1024) for _ in range(JOINTS)]
    shape, changes = shaping.Shape(volts=Fraction(0)), []
    for _ in range(chance.randint(0, 3)):
        changes.append(change_by_chance(chance, pages))
        shape = apply(shape, *changes[-1])
    if shape.volts == 0:
        changes.append(("voltage", 111))
        shape = apply(shape, "voltage", 111)
    play = Played(image, pages[0], EXACT, ALL, dict(enumerate(pose)), shape=[("reset",), *changes])
    if not play.started:
        return None
    return Check(image, pose).follow(play, shape, lambda events: [change_by_chance(chance, pages)] if chance.random() < 0.03 else [])


def compare(first, count):
    """Returns [(seed, difference)]."""
    found = [(seed, first_difference(seed)) for seed in range(first, first + count)]
    return [(seed, what) for seed, what in found if what]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=1, metavar="SEED")
    parser.add_argument("--count", type=int, default=2_000, metavar="N")
    asked = parser.parse_args()
    different = compare(asked.first, asked.count)
    for seed, what in different[:20]:
        print(f"seed {seed}: {what}")
    print(f"{asked.count} motion areas by chance from seed {asked.first}: {len(different)} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
