# SPDX-License-Identifier: MIT
"""Random bytes, and bytes that are almost valid, go to three subjects: the shipped images on the strict board (a million bytes on
each input), the portable modules and both applications as programs on the PC (guided by coverage), and the readers of m512 for
files and answers.

Nothing may hang, restart, write anything that nobody asked for, or send a servo anything it must not get.
"""

import dataclasses
import time

from tests.campaigns import fuzz_board, fuzz_host, fuzz_parsers, proof
from tests.campaigns.proof import Figure

TITLE = "Fuzzing"
PROMISE = "Whatever bytes arrive on a line or in a file, nothing hangs, restarts or writes what nobody asked for."
BYTES = 1_000_000  # a whole run takes at most half an hour of one core; tools/prove sessions tries far more in simulated time
SAMPLE_BYTES = {"loader": 24_000}
SAMPLE_BYTES_ELSE = 12_000
SECONDS = 30  # of libFuzzer per harness
SAMPLE_RUNS = 200  # per harness, in addition to its corpus; a count, not a time, so that CI always runs the same inputs
SHRINK_TRIALS = 12
SHRINKS = 3  # how many failing sessions of an input are shrunk


def add_arguments(group):
    """The options of this part."""
    group.add_argument(
        "--only", metavar="INPUT:SEED[:PIECES]", help=f"one session again ({', '.join(fuzz_board.INPUTS)}), whole or some of its pieces: 0-3,9"
    )
    group.add_argument("--bytes", type=int, default=BYTES, help="for each input of the images (default: %(default)s)")
    group.add_argument("--seconds", type=int, default=SECONDS, help="of libFuzzer for each harness (default: %(default)s)")
    group.add_argument("--keep-corpus", action="store_true", help="adds to tests/campaigns/fuzz/corpus what libFuzzer has found")
    group.add_argument("--inputs", metavar="LIST", help="these inputs and harnesses only, with commas; m512 is one of them")


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


def fails(name, seed, size, chosen):
    """Plays only these pieces. Returns the fault, or ""."""
    kind = fuzz_board.INPUTS[name](seed, size)
    pieces = kind.pieces()
    try:
        kind.play([pieces[i] for i in chosen])
        return ""
    except Exception as fault:  # pylint: disable=broad-except
        return describe(fault)


def shrink(name, seed, size):
    """Returns fewer pieces that still fail, as ":0-2,5"; "" if the input has no pieces. Leaves out halves, quarters, and so on, in at
    most SHRINK_TRIALS trials."""
    kind = fuzz_board.INPUTS[name](seed, size)
    if not hasattr(kind, "pieces"):
        return ""
    chosen, trials = list(range(len(kind.pieces()))), SHRINK_TRIALS
    part = max(1, len(chosen) // 2)
    while trials and part:
        start = 0
        while start < len(chosen) and trials:
            rest = chosen[:start] + chosen[start + part :]
            trials -= 1
            if fails(name, seed, size, rest):
                chosen = rest
            else:
                start += part
        part //= 2
    return ":" + ranges(chosen)


def ranges(numbers):
    """Returns 0,1,2,5 as "0-2,5"."""
    out = []
    for number in numbers:
        if out and out[-1][1] == number - 1:
            out[-1][1] = number
        else:
            out.append([number, number])
    return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in out)


def again(options):
    """Repeats the session that --only names, and prints the chosen pieces."""
    name, seed, *chosen = options.only.split(":")
    kind = fuzz_board.INPUTS[name](int(seed), size_of(name, options))
    began = time.monotonic()
    if chosen:
        pieces, picked = kind.pieces(), []
        for part in chosen[0].split(","):
            first, _, last = part.partition("-")
            picked += range(int(first), int(last or first) + 1)
        fault = fails(name, int(seed), size_of(name, options), picked)
        for i in picked:
            print(f"{i}: {pieces[i]!r}"[:2000])
    else:
        fault = session((name, int(seed), size_of(name, options))).fault
    print(fault or "no fault")
    return [Figure(f"{name}, seed {seed}", "once more", fault or f"no fault, {time.monotonic() - began:.1f} s", not fault)]


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
    for number, (task, result) in enumerate(faults):
        pieces = shrink(*task) if number < SHRINKS and not options.sample else ""
        sample = " --sample" if options.sample else ""
        measured += f"; `tools/prove fuzz{sample} --only {name}:{task[1]}{pieces}`: {result.fault}"
    return Figure(kind.promise, f"the shipped image on the strict board: {kind.how}", measured, not faults)


# ---- modules on the PC ----


def modules(options, names):
    """Returns the figure of the harnesses. A sample does not use libFuzzer, because building its programs takes too long."""
    if options.sample or not fuzz_host.build():
        runs = proof.each(fuzz_host.replay, [(name, SAMPLE_RUNS, options.seed) for name in names], "harnesses", options.jobs)
        how = f"the corpora of tests/campaigns/fuzz under ASan and UBSan, and {SAMPLE_RUNS} inputs a harness that chance made from them" + (
            "" if options.sample else "; clang with libFuzzer is not here, so nothing was searched"
        )
        edges = ", ".join(f"{run.name} {run.executions}" for run in runs)
    else:
        tasks = [(name, f"-max_total_time={options.seconds}", options.seed, options.keep_corpus) for name in names]
        runs = proof.each(fuzz_host.search, tasks, "harnesses", options.jobs)
        how = f"libFuzzer with ASan and UBSan, {options.seconds} s a harness, from the corpora of tests/campaigns/fuzz on"
        edges = ", ".join(f"{run.name} {run.executions:,} ({run.edges} edges, corpus {run.corpus})" for run in runs)
    findings = [run.finding for run in runs if run.finding]
    measured = f"{sum(run.executions for run in runs):,} executions, {len(findings)} findings: {edges}"
    return Figure(
        "Page codec, packets, bus engine, remote, settings, journal, player, loader, Play and Edit keep their contracts whatever they are given",
        how,
        "; ".join([measured, *findings]),
        not findings,
    )


def run(options):
    """Runs the whole part."""
    options.keep = not (options.only or options.inputs or options.bytes < BYTES or options.seconds < SECONDS)
    if options.only:
        return again(options)
    chosen = options.inputs.split(",") if options.inputs else [*fuzz_board.INPUTS, *fuzz_host.NAMES, "m512"]
    figures = []
    if any(name in chosen for name in fuzz_host.NAMES):
        figures.append(modules(options, [name for name in fuzz_host.NAMES if name in chosen]))
    if "m512" in chosen:
        figures += fuzz_parsers.figures(options)
    return [*images(options, [name for name in fuzz_board.INPUTS if name in chosen]), *figures]
