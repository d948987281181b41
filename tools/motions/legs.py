# SPDX-License-Identifier: MIT
"""The legs of the robot of these motions, as geometry: where a foot is, and which joint positions bring it there.

Joints from the hip down: yaw, roll, pitch, knee (pitch), ankle pitch, ankle roll. The body stays upright, and a foot is
flat on the ground exactly when its three pitch angles sum to 0 and its two roll angles do; `reach` gives nothing else.

Coordinates of the body, in mm: x forward, y to the left, z down; a foot is told by its ankle, seen from where its own
hip stands above the ground, with its yaw in degrees, to the left. Angles of joints are told as for the right leg: see
SIGNS. The left leg is the mirror image.
"""
from dataclasses import dataclass
from math import acos, atan2, cos, degrees, hypot, radians, sin

THIGH_MM = SHANK_MM = 75.0
HIP_MM = 38.0               # from the middle of the body to the hip
UNITS_PER_DEGREE = 1024 / 300
CENTRE = 512

# IDs of the right leg; the left leg's are one higher. Right leg, above 512: yaw turns the toes outward, roll spreads the leg
# (the ankle's turns the sole the same way round), pitch brings forward what hangs below: thigh, shank, toes.
YAW, ROLL, HIP, KNEE, ANKLE, ANKLE_ROLL = 7, 9, 11, 13, 15, 17


@dataclass(frozen=True)
class Foot:
    """A foot below its hip. x, y, yaw: to the front, to the left, turned to the left. height: hip above the ankle."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    height: float = 132.0


def units(angle: float) -> int:
    """Degrees as servo units, rounded away from 0 at the half, so that left and right stay mirrored."""
    size = int(abs(angle) * UNITS_PER_DEGREE + 0.5)
    return size if angle >= 0 else -size


def reach(foot: Foot, side: int):
    """{ID: position} of one leg; side +1 right, -1 left. The sums of pitch and of roll come out as exactly 0."""
    turn = radians(foot.yaw)
    forward = foot.x * cos(turn) + foot.y * sin(turn)
    outward = -side * (foot.y * cos(turn) - foot.x * sin(turn))
    roll = atan2(outward, foot.height)
    down = hypot(outward, foot.height)
    length = hypot(forward, down)
    if length > THIGH_MM + SHANK_MM:
        raise ValueError(f"{foot} is out of reach")
    bend = acos(length / (THIGH_MM + SHANK_MM))  # thigh and shank are equal: half the knee's angle
    lean = atan2(forward, down)
    hip, ankle = units(degrees(bend + lean)), units(degrees(bend - lean))
    angles = {YAW: -side * units(foot.yaw), ROLL: units(degrees(roll)), HIP: hip, KNEE: -(hip + ankle), ANKLE: ankle,
              ANKLE_ROLL: -units(degrees(roll))}
    return {joint + (side < 0): CENTRE + side * angle for joint, angle in angles.items()}


def foot_of(position, side: int) -> Foot:
    """The way back: where the positions of one leg put its ankle ({ID: position} of at least that leg)."""
    angle = {joint: radians(side * (position[joint + (side < 0)] - CENTRE) / UNITS_PER_DEGREE)
             for joint in (YAW, ROLL, HIP, KNEE)}
    forward = THIGH_MM * sin(angle[HIP]) + SHANK_MM * sin(angle[HIP] + angle[KNEE])
    down = THIGH_MM * cos(angle[HIP]) + SHANK_MM * cos(angle[HIP] + angle[KNEE])
    left = -side * down * sin(angle[ROLL])
    turn = -side * angle[YAW]
    return Foot(forward * cos(turn) - left * sin(turn), left * cos(turn) + forward * sin(turn), degrees(turn),
                down * cos(angle[ROLL]))


def between(position):
    """Where the left foot stands for the right one: (x, y) in mm, its turn to the left in degrees, and how much lower it
    is. What does not change while both are on the ground does not drag."""
    right, left = foot_of(position, 1), foot_of(position, -1)
    forward, sideways, turn = left.x - right.x, left.y - right.y + 2 * HIP_MM, radians(-right.yaw)
    return (forward * cos(turn) - sideways * sin(turn), forward * sin(turn) + sideways * cos(turn),
            left.yaw - right.yaw, left.height - right.height)


# Where the weight of the body is, for the check of balance. Masses in g, of a kit robot of 18 servos with its battery in
# the trunk; heights in mm above the hip, distances along a limb from its upper joint.
TRUNK_G, TRUNK_MM, SHOULDER_MM = 900.0, 55.0, 115.0
ARM_G, UPPER_ARM_MM, FOREARM_MM = 150.0, 65.0, 90.0
THIGH_G, SHANK_G, FOOT_G = 180.0, 70.0, 100.0


def weight_ahead(position):
    """How far the weight lies before the middle between the ankles, in mm, with both feet flat on the ground. The lean of the
    body is what the right leg's pitch angles sum to."""
    angle = {joint: radians((1 if joint % 2 else -1) * (position[joint] - CENTRE) / UNITS_PER_DEGREE) for joint in range(1, 19)}
    lean = angle[HIP] + angle[KNEE] + angle[ANKLE]
    parts = [(TRUNK_G, TRUNK_MM * sin(lean))]
    ankles = []
    for left in (0, 1):
        swing, lift, elbow = (angle[joint + left] for joint in (1, 3, 5))
        reached = (UPPER_ARM_MM * cos(lift) + FOREARM_MM * cos(lift + elbow)) / 2 * sin(swing - lean)
        parts.append((ARM_G, SHOULDER_MM * sin(lean) + reached))
        thigh = angle[HIP + left] - lean
        knee = THIGH_MM * sin(thigh)
        ankle = knee + SHANK_MM * sin(thigh + angle[KNEE + left])
        parts += [(THIGH_G, knee / 2), (SHANK_G, (knee + ankle) / 2), (FOOT_G, ankle)]
        ankles.append(ankle)
    return sum(mass * x for mass, x in parts) / sum(mass for mass, _ in parts) - sum(ankles) / 2
