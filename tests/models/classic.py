#!/usr/bin/env -S sh -c 'exec "${0%/*}/../../tools/dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Compares the C player's classic law with the model of the page (tests/models/classic_law.py), on motion areas by chance.

    tests/models/classic.py [--first SEED] [--count N]     10,000 cases by default; exit code 1 when one differs

Equal means: the same calls have output, every goal of every joint is the same, the play ends in the same call. Where the page leaves two
readings open (tests/models/README.md) a case that is equal under ours counts as equal and is told apart.
"""

import argparse
import pathlib
import sys
import types

from tests.models import classic_law, random_pages
from tests.models.played import CLASSIC, ENDED, OUTPUT, Played

READING = "reading"
# The player's choice where the page can be read in two ways (readings 4, 5 and 6 of tests/models/README.md). A page left by its exit link
# counts as passed. A linked page of the call's code has priority over NEXT_PAGE. Pages are passed over by the code that decided the link.
OURS = (
    ("            if link in self.exit_pages:", "            self.exit_pages.add(page.number)\n            if link in self.exit_pages:"),
    ("elif self.code and self.code != self.call:", "elif self.code:"),
    ("        self.repeat = self.repetitions > 0\n", "        self.repeat, self.decided_by = self.repetitions > 0, self.code\n"),
    (
        "            number = self.follow(page)\n",
        "            code, self.code = self.code, getattr(self, 'decided_by', self.code)\n            number, self.code = self.follow(page), code\n",
    ),
)


def model_with_our_readings():
    text = pathlib.Path(classic_law.__file__).read_text(encoding="utf-8")
    for old, new in OURS:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    module = types.ModuleType("our_readings")
    sys.modules[module.__name__] = module  # dataclasses look up their module
    exec(compile(text, module.__name__, "exec"), module.__dict__)
    return module


our_readings = model_with_our_readings()


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
    """Returns None if equal, READING if equal under our readings, otherwise a description of the first difference."""
    ours = play_in_c(case)
    theirs = random_pages.result(case)[:2]
    if ours == theirs:
        return None
    if ours == random_pages.result(case, our_readings)[:2]:
        return READING
    for mine, model in zip(ours[0], theirs[0]):
        if mine != model:
            return f"DIFFERS: call {mine[0]} {mine[1]}, model {model[0]} {model[1]}"
    return f"DIFFERS: {len(ours[0])} outputs, last call {ours[1]}; model {len(theirs[0])}, {theirs[1]}"


def compare(first, count):
    """Returns (number of cases equal only under our readings, [(seed, difference)])."""
    found = [(seed, differs(random_pages.case(seed))) for seed in range(first, first + count)]
    return sum(what == READING for _, what in found), [(seed, what) for seed, what in found if what not in (None, READING)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=1, metavar="SEED")
    parser.add_argument("--count", type=int, default=10_000, metavar="N")
    asked = parser.parse_args()
    readings, different = compare(asked.first, asked.count)
    for seed, what in different[:20]:
        print(f"seed {seed}: {what}")
    print(
        f"{asked.count} motion areas by chance from seed {asked.first}: {len(different)} differ, "
        f"{readings} are equal under our readings of what the page leaves open"
    )
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
