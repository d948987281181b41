# SPDX-License-Identifier: MIT
"""Random bytes, and bytes that are almost valid, go to the shipped images on the strict board (a million bytes on each input) and to the
readers of m512 for files and answers.

Nothing may hang, restart, write anything that nobody asked for, or send a servo anything it must not get. (Sessions in simulated time
type noise at Play and Edit as well, built with ASan and UBSan.)
"""

import dataclasses

from tests.campaigns import fuzz_board, fuzz_parsers, proof
from tests.campaigns.proof import Figure

TITLE = "Fuzzing"
PROMISE = "Whatever bytes arrive on a line or in a file, nothing hangs, restarts or writes what nobody asked for."
BYTES = 1_000_000  # a whole run takes at most half an hour of one core; tools/prove sessions tries far more in simulated time
SAMPLE_BYTES = {"loader": 24_000}
SAMPLE_BYTES_ELSE = 12_000


def add_arguments(group):
    """The options of this part."""
    group.add_argument("--only", metavar="INPUT:SEED", help=f"one session again ({', '.join(fuzz_board.INPUTS)})")
    group.add_argument("--bytes", type=int, default=BYTES, help="for each input of the images (default: %(default)s)")
    group.add_argument("--inputs", metavar="LIST", help="these inputs only, with commas; m512 is one of them")


# ---- whole images ----


@dataclasses.dataclass
class Result:
    """One session."""

    sent: int = 0
    seconds: float = 0.0
    slowest_ms: float = 0.0
    headroom: int = 4096
    fault: str = ""


def describe(fault):
    """Returns the fault in one line."""
    return f"{type(fault).__name__}: {' '.join(str(fault).split())[:300]}"


def session(task):
    """Plays one session. task: (input, seed, bytes)."""
    name, seed, size = task
    kind = fuzz_board.INPUTS[name](seed, size)
    try:
        return Result(*kind.run())
    except Exception as fault:  # pylint: disable=broad-except  (any exception is a finding)
        return Result(sent=getattr(kind, "sent", 0), fault=describe(fault))


def session_row(task):
    """The result of a session as a list, for JSON."""
    return list(dataclasses.astuple(session(task)))


def again(options):
    """Repeats the session that --only names."""
    name, _, seed = options.only.partition(":")
    result = session((name, int(seed), size_of(name, options)))
    print(result.fault or "no fault")
    return [Figure(f"{name}, seed {seed}", "once more", result.fault or f"no fault, {result.seconds:.1f} simulated s", not result.fault)]


def size_of(name, options):
    """Returns the number of bytes of one session."""
    if options.sample:
        return SAMPLE_BYTES.get(name, SAMPLE_BYTES_ELSE)
    return fuzz_board.INPUTS[name].size


def images(options, names):
    """Yields a figure for each input. Tasks are sorted so that long sessions do not come last."""
    tasks = []
    for name in names:
        size = size_of(name, options)
        count = 1 if options.sample else -(-options.bytes // fuzz_board.mean_size(name))
        tasks += [(name, options.seed * 10_000 + i, size) for i in range(count)]
    tasks.sort(key=lambda task: (-fuzz_board.INPUTS[task[0]].size, task[1]))
    kept = proof.Kept("fuzz", options.keep and not options.sample)
    results = [Result(*row) for row in kept.each(session_row, tasks, "sessions on the board", options.jobs)]
    for name in names:
        yield image_figure(name, [(task, result) for task, result in zip(tasks, results) if task[0] == name], options)
    kept.finish()


def image_figure(name, done, options):
    """Returns the figure of one input."""
    kind = fuzz_board.INPUTS[name]
    faults = [(task, result) for task, result in done if result.fault]
    measured = (
        f"{sum(r.sent for _, r in done):,} bytes in {len(done)} sessions, {sum(r.seconds for _, r in done):,.0f} simulated s, "
        f"{len(faults)} faults; stack never closer than {min(r.headroom for _, r in done)} bytes"
    )
    slowest = max(r.slowest_ms for _, r in done)
    if slowest:
        measured += f"; slowest answer afterwards {slowest / 1000:.1f} s"
    for task, result in faults:
        sample = " --sample" if options.sample else ""
        measured += f"; `tools/prove fuzz{sample} --only {name}:{task[1]}`: {result.fault}"
    return Figure(kind.promise, f"the shipped image on the strict board: {kind.how}", measured, not faults)


def run(options):
    """Runs the whole part."""
    options.keep = not (options.only or options.inputs or options.bytes < BYTES)
    if options.only:
        return again(options)
    chosen = options.inputs.split(",") if options.inputs else [*fuzz_board.INPUTS, "m512"]
    figures = fuzz_parsers.figures(options) if "m512" in chosen else []
    return [*images(options, [name for name in fuzz_board.INPUTS if name in chosen]), *figures]
