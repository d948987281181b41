# SPDX-License-Identifier: MIT
"""The checks of mixed.py. Each compares two plays that are equal by the specification, or checks a bound. A check takes a Case and its
Run, and returns the fault or None."""

import bisect
import itertools
import math
from fractions import Fraction

from tests.models import classic_law, mixed_cases, shaping
from tests.models.mixed_cases import LAYER_ACTIONS, SHAPE_ACTIONS, TICKS, play
from tests.models.mixed_facts import bits, dropped, ends_of, first_difference, halts_of, in_force, is_broken, lent, model_pose, owners, paused_ticks
from tests.models.played import CLASSIC, ENDED, EXACT, JOINTS, OUTPUT, STOPPED

BYTES_PAGE, UNROLLED = 512, 109  # the number of pages that an unrolled play may have
COMBINATIONS = 64
BRAKES_TICKS = 8
UNITS_A_TICK = 1024 / 300 / 128  # units per tick for 1 degree/s
BESIDE_TARGET = 3 * JOINTS  # units, over all joints: the classic law ends a step slightly off its target


# --- bytes ---


def poses_of(case, run):
    """Returns for each step its possible poses, the likeliest first: from the shapes in force in the two steps before it and in its
    first tick. Returns a text if there is a fault. A pause between two steps counts to the first one, which has ended then."""
    shapes, found, away = in_force(case, run), [], lent(case, run) | dropped(run)
    present = bits(case.present)
    ends, halts = ends_of(run), halts_of(run)
    for k, (tick, page, step) in enumerate(run.steps):
        since = run.steps[k - 2][0] if k >= 2 else 0
        looked = run.steps[k - 1][0] if k >= 1 else 0
        window = sorted(range(since, tick + 2), key=lambda at: abs(at - looked))
        poses = []
        for shape in {id(shapes[at]): shapes[at] for at in window}.values():
            pose = model_pose(case.image, (page, step), shape)
            if pose not in poses:
                poses.append(pose)
        if k + 1 < len(run.steps) or (run.ended and not is_broken(run)):
            at_ends = [ends[k], *(at for halt in halts if tick < halt <= ends[k] for at in (halt - 1, halt))]
            off = [min(sum(abs(run.columns[j][at] - pose[j]) for j in pose if j in present - away) for at in at_ends) for pose in poses]
            if case.law == EXACT:
                if 0 not in off:
                    return f"page {page} step {step} ends in tick {ends[k]}: no shape that was in force makes these goals"
                poses = [pose for pose, by in zip(poses, off) if by == 0]
            else:
                played = any(run.events[at] & OUTPUT for at in range(tick, ends[k] + 1))  # otherwise it is skipped and ends anywhere
                most = min(off) + BESIDE_TARGET if played and min(off) <= BESIDE_TARGET else max(off)
                poses = [pose for by, pose in sorted(zip(off, poses), key=lambda pair: pair[0]) if by <= most]
        found.append(poses)
    return found


def unrolled(case, run, poses):
    """Returns (area with one page for each page visited, tick up to which the run can be compared)."""
    image, number = bytearray(case.image), 0
    until = run.ticks if run.ended and not is_broken(run) else run.steps[-1][0]
    for k, ((tick, page, step), pose) in enumerate(zip(run.steps, poses)):
        if step == 1:
            if number == UNROLLED:
                until = min(until, run.steps[k - 1][0])
                break
            number += 1
            image[BYTES_PAGE * number : BYTES_PAGE * (number + 1)] = case.image[BYTES_PAGE * page : BYTES_PAGE * (page + 1)]
            made = memoryview(image)[BYTES_PAGE * number : BYTES_PAGE * (number + 1)]
            made[15], made[17], made[18], made[25], made[26] = 1, 0, 0, number + 1, 0
        for joint, place in pose.items():
            made[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = place.to_bytes(2, "little")
    last = image[BYTES_PAGE * number : BYTES_PAGE * (number + 1)]
    last[25] = 0
    image[BYTES_PAGE * number : BYTES_PAGE * (number + 1)] = last
    for page in range(1, number + 1):
        made = memoryview(image)[BYTES_PAGE * page : BYTES_PAGE * (page + 1)]
        mixed_cases.sealed(made)
    return bytes(image), until


def check_bytes(case, run):
    if case.about["rates"] or not run.steps:
        return None
    if dropped(run) and by_way(case, run):
        return None  # a joint lost after the look still counts for that step's length; a shaped step is looked at earlier
    poses = poses_of(case, run)
    if isinstance(poses, str):
        return poses
    before = [action for action in case.before if action[0] in ("rate", "voltage")]
    actions = [action for action in case.actions if action[1] not in (*SHAPE_ACTIONS, "stop")]
    if math.prod(map(len, poses)) > COMBINATIONS:
        return None  # too many combinations that the joints never lent cannot tell apart
    found = None
    for chosen in itertools.product(*poses):
        image, until = unrolled(case, run, chosen)
        found = first_difference(run, play(case, image, before, actions), range(JOINTS), until)
        if found is None:
            break
    return found


# --- layers ---


def by_way(case, run):
    """Returns whether the length of any step depends on its joints' displacements."""
    limited = any(shape.volts and shape.is_set() for shape in in_force(case, run))
    return limited or any(case.image[BYTES_PAGE * page + 16] == 0 for page in mixed_cases.MAIN_PAGES)


def check_layers(case, run):
    if not any(action[1] in LAYER_ACTIONS for action in case.actions):
        return None
    plain = play(case, actions=[action for action in case.actions if action[1] not in LAYER_ACTIONS])
    return first_difference(run, plain, sorted(set(range(JOINTS)) - lent(case, run)), TICKS, 0xFF)


# --- hands, and motion by code ---


def bounded_until(row, begin, per_tick):
    """Returns the last tick up to which the joint keeps to the speed between any two ticks from `begin` on."""
    # row[b] - row[a] <= per_tick (b - a) + 1 for all a < b, in both directions: it is enough to keep the extreme lines.
    above = below = None
    for tick in range(begin, len(row)):
        up, down = row[tick] - per_tick * tick, row[tick] + per_tick * tick
        above, below = up if above is None else min(above, up), down if below is None else max(below, down)
        if up > above + 1.001 or down < below - 1.001:
            return tick - 1
    return len(row) - 1


def check_hand_over(row, steps, at, end, per_tick):
    """Checks a joint that changes hands after tick `at`: it keeps to the speed until it has completed its new owner's first step.
    Returns the fault or None."""
    free = bounded_until(row[:end], at, per_tick) + 1
    firsts = [step[0] for step in steps]
    k = bisect.bisect_right(firsts, at)
    if free < end and (k + 1 >= len(firsts) or free < firsts[k + 1]):
        return f"tick {free}: faster than the approach in its new owner's first step, {row[free - 1]} -> {row[free]}"
    return None


def check_return(row, source, at, end, per_tick):
    """Checks a joint that returns to the walk after tick `at`. Until it meets the walk without a layer it keeps to the speed; from then
    on it equals that walk. Returns the fault or None."""
    met = end = min(end, len(row), len(source))
    while met > at + 1 and row[met - 1] == source[met - 1]:
        met -= 1
    free = bounded_until(row[:met], at, per_tick) + 1
    if free < met:
        return f"tick {free}: faster than the approach, {row[free - 1]} -> {row[free]}"
    if met < end and abs(row[met] - row[met - 1]) > max(per_tick + 1, abs(source[met] - source[met - 1])):
        return f"tick {met}: leaps from {row[met - 1]} to the walk at {row[met]}"
    return None


def check_hands(case, run):
    per_tick, paused = case.deg_s * UNITS_A_TICK, paused_ticks(run)
    layer_ends = [(tick + 1, 0, 0) for tick in range(run.ticks) if run.layer_events[tick] & ENDED]
    steps = sorted(run.layer_steps + layer_ends)
    plain = play(case, actions=[action for action in case.actions if action[1] not in LAYER_ACTIONS])
    for joint, spans in owners(case, run).items():
        row = run.columns[joint]
        for k, (tick, owner, action) in enumerate(spans):
            end = min(spans[k + 1][0] if k + 1 < len(spans) else run.ticks, run.ticks)
            if tick == 0 or tick >= end:
                continue
            if owner == "main":
                wrong = check_return(row, plain.columns[joint], tick - 1, end, per_tick)
            elif owner == "page":
                wrong = check_hand_over(row, steps, tick - 1, end, per_tick)
            elif owner == "code":
                wrong = by_code(row, action, tick, end, per_tick, paused)
            else:
                wrong = None if len(set(row[tick - 1 : end])) == 1 or any(name == "break" for _, name, _, _ in run.done) else "moves, but is lost"
            if wrong:
                return f"joint {joint}, to {owner} in tick {tick}: {wrong}"
    return None


def by_code(row, action, begin, end, per_tick, paused):
    """Returns what is wrong with a joint that code moves in ticks begin..end-1, or None."""
    moves = [tick for tick in range(begin, end) if tick not in paused]
    if any(row[tick] != row[tick - 1] for tick in range(begin, end) if tick in paused):
        return "moves in a pause"
    if action[0] == "swing":
        most = max(per_tick, 6.3 * action[3] / action[4]) + 2
        fast = [tick for tick in moves if abs(row[tick] - row[tick - 1]) > most]
        return f"tick {fast[0]}: a swing of {most:.1f} units a tick goes {row[fast[0] - 1]} -> {row[fast[0]]}" if fast else None
    slow = bounded_until(row[:end], begin - 1, per_tick) + 1
    if slow < end:
        return f"tick {slow}: an aim is too fast, {row[slow - 1]} -> {row[slow]}"
    most_left = max(0, abs(row[begin - 1] - action[2]) - per_tick * len(moves) + 2)
    return f"an aim is at {row[end - 1]} after {len(moves)} ticks" if abs(row[end - 1] - action[2]) > most_left else None


# --- nothing set ---


def check_nothing(case, run):
    if any(action[0] == "rate" for action in case.before) or case.about["rates"]:
        return None
    actions = case.only("pause", "resume", "stop", "break", "drop")
    return first_difference(play(case, actions=actions), play(case, actions=actions, alone=True), range(JOINTS), TICKS, 0xFF)


# --- lengths ---


def check_lengths(case, run):
    if case.law != EXACT or is_broken(run) or case.only("drop"):
        return None
    plain = play(case, actions=[action for action in case.actions if action[1] not in LAYER_ACTIONS]) if case.only(*LAYER_ACTIONS) else run
    shapes, target, halts = in_force(case, plain), list(case.pose), halts_of(plain)
    present, ends, sums = bits(case.present), ends_of(plain), [Fraction(0)] * 2
    # After a pause between two steps, or before the first, the next step begins from a stop and is longer.
    next_halted = bool(halts) and halts[0] <= plain.steps[0][0]
    was_shaped = False
    exactly = not case.about["rates"] and not halts and not any(action[0] == "voltage" and action[1] for action in case.before)
    for k, (tick, page, step) in enumerate(plain.steps[:-1]):
        since, wrong, fits = plain.steps[k - 2][0] if k >= 2 else 0, None, False
        halted = next_halted or any(tick < halt <= ends[k] for halt in halts)
        next_halted = False
        at_ends = [ends[k], *(at for halt in halts if tick < halt <= ends[k] for at in (halt - 1, halt))]
        in_question = list({id(shapes[at]): shapes[at] for at in range(since, tick + 2)}.values())
        # The step before may have been a shaped one: then this one is limited.
        for shape, after_shaped in itertools.product(in_question, {False, was_shaped}):
            pose = {j: to for j, to in model_pose(case.image, (page, step), shape).items() if j in present}
            at_end = [at for at in at_ends if all(plain.columns[j][at] == to for j, to in pose.items())]
            if at_end:
                next_halted, fits, ideal = at_end != [ends[k]], True, ideal_of(case, page, step, target, pose, shape, after_shaped)
                wrong = None if halted else length_wrong(plain, target, pose, shape.is_set() or after_shaped, ideal, k, ends)
                if wrong is None:
                    break
        was_shaped = any(shape.is_set() for shape in in_question)
        if not fits or wrong:
            return wrong or f"page {page} step {step} ends in tick {ends[k]}: no shape that was in force makes these goals"
        sums = [sums[0] + ideal, sums[1] + ends[k] + 1 - tick]
        exactly = exactly and ideal >= 1
        if exactly and abs(sums[0] - sums[1]) > Fraction(9, 8):
            return f"page {page} step {step} ends in tick {ends[k]}: {sums[1]} ticks since the beginning, model {float(sums[0]):.2f}"
        for joint, to in pose.items():
            target[joint] = to
    return None


def ideal_of(case, page, step, target, pose, shape, after_shaped):
    of = classic_law.Page(case.image, page)
    longest = max((abs(to - target[j]) for j, to in pose.items()), default=0)
    unlimited = shaping.Shape(rate=shape.rate) if shape.volts == 0 else shape
    if shape.volts == 0:
        unlimited.volts = Fraction(10**6)
    return max(shaping.ideal_step(of, step, longest, unlimited, after_shaped), Fraction(1)) + shaping.ideal_pause(of, step, shape)


def length_wrong(run, target, pose, is_limited, ideal, k, ends):
    """Returns what is wrong with step k, or None: its length, or a joint outside its range."""
    tick, page, step = run.steps[k]
    if abs(ends[k] + 1 - tick - ideal) > 2 + (ideal / 60 if is_limited else 0):
        return f"page {page} step {step} from tick {tick} on: {ends[k] + 1 - tick} ticks, model {float(ideal):.2f}"
    for joint, to in pose.items():
        low, high = sorted((target[joint], to))
        beside = [at for at in range(tick, ends[k] + 1) if not low <= run.columns[joint][at] <= high]
        if beside:
            return f"tick {beside[0]}: joint {joint} at {run.columns[joint][beside[0]]}, its way is {low}..{high}"
    return None


# --- pauses and breaks ---


def check_pauses(case, run):
    if not case.only("pause", "break"):
        return None
    plain = play(case, actions=case.only("pause", "resume", "break"))
    wrong = stands_well(case, plain)
    if wrong:
        return wrong
    actions = case.only("pause", "resume")
    halted, straight = play(case, actions=actions), play(case, actions=[], ticks=2 * TICKS)
    halts, ends, straight_ends = halts_of(halted), ends_of(halted), ends_of(straight)
    # After a pause between two steps, in a step's last tick, or before the first step, the next step begins from a stop and is longer.
    between = bool(halts) and halts[0] <= halted.steps[0][0]
    for k, ((tick, *place), (begun, *other)) in enumerate(zip(halted.steps[:-1], straight.steps)):
        if place != other:
            return f"step {k} is {place}, without a pause {other}"
        inside = [halt for halt in halts if tick < halt <= ends[k]]
        was_between, between = between, len(inside) > 1 or any(halt - tick >= straight_ends[k] - begun for halt in inside)
        if was_between or inside or (case.law == CLASSIC and by_way(case, halted)):
            continue  # under the classic law a joint may be slightly off its target after a step, but not after a pause
        if ends[k] - tick != straight_ends[k] - begun:
            return f"step {k} from tick {tick} on has {ends[k] - tick + 1} ticks, without a pause {straight_ends[k] - begun + 1}"
        wrong = [j for j in range(JOINTS) if halted.columns[j][ends[k]] != straight.columns[j][straight_ends[k]]]
        if wrong and case.law == EXACT:
            return (
                f"step {k} ends with joint {wrong[0]} at {halted.columns[wrong[0]][ends[k]]}, without a pause at "
                f"{straight.columns[wrong[0]][straight_ends[k]]}"
            )
    return None


def stands_well(case, run):
    """Checks that braking takes at most ACCEL_TIME ticks or 8, that no joint reverses meanwhile, and that nothing moves until it is
    resumed."""
    most = max(BRAKES_TICKS, max(case.image[512 * page + 24] for page in mixed_cases.MAIN_PAGES))
    halts = [(tick, name) for tick, name, _, _ in run.done]
    halted = False
    for k, (tick, name) in enumerate(halts):
        until = halts[k + 1][0] if k + 1 < len(halts) else run.ticks
        was, halted = halted, name != "resume"
        taken_back = k > 1 and halts[k - 1] == (tick, "resume") and halts[k - 2][1] == "pause"  # a resume that no tick has seen
        if name == "resume" or was or until <= tick or taken_back:
            continue
        stand = next((at for at in range(tick, until) if run.events[at] & (STOPPED | ENDED)), until - 1)
        if stand - tick > most:
            return f"a {name} in front of tick {tick} does not stand in tick {stand}"
        for joint in range(JOINTS):
            ways = [run.columns[joint][at] - run.columns[joint][at - 1] for at in range(max(tick, 1), until)]
            if any(way > 0 for way in ways) and any(way < 0 for way in ways):
                return f"a {name} in front of tick {tick}: joint {joint} turns round"
            if any(ways[stand + 1 - max(tick, 1) :]):
                return f"a {name} in front of tick {tick}: joint {joint} moves after tick {stand}"
    return None


CHECKS = {
    "bytes": check_bytes,
    "layers": check_layers,
    "hands": check_hands,
    "nothing": check_nothing,
    "lengths": check_lengths,
    "pauses": check_pauses,
}
