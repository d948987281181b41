# SPDX-License-Identifier: MIT
"""Random bodies: the unknown properties of a robot, drawn from a seed. The nominal body is Variation()."""

import dataclasses
import math
import random
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Push:
    """A push against the trunk, spread over 1/32 s: N s, direction in degrees (0 forward, 90 left)."""

    at_s: float
    newton_s: float
    towards: float


@dataclass(frozen=True)
class Variation:
    """Differences of one body from its file. Lengths in mm, angles in degrees."""

    seed: int = 0
    volts: float = 11.1
    floor_friction: float = 0.8
    tilt: float = 0.0  # of the floor; tilt_towards: downhill direction (0: forward)
    tilt_towards: float = 0.0
    gear_friction_nm: float = 0.05
    rotor_kgm2: float = 0.003
    mass: dict = field(default_factory=dict)  # body -> factor; other bodies keep their mass
    trunk_forward_mm: float = 0.0  # position of its centre of mass
    sole_forward_mm: float = 0.0
    hand_mm: float = 0.0  # added to the length of the hand
    zero_units: dict = field(default_factory=dict)  # servo -> error of its zero (512)
    pushes: tuple = ()

    def said(self):
        """The main values, on one line."""
        return (
            f"seed {self.seed}: {self.volts:.1f} V, floor {self.floor_friction:.2f}, tilt {self.tilt:.1f} towards "
            f"{self.tilt_towards:.0f}, gears {self.gear_friction_nm:.3f} N m, rotor {self.rotor_kgm2:.4f} kg m2, "
            f"{len(self.pushes)} pushes"
        )


NOMINAL = Variation()
DEGREE = 1024 / 300  # servo units
PUSH_NEWTON_S = 0.3


def random_body(robot, seed, seconds=0.0, zero_sigma_degrees=1.0, joint_units=2.0, pushes=0, volts=(9.0, 12.0)):
    """Returns a random body: friction 0.4..1.2, volts in the given range, masses +-15 %, servo zeros off by sigma and joints by +-units,
    the floor tilted 0..2 degrees, servo friction 0.03..0.1, rotor 0.001..0.01 (both uniform in their logarithm), pushes of up to 0.3 N s at
    random times within `seconds`. The same robot, seed and arguments give the same body on every machine."""
    chance = random.Random(f"{robot.name} {seed}")
    everything = chance.uniform(0.95, 1.05)
    return Variation(
        seed=seed,
        volts=chance.uniform(*volts),
        floor_friction=chance.uniform(0.4, 1.2),
        tilt=chance.uniform(0, 2),
        tilt_towards=chance.uniform(0, 360),
        gear_friction_nm=_even_in_log(chance, 0.03, 0.1),
        rotor_kgm2=_even_in_log(chance, 0.001, 0.01),
        mass={body: everything * chance.uniform(0.9, 1.1) for body in sorted(robot.bodies)},
        trunk_forward_mm=chance.uniform(-8, 8),
        sole_forward_mm=chance.uniform(-8, 8),
        hand_mm=chance.uniform(-8, 8),
        zero_units={servo: chance.gauss(0, zero_sigma_degrees) * DEGREE + chance.uniform(-joint_units, joint_units) for servo in robot.servos},
        pushes=tuple(Push(chance.uniform(0, seconds), chance.uniform(0, PUSH_NEWTON_S), chance.uniform(0, 360)) for _ in range(pushes)),
    )


def body_of_the_bench(robot, seed):
    """Returns a milder random body, for a robot on a good floor with its servo zeros set: friction 0.5..1.1, 9.6..12 V, masses +-15 %, the
    floor tilted by up to 2 degrees, joints off by +-1.5 units, servo friction and rotor as above."""
    body = random_body(robot, seed, zero_sigma_degrees=0.0, joint_units=1.5, volts=(9.6, 12.0))
    return dataclasses.replace(body, floor_friction=0.5 + 0.75 * (body.floor_friction - 0.4))


def _even_in_log(chance, low, high):
    return math.exp(chance.uniform(math.log(low), math.log(high)))
