# SPDX-License-Identifier: MIT
"""The shipped player and accurate servo models move random bodies in MuJoCo. A yardstick comes first: the maker's own motions for its
GP robot, which walk on the real robot, must walk here, and must fall when they are spoiled. Without that, the physics could not
judge anything. Physics is a model, and no real robot has walked our motions yet."""

import os
import pathlib

import mujoco

from body.chance import NOMINAL, Variation, random_body
from body.description import load
from body.trial import first_pose, try_motion
from m512.files.formats import load as load_motions
from motions import promises
from motions.promises import IMAGE, LIBRARY
from tests.campaigns import proof
from tests.campaigns.onboard import try_on_board

TITLE = "Motions in physics"
PROMISE = "Motions walk, turn, get up and stay on their feet on bodies as they may be."

DATA = pathlib.Path(os.environ.get("M512_SHARED", proof.TOP.parent / "shared")) / "data" / "bio_gp_humanoid_kr_128p.bin"
GP = load("gp")
INIT, FORWARD, BACK = 1, 3, 13  # pages of the maker's set
AX18 = {servo: "ax18" for servo in range(9, 19)}
MODELS = {"AX-18": AX18, "AX-12": {}}
# Expected speeds in mm/s within +-25 %, measured with another model of the same robot (README of tools/body).
EXPECTED = {("AX-18", FORWARD): 210, ("AX-18", BACK): -204, ("AX-12", FORWARD): 139, ("AX-12", BACK): -83}
TOLERANCE = 0.25
SECONDS = 10
WALKS_ON_BOARD = 50
FIRST_SEED = 1000  # lower seeds were used while the motions were made


def add_arguments(group):
    group.add_argument("--only", metavar="PAGE", help="of our motions this one alone")
    group.add_argument("--bodies", type=int, metavar="N", help="bodies for each motion (default: as promises.py says)")
    group.add_argument(
        "--on-board",
        type=int,
        default=WALKS_ON_BOARD,
        metavar="N",
        help="bodies that walk with the shipped image on the simulated board (default: %(default)s)",
    )
    group.add_argument("--seed-of", type=int, metavar="SEED", help="repeat this body alone")


# --- the yardstick ---


def spoiled(how):
    """Returns the maker's set with one slope for all joints ("slope 4": 2^4) or with bent ankles ("ankle 12": degrees, toes up)."""
    library = load_motions(DATA)
    kind, _, amount = how.partition(" ")
    for number, page in library.items():
        if not number or not page.is_playable or not kind:
            continue
        for joint in range(31):
            if kind == "slope":
                page.set_compliance(joint, int(amount) * 0x11)
        for step in range(page.steps if kind == "ankle" else 0):
            for joint, side in ((15, 1), (16, -1)):
                word = page.word(step, joint)
                page.set_word(step, joint, min(1023, max(0, word + side * round(float(amount) * 1024 / 300))))
        page.seal()
    return library.to_bytes()


def gp_body(seed):
    """Returns a body within the ranges used for the expected speeds: friction, supply voltage and masses."""
    if seed is None:
        return NOMINAL
    chance = random_body(GP, seed)
    return Variation(
        seed=seed,
        volts=9.6 + 0.8 * (chance.volts - 9),
        floor_friction=0.5 + 0.75 * (chance.floor_friction - 0.4),
        mass={body: 1 + 2 / 3 * (factor - 1) for body, factor in chance.mass.items()},
    )


def yardstick(item):
    """Returns the Outcome of one trial. item: (change, servos, page, seed, on the board)."""
    how, servos, page, seed, on_board = item
    image = spoiled(how)
    if on_board:
        return try_on_board(image, page, SECONDS, INIT, robot=GP, variation=gp_body(seed), models=MODELS[servos])
    return try_motion(image, page, SECONDS, robot=GP, variation=gp_body(seed), models=MODELS[servos], pose=first_pose(image, INIT, GP))


def speed_figures(options):
    items = [("", servos, page, None, True) for servos, page in EXPECTED]
    outcomes = proof.each(yardstick, items, "yardstick, on the board", options.jobs)
    said, kept = [], True
    for (_, servos, page, _, _), outcome in zip(items, outcomes):
        expected = EXPECTED[servos, page]
        kept &= outcome.fell_s is None and outcome.on_feet and abs(outcome.forward_mm_s - expected) <= TOLERANCE * abs(expected)
        said.append(f"{servos} {'forward' if page == FORWARD else 'back'} {outcome.forward_mm_s:.0f} mm/s (expected {expected})")
    return proof.Figure(
        "The maker's walks walk, as fast as they should within 25 %.",
        f"the maker's pages, each with its own slopes, on the simulated board, 11.1 V, {SECONDS} s, MuJoCo {mujoco.__version__}",
        "; ".join(said),
        kept,
        headline=True,
    )


SPOILT = {"": (1, 1), "slope 4": (0, 0.1), "slope 5": (0, 0.3), "ankle 12": (0, 0), "ankle -12": (0, 0)}  # share that may stand


def spoilt_figures(options):
    seeds = range(1, 3 if options.sample else 11)
    items = [(how, "AX-18", FORWARD, seed, False) for how in SPOILT for seed in seeds]
    outcomes = proof.each(yardstick, items, "yardstick, bodies by chance", options.jobs)
    said, kept = [], True
    for how, (least, most) in SPOILT.items():
        stood = sum(outcome.fell_s is None for item, outcome in zip(items, outcomes) if item[0] == how)
        kept &= least * len(seeds) <= stood <= most * len(seeds)
        said.append(f"{how or 'as made'}: {stood} of {len(seeds)} stand")
    return proof.Figure(
        "The maker's walk stands on all bodies; with wrong slopes or bent ankles it falls.",
        "friction 0.5..1.1, 9.6..12 V, masses +-10 %, AX-18 legs; slopes 16 and 32 for all joints, ankles off by 12 degrees",
        "; ".join(said),
        kept,
    )


# --- our motions ---


def body_stands(item):
    promise, seed, _ = item
    stood, said = promises.stands(IMAGE, LIBRARY.find(promise.page), promise, seed)
    return bool(stood), said


def walk_on_board(item):
    promise, seed, _ = item
    page, ready, body = LIBRARY.find("walk"), LIBRARY.find("ready"), promises.body_of(promise, seed)
    outcome = try_on_board(IMAGE, page, promise.seconds, ready, variation=body, keys=promise.keys)
    return bool(outcome.fell_s is None and outcome.on_feet), outcome.said()


def share_figure(what, how, promise, results):
    """results: {seed: (kept, message)}, at least one."""
    bad = {seed: said for seed, (kept, said) in sorted(results.items()) if not kept}
    stood = len(results) - len(bad)
    measured = f"{stood} of {len(results)} bodies; seeds {min(results)}-{max(results)}"
    if bad:
        measured += f"; not {', '.join(str(seed) for seed in list(bad)[:60])}; the first: {next(iter(bad.values()))}"
    return proof.Figure(what, how, measured, stood >= promise.share * len(results), headline=promise.page == "walk")


def results_of(work, promise, count, where, options):
    """Returns {seed: (kept, message)} of a motion's bodies. work((promise, seed, where)) tries one; where: what leads it."""
    seeds = [options.seed_of] if options.seed_of is not None else range(FIRST_SEED, FIRST_SEED + count)
    results = options.kept.each(work, [(promise, seed, where) for seed in seeds], f"{promise.page}, {where}", options.jobs)
    return dict(zip(seeds, results))


def stand_figures(options):
    figures = []
    for promise in promises.STANDS:
        if options.only not in (None, promise.page) or (options.sample and promise.page not in promises.EASY):
            continue
        count = promise.bodies if options.bodies is None else options.bodies
        results = results_of(body_stands, promise, 1 if options.sample else count, "player", options)
        begin = f", from its {promise.lie}, arms anyhow" if promise.lie else ""
        how = f" {promise.how}" if promise.how else ""
        what = f"`{promise.page}`{how}{begin}: it ends on its feet."
        figures.append(share_figure(what, f"{promise.seconds:.0f} s, bodies by chance", promise, results))
    return figures


def board_figures(options):
    walk = next(promise for promise in promises.STANDS if promise.page == "walk")
    results = results_of(walk_on_board, walk, options.on_board, "board", options)
    what = "`walk` led by the shipped image: it ends on its feet."
    return [share_figure(what, "the same, on the simulated board with a remote", walk, results)]


def nominal_figure():
    said, kept = [], True
    for promise in promises.GOES:
        missing, what = promises.goes(IMAGE, LIBRARY.find(promise.page), promise)
        kept &= not missing
        said.append(f"{promise.page}: {', '.join(missing) or 'as promised'} ({what})")
    return proof.Figure("Motions go as far and turn as much as they promise.", "nominal body, AX-12, 11.1 V", "; ".join(said), kept)


def ease_of(promise):
    return promises.eases(IMAGE, LIBRARY.find(promise.page), promise)


def eases_figure(options):
    asked = [promise for promise in promises.STANDS if not options.sample or promise.page in promises.EASY]
    results = proof.each(ease_of, asked, "torques", options.jobs)
    bad = [f"{promise.page}: {', '.join(missing)}" for promise, (missing, _) in zip(asked, results) if missing]
    said = ", ".join(f"{promise.page} {what}" for promise, (_, what) in zip(asked, results))
    return proof.Figure(
        "No motion asks a servo for more than 90 % of its speed, or for more than a third of its torque on average.",
        "nominal body, AX-12, 11.1 V, every motion once; goals are whole units (tests/models/test_library_speeds.py: over four ticks)",
        "; ".join(bad) or said,
        not bad,
    )


def bears_figure():
    missing, what = promises.bears(IMAGE, LIBRARY.find("walk"))
    return proof.Figure(
        "Servos bear ten minutes of walking.",
        "nominal body, AX-12, 11.1 V; mean torque below a third of stall, heat below the servo's limit",
        "; ".join([*missing, what]),
        not missing,
    )


def run(options):
    figures = []
    if DATA.exists() and not options.only:
        figures += [speed_figures(options), spoilt_figures(options)]
    elif not DATA.exists():
        print(f"   the maker's motions are not here ({DATA.name}): no yardstick")
    if options.only or options.bodies is not None or options.seed_of is not None:
        options.keep = False  # a partial run
    options.kept = proof.Kept("physics", not options.sample and options.seed_of is None)
    figures += stand_figures(options)
    if not options.only and options.seed_of is None:
        figures.append(eases_figure(options))
    if not options.sample and options.seed_of is None:
        if options.only in (None, "walk") and options.on_board:
            figures += board_figures(options)
        if not options.only:
            figures += [nominal_figure(), bears_figure()]
    options.kept.finish()
    return figures
