# SPDX-License-Identifier: MIT
"""Random events in a play for mixed.py: pages of both schedules with steps of 1 to 40 ticks, changes of the shape, a layer, motion by code,
pause and resume, stop, break, lost joints.

A case is a motion area, settings made before the play, and actions: (tick before which it is done, name, words of do()).
"""

import ctypes
import random
from array import array
from dataclasses import dataclass, field

from tests.models.played import CLASSIC, ENDED, EXACT, GOALS, JOINTS, library

ALL = 0x7FFFFFFF
MAIN_PAGES, LAYER_PAGES, PARTNERS = range(1, 6), range(120, 124), range(110, 114)
CENTRE_PAGE = 100
JOINTS_USED = tuple(range(12))  # few, so that the same joints meet often
TICKS = 420
LAYER_ACTIONS = ("layer", "layer_off", "aim", "swing", "free")
SHAPE_ACTIONS = ("rate", "amplitude", "blend", "centre", "voltage", "reset")

library.played_layer.argtypes = (ctypes.c_int, ctypes.c_uint32, ctypes.c_int)
library.played_free.argtypes = library.played_drop.argtypes = (ctypes.c_uint32,)
for name in ("pause", "resume", "stop", "break", "drop", "layer_off", "free", "voltage", "reset", "speed"):
    getattr(library, f"played_{name}").restype = None


@dataclass
class Case:
    seed: int
    law: int
    image: bytes
    page: int
    present: int
    pose: list
    before: list  # settings made before the play, as actions without ticks
    actions: list
    deg_s: int  # the speed of hand-overs
    about: dict = field(default_factory=dict)

    def only(self, *kinds):
        """Returns the actions of these kinds."""
        return [action for action in self.actions if action[1] in kinds]


@dataclass
class Run:
    """A recording up to the end of the play. columns[joint][tick]; events and layer_events by tick; steps: (first tick, page, step) of
    the main play; layer_steps; done: (tick, name, words, status) of the actions."""

    columns: list
    events: list
    layer_events: list
    places: list
    steps: list
    layer_steps: list
    done: list
    ended: bool

    @property
    def ticks(self):
        return len(self.events)


def do(name, words):
    """Does an action. Returns its status, 0: done."""
    return getattr(library, f"played_{name}")(*words) or 0


def play(case, image=None, before=None, actions=None, alone=False, ticks=TICKS):
    """Plays the case, or with another image or other actions. Returns None if it does not start."""
    library.played_load(case.image if image is None else image)
    for name, *words in case.before if before is None else before:
        do(name, words)
    library.played_call(0)
    if library.played_start(case.law, case.page if image is None else 1, case.present, GOALS(*case.pose)) != 0:
        return None
    if alone:
        library.played_alone()
    goals, events, places = (ctypes.c_uint16 * (JOINTS * ticks))(), (ctypes.c_uint8 * (2 * ticks))(), (ctypes.c_uint8 * (4 * ticks))()
    made, done = 0, []
    for tick, name, *words in [*(case.actions if actions is None else actions), (ticks, None)]:
        if tick > made:
            library.played_run(made, min(tick, ticks) - made, ticks, goals, events, places)
            if any(events[2 * at] & ENDED for at in range(made, min(tick, ticks))):
                break
            made = tick
        if name:
            done.append((tick, name, words, do(name, words)))
    return recorded(goals, events, places, done, ticks)


def recorded(goals, events, places, done, ticks):
    main, layer = list(events[0::2]), list(events[1::2])
    last = next((tick for tick in range(ticks) if main[tick] & ENDED), None)
    count = ticks if last is None else last + 1
    flat, where = array("H", bytes(goals)), bytes(places)
    steps = [
        [(tick, where[4 * tick + 2 * which], where[4 * tick + 2 * which + 1]) for tick in range(count) if of[tick] & 2]
        for which, of in ((0, main), (1, layer))
    ]
    return Run(
        [flat[joint * ticks : joint * ticks + count] for joint in range(JOINTS)],
        main[:count],
        layer[:count],
        [where[4 * tick : 4 * tick + 2] for tick in range(count)],
        *steps,
        [action for action in done if action[0] < count],
        last is not None,
    )


# --- pages ---


def sealed(page):
    page[31] = 0
    page[31] = (0xFF - sum(page)) % 256
    return page


def time_byte(chance, ticks, page, longest):
    """Returns byte 63 of a step for about `ticks` ticks."""
    if page[16] == 0x0A:
        return max(1, min(255, round(ticks * 32 / page[22])))
    return max(1, min(255, round(40 * 32 * longest / (3 * ticks * page[22]))))


def page_by_chance(chance, style, steps, following, leaving):
    page = bytearray(512)
    page[15] = chance.choice((1, 1, 1, 2, 3))
    page[16] = chance.choice(style["schedules"])
    page[20], page[22], page[24] = steps, chance.choice((32, 32, 32, 21, 50)), chance.choice((0, 1, 2, 3, 4, 8, 32))
    page[25], page[26] = following, leaving
    spread = chance.choice((8, 60, 250))
    for step in range(1, 8):
        for joint in range(JOINTS):
            used = joint in JOINTS_USED and chance.random() > 0.15
            word = max(0, min(1023, 512 + chance.randint(-spread, spread))) if used else 0x4000
            page[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = word.to_bytes(2, "little")
        low, high = chance.choice(style["ticks"])
        page[64 * step + 62] = chance.choice((0, 0, 0, 0, 1, 2, 9)) if style["pauses"] else 0
        page[64 * step + 63] = time_byte(chance, chance.randint(low, high), page, spread)
    return sealed(page)


def area_by_chance(chance, style):
    """Returns an area. The main play's pages link to each other, and so do the layers'. Each partner has as many steps as one of the
    main pages."""
    image = bytearray(65536)

    def put(number, steps, following, leaving, partners=(0, 0)):
        page = page_by_chance(chance, style, steps, following, leaving)
        page[17], page[18] = partners
        image[512 * number : 512 * number + 512] = sealed(page)

    for number in MAIN_PAGES:
        steps = chance.randint(1, 7)
        following = chance.choice(MAIN_PAGES) if chance.random() < 0.9 else 0
        put(number, steps, following, chance.choice((*MAIN_PAGES, 0)), (chance.choice((0, *PARTNERS)), chance.choice((0, *PARTNERS))))
    for partner in PARTNERS:
        put(partner, image[512 * chance.choice(MAIN_PAGES) + 20], 0, 0)
    for number in LAYER_PAGES:
        put(number, chance.randint(1, 7), chance.choice((0, *LAYER_PAGES)), 0)
    put(CENTRE_PAGE, 1, 0, 0)
    return bytes(image)


# --- actions ---


def mask_by_chance(chance):
    return sum(1 << joint for joint in JOINTS_USED if chance.random() < chance.choice((0.15, 0.5)))


def shape_by_chance(chance, rates):
    kind = chance.choice(
        ("rate", "amplitude", "amplitude", "blend", "blend", "centre", "voltage", "reset")
        if rates
        else ("amplitude", "amplitude", "amplitude", "blend", "blend", "blend", "centre", "reset")
    )
    return {
        "rate": lambda: ("rate", chance.choice((10, 50, 75, 100, 130, 200, 400))),
        "amplitude": lambda: ("amplitude", chance.choice((0, 1, 60, 100, 120, 150)), chance.choice((ALL, mask_by_chance(chance) | 1))),
        "blend": lambda: ("blend", chance.choice((-100, -37, 0, 1, 50, 100))),
        "centre": lambda: ("centre", chance.choice((CENTRE_PAGE, *MAIN_PAGES, 0))),
        "voltage": lambda: ("voltage", chance.choice((0, 96, 111, 120))),
        "reset": lambda: ("reset",),
    }[kind]()


def layer_by_chance(chance, deg_s):
    kind = chance.choice(("layer", "layer", "layer", "layer_off", "aim", "swing", "free"))
    joint = chance.choice(JOINTS_USED)
    return {
        "layer": lambda: ("layer", chance.choice(LAYER_PAGES), chance.choice((0, mask_by_chance(chance) | 1)), deg_s),
        "layer_off": lambda: ("layer_off",),
        "aim": lambda: ("aim", joint, chance.randrange(1024), 0),
        "swing": lambda: ("swing", joint, 512, chance.randint(1, 60), chance.randint(60, 300), chance.randrange(360)),
        "free": lambda: ("free", mask_by_chance(chance)),
    }[kind]()


def actions_by_chance(chance, style, deg_s):
    actions = [(0, "speed", deg_s)]
    for _ in range(style["shapes"]):
        actions.append((chance.randrange(TICKS), *shape_by_chance(chance, style["rates"])))
    for _ in range(style["layers"]):
        actions.append((chance.randrange(TICKS), *layer_by_chance(chance, deg_s)))
    for _ in range(style["halts"]):
        begin = chance.randrange(TICKS)
        actions += [(begin, "pause"), (begin + chance.choice((1, 2, 5, 12, 30)), "resume")]
    if chance.random() < 0.3:
        actions.append((chance.randrange(30, TICKS), chance.choice(("stop", "stop", "break"))))
    if chance.random() < 0.15:
        actions.append((chance.randrange(TICKS), "drop", mask_by_chance(chance)))
    return sorted((action for action in actions if action[0] < TICKS), key=lambda action: action[0])


TICK_STYLES = (((1, 6),), ((1, 6),), ((1, 3), (1, 6), (20, 40)), ((1, 40),), ((5, 9),), ((1, 1), (6, 7), (12, 14)))


def case_by_chance(seed):
    chance = random.Random(f"mixed {seed}")
    style = {
        "ticks": chance.choice(TICK_STYLES),
        "schedules": chance.choice(((0x0A,), (0x0A,), (0x0A, 0), (0,))),
        "pauses": chance.random() < 0.3,
        "shapes": chance.choice((0, 0, 2, 8, 30)),
        "layers": chance.choice((0, 1, 3, 9)),
        "halts": chance.choice((0, 0, 1, 4)),
        "rates": chance.random() < 0.4,
    }
    deg_s = chance.choice((20, 60, 120, 360))
    before = [("centre", CENTRE_PAGE)]
    if style["rates"]:
        before += [shape_by_chance(chance, True) for _ in range(chance.randint(0, 3))]
    elif chance.random() < 0.4:
        before += [("rate", chance.choice((50, 130, 200))), ("voltage", chance.choice((0, 96, 111)))]
        style["rate"] = True
    present = ALL if chance.random() < 0.7 else mask_by_chance(chance) | 1
    case = Case(
        seed,
        chance.choice((EXACT, EXACT, CLASSIC)),
        area_by_chance(chance, style),
        chance.choice(MAIN_PAGES),
        present,
        [chance.randint(300, 700) for _ in range(JOINTS)],
        before,
        [],
        deg_s,
        style,
    )
    case.actions = actions_by_chance(chance, style, deg_s)
    if style.get("rate"):  # reset would also set the rate
        case.actions = [action for action in case.actions if action[1] != "reset"]
    return case
