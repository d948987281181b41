# SPDX-License-Identifier: MIT
"""The legs of the robot of these motions, as geometry: where a foot is, and which joint positions bring it there.

Joints from the hip down: yaw, roll, pitch, knee (pitch), ankle pitch, ankle roll. The body stays upright, and a foot is
flat on the ground exactly when its three pitch angles sum to 0 and its two roll angles do; `reach` gives nothing else.

Coordinates of the body, in mm: x forward, y to the left, z down; a foot is told by its ankle, seen from where its own
hip stands above the ground, with its yaw in degrees, to the left. Angles of joints are told as for the right leg: see
SIGNS. The left leg is the mirror image.
"""
import pathlib
import sys
from dataclasses import dataclass
from math import acos, atan2, cos, degrees, hypot, radians, sin

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "body" / "src"))
from body.description import load  # noqa: E402  (the path comes first)

ROBOT = load("humanoid")            # the one body that these motions are made for
_LEG = ROBOT.leg("right")
BONE_MM = (_LEG.thigh_mm + _LEG.shank_mm) / 2   # from axis to axis; thigh and shank are equal within 0.1 mm
BENT_DEGREES = degrees(atan2(_LEG.thigh_back, _LEG.thigh_down))  # how far the thigh points back, the shank forward, at 512
HIP_MM = _LEG.hip_to_side           # from the middle of the body to the hip
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
    height: float = 146.0


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
    if length > 2 * BONE_MM:
        raise ValueError(f"{foot} is out of reach")
    bend = acos(length / (2 * BONE_MM)) + radians(BENT_DEGREES)  # half the knee's angle
    lean = atan2(forward, down)
    hip, ankle = units(degrees(bend + lean)), units(degrees(bend - lean))
    angles = {YAW: -side * units(foot.yaw), ROLL: units(degrees(roll)), HIP: hip, KNEE: -(hip + ankle), ANKLE: ankle,
              ANKLE_ROLL: -units(degrees(roll))}
    return {joint + (side < 0): CENTRE + side * angle for joint, angle in angles.items()}


def foot_of(position, side: int) -> Foot:
    """The way back: where the positions of one leg put its ankle ({ID: position} of at least that leg)."""
    angle = {joint: radians(side * (position[joint + (side < 0)] - CENTRE) / UNITS_PER_DEGREE)
             for joint in (YAW, ROLL, HIP, KNEE)}
    thigh = angle[HIP] - radians(BENT_DEGREES)
    shank = angle[HIP] + angle[KNEE] + radians(BENT_DEGREES)
    forward = BONE_MM * (sin(thigh) + sin(shank))
    down = BONE_MM * (cos(thigh) + cos(shank))
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


def weight_ahead(position):
    """How far the weight lies before the middle between the ankles, in mm, with both feet flat on the ground: the body leans
    as the right leg's pitch angles sum up to. Needs numpy."""
    from body.kinematics import centre_of_mass, places

    lean = sum(radians((position[joint] - CENTRE) / UNITS_PER_DEGREE) for joint in (HIP, KNEE, ANKLE))
    ankles = sum(places(ROBOT, position)[f"{side}_ankle"][0] for side in ("right", "left")) / 2
    away = centre_of_mass(ROBOT, position) - ankles
    return float(away[0] * cos(lean) + away[2] * sin(lean))
