#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes walk.m512: every motion in which the robot goes somewhere on its feet, computed from the legs (legs.py).

    tools/motions/gait.py [FILE]     writes walk.m512 (or FILE); the test compares what is committed with what this makes

A walk is six poses 60 degrees of the cycle apart. The body sways like a sine, a foot is in the air while the sway is
greatest to the other side, and each foot on the ground goes back at one speed, so that the two never drag each other:

    phase      30     90     150    210    270    330
    sway      +1/2    +1    +1/2   -1/2    -1    -1/2    of SWAY, to the left
    right      -1   in air   +1    +1/2     0    -1/2    of the stride, to the front
    left      +1/2     0    -1/2    -1   in air   +1
               \\______ walk_r ______/ \\______ walk_l _____/

Turning uses the same poses. The foot that is to go out turns while it is in the air, the other closes up in its turn, so that
toes never meet and no foot turns on the ground; every page begins and ends with the feet parallel.
"""
import pathlib
import sys
from dataclasses import replace

from legs import CENTRE, Foot, reach, units

SWAY = 26.0         # mm to either side; the hips are 38 from the middle
STRIDE = 16.0       # mm a foot is before and behind the hip; a cycle of six poses covers three of these
BACK = -12.0
LIFT = 12.0
TURN = 24.0         # degrees in a cycle of six poses
SIDE = 16.0         # mm to the side in one page
HEIGHT = 146.0      # hip above ankle
TICKS = 20          # from pose to pose
ARM_SWING = 0.9     # degrees of the arm for each mm of the foot
KICK_SWAY = 37.0    # on one leg for long: the body right above the foot

READY_ARM = {1: 12.0, 3: 12.0, 5: -20.0}  # shoulder swing, lift, elbow


def pose(right=Foot(), left=Foot(), sway=0.0, arms=(0.0, 0.0)):
    """Positions of all joints. sway: body to the left; arms: swing to the front added to the right and the left arm."""
    feet = [(replace(foot, y=foot.y - sway), side) for foot, side in ((right, 1), (left, -1))]
    row = {}
    for (foot, side), extra in zip(feet, arms):
        row |= reach(foot, side)
        arm = READY_ARM | {1: READY_ARM[1] + extra}
        row |= {joint + (side < 0): CENTRE + side * units(angle) for joint, angle in arm.items()}
    return row


def mirrored(row):
    return {joint: 2 * CENTRE - row[joint + 1 if joint % 2 else joint - 1] for joint in row}


READY = pose()


def cycle(stride, turn=0.0):
    """The six poses of a walk to the front (or back: stride below 0) that turns to the right by `turn` degrees."""
    def at(right, left, sway, yaw, lift_right=0.0, lift_left=0.0):
        return pose(Foot(right * stride, 0, -yaw * turn, HEIGHT - lift_right),
                    Foot(left * stride, 0, yaw * turn, HEIGHT - lift_left),
                    sway * SWAY, (ARM_SWING * left * stride, ARM_SWING * right * stride))
    return [at(-1, 1 / 2, 1 / 2, 0), at(0, 0, 1, 1 / 4, lift_right=LIFT), at(1, -1 / 2, 1 / 2, 1 / 2),
            at(1 / 2, -1, -1 / 2, 1 / 2), at(0, 0, -1, 1 / 4, lift_left=LIFT), at(-1 / 2, 1, -1 / 2, 0)]


def start(stride):
    """From ready: onto the right foot, the left one goes ahead; ends at phase 330."""
    return [(32, READY), (24, pose(sway=-0.9 * SWAY)),
            (TICKS, pose(Foot(-stride / 4), Foot(stride / 4, height=HEIGHT - LIFT), -SWAY)),
            (TICKS, cycle(stride)[5])]


def end(stride):
    """From phase 330: the right foot closes up."""
    return [(TICKS, cycle(stride)[0]),
            (TICKS, pose(Foot(-stride / 4, height=HEIGHT - LIFT), Foot(stride / 4), SWAY)),
            (TICKS, pose(sway=0.5 * SWAY)),
            (24, READY)]


def spin():
    """To the right on the spot, from ready to ready."""
    return [(TICKS, row) for row in cycle(0.0, TURN)] + [(TICKS, READY)]


def sidestep():
    """To the right, from ready to ready: the right foot out, the left one after it."""
    half = SIDE / 2
    apart = dict(right=Foot(y=-half), left=Foot(y=half))
    return [(24, pose(sway=0.7 * SWAY)),
            (TICKS, pose(Foot(y=-half, height=HEIGHT - LIFT), sway=SWAY)),
            (TICKS, pose(**apart, sway=0.5 * SWAY)),
            (TICKS, pose(**apart, sway=-0.7 * SWAY)),
            (TICKS, pose(left=Foot(y=half / 2, height=HEIGHT - LIFT), sway=-SWAY)),
            (TICKS, pose(sway=-0.5 * SWAY)),
            (24, READY)]


def kick():
    """With the right foot: weight onto the left one, back, forward fast, and down again."""
    def leg(x, lift):
        return pose(Foot(x, height=HEIGHT - lift), sway=KICK_SWAY, arms=(-0.8 * x, 0.8 * x))
    return [(64, pose(sway=KICK_SWAY)), (40, leg(0, 20)), (32, leg(-30, 24)), (40, leg(45, 24)), (40, leg(0, 20)),
            (40, pose(sway=KICK_SWAY)), (64, READY)]


PAGES = [
    # page, name, statements, steps (None: the mirror image of the page before), what it does
    (20, "walk", "code U; next walk_r; exit end_r; link1 R turn_r", start(STRIDE),
     "From ready onto the right foot; the left one goes ahead."),
    (21, "walk_r", "next walk_l; exit end_l; link1 L turn_l; link2 D end_l", [(TICKS, row) for row in cycle(STRIDE)[:3]],
     "The loop: right foot ..."),
    (22, "walk_l", "next walk_r; exit end_r; link1 R turn_r; link2 D end_r", None, "... and left foot."),
    (23, "turn_r", "next self; exit end_r; link1 U walk_r; link2 L walk_r", [(TICKS, row) for row in cycle(STRIDE, TURN)],
     "Walking on, to the right: right foot out, left foot after it."),
    (24, "turn_l", "next self; exit end_l; link1 U walk_l; link2 R walk_l", None,
     "The same to the left, begun by the left foot."),
    (25, "end_r", "", end(STRIDE), "The right foot closes up."),
    (26, "end_l", "", None, "The left foot closes up."),
    (27, "back", "code D; next back_r; exit back_end_r; link1 U back_end_r", start(BACK), "As walk, backwards."),
    (28, "back_r", "next back_l; exit back_end_l; link1 U back_end_l", [(TICKS, row) for row in cycle(BACK)[:3]],
     "The loop: right foot ..."),
    (29, "back_l", "next back_r; exit back_end_r; link1 U back_end_r", None, "... and left foot."),
    (30, "back_end_r", "", end(BACK), "The right foot closes up."),
    (31, "back_end_l", "", None, "The left foot closes up."),
    (32, "right", "code R; next self; link1 L left; link2 U walk", spin(), "Turns right on the spot, from ready to ready."),
    (33, "left", "code L; next self; link1 R right; link2 U walk", None, "Turns left on the spot."),
    (34, "side_r", "code R+B1; next self; link1 L+B1 side_l; link2 U walk", sidestep(), "A step to the side."),
    (35, "side_l", "code L+B1; next self; link1 R+B1 side_r; link2 U walk", None, "A step to the other side."),
    (36, "kick_r", "code R+B4; accel 6", kick(), "Kicks with the right foot, standing on the left."),
    (37, "kick_l", "code L+B4; accel 6", None, "Kicks with the left foot."),
]

HEADER = """\
# SPDX-License-Identifier: MIT
# Made by gait.py: change that, not this. Positions 0..1023, 512 straight; README.md tells the joints and their directions.
motion512 1
include "body.m512"
accel 8
softness 5

#           swing    lift    elbow    yaw     roll     hip     knee    ankle  ankle roll
pose ready | """


POSES = [
    ("left", pose(sway=SWAY), "the body swayed to the left, feet where they are; `mirror @left` is the other side"),
    ("low", pose(*2 * [Foot(height=134.5)]), "knees bent"),
    ("low_left", pose(*2 * [Foot(height=134.5)], sway=SWAY), "both"),
    ("deep", pose(*2 * [Foot(height=115.0)]), "knees bent a lot"),
    ("seat", pose(*2 * [Foot(height=101.5)]), "down on the heels"),
]


def line(row):
    return "  ".join(f"{row[joint]:3} {row[joint + 1]:3}" for joint in range(1, 19, 2))


def text():
    out, steps = [HEADER + line(READY)], []
    out += [f"pose {name} | {line(row)}  # {remark}" for name, row, remark in POSES]
    for number, name, statements, made, remark in PAGES:
        steps = made if made is not None else [(ticks, mirrored(row)) for ticks, row in steps]
        out += ["", f"# {remark}", f"page {number} {name}"] + [f"  {part}" for part in statements.split("; ") if part]
        out += [f"  step {ticks:2} | {'@ready' if row == READY else line(row)}" for ticks, row in steps]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    target = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("walk.m512")
    target.write_text(text())
