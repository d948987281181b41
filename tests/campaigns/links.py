# SPDX-License-Identifier: MIT
"""m512 flashes boards that have the factory's kind of loader. Their lines are slow (down to 0.05 of the rate), late, uneven and
interrupted; they lose, double and change bytes. m512 is killed or cancelled at any moment, the line breaks, somebody presses
MODE, and m512 is called again. The pages contain random bytes, or text that would do harm if the loader took it for typed
commands. Everything runs in simulated time, with a loader written from its description. `tools/prove links --only 66` repeats
schedule 66 and describes it.

The line, the loader and the schedules are in badlinks/. Our own loader takes no page without its CRC: `fuzz` and the tests of m512 and the
loader (sim.boot, m512.flash) ask the same of it.
"""

import collections

from tests.campaigns import proof
from tests.campaigns.badlinks import runs

TITLE = "Bad lines to a boot loader"
PROMISE = "No byte outside the pages that m512 names ever changes, whatever the line does."
SCHEDULES = 4000
SAMPLE = 50
CHUNK = 25
SHOWN = 12


def add_arguments(group):
    group.add_argument("--only", type=int, metavar="NUMBER", help="repeat one schedule")
    group.add_argument("--schedules", type=int, help=f"how many (default: {SCHEDULES})")


def chunk(numbers):
    """Plays some schedules in one process."""
    return [runs.play(number) for number in numbers]


def run(options):
    """Plays the schedules; see proof.py."""
    options.keep = options.keep and not options.schedules
    if options.only is not None:
        options.keep = False
        outcomes = chunk([options.only])
        print(f"   {runs.Schedule(options.only).conditions}: {outcomes[0]}")
    else:
        count = SAMPLE if options.sample else options.schedules or SCHEDULES
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
        proof.Figure(
            "No byte outside the pages that a command names ever changes; no loader is hurt or crashed",
            f"flash compared byte for byte after each of {len(outcomes):,} schedules on {kinds} kinds of lines",
            f"{sum(ends.values()):,} calls of m512 ({shown}), {pages[0]:,} page writes, {pages[1]:,} by the "
            f"mailbox, {hours:.0f} simulated hours, {len(broken)} schedules broken",
            not broken,
        ),
        proof.Figure(
            "m512 says that all is there only when it is",
            "the last call of each schedule",
            f"{sum(outcome.ends[-1] == runs.DONE for outcome in outcomes):,} that ended well",
            not any("says that all" in fault for outcome in outcomes for fault in outcome.faults),
        ),
    ]
