# SPDX-License-Identifier: MIT
"""A robot walks for an hour under a remote control, with randomly called pages, stops, breaks, pauses, a serial line that is full in
both directions, and servos that fail from time to time. Another one with 31 joints does the same for ten minutes. Nothing may
be lost or late, and the end state must equal the start state.

The hour is one run of one robot. Everything is drawn from --seed.
"""

import random
import traceback

from cm5sim import Violation
from m512.files.image import Image
from tests.campaigns import proof
from tests.campaigns.walker import DOWN, LEFT, RIGHT, UP, Walker
from tests.sim.made_page import page

TITLE = "Endurance"
PROMISE = "An hour of walking loses no tick and no character."

TICK_CYCLES, CYCLES_PER_US = 125_000, 16
ENTRY_CYCLES = 200  # between a tick and its interrupt's first instruction, including other interrupts
MEASURE_MINUTES = 10  # the interval between two plays of the reference page
EEPROM_CYCLES = 100_000  # guaranteed by the data sheet
PLAY_HEADROOM = 512
ALL_JOINTS = range(31)
BOW = 2
WAVE_OVER, CROWDED_LAYER = 60, 9  # pages layered over a driven walk


def add_arguments(group):
    group.add_argument("--minutes", type=float, default=60, help="of walking (default: %(default)s)")


# ---- walking ----


def library():
    return (proof.BUILD / "motions" / "motions.bin").read_bytes()


def crowded(seed):
    """Returns pages in which all 31 joints move in every step: a reference page, and walks under four codes with links between them."""
    chance = random.Random(seed)

    def steps(count, ticks):
        return [(ticks, {joint: chance.randrange(412, 612) for joint in ALL_JOINTS}) for _ in range(count)]

    image = Image.empty()
    image[BOW] = page("yardstick", steps(7, 64), joints=ALL_JOINTS)
    for number, code in ((4, UP), (5, DOWN), (6, LEFT), (7, RIGHT)):
        image[number] = page(
            f"code {code}",
            steps(4, 64),
            joints=ALL_JOINTS,
            code=code,
            next=number,
            exit=8,
            link1_code=LEFT,
            link1_page=6,
            link2_code=UP,
            link2_page=4,
        )
    image[8] = page("stop", steps(1, 96), joints=ALL_JOINTS)
    image[CROWDED_LAYER] = page("layer", [(48, {joint: 600 for joint in range(15)}), (48, {})], joints=range(15), next=CROWDED_LAYER)
    image[4].data[17], image[4].data[18] = 7, 6  # blend partners with the same number of steps
    image[4].seal()
    return image.to_bytes()


def walk(seed, joints, motions, minutes, layer):
    walker = Walker(seed, joints, motions, reference=BOW, layer=layer)
    board = walker.board
    first, same = walker.measure(), 0
    measured_ms, end_ms = board.now_ms, board.now_ms + minutes * 60_000
    while board.now_ms < end_ms:
        walker.episode()
        if board.now_ms - measured_ms > MEASURE_MINUTES * 60_000 or board.now_ms >= end_ms:
            measured_ms, same = board.now_ms, same + 1
            if walker.measure() != first:
                walker.complaints.append(f"the yardstick plays otherwise at {board.now_ms:.0f} ms than in the first minute")
    counts = walker.statistics()
    board.run_to("__vector_12")
    return {
        "minutes": board.now_ms / 60_000,
        "done": walker.done,
        "complaints": walker.complaints,
        "measured": same,
        "yardstick": len(first),
        "bus": vars(walker.bus),
        "counts": counts,
        "resets": board.resets - walker.resets,
        "overruns": board.uart(0).overruns + board.uart(1).overruns,
        "framing": board.uart(1).framing,
        "phase": (board.now_cycles - walker.bus.phase + ENTRY_CYCLES) % TICK_CYCLES - ENTRY_CYCLES,
        "headroom": board.stack_headroom,
        "flash wear": max(board.wear(number) for number in range(512)),
        "eeprom wear": max(board.eeprom_wear(at) for at in range(4096)),
    }


# ---- all of it ----


def work(item):
    """Runs one robot to its end. A violation or a missing answer ends the run."""
    what, seed, amount = item
    try:
        if what == "walk":
            return walk(seed, range(1, 19), library(), amount, layer=WAVE_OVER)
        return walk(seed, ALL_JOINTS, crowded(seed), amount, layer=CROWDED_LAYER)
    except (Violation, AssertionError) as error:
        return {"died": f"{what}, seed {seed}: {error}\n{traceback.format_exc()}"}


def walked(result, joints):
    """Returns the figures of one walk."""
    bus, counts, done = result["bus"], result["counts"], result["done"]
    how = (
        f"Play with {joints} servos, {result['minutes']:.1f} simulated minutes in one run: {done['packets']} packets of the remote, "
        f"{done['plays']} pages called, {done['stops']} stops, {done['breaks']} breaks, {done['pauses']} pauses, "
        f"{done['commands']} commands, {done['faults']} faults of servos, "
        f"{done['driven']} lines of @drive with pages laid over the walk"
    )
    for complaint in result["complaints"]:
        print(f"   {complaint}")
    return [
        proof.Figure(
            "No tick is missed, none has two frames, no goal is late.",
            how,
            f"{bus['frames']} frames, {bus['missed']} ticks without, {bus['doubled']} with two; Play counts {counts['missed']} "
            f"missed, {counts['late']} late; {result['resets']} resets",
            not (bus["missed"] or bus["doubled"] or counts["missed"] or counts["late"] or result["resets"]),
            headline=True,
        ),
        proof.Figure(
            "Nothing drifts.",
            "the tick's phase at the end against the start; a page's goals tick by tick, in the first minute "
            f"and every {MEASURE_MINUTES} minutes up to the last; where the joints stand behind it",
            f"phase off by {result['phase']} cycles; {result['measured']} times the same {result['yardstick']} frames; frames go out "
            f"{bus['offset_min'] / CYCLES_PER_US / 1000:.2f}..{bus['offset_max'] / CYCLES_PER_US / 1000:.2f} ms behind the tick; "
            f"{len(result['complaints'])} complaints",
            abs(result["phase"]) < ENTRY_CYCLES and not result["complaints"],
        ),
        proof.Figure(
            "Nothing is lost on the lines.",
            "the same run; the serial line full in both directions for minutes",
            f"{result['overruns']} overruns, {result['framing']} framing errors, {counts['lost']} characters lost, "
            f"{counts['packets']} of {done['packets']} packets of the remote heard",
            not (result["overruns"] or result["framing"] or counts["lost"]) and counts["packets"] == done["packets"],
        ),
        proof.Figure(
            f"The stack keeps {PLAY_HEADROOM} bytes free; nothing wears.",
            "deepest stack, erases and EEPROM writes of the same run",
            f"{result['headroom']} bytes; {result['flash wear']} erases; {result['eeprom wear']} writes of the busiest EEPROM byte "
            f"({EEPROM_CYCLES} allowed)",
            result["headroom"] >= PLAY_HEADROOM and result["flash wear"] == 0,
        ),
    ]


def run(options):
    minutes = options.minutes
    options.keep = minutes >= 60
    if options.sample:
        items = [("walk", options.seed, 0.5), ("crowd", options.seed, 0.2)]
    else:
        items = [("walk", options.seed, minutes), ("crowd", options.seed, minutes / 6)]
    kept = proof.Kept("endurance", options.keep and not options.sample)
    results = kept.each(work, items, "lives", options.jobs)
    kept.finish()
    died = [result["died"] for result in results if "died" in result]
    for text in died:
        print(f"   tools/prove endurance --seed {options.seed}: {text}")
    figures = [
        proof.Figure(
            "Every robot lives to the end of its run.",
            "whole images on the strict board; the first violation ends a run",
            f"{len(items) - len(died)} of {len(items)}" + "".join(f"; {text.splitlines()[0]}" for text in died),
            not died,
        )
    ]
    for item, result in zip(items, results):
        if "died" not in result:
            figures += walked(result, 18 if item[0] == "walk" else len(ALL_JOINTS))
    return figures
