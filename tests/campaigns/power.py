# SPDX-License-Identifier: MIT
"""The power fails at every flash and EEPROM operation of the shipped images on the strict board: before it, in its middle with
torn contents (seven kinds), and after it. Then the same images start again. All 128 motion pages, the application, the loader
and the EEPROM are compared byte for byte with what they may contain. The application must answer, the loader must identify
itself, and the next save must work. The repairs at the start are interrupted as well, three levels deep. A state has the name
scene:operation:phase. `tools/prove power --only save:7:half/2:after` repeats the state in which SAVE was interrupted in the middle
of its 7th operation and its repair after its 2nd.

The scenes and the code that plays them are in powercuts/.
"""

import collections
import os
import sys
import time
import zlib

from tests.campaigns import proof
from tests.campaigns.powercuts import loads, saves, settings
from tests.campaigns.powercuts.cutter import PHASES, Cutter, path_of

TITLE = "Power cuts"
PROMISE = "Whenever the power fails, each motion page, setting and download is old or new, and the robot starts again."
SCENES = {scene.name: scene for scene in (*saves.SCENES, *loads.SCENES, *settings.SCENES)}
SAMPLED = (
    "save",
    "save-factory",
    "save-play",
    "mailbox",
    "repair",
    "app-blocks",
    "foreign-load",
    "motions-load",
    "words",
    "taken",
    "settings",
    "pairs-save",
)
SAMPLE_STATES = 2  # per scene
DEEPEST = 3
SHOWN = 12  # failures that are printed individually


def add_arguments(group):
    group.add_argument("--only", metavar="STATE", help="repeat one state: scene:operation:phase[/operation:phase]")
    group.add_argument("--scene", metavar="NAME", help="one scene alone: " + ", ".join(SCENES))


def chooser(scene, seed, sample, chunk):
    """Returns a function that tells at which phases to cut an operation: at all of them, or at one in so many, picked by the seed."""
    every_phase = getattr(scene, "all_phases_until", 0)
    sampled = {(2 * i + 1) * scene.about // (2 * SAMPLE_STATES) + 1 for i in range(SAMPLE_STATES)}

    def number(*words):
        return zlib.crc32(" ".join(map(str, (seed, scene.name, *words))).encode())

    def wanted(path, operation):
        depth = len(path)
        if sample and depth == 0:
            return [PHASES[1 + number(operation) % (len(PHASES) - 1)]] if operation in sampled else []
        if depth == DEEPEST or (depth == 0 and operation % scene.chunks != chunk):
            return []
        rate = 1 if depth == 0 and operation <= every_phase else 40 if sample else scene.rates[depth]
        phases = PHASES if operation == 1 and depth == 0 else PHASES[1:]  # "before" equals the previous "after"
        return [phase for phase in phases if number(*path, operation, phase) % rate == 0]

    return wanted


def play(work):
    """Plays one piece of work in its own process. Returns (scene, [(state, outcome, fault)], operations, seconds of one core)."""
    spent = sum(os.times()[:4])
    return (*play_one(*work), sum(os.times()[:4]) - spent)


def play_one(name, part, seed, sample):
    cutter = Cutter(SCENES[name](seed), chooser(SCENES[name], seed, sample, part), seed=seed)
    return name, cutter.play(), cutter.operations


def repeat(state, seed):
    """Repeats a single state."""
    name, path = path_of(state)
    if name not in SCENES or not path:
        raise SystemExit(f"prove: {state} is no state of power; see --help")
    results = Cutter(SCENES[name](seed), None, only=path, seed=seed).play()
    state, outcome, fault = results[-1]
    if outcome == "same":
        outcome = "the same contents as before or after the operation: counted there"
    return [proof.Figure(f"The state {state}", "played again", fault or outcome, fault is None)]


def pieces(names, seed, sample):
    """Returns all pieces of work, the longest first."""
    work = [(name, part, seed, sample) for name in names for part in range(1 if sample else SCENES[name].chunks)]
    return sorted(work, key=lambda piece: -SCENES[piece[0]].about)


def run(options):
    only, one = options.only, options.scene
    options.keep = not only and not one
    if only:
        return repeat(only, options.seed)
    names = [one] if one else SAMPLED if options.sample else list(SCENES)
    begun, spent = time.monotonic(), 0
    results, operations = collections.defaultdict(list), {}
    kept = proof.Kept("power", options.keep and not options.sample)
    for name, found, count, seconds in kept.each(play, pieces(names, options.seed, options.sample), "pieces of work", options.jobs):
        spent += seconds
        operations[name] = max(count, operations.get(name, 0))
        results[name] += found
    kept.finish()
    figures = [figure_of(name, results[name], operations[name]) for name in names if name in results]
    return [total_figure(results, time.monotonic() - begun, spent), *figures]


def figure_of(name, states, operations):
    scene = SCENES[name]
    states = [state for state in states if state[1] != "same"]
    counts = collections.Counter(outcome for _, outcome, fault in states if not fault)
    faults = [(state, fault) for state, _, fault in states if fault]
    tell(faults)
    deep = sum("/" in state for state, _, _ in states)
    text = (
        f"{len(states):,} states"
        + (f" ({deep} of repairs)" if deep else "")
        + ": "
        + ", ".join(f"{outcome} {count}" for outcome, count in sorted(counts.items()))
    )
    if faults:
        text += f"; {len(faults)} BROKEN, such as `tools/prove power --only {faults[0][0]}`: {faults[0][1]}"
    return proof.Figure(scene.promise, f"`{name}`: {about(scene)}; {operations} operations", text, not faults)


def about(scene):
    return " ".join(scene.__doc__.split()).rstrip(".")


def tell(faults):
    for state, fault in faults[:SHOWN]:
        print(f"       BROKEN tools/prove power --only {state}\n              {fault}", file=sys.stderr)


def total_figure(results, seconds, spent):
    states = [state for found in results.values() for state in found if state[1] != "same"]
    broken = sum(fault is not None for _, _, fault in states)
    return proof.Figure(
        "After a power cut everything is old or new, the loader answers, and the robot goes on",
        f"{len(results)} scenes",
        f"{len(states):,} states, {broken} broken; {seconds / 60:.1f} min, {spent / 60:.1f} min of one core",
        broken == 0,
        headline=True,
    )
