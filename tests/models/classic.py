#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Compares the C player's classic law with the model of the page (tests/models/classic_law.py), on motion areas by chance.

    tests/models/classic.py [--first SEED] [--count N]     10,000 cases by default; exit code 1 when one differs

Equal means: the same calls have output, every goal of every joint is the same, the play ends in the same call.
"""

import argparse
import sys

from tests.models import classic_law, random_pages
from tests.models.played import CLASSIC, ENDED, OUTPUT, Played


def play_in_c(case):
    """Returns ([(call, goals)] with output, number of the last call), as random_pages.result does."""
    early = [code for tick, code in sorted(case.schedule.items()) if tick == 0 and code]
    play = Played(case.image, case.page, CLASSIC, case.joints, case.positions, case.call or 0, early)
    if not play.started:
        return [], 0
    sent, last = [], -1
    ids = [i for i in range(classic_law.JOINTS) if case.joints >> i & 1]
    for last in range(case.limit):
        if last and case.schedule.get(last):
            play.code(case.schedule[last])
        events = play.tick()
        if events & OUTPUT:
            goals = play.goals()
            sent.append((last, tuple(goals[i] for i in ids)))
        if events & ENDED:
            break
    return sent, last


def differs(case):
    """Returns None if equal, otherwise a description of the first difference."""
    ours, theirs = play_in_c(case), random_pages.result(case)
    if ours == theirs:
        return None
    for mine, model in zip(ours[0], theirs[0]):
        if mine != model:
            return f"DIFFERS: call {mine[0]} {mine[1]}, model {model[0]} {model[1]}"
    return f"DIFFERS: {len(ours[0])} outputs, last call {ours[1]}; model {len(theirs[0])}, {theirs[1]}"


def compare(first, count):
    """Returns [(seed, difference)]."""
    found = ((seed, differs(random_pages.case(seed))) for seed in range(first, first + count))
    return [(seed, what) for seed, what in found if what]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=1, metavar="SEED")
    parser.add_argument("--count", type=int, default=10_000, metavar="N")
    asked = parser.parse_args()
    different = compare(asked.first, asked.count)
    for seed, what in different[:20]:
        print(f"seed {seed}: {what}")
    print(f"{asked.count} motion areas by chance from seed {asked.first}: {len(different)} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
