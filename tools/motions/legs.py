# SPDX-License-Identifier: MIT
"""Leg geometry of the robot of these motions: foot positions and the joint positions that reach them.

Lengths come from the body (../body/humanoid.xml). Joints from the hip down: yaw, roll, pitch, knee (pitch), ankle pitch, ankle roll. At 512
the knee is behind the line from hip to ankle, so the angles of thigh and shank differ from those of their servos by SET.

Coordinates of the body, in mm: x forward, y to the left, z down. The position of a foot is that of its ankle, relative to the point on the
ground below its hip; its yaw is in degrees to the left. Joint angles are those of the right leg. The left leg is the mirror image.
"""

from dataclasses import dataclass
from math import acos, atan2, cos, degrees, hypot, radians, sin

from body.description import load

LEG = load("humanoid").leg("right")
THIGH_MM, SHANK_MM = LEG.thigh_mm, LEG.shank_mm
HIP_MM = LEG.hip_to_side  # from the middle of the body to the hip
SET = degrees(atan2(LEG.thigh_back, LEG.thigh_down))  # of the thigh; the shank's is as large
UNITS_PER_DEGREE = 1024 / 300
CENTRE = 512

# IDs of the right leg; those of the left leg are one higher. Right leg, above 512: yaw turns the toes outward, roll spreads the leg (ankle
# roll turns the sole in the same direction), pitch moves the link below forward: thigh, shank, toes.
YAW, ROLL, HIP, KNEE, ANKLE, ANKLE_ROLL = 7, 9, 11, 13, 15, 17


@dataclass(frozen=True)
class Foot:
    """A foot below its hip. x, y, yaw: forward, left, turned left. height: hip above the ankle. toes: degrees up. spread: extra degrees of
    the hip servo outward, to hold the body up on one leg."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    height: float = 132.0
    toes: float = 0.0
    spread: float = 0.0


def units(angle: float) -> int:
    """Converts degrees to servo units. Halves are rounded away from 0, so that left and right stay mirrored."""
    size = int(abs(angle) * UNITS_PER_DEGREE + 0.5)
    return size if angle >= 0 else -size


def reach(foot: Foot, side: int, lean: float = 0.0):
    """{ID: position} of one leg. side: +1 right, -1 left; lean: degrees that the body leans forward above the legs. ValueError: the foot is
    out of reach."""
    turn = radians(foot.yaw)
    forward = foot.x * cos(turn) + foot.y * sin(turn)
    outward = -side * (foot.y * cos(turn) - foot.x * sin(turn))
    roll = degrees(atan2(outward, foot.height))
    down = hypot(outward, foot.height)
    length = hypot(forward, down)
    if length > THIGH_MM + SHANK_MM:
        raise ValueError(f"{foot} is out of reach")
    bend = degrees(acos(length / (THIGH_MM + SHANK_MM)))  # thigh and shank are equally long: half the angle between them
    line = degrees(atan2(forward, down))  # angle of the line from hip to ankle
    thigh, shank = units(line + bend + SET), units(line - bend - SET)
    angles = {
        YAW: -side * units(foot.yaw),
        ROLL: units(roll + foot.spread),
        HIP: thigh + units(lean),
        KNEE: shank - thigh,
        ANKLE: units(foot.toes) - shank,
        ANKLE_ROLL: -units(roll),
    }
    return {joint + (side < 0): CENTRE + side * angle for joint, angle in angles.items()}
