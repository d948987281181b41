# SPDX-License-Identifier: MIT
"""m512 flashes boards with a loader of the factory's kind over lines that are slow (down to 0.05 of the rate), late, in lumps,
with holes, that lose, double and change bytes; it is killed or cancelled at any moment, the line breaks, somebody presses
MODE, and it is called again. The pages hold chance, or text that would do harm if the loader took it for typed. All in
simulated time, by the loader's description. `tools/prove links --only 66` repeats schedule 66 and says what it was.

The line, the loader and the schedules: badlinks/.
"""
import collections

import proof
from badlinks import runs

TITLE = "Bad lines to a factory loader"
SCHEDULES = 10000
SAMPLE = 150
CHUNK = 25
SHOWN = 12


def add_arguments(group):
    group.add_argument("--only", type=int, metavar="NUMBER", help="repeat one schedule")
    group.add_argument("--schedules", type=int, default=SCHEDULES, help="how many (default: %(default)s)")


def chunk(numbers):
    """Some schedules in one process."""
    return [runs.play(number) for number in numbers]


def run(options):
    """Plays the schedules; see proof.py."""
    if options.only is not None:
        options.keep = False
        outcomes = chunk([options.only])
        print(f"   {runs.Schedule(options.only).weather}: {outcomes[0]}")
    else:
        count = SAMPLE if options.sample else options.schedules
        first = options.seed * 1_000_000
        chunks = [range(at, min(at + CHUNK, first + count)) for at in range(first, first + count, CHUNK)]
        outcomes = [outcome for part in proof.each(chunk, chunks, "chunks of schedules", options.jobs) for outcome in part]
    broken = [outcome for outcome in outcomes if outcome.faults]
    for outcome in broken[:SHOWN]:
        print(f"   schedule {outcome.number} ({outcome.kind}, {', '.join(outcome.ends)}): {'; '.join(outcome.faults[:4])}")
    ends = collections.Counter(end for outcome in outcomes for end in outcome.ends)
    kinds = len({outcome.kind for outcome in outcomes})
    pages = sum(outcome.loads for outcome in outcomes), sum(outcome.mails for outcome in outcomes)
    hours = sum(outcome.seconds for outcome in outcomes) / 3600
    shown = ", ".join(f"{count} {end}" for end, count in ends.most_common())
    return [
        proof.Figure("No byte outside the pages that a command names ever changes; no loader is hurt or crashed",
                     f"flash compared byte for byte after each of {len(outcomes):,} schedules on {kinds} kinds of lines",
                     f"{sum(ends.values()):,} calls of m512 ({shown}), {pages[0]:,} page writes by `load`, {pages[1]:,} by the "
                     f"mailbox, {hours:.0f} simulated hours, {len(broken)} schedules broken", not broken),
        proof.Figure("m512 says that all is there only when it is", "the last call of each schedule",
                     f"{sum(outcome.ends[-1] == runs.DONE for outcome in outcomes):,} that ended well",
                     not any("says that all" in fault for outcome in outcomes for fault in outcome.faults)),
    ]
