# SPDX-License-Identifier: MIT
"""A robot walks for an hour under a remote control, with randomly called pages, stops, breaks, pauses, a serial line that is full in
both directions, and servos that fail from time to time. Another one with 31 joints does the same for ten minutes. An editor saves
thousands of times. Nothing may be lost or late, and the end state must equal the start state.

The hour is one run of one robot. Everything is drawn from --seed.
"""

import random
import traceback

from cm5sim import Violation
from m512.files.image import Image
from tests.campaigns import proof
from tests.campaigns.endure.edit import FIRST, LAST, MOTION_START, Editor
from tests.campaigns.endure.walk import DOWN, LEFT, RIGHT, UP, Walker
from tests.campaigns.powercuts.robot import SLOT_BYTES, SLOTS
from tests.sim.boot_board import MAP
from tests.sim.made_page import page

TITLE = "Endurance"
PROMISE = "Hours of walking and thousands of saves lose no tick, no character and no page."

TICK_CYCLES, CYCLES_PER_US = 125_000, 16
ENTRY_CYCLES = 200  # between a tick and its interrupt's first instruction, including other interrupts
MEASURE_MINUTES = 10  # the interval between two plays of the reference page
FLASH_CYCLES, EEPROM_CYCLES = 10_000, 100_000  # guaranteed by the data sheet
PLAY_HEADROOM, EDIT_HEADROOM = 512, 384
FLASH_PAGE = MAP["MEM_FLASH_PAGE_BYTES"]
SLOT_PAGES = SLOT_BYTES // FLASH_PAGE
JOURNAL = MAP["MEM_JOURNAL_START"], MAP["MEM_JOURNAL_START"] + SLOTS * SLOT_BYTES  # the two flash pages after it are not a slot
ALL_JOINTS = range(31)
BOW = 2
WAVE_OVER, CROWDED_LAYER = 60, 9  # pages layered over a driven walk


def add_arguments(group):
    group.add_argument("--minutes", type=float, default=60, help="of walking (default: %(default)s)")
    group.add_argument("--saves", type=int, default=3000, help="of the editor (default: %(default)s)")


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


# ---- editing ----


def edit(seed, saves):
    editor = Editor(seed)
    board = editor.board
    while editor.saves < saves:
        editor.episode()
    editor.check_all()
    slots = [at // FLASH_PAGE for at in range(*JOURNAL, FLASH_PAGE)]
    saved = {MOTION_START // FLASH_PAGE + 2 * number + half for number in range(FIRST, LAST + 1) for half in (0, 1)}
    return {
        "saves": editor.saves,
        "done": editor.done,
        "complaints": editor.complaints,
        "bus": vars(editor.bus),
        "resets": board.resets - editor.resets,
        "overruns": board.uart(0).overruns + board.uart(1).overruns,
        "headroom": board.stack_headroom,
        "journal": [board.wear(number) for number in slots],
        "motions": [board.wear(number) for number in saved],
        "other wear": max(board.wear(number) for number in set(range(512)) - set(slots) - saved),
        "eeprom wear": max(board.eeprom_wear(at) for at in range(4096)),
        "minutes": board.now_ms / 60_000,
    }


def wears_evenly(journal):
    """Returns whether the wear is even. Saves rewrite the slots' records in turn (a record is SLOT_PAGES - 1 pages after its slot's
    start). A slot's data is rewritten unless it is already there."""
    records = journal[SLOT_PAGES - 1 :: SLOT_PAGES]
    return max(records) - min(records) <= 1 and all(wear <= records[number // SLOT_PAGES] for number, wear in enumerate(journal))


# ---- all of it ----


def work(item):
    """Runs one robot to its end. A violation or a missing answer ends the run."""
    what, seed, amount = item
    try:
        if what == "edit":
            return edit(seed, amount)
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


def edited(results):
    """Returns the figures of all editors."""
    complaints = [text for result in results for text in result["complaints"]]
    for complaint in complaints[:10]:
        print(f"   {complaint}")
    saves, bus = sum(result["saves"] for result in results), [result["bus"] for result in results]
    missed, overruns = sum(one["missed"] + one["doubled"] for one in bus), sum(result["overruns"] for result in results)
    resets, headroom = sum(result["resets"] for result in results), min(result["headroom"] for result in results)
    low, high = min(min(result["journal"]) for result in results), max(max(result["journal"]) for result in results)
    even = all(wears_evenly(result["journal"]) for result in results)
    worst = max(results, key=lambda result: max(result["journal"]) / result["saves"])
    lasts = FLASH_CYCLES * worst["saves"] // max(1, max(worst["journal"]))
    target = max(max(result["motions"]) for result in results)
    plays, edits = (sum(result["done"][what] for result in results) for what in ("plays", "edits"))
    return [
        proof.Figure(
            "What was saved is what the flash holds, and nothing else changes.",
            f"Edit in {len(results)} runs of {max(result['minutes'] for result in results):.0f} simulated minutes: {edits} edits with "
            f"undo, saves by key and by program, {plays} plays",
            f"{saves} saves, {len(complaints)} complaints, {resets} resets, "
            f"{missed} ticks missed in plays, {overruns} overruns; stack headroom {headroom} bytes (at least {EDIT_HEADROOM})",
            not (complaints or resets or missed or overruns) and headroom >= EDIT_HEADROOM,
            headline=True,
        ),
        proof.Figure(
            "The journal wears evenly, and lasts.",
            f"erases of each of its flash pages in the same runs, extrapolated to the {FLASH_CYCLES} that the data sheet allows",
            f"{low}..{high} erases a journal page ({worst['saves']} saves a run): {lasts} saves until {FLASH_CYCLES}; a motion page "
            f"saved every time lasts {FLASH_CYCLES}; busiest motion page here {target}; other flash "
            f"{max(result['other wear'] for result in results)}, EEPROM {max(result['eeprom wear'] for result in results)}",
            even and not max(result["other wear"] for result in results),
        ),
    ]


def run(options):
    minutes, saves = options.minutes, options.saves
    options.keep = minutes >= 60 and saves >= 3000
    if options.sample:
        items = [("walk", options.seed, 0.5), ("crowd", options.seed, 0.2), ("edit", options.seed, 15)]
    else:
        items = [
            ("walk", options.seed, minutes),
            ("crowd", options.seed, minutes / 6),
            ("edit", options.seed, saves // 2),
            ("edit", options.seed + 1, saves - saves // 2),
        ]
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
    lives = [(item[0], result) for item, result in zip(items, results) if "died" not in result]
    for what, result in lives:
        if what != "edit":
            figures += walked(result, 18 if what == "walk" else len(ALL_JOINTS))
    editors = [result for what, result in lives if what == "edit"]
    return figures + (edited(editors) if editors else [])
