# SPDX-License-Identifier: MIT
"""What happened in a run of a case, for the checks of mixed.py: the shape in force, the owner of each joint, the first difference of two
runs."""

from fractions import Fraction

from tests.models import classic_law, shaping
from tests.models.mixed_cases import SHAPE_ACTIONS
from tests.models.played import ENDED, JOINTS, OUTPUT, STEP, STOPPED

TIMING = STEP | ENDED | STOPPED | OUTPUT


def apply(shape, kind, *values):
    """Returns the model's Shape after a change, as a new object."""
    made = shaping.Shape(shape.blend, dict(shape.amplitude), shape.rate, shape.centre_page, shape.volts)
    if kind == "amplitude":
        made.amplitude.update({j: values[0] for j in range(JOINTS) if values[1] >> j & 1})
    elif kind == "reset":
        made.blend, made.amplitude, made.rate = 0, {}, 100
    else:
        setattr(
            made,
            {"rate": "rate", "blend": "blend", "centre": "centre_page", "voltage": "volts"}[kind],
            Fraction(values[0], 10) if kind == "voltage" else values[0],
        )
    return made


def model_pose(image, place, shape):
    """Returns the shaped pose. Centre page 0 means that nothing is scaled."""
    if shape.centre_page == 0:
        scaled = shaping.Shape(shape.blend, {}, shape.rate, place[0], shape.volts)
        page = classic_law.Page(image, place[0])
        other = shaping.partner(image, page, shape.blend)
        return {
            j: shaping.shaped_position(
                page.word(place[1], j),
                None if other is None or not shaping.used(other.word(place[1], j)) else other.word(place[1], j),
                None,
                scaled.blend,
                100,
            )
            for j in range(JOINTS)
            if shaping.used(page.word(place[1], j))
        }
    return shaping.shaped_pose(image, place[0], place[1], shape)


def in_force(case, run):
    """Returns the shapes: [0] before the play, [t + 1] in tick t."""
    shape = shaping.Shape(volts=Fraction(0))
    for action in case.before:
        shape = apply(shape, *action)
    shapes, actions = [shape], [action for action in run.done if action[1] in SHAPE_ACTIONS]
    for tick in range(run.ticks):
        while actions and actions[0][0] <= tick:
            shape = apply(shape, actions[0][1], *actions[0][2])
            actions.pop(0)
        shapes.append(shape)
    return shapes


def bits(mask):
    return {joint for joint in range(JOINTS) if mask >> joint & 1}


def used_by(image, page, step):
    return {joint for joint in range(JOINTS) if shaping.used(classic_law.Page(image, page).word(step, joint))}


def lent(case, run):
    """Returns the joints that may have been lent."""
    joints = set()
    for _, name, words, status in run.done:
        if name == "layer" and status == 0:
            joints |= bits(words[1]) if words[1] else used_by(case.image, words[0], 1)
        elif name in ("aim", "swing"):
            joints.add(words[0])
    return joints


def dropped(run):
    return set().union(*(bits(words[0]) for _, name, words, _ in run.done if name == "drop"))


def is_broken(run):
    return any(name == "break" for _, name, _, _ in run.done)


def ends_of(run):
    """Returns the last tick of each step."""
    return [step[0] - 1 for step in run.steps[1:]] + [run.ticks - 1]


def first_difference(run, other, joints, ticks, events=TIMING):
    """Returns the first difference of two runs within the first `ticks` ticks, or None."""
    ticks = min(ticks, max(run.ticks, other.ticks))
    if any(a[:ticks] != b[:ticks] for a, b in ((run.columns[j], other.columns[j]) for j in joints)) or [e & events for e in run.events[:ticks]] != [
        e & events for e in other.events[:ticks]
    ]:
        for tick in range(ticks):
            if tick >= run.ticks or tick >= other.ticks:
                return f"tick {tick}: {run.ticks} ticks, other {other.ticks}"
            if (run.events[tick] ^ other.events[tick]) & events:
                return f"tick {tick}: events {run.events[tick]:02x}, other {other.events[tick]:02x}"
            wrong = [j for j in joints if run.columns[j][tick] != other.columns[j][tick]]
            if wrong:
                return f"tick {tick}: joint {wrong[0]} at {run.columns[wrong[0]][tick]}, other {other.columns[wrong[0]][tick]}"
    return None


def owners(case, run):
    """Returns {joint: [(first tick, "main" | "page" | "code" | "none", action)]}, up to a break."""
    of_page, of_code, gone, found = set(), set(), set(range(JOINTS)) - bits(case.present), {j: [(0, "main", None)] for j in range(JOINTS)}

    def give(joints, tick, owner, action=None):
        for joint in joints - gone:
            found[joint].append((tick, owner, action))
        return joints - gone

    ends = [(tick + 1, "layer_off", (), 0) for tick in range(run.ticks) if run.layer_events[tick] & ENDED]
    for tick, name, words, status in sorted([*run.done, *ends], key=lambda action: (action[0], action[1] != "layer_off" or action in run.done)):
        if status != 0:
            continue
        if name in ("layer_off", "layer"):
            give(of_page, tick, "main")
            of_page = set()
        if name == "layer":
            joints = bits(words[1]) if words[1] else used_by(case.image, words[0], 1)
            of_page = give(joints - of_code, tick, "page")
        elif name in ("aim", "swing"):
            of_page -= {words[0]}
            of_code |= give({words[0]}, tick, "code", (name, *words))
        elif name == "free":
            give(of_code & bits(words[0]), tick, "main")
            of_code -= bits(words[0])
        elif name == "drop":
            give(bits(words[0]), tick, "none")
            of_page, of_code, gone = of_page - bits(words[0]), of_code - bits(words[0]), gone | bits(words[0])
        elif name == "break":
            give(set(range(JOINTS)), tick, "none")
            break
    return found


def halts_of(run):
    """Returns the ticks before which a pause began."""
    halts, paused = [], False
    for tick, name, _, _ in run.done:
        if name == "pause" and not paused:
            halts.append(tick)
        paused = name == "pause" or (paused and name != "resume")
    return halts


def paused_ticks(run):
    """Returns the ticks before which a pause was in force."""
    ticks, since = set(), None
    for tick, name, _, _ in run.done:
        if name == "pause" and since is None:
            since = tick
        elif name == "resume" and since is not None:
            ticks |= set(range(since, tick))
            since = None
    return ticks | (set(range(since, run.ticks)) if since is not None else set())
