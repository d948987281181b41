# SPDX-License-Identifier: MIT
"""What the library's motions promise in physics: figures on the nominal body, and a good end on random bodies.

`tools/prove physics` checks all promises.
All bodies are tilted, slippery and off their zeros (../body/src/body/chance.py). They are also pushed, except on the floor.
"""

import itertools
import math
import pathlib
import random
from dataclasses import dataclass

from body.chance import random_body
from body.description import load
from body.physics import Physics
from body.quick import IMAGE_BYTES, Quick
from body.trial import STOP, first_pose, try_motion
from m512.files.formats import load as load_motions

ROBOT = load("humanoid")
UP, DOWN, LEFT, RIGHT = 1, 2, 4, 8
PUSHES_PER_S = 1 / 12
ARMS = range(1, 7)
LYING_DEGREES = 45
LIBRARY = load_motions(pathlib.Path(__file__).with_name("motions.m512"))
IMAGE = LIBRARY.to_bytes()
READY = first_pose(IMAGE, 1, ROBOT)
NOTHING = bytes(IMAGE_BYTES)  # an image without motions


@dataclass(frozen=True)
class Stands:
    """A motion that ends on the robot's feet on at least the fraction `share` of the bodies."""

    page: str
    seconds: float
    keys: tuple = ()  # of the remote: (second, code)
    how: str = ""  # distinguishes two promises of the same page
    lie: str = None  # starts on its "face" or "back", with random arms
    floor: bool = False  # goes to the floor on the way
    share: float = 0.99
    bodies: int = 200  # in a whole campaign


@dataclass(frozen=True)
class Goes:
    """Figures of a motion on the nominal body at 11.1 V: (lowest, highest), None: no limit."""

    page: str
    seconds: float
    keys: tuple = ()
    forward_mm_s: tuple = (None, None)
    turn_deg_s: tuple = (None, None)
    degrees_per_metre: float = None  # heading error, upper limit
    drift_mm_a_turn: float = None
    sideways_mm_s: tuple = (None, None)  # to the left


def round_trip(code, turn_codes, seconds):
    """A remote that walks, turns alternately to each side, and stops in time."""
    keys, at, turns = [], 0.0, itertools.cycle(turn_codes)
    while at < seconds - 8:
        keys += [(at, code), (at + 5, next(turns)), (at + 7, code)]
        at += 8
    return (*keys, (seconds - 4, STOP))


def a_minute(page, code, bodies):
    """One gait for a minute, then a stop."""
    return Stands(page, 60, ((0, code), (56, STOP)), bodies=bodies)


STANDS = [
    Stands("walk", 60, round_trip(UP, (RIGHT, LEFT), 60), bodies=200),
    a_minute("back", DOWN, 100),
    a_minute("right", RIGHT, 100),
    a_minute("left", LEFT, 100),
    a_minute("side_r", RIGHT + 16, 100),
    a_minute("side_l", LEFT + 16, 100),
    a_minute("turn_r", RIGHT, 100),
    a_minute("turn_l", LEFT, 100),
    Stands("right", 40, ((0, RIGHT), (8, LEFT), (16, UP), (22, RIGHT), (26, LEFT), (30, UP), (36, STOP)), "from way to way", bodies=100),
    Stands("side_r", 40, ((0, RIGHT + 16), (8, LEFT + 16), (16, UP), (22, LEFT), (28, UP), (34, DOWN), (36, STOP)), "from way to way", bodies=100),
    Stands("ready", 3),
    Stands("bow", 6),
    Stands("wave", 6),
    Stands("clap", 6),
    Stands("cheer", 6),
    Stands("sit", 6),
    Stands("stand", 6),
    Stands("dance", 24, ((14, STOP),)),
    Stands("kick_r", 8),
    Stands("kick_l", 8),
    Stands("pushups", 40, ((6, STOP),), floor=True),
    Stands("get_up", 20, lie="face", floor=True),
    Stands("get_up_back", 20, lie="back", floor=True),
]
GOES = [
    Goes("walk", 12, ((0, UP),), forward_mm_s=(150, None), degrees_per_metre=5),
    Goes("back", 12, ((0, DOWN),), forward_mm_s=(None, -60)),
    Goes("right", 12, ((0, RIGHT),), turn_deg_s=(None, -30), drift_mm_a_turn=50),
    Goes("left", 12, ((0, LEFT),), turn_deg_s=(30, None), drift_mm_a_turn=50),
    # A cycle to the side takes 64 ticks: 26 mm a step and less than 9 forward. A cycle of a curve takes 56: 20 degrees a cycle.
    Goes("side_r", 12, ((0, RIGHT + 16),), sideways_mm_s=(None, -53), forward_mm_s=(-17, 17)),
    Goes("side_l", 12, ((0, LEFT + 16),), sideways_mm_s=(53, None), forward_mm_s=(-17, 17)),
    Goes("turn_r", 12, turn_deg_s=(None, -46)),
    Goes("turn_l", 12, turn_deg_s=(46, None)),
]
BEARS_S = 600  # of walking
BEARS_NM = 1.5 * 11.1 / 12 / 3  # mean torque of a servo: a third of its stall torque at 11.1 V
EASES_UNITS_PER_TICK = 0.9 * 59 * 11.1 / 12 * 6 / 128 * 1024 / 300 + 1  # 90 % of an AX-12's speed; goals are whole units
BEARS_DEGREES_C = 70  # the limit in an AX-12's address 11
EASY = ("ready", "bow", "wave", "clap", "cheer", "sit", "stand")  # a sample of these must never fail


def body_of(promise, seed):
    pushes = 0 if promise.floor or promise.lie else max(1, round(promise.seconds * PUSHES_PER_S))
    return random_body(ROBOT, seed, promise.seconds - 1, pushes=pushes)


def lying_by_chance(promise, seed):
    """{servo: position} in which this body lies on its face or back: each arm joint anywhere between its stops, independently; the legs
    anywhere between straight and `ready`, each joint off by up to 9 degrees. Rejects poses in which links overlap, or in which the robot
    does not lie: after a second with torque on, the trunk is tilted by more than LYING_DEGREES."""
    chance, body = random.Random(f"lying {promise.lie} {seed}"), body_of(promise, seed)
    for _ in range(1000):
        pose = _arms_and_legs(chance)
        physics = Physics(ROBOT, body)
        physics.lie(pose, face_down=promise.lie == "face")
        if _through_itself(physics):
            continue
        quick = Quick(NOTHING, physics)
        quick.torque_on()
        quick.run(128)
        if _lies(physics, promise.lie):
            return pose
    raise ValueError(f"no pose found in which body {seed} lies on its {promise.lie}")


def _arms_and_legs(chance):
    bent, pose = chance.random(), {}
    for servo, joint in ROBOT.joints.items():
        if servo in ARMS:
            pose[servo] = round(joint.position(chance.uniform(joint.low, joint.high)))
        else:
            pose[servo] = round(512 + bent * (READY[servo] - 512) + chance.uniform(-30, 30))
    return pose


def _through_itself(physics):
    """Whether links of the robot overlap by more than 2 mm; the floor does not count."""
    floor = physics.model.geom("floor").id
    return any(contact.dist < -0.002 and floor not in (contact.geom1, contact.geom2) for contact in physics.data.contact[: physics.data.ncon])


def _lies(physics, side):
    """Whether the trunk's front, or back, points down."""
    front = physics.data.xmat[physics.root].reshape(3, 3)[2, 0]
    return (-front if side == "face" else front) > math.cos(math.radians(LYING_DEGREES))


def stands(image, number, promise, seed):
    """Tries one body: (promise kept, what happened)."""
    outcome = try_motion(
        image,
        number,
        promise.seconds,
        robot=ROBOT,
        variation=body_of(promise, seed),
        keys=promise.keys,
        lie=promise.lie,
        pose=lying_by_chance(promise, seed) if promise.lie else None,
        falls=not promise.floor,
    )
    return outcome.fell_s is None and outcome.on_feet, outcome.said()


def goes(image, number, promise):
    """Tries the nominal body: (failures, what happened)."""
    outcome = try_motion(image, number, promise.seconds, robot=ROBOT, keys=promise.keys)
    missing = [] if outcome.fell_s is None else ["it falls"]
    for name in ("forward_mm_s", "turn_deg_s", "sideways_mm_s"):
        low, high = getattr(promise, name)
        value = getattr(outcome, name)
        if low is not None and value < low or high is not None and value > high:
            missing.append(f"{name} {value:.0f}, promised {low if low is not None else high}")
    if promise.degrees_per_metre is not None and abs(outcome.x_mm) > 1:
        off = abs(outcome.heading) / abs(outcome.x_mm / 1000)
        if off > promise.degrees_per_metre:
            missing.append(f"{off:.1f} degrees a metre, promised {promise.degrees_per_metre}")
    if promise.drift_mm_a_turn is not None and abs(outcome.heading) > 30:
        drift = (outcome.x_mm**2 + outcome.y_mm**2) ** 0.5 / (abs(outcome.heading) / 360)
        if drift > promise.drift_mm_a_turn:
            missing.append(f"drifts {drift:.0f} mm a turn, promised {promise.drift_mm_a_turn}")
    return missing, outcome.said()


def eases(image, number, promise):
    """Tries the nominal body: (excesses of its servos, what happened). Checks the speed and the mean torque."""
    outcome = try_motion(image, number, promise.seconds, robot=ROBOT, keys=promise.keys, lie=promise.lie, falls=not promise.floor)
    missing = [f"mean torque {outcome.most_torque_nm:.2f} N m"] if outcome.most_torque_nm >= BEARS_NM else []
    if outcome.most_units_per_tick > EASES_UNITS_PER_TICK:
        missing.append(f"{outcome.most_units_per_tick:.0f} units a tick")
    return missing, f"{outcome.most_torque_nm:.2f} N m, {outcome.most_units_per_tick:.0f} units a tick"


def bears(image, number):
    """Ten minutes of walking on the nominal body: (failures, what happened)."""
    outcome = try_motion(image, number, BEARS_S, robot=ROBOT, keys=((0, UP),))
    hottest = max(load.most_degrees_c for load in outcome.loads.values())
    missing = [] if outcome.fell_s is None else [f"it falls after {outcome.fell_s:.0f} s"]
    missing += [f"mean torque {outcome.most_torque_nm:.2f} N m"] if outcome.most_torque_nm >= BEARS_NM else []
    missing += [f"{hottest:.0f} degrees C"] if hottest >= BEARS_DEGREES_C else []
    return missing, f"largest mean torque {outcome.most_torque_nm:.2f} N m of {BEARS_NM:.2f}, {hottest:.0f} degrees C of {BEARS_DEGREES_C}"
