# SPDX-License-Identifier: MIT
"""Play and Edit run as programs in simulated time, from the same sources as on the chip, with simulated servos on their line. One seed
makes a session: typing, the remote, the panel, faults of servos and of the line, a hand at a joint, a late computer, an adapter
that is pulled out, and power cuts at any tick and within any write. Rules are checked at every tick (simtime/rules.c), and the
places that a campaign must reach are counted (simtime/marks.c). `tools/prove sessions --only 66` repeats session 66 and shortens it
if it fails.

What only the chip can show (interrupts, stack, its loader, timing) is left to the other parts.
"""

import collections
import itertools
import json
import re

from tests.campaigns import proof
from tests.campaigns.simtime import board, chance, runs

TITLE = "Sessions in simulated time"
PROMISE = "Whatever a person, servos, lines, a computer and the power do at any tick: no leap, nothing moves unasked, text and pages are kept."
SESSIONS, SAMPLE, CHUNK, SHOWN = 8400, 40, 20, 6
BOTH = 100  # sessions that the strict board plays as well, 4 s each
PLAYED = proof.RESULTS / "board_sessions.jsonl"
MISSED_IN_SAMPLE = 18  # places that a sample may miss


def places():
    """Returns the places that a campaign must reach: all that simtime/*.c can mark."""
    code = "".join(path.read_text(encoding="utf-8") for path in (proof.TOP / "tests" / "campaigns" / "simtime").glob("*.c"))
    marked = re.findall(r"\b(?:reached|stop_asked|marks_cut)\(([^;{}]*)\);", code) + re.findall(r'^    \{"[^"]*", ("[^"]*")\},$', code, re.M)
    marked += re.findall(r'"power cut[^"]*"', code)
    return sorted({name for words in marked for name in re.findall(r'"([^"]*)"', words)})


def add_arguments(group):
    group.add_argument("--only", type=int, metavar="SEED", help="repeat one session; if it fails, make it short")
    group.add_argument("--list", metavar="FILE", help="repeat a list of actions from a file")
    group.add_argument("--on-board", action="store_true", help="with --only or --list: what the strict board makes of it (Play alone)")
    group.add_argument("--both", type=int, metavar="COUNT", help=f"more sessions that the strict board plays as well (default: {BOTH})")
    group.add_argument("--from", dest="first", type=int, metavar="SEED", help="the first session (default: the seed times a million)")
    group.add_argument("--sessions", type=int, help=f"how many (default: {SESSIONS})")


def chunk(seeds):
    """Plays some sessions in one process."""
    return [runs.play(seed, chance.made(seed, runs.MOTIONS)) for seed in seeds]


def make_short(outcome, actions):
    """Writes the shortened list of a failed session, and prints its path."""
    path = proof.RESULTS / f"session-{outcome.seed}.txt"
    path.parent.mkdir(parents=True, exist_ok=True)
    short = runs.shrunk(actions, runs.rule_of(outcome.fault))
    path.write_text(chance.text(short), encoding="utf-8")
    print(f"   short, of {len(actions)} actions {len(short)}; again: tools/prove sessions --list {path.relative_to(proof.TOP)}")
    print(runs.shown([action for action in short if action[0] > 0]))


def run(options):
    """Plays the sessions; see proof.py."""
    motions = runs.motions()
    if options.list or options.only is not None:
        options.keep = False
        actions = runs.read(options.list) if options.list else chance.made(options.only, motions)
        if options.on_board:
            board.replay(actions)
        outcomes = [runs.play(options.only or 0, actions)]
        if outcomes[0].fault and not options.list:
            make_short(outcomes[0], actions)
    else:
        options.keep = options.keep and options.sessions is None and options.first is None
        count = SAMPLE if options.sample else SESSIONS if options.sessions is None else options.sessions
        first = options.seed * 1_000_000 if options.first is None else options.first
        chunks = [range(at, min(at + CHUNK, first + count)) for at in range(first, first + count, CHUNK)]
        kept = proof.Kept("sessions", is_whole=options.keep and not options.sample)
        parts = kept.each(chunk, chunks, "chunks of sessions", options.jobs)
        outcomes = [runs.Outcome(*outcome) for part in parts for outcome in part]
        kept.finish()
    return (figures(options, outcomes) if outcomes else []) + both(options)


def board_sessions():
    """Returns the code digest and the sessions that the strict board has also played with it, by seed: (frames, ticks, difference). They
    are kept, so that the hours of several runs add up."""
    code = proof.code("sessions")
    lines = map(json.loads, PLAYED.read_text(encoding="utf-8").splitlines()) if PLAYED.exists() else ()
    return code, {line["seed"]: line["found"] for line in lines if line["code"] == code}


def both(options):
    """Returns the figure of the sessions that the strict board also played. In a sample, the test prove.simtime covers this."""
    count = BOTH if options.both is None else options.both
    if options.sample or options.list or options.only is not None or (options.sessions is not None and options.both is None):
        return []
    code, played = board_sessions()
    seeds = itertools.islice((seed for seed in itertools.count(options.seed * 1000) if seed not in played), count)

    def keep(seed, found):
        played[seed] = found
        PLAYED.parent.mkdir(parents=True, exist_ok=True)
        with PLAYED.open("a", encoding="utf-8") as file:
            file.write(json.dumps({"code": code, "seed": seed, "found": found}) + "\n")

    proof.each(board.difference, seeds, "sessions on the board", options.jobs, done=keep)
    wrong = [(seed, words) for seed, (_, _, words) in sorted(played.items()) if words]
    for seed, words in wrong[:SHOWN]:
        print(f"   session {seed} of both: {words}")
    hours = sum(ticks for _, ticks, _ in played.values()) / 128 / 3600
    return [
        proof.Figure(
            "The strict board with the shipped image does the same",
            "plays, layers, shapes, pauses, settings and the remote by chance; every frame of goals, the console, motion pages and settings "
            "are compared; the hours of all runs of this code are added up",
            f"{hours:.1f} simulated hours, {sum(frames for frames, _, _ in played.values()):,} frames in {len(played):,} sessions, {len(wrong)} differ",
            not wrong and bool(played),
            headline=True,
        )
    ]


def figures(options, outcomes):
    """Returns the figures of these outcomes."""
    broken = [outcome for outcome in outcomes if outcome.fault]
    for outcome in broken[:SHOWN]:
        print(f"   session {outcome.seed}: {outcome.fault}; again: tools/prove sessions --only {outcome.seed}")
    marks = collections.Counter()
    for outcome in outcomes:
        marks.update(outcome.marks)
    wanted = places()
    missed = [place for place in wanted if not marks[place]]
    ticks, cpu_s = sum(outcome.ticks for outcome in outcomes), sum(outcome.cpu_s for outcome in outcomes)
    one = options.list or options.only is not None
    made = [
        proof.Figure(
            "The rules hold at every tick",
            "steps and links as the pages say, approaches keep to their speed; aims arrive; pauses and breaks come to rest; no play begins without a call or a press; "
            "joints are as soft as their page says; nothing moves unasked or after it was let go or lost; one packet at a time is on the bus; a silent servo is named and a well one is not; requests "
            "are answered as their pages say, lists show what is so; typed text stands; Edit's table, cursor, work pose and answers by a second model of its lines "
            "and keys; pages and settings are old or new, settings those that were set, and a page of a program as it was sent",
            f"{ticks:,} ticks in {len(outcomes):,} sessions, {ticks / 128 / max(cpu_s, 0.001):,.0f} x real time on one core; "
            f"{len(broken)} sessions broken",
            not broken,
            headline=True,
        )
    ]
    if not one:
        made.append(
            proof.Figure(
                "The sessions reach every place that they are to reach",
                f"{len(wanted)} named places, such as `servo lost in a layer during stop`",
                f"{len(wanted) - len(missed)} reached" + (f"; never: {', '.join(missed)}" if missed else ""),
                len(missed) <= (MISSED_IN_SAMPLE if options.sample or options.sessions else 0),
                headline=True,
            )
        )
    return made
