#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Everything at once, by chance: a shape that changes, a second page, motion made by code, pause, stop, break and lost joints, over steps of
1 to 40 ticks under both laws (mixed_cases.py). No model of the whole is needed: what the page of the spec calls equal is played twice.

    tests/models/mixed.py [--first SEED] [--count N]      10,000 cases by default; exit code 1 when a check objects
    tests/models/mixed.py --seed SEED                     this case alone, with the fewest actions to which the same check objects

Checks (mixed_checks.py):
bytes      A shaped play goes as a play of pages that hold the shaped positions (tests/models/shaping.py), bit by bit: goals of all joints,
           events. So each step was shaped once, whatever was set behind the look, and was planned like any other.
layers     Without its second page and without motion by code the main play has the same timing, and the joints that were never lent have
           the same goals, bit by bit.
hands      A joint that gets another source keeps to the speed of the hand-over until it meets that source: on a page layer, until it has
           completed the layer's first step; back in the main play, until it has the goals of the play without layers, which it keeps. What
           code aims gets there at that speed and stays; a swing is not faster than it may be.
nothing    With nothing set every goal is that of a program without shape and layers.
lengths    Exact law: each step ends on the model's positions, with the model's length; no joint leaves its way.
pauses     A pause changes the step it comes in and no other. It stands in time, nothing turns round on the way and nothing moves in it. So
           does a break.
"""

import argparse
import collections
import sys

from tests.models import mixed_cases
from tests.models.mixed_cases import play
from tests.models.mixed_checks import CHECKS

SHOWN = 20


def first_objection(case, checks=tuple(CHECKS)):
    """Returns None, or (check, fault)."""
    run = play(case)
    for name in checks if run else ():
        wrong = CHECKS[name](case, run)
        if wrong:
            return name, wrong
    return None


def shrunk(case, check):
    """Removes every action without which the check still objects. Returns the case."""
    for action in list(case.actions):
        actions = case.actions
        case.actions = [other for other in actions if other is not action]
        if not first_objection(case, [check]):
            case.actions = actions
    return case


def objections(first, count):
    """Returns [(seed, check, fault)]."""
    found = ((seed, first_objection(mixed_cases.case_by_chance(seed))) for seed in range(first, first + count))
    return [(seed, *said) for seed, said in found if said]


def tell(seed):
    case = mixed_cases.case_by_chance(seed)
    said = first_objection(case)
    if said:
        case = shrunk(case, said[0])
        said = first_objection(case, [said[0]])
        print(f"{'classic' if case.law else 'exact'}, page {case.page}, joints {case.present:08X}, before: {case.before}")
        print("".join(f"  {action}\n" for action in case.actions) + f"{said[0]}: {said[1]}")
    else:
        print(f"seed {seed}: no objection")
    return 1 if said else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=1, metavar="SEED")
    parser.add_argument("--count", type=int, default=10_000, metavar="N")
    parser.add_argument("--seed", type=int, metavar="SEED")
    asked = parser.parse_args()
    if asked.seed is not None:
        return tell(asked.seed)
    found = objections(asked.first, asked.count)
    for seed, check, what in found[:SHOWN]:
        print(f"seed {seed}, {check}: {what}")
    each = ", ".join(f"{check} {count}" for check, count in collections.Counter(check for _, check, _ in found).items())
    print(f"{asked.count} cases by chance from seed {asked.first}: {len(found)} objections" + (f" ({each})" if each else ""))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
