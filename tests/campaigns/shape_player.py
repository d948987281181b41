# SPDX-License-Identifier: MIT
"""The rows of the part shape that need no body: the player on the PC against the models of the specification (tests/models)."""

import functools

from tests.campaigns import proof
from tests.models import classic, hand_over, jumps, shaped

# --- what is played ---

CASES, STEPS = 2000, 1000
PIECE = 100


def unset(first):
    """Compares PIECE plays with nothing set. Returns the differences."""
    return classic.compare(first, PIECE)[1]


def changed(first):
    """Compares PIECE plays whose settings change at any tick. Returns the differences."""
    return shaped.compare(first, PIECE)


def law_figures(options):
    firsts = range(options.seed, options.seed + CASES, PIECE)
    plain = [said for found in proof.each(unset, firsts, "nothing set", options.jobs) for said in found]
    wrong = [said for found in proof.each(changed, firsts, "set at any tick", options.jobs) for said in found]
    jumped = {what: jumps.broken(what, STEPS, options.seed) for what in jumps.WHATS}
    bad = {what: said for what, (said, _) in jumped.items() if said}
    return [
        proof.Figure(
            "Nothing set: every goal as the original's.",
            "classic law, motion areas by chance, every call of every joint against the "
            "model of the page of the spec (which gives the twelve recordings of the original); exact law: unit.player_golden",
            f"{len(plain)} of {CASES} plays differ" + (f"; the first: {plain[0]}" if plain else ""),
            not plain,
        ),
        proof.Figure(
            "Rate, amplitude, blend and centre change at any tick: every way-point, length and way as the page of the spec says.",
            "exact law, motion areas by chance",
            f"{len(wrong)} of {CASES} plays differ" + (f"; the first: {wrong[0]}" if wrong else ""),
            not wrong,
        ),
        proof.Figure(
            "They jump in every step of a walk: nothing passes a shaped way-point, no tick is idle, no change of speed above the law's own.",
            "our walk; rate 50 <-> 200, amplitude 0 <-> 120, blend -100 <-> 100, all, and each by chance",
            "; ".join(f"{what}: {said}" for what, said in bad.items()) or jumped["all"][1],
            not bad,
        ),
    ]


# --- a layer that comes and goes at every tick ---

EVERY_DEPTH = range(1, hand_over.DEPTH)
BY_CHANCE = 2000


def came_at(offs, item):
    """Returns (walks, faults) for a layer that starts at this tick of a walk and ends after each of the given times."""
    law, name, on = item
    return hand_over.every_tick(law, name, ons=[on], offs=offs)


def hand_over_figures(options):
    items = [(law, name, on) for law in hand_over.LAWS for name in hand_over.LAYERS for on in range(hand_over.CYCLE)]
    results = proof.each(functools.partial(came_at, EVERY_DEPTH), items, "layer", options.jobs)
    bad = [said for _, found in results for said in found]
    seeds = range(options.seed, options.seed + BY_CHANCE)
    strange = [said for said in proof.each(hand_over.by_chance, seeds, "pages by chance", options.jobs) if said]
    walks = sum(count for count, _ in results)
    how = "the player on the PC against the page of the spec; a joint that changes hands: 60 degrees/s, however many ticks one looks at"
    return [
        proof.Figure(
            "A layer comes at every tick of a walk and goes at every tick: who changes hands keeps to the approach speed and does not leap, the "
            "others go on bit by bit.",
            f"{how}; `wave_over` and `look` over our walk, both laws",
            f"{len(bad)} of {walks} walks wrong" + (f"; the first: {bad[0]}" if bad else ""),
            not bad,
        ),
        proof.Figure(
            "The same with pages, joints, moments and speeds by chance.",
            how,
            f"{len(strange)} of {BY_CHANCE} walks wrong" + (f"; the first: {strange[0]}" if strange else ""),
            not strange,
        ),
    ]
