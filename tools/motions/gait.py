#!/usr/bin/env -S sh -c 'exec "${0%/*}/../dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""Makes walk.m512: every motion in which the robot goes somewhere on its feet, computed from the legs (legs.py).

    tools/motions/gait.py [FILE]     writes walk.m512 (or FILE); the test compares what is committed with what this makes

A walk is eight poses of a cycle. The right foot is in the air around the middle of the first four, the left foot of the last
four; the body sways like a sine, away from the foot in the air. A foot on the ground goes back at one speed:

             |      walk_r       |      walk_l       |
    right     back _/^^ air ^^\\_ front ............. back
    left      front ............. back _/^^ air ^^\\_ front
    body      left of the middle  | right of the middle

Walking on the spot, backwards, to the side, and curves are the same cycle with other ways of the feet. The numbers are in
gait.json, found by a search in physics; `Gait` describes them.
"""

import argparse
import json
import pathlib
from dataclasses import dataclass, replace
from math import cos, pi, radians, sin

from motions.legs import CENTRE, HIP_MM, Foot, reach, units

POSES = 8
HERE = pathlib.Path(__file__).resolve().parent


@dataclass(frozen=True)
class Gait:
    """One kind of gait. mm and degrees; ticks of 1/128 s."""

    ticks: int = 10  # between two poses
    accel: int = 3  # ACCEL_TIME of the pages
    slope: int = 5  # compliance of the legs
    hip_slope: int = 5  # of the hips' pitch, which carries the trunk: stiff
    ankle_slope: int = 5  # softness of the ankles' pitch; 4 is too stiff for wrong zeros, 6 sags (README.md)
    roll_slope: int = 5  # of the roll of hips and ankles: stiff where the robot stands on one foot for long
    stride: float = 0.0  # a foot moves this far to the front and back of its middle
    side: float = 0.0  # likewise, to the right
    turn: float = 0.0  # likewise, as an angle: the body turns to the right
    sway: float = 20.0  # of the body, to either side
    sway_lead: float = 0.0  # lead of the sway over the feet, in cycles
    step_lead: float = 0.0  # lead of the feet over the middle of the four poses, in cycles
    swing: float = 0.4  # fraction of the cycle that a foot is in the air
    lift: float = 15.0
    square: float = 0.7  # shape of the lift: 0 is a plateau, 1 a squared sine
    height: float = 138.0  # of the hip above the ankle
    lean: float = 0.0  # of the body, forward
    ahead: float = 0.0  # feet in front of the hips
    apart: float = 0.0  # feet, in addition to the distance of the hips
    spread: float = 5.0  # of the supporting leg's hip while it stands alone
    toes: float = 0.0  # up, in the air
    arms: float = 0.4  # degrees of an arm per mm of the opposite foot
    brace: float = 0.5  # fraction of the stride: at a stop the feet are this much further forward
    crouch: int = 0  # ticks in which a start first lowers the body to the gait's height; 0: during the first step

    @property
    def slopes(self):
        """{joints, as in the text format: compliance}."""
        return {
            "7..8": self.slope,
            "9..10": self.roll_slope,
            "11..12": self.hip_slope,
            "13..14": self.slope,
            "15..16": self.ankle_slope,
            "17..18": self.roll_slope,
        }


READY_ARM = {1: 12.0, 3: 12.0, 5: -20.0}  # shoulder swing, lift, elbow
KICK_SWAY = 39.0  # on one leg for long: the body exactly above the foot
KICK_LAND = 20.0  # the foot lands further inward, where the body is going
KICK_SPREAD = 6.0  # how far the hip of that leg yields under the load
KICK_ARMS_OUT = 15.0  # degrees; lets the hands pass hips and knees


def numbers():
    """Reads {name: Gait} from gait.json."""
    return {name: Gait(**values) for name, values in json.loads((HERE / "gait.json").read_text()).items()}


def arm(side, swing=0.0, out=0.0):
    angles = READY_ARM | {1: READY_ARM[1] + swing, 3: READY_ARM[3] + out}
    return {joint + (side < 0): CENTRE + side * units(angle) for joint, angle in angles.items()}


def stand(gait, sway=0.0, right=None, left=None, arms=(0.0, 0.0), arms_out=0.0):
    """Positions of all joints: feet side by side, the body `sway` mm to the left. right, left: changes of that foot. arms: degrees forward.
    arms_out: degrees to the side."""
    row = {}
    for side, change, swing in ((1, right, arms[0]), (-1, left, arms[1])):
        foot = Foot(gait.ahead, -side * gait.apart / 2 - sway, height=gait.height)
        row |= reach(replace(foot, **(change or {})), side, gait.lean) | arm(side, swing, arms_out)
    return row


def mirrored(row):
    return {joint: 2 * CENTRE - row[joint + 1 if joint % 2 else joint - 1] for joint in row}


def way(gait, phase):
    """Place of a foot in its cycle, which begins in the middle of the air phase: (-1 back .. 1 front, 0 down .. 1 up)."""
    phase = (phase + 0.5) % 1 - 0.5
    if abs(phase) < gait.swing / 2:
        part = phase / gait.swing + 0.5
        return -cos(pi * part), sin(pi * part) ** (2 * gait.square)
    return 1 - 2 * ((phase - gait.swing / 2) % 1) / (1 - gait.swing), 0.0


def foot(gait, side, phase, sway):
    """Returns one foot at a phase of its own cycle."""
    ahead, up = way(gait, phase + gait.step_lead)
    other_up = way(gait, phase + gait.step_lead + 0.5)[1]
    yaw = -gait.turn * ahead  # to the left, relative to the turning body
    curve = side * HIP_MM * sin(radians(yaw))  # the outer foot travels further
    return Foot(
        gait.ahead + gait.stride * ahead + curve,
        -side * gait.apart / 2 - gait.side * ahead - sway,
        yaw,
        gait.height - gait.lift * up,
        gait.toes * up,
        gait.spread * other_up,
    )


def cycle(gait):
    """Returns the eight poses."""
    rows = []
    for number in range(POSES):
        phase = (number + 0.5) / POSES - 0.25
        sway = gait.sway * sin(2 * pi * (phase + 0.25 + gait.sway_lead))
        feet = [foot(gait, side, phase + offset, sway) for side, offset in ((1, 0.0), (-1, 0.5))]
        swings = [gait.arms * (other.x - gait.ahead) for other in reversed(feet)]
        rows.append({})
        for side, at, swing in zip((1, -1), feet, swings):
            rows[-1] |= reach(at, side, gait.lean) | arm(side, swing)
    return rows


def half(gait):
    """The same gait with half the stride, side step and turn."""
    return replace(gait, stride=gait.stride / 2, side=gait.side / 2, turn=gait.turn / 2)


def start(gait, ready, first=-1):
    """From ready with half a step: onto one foot, while the other one (`first`: +1 right, -1 left) moves. Ends at the end of that half
    cycle."""
    whole, part = cycle(gait), cycle(half(gait))
    at = 0 if first > 0 else 4
    down = [(gait.crouch, stand(gait))] if gait.crouch else []
    return [
        (32, ready),
        *down,
        (round(1.6 * gait.ticks), stand(gait, first * 0.7 * gait.sway)),
        (gait.ticks, part[at + 1]),
        (gait.ticks, part[at + 2]),
        (round(1.5 * gait.ticks), whole[at + 3]),
    ]


def end(gait, ready):
    """From the end of the left foot's half cycle: the right foot closes up. Both feet end further forward than under a standing body, to
    catch the body's remaining motion. Then the body rises to ready."""
    whole, braced = cycle(gait), replace(gait, ahead=gait.ahead + gait.brace * gait.stride)
    part = cycle(half(braced))
    return [
        (gait.ticks, whole[0]),
        (round(1.5 * gait.ticks), part[1]),
        (gait.ticks, part[2]),
        (gait.ticks, stand(braced, 0.35 * gait.sway)),
        (40, ready),
    ]


def kick(ready_gait):
    """A kick with the right foot: weight onto the left one, back, fast forward, and down again. Most falls were to the left but began to
    the right: the hip gave way, the right foot touched the floor too early and pushed the body over the other one."""

    def leg(x, lift):
        return stand(
            ready_gait,
            KICK_SWAY,
            right={"x": ready_gait.ahead + x, "height": ready_gait.height - lift},
            left={"spread": KICK_SPREAD},
            arms=(-0.5 * x, 0.5 * x),
            arms_out=KICK_ARMS_OUT,
        )

    ready = stand(ready_gait)
    return [
        (32, ready),
        (72, stand(ready_gait, KICK_SWAY, arms_out=KICK_ARMS_OUT)),
        (40, leg(-30, 18)),
        (28, leg(40, 18)),
        (32, leg(0, 14)),
        (32, stand(ready_gait, KICK_LAND, arms_out=KICK_ARMS_OUT)),
        (64, ready),
    ]


@dataclass(frozen=True)
class Sheet:
    """One page of walk.m512: number, name, statements (separated by "; "), description, steps (ticks, positions)."""

    number: int
    name: str
    words: str
    remark: str
    steps: tuple
    gait: Gait

    def other(self, number, name, words, remark):
        """The page with the mirror image of these steps."""
        return replace(self, number=number, name=name, words=words, remark=remark, steps=tuple((ticks, mirrored(row)) for ticks, row in self.steps))


def beats(gait, rows):
    return tuple((gait.ticks, row) for row in rows)


def walking(gait, turn, ready):
    """The walk and its curves: partners of its two pages, and pages of their own."""
    loop, curve = cycle(gait), cycle(replace(gait, turn=turn, stride=0.94 * gait.stride))  # the outer foot travels further
    right = Sheet(
        21,
        "walk_r",
        "next walk_l; exit end_l; link1 L turn_l; link2 D end_l; blend right turn_r; blend left turn_l2",
        "The loop: right foot ...",
        beats(gait, loop[:4]),
        gait,
    )
    out = Sheet(
        23,
        "turn_r",
        "next turn_r2; exit end_l; link1 U walk_l; link2 L walk_l",
        "Walking on in a curve to the right: right foot out ...",
        beats(gait, curve[:4]),
        gait,
    )
    after = Sheet(38, "turn_r2", "next turn_r; exit end_r; link1 U walk_r; link2 L walk_r", "... left foot after it.", beats(gait, curve[4:]), gait)
    close = Sheet(25, "end_r", "", "The right foot closes up.", tuple(end(gait, ready)), gait)
    return [
        Sheet(
            20,
            "walk",
            "code U; next walk_r; exit end_r; link1 R turn_r",
            "From ready onto the right foot; the left one goes ahead.",
            tuple(start(gait, ready)),
            gait,
        ),
        right,
        right.other(
            22, "walk_l", "next walk_r; exit end_r; link1 R turn_r; link2 D end_r; blend right turn_r2; blend left turn_l", "... and left foot."
        ),
        out,
        out.other(24, "turn_l", "next turn_l2; exit end_r; link1 U walk_r; link2 R walk_r", "The same to the left, begun by the left foot."),
        close,
        close.other(26, "end_l", "", "The left foot closes up."),
        after,
        after.other(39, "turn_l2", "next turn_l; exit end_l; link1 U walk_l; link2 R walk_l", "... right foot after it."),
    ]


def backing(gait, ready):
    loop = cycle(gait)
    right = Sheet(28, "back_r", "next back_l; exit back_end_l; link1 U back_end_l", "The loop: right foot ...", beats(gait, loop[:4]), gait)
    close = Sheet(30, "back_end_r", "", "The right foot closes up.", tuple(end(gait, ready)), gait)
    return [
        Sheet(27, "back", "code D; next back_r; exit back_end_r; link1 U back_end_r", "As walk, backwards.", tuple(start(gait, ready)), gait),
        right,
        right.other(29, "back_l", "next back_r; exit back_end_r; link1 U back_end_r", "... and left foot."),
        close,
        close.other(31, "back_end_l", "", "The left foot closes up."),
    ]


def aside(gait, ready, numbers_of, names, keys, remark):
    """A gait with a right and a left version: start, loop of two pages, end, and their mirror images. The foot on that side moves first.
    numbers_of, names, keys: (right, left). The pages are name, name_a, name_b, name_end."""
    loop = cycle(gait)
    steps = [
        start(gait, ready, 1),
        beats(gait, loop[4:]),
        beats(gait, loop[:4]),
        [(ticks, mirrored(row)) for ticks, row in end(replace(gait, side=-gait.side, turn=-gait.turn), ready)],
    ]
    pages = []
    for numbers_here, name, other, key, other_key in zip(numbers_of, names, names[::-1], keys, keys[::-1]):
        end_name, away = f"{name}_end", f"link1 {other_key} {name}_end; link2 U {name}_end"
        words = [
            f"code {key}; next {name}_a; exit {end_name}",
            f"next {name}_b; exit {name}_b",
            f"next {name}_a; exit {end_name}; {away}",
            f"link1 {other_key} {other}; link2 U walk",
        ]
        remarks = [
            remark if name == names[0] else "The same to the other side.",
            "The loop: one foot ...",
            "... and the other.",
            "The feet close up.",
        ]
        pages += [
            Sheet(number, name + part, word, text, tuple(rows), gait)
            for number, part, word, text, rows in zip(numbers_here, ("", "_a", "_b", "_end"), words, remarks, steps)
        ]
        steps = [[(ticks, mirrored(row)) for ticks, row in rows] for rows in steps]
    return pages


def sheets(gaits):
    """All pages, in order of number."""
    ready = stand(gaits["ready"])
    kick_r = Sheet(
        36,
        "kick_r",
        "code R+B4",
        "Kicks with the right foot, standing on the left.",
        tuple(kick(gaits["ready"])),
        replace(gaits["ready"], accel=6, roll_slope=4),
    )
    return sorted(
        [
            *walking(gaits["walk"], gaits["turn"].turn, ready),
            *backing(gaits["back"], ready),
            *aside(gaits["spin"], ready, ((32, 40, 41, 42), (33, 43, 44, 45)), ("right", "left"), ("R", "L"), "Turns right on the spot."),
            *aside(gaits["side"], ready, ((34, 46, 47, 48), (35, 49, 50, 51)), ("side_r", "side_l"), ("R+B1", "L+B1"), "Steps to the right."),
            kick_r,
            kick_r.other(37, "kick_l", "code L+B4", "Kicks with the left foot."),
        ],
        key=lambda sheet: sheet.number,
    )


HEADER = """\
# SPDX-License-Identifier: MIT
# Made by gait.py: change that, not this. Positions 0..1023, 512 straight; README.md tells the joints and their directions.
motion512 1
include "body.m512"
accel 8
softness 5

#           swing    lift    elbow    yaw     roll     hip     knee    ankle  ankle roll
pose ready | """


def poses(gait):
    """Leg poses for the hand-written motions."""
    low, deep, seat = (Gait(height=height) for height in (120.0, 115.0, 101.5))  # upright, feet below the hips
    return [
        ("left", stand(gait, 26.0), "the body swayed to the left, feet where they are; `mirror @left` is the other side"),
        ("leaned", stand(replace(gait, lean=40.0, ahead=gait.ahead + 24.0)), "the body leans, the hips go back"),
        ("low", stand(low), "knees bent"),
        ("low_left", stand(low, 26.0), "both"),
        ("deep", stand(deep), "knees bent a lot"),
        ("seat", stand(seat), "down on the heels"),
    ]


def line(row):
    return "  ".join(f"{row[joint]:3} {row[joint + 1]:3}" for joint in range(1, 19, 2))


def text(gaits):
    ready = stand(gaits["ready"])
    out = [HEADER + line(ready)]
    out += [f"pose {name} | {line(row)}  # {remark}" for name, row, remark in poses(gaits["ready"])]
    for sheet in sheets(gaits):
        out += ["", f"# {sheet.remark}", f"page {sheet.number} {sheet.name}"] + [f"  {part}" for part in sheet.words.split("; ") if part]
        out += [f"  accel {sheet.gait.accel}"] if sheet.gait.accel != 8 else []
        softness = [f"{joints}:{slope}" for joints, slope in sheet.gait.slopes.items() if slope != 5]
        out += ["  softness " + " ".join(softness)] if softness else []
        out += [f"  step {ticks:2} | {'@ready' if row == ready else line(row)}" for ticks, row in sheet.steps]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="?", type=pathlib.Path, default=HERE / "walk.m512")
    parser.parse_args().file.write_text(text(numbers()), encoding="utf-8")
