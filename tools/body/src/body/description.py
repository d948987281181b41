# SPDX-License-Identifier: MIT
"""A body file (humanoid.xml, gp.xml, or one of yours) as facts: joints, servo IDs, lengths, masses. Needs no MuJoCo.

    robot = load("humanoid")                  # a name in tools/body, or a path; head=True: with servos 19 and 20
    robot.angle(13, 318)                      # servo position -> radians of the joint
    robot.position(13, -0.99)                 # and back, with fractions
    robot.leg("right").thigh_mm

Angles are those of the body file: 0 is straight, and the table in README.md gives the positive direction for both sides. Servo positions
are 0..1023 for 300 degrees. Direction and zero of each servo come from the file.
"""

import pathlib
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from math import hypot, pi, radians

FOLDER = pathlib.Path(__file__).resolve().parents[2]
UNITS_PER_TURN = 1024 * 360 / 300
UNITS_PER_RADIAN = UNITS_PER_TURN / (2 * pi)


class BodyError(ValueError):
    """A body file cannot be used. The text names the file and the remedy."""


@dataclass(frozen=True)
class Joint:
    """A joint with a servo. low, high: limits of the body in radians; zero: servo position at angle 0; direction: +1 or -1."""

    servo: int
    name: str
    body: str
    direction: int
    zero: float
    low: float
    high: float

    def angle(self, position):
        return self.direction * (position - self.zero) / UNITS_PER_RADIAN

    def position(self, angle):
        return self.zero + self.direction * angle * UNITS_PER_RADIAN


@dataclass(frozen=True)
class Leg:
    """Lengths of a leg in mm, at angle 0. The knee is `back` mm behind the line from hip to ankle."""

    hip_to_side: float  # from the middle of the body to the hip
    shoulder_to_yaw: float  # from shoulder height down to the yaw axis; 0 without a yaw axis
    yaw_to_hip: float
    thigh_down: float
    thigh_back: float
    shank_down: float
    shank_forward: float
    ankle_to_sole: float
    sole: tuple  # extent from the ankle: back and front, inside and outside, such as (-58, 42, -30, 30)

    @property
    def thigh_mm(self):
        return hypot(self.thigh_down, self.thigh_back)

    @property
    def shank_mm(self):
        return hypot(self.shank_down, self.shank_forward)


class Description:
    """One body file."""

    def __init__(self, path, root):
        self.path, self.root = path, root
        self.name = root.get("model", path.stem)
        self.parent = {}  # body -> body that carries it; None: the trunk
        self.bodies = {}  # name -> element
        self._collect(root.find("worldbody"), None)
        self.joints = {}
        for joint in self._joints():
            if joint.servo in self.joints:
                raise BodyError(f"{path}: joints {self.joints[joint.servo].name} and {joint.name} both have servo {joint.servo}")
            self.joints[joint.servo] = joint
        if not self.joints:
            raise BodyError(f'{path}: no joint has user="ID direction zero"; without it no servo moves anything')
        self._check_parts()

    def _collect(self, element, parent):
        for child in element.findall("body"):
            self.bodies[child.get("name")] = child
            self.parent[child.get("name")] = parent
            self._collect(child, child.get("name"))

    def _check_parts(self):
        """What physics.py and trial.py need by name."""
        geoms = {geom.get("name") for geom in self.root.iter("geom")}
        for name in ("floor", "right_sole", "left_sole", "right_hand", "left_hand"):
            if name not in geoms:
                raise BodyError(f"{self.path}: no geom is called {name}; humanoid.xml shows what it is for")
        driven = {motor.get("joint") for motor in self.root.iter("motor")}
        for joint in self.joints.values():
            if joint.name not in driven:
                raise BodyError(f'{self.path}: joint {joint.name} has servo {joint.servo} and no motor; add <motor joint="{joint.name}"/>')

    def _joints(self):
        for name, body in self.bodies.items():
            for joint in body.findall("joint"):
                if joint.get("user") is None:
                    continue
                try:
                    servo, direction, zero = numbers(joint.get("user"))
                except ValueError:
                    servo = direction = zero = -1
                if not 0 <= servo <= 253 or servo != int(servo) or abs(direction) != 1:
                    raise BodyError(
                        f'{self.path}: joint {joint.get("name")} has user="{joint.get("user")}"; '
                        "it must be a servo ID 0..253, a direction 1 or -1, and a servo position"
                    )
                try:
                    low, high = (radians(angle) for angle in numbers(joint.get("range", "")))
                except ValueError:
                    raise BodyError(f'{self.path}: joint {joint.get("name")} needs range="LOW HIGH", in degrees') from None
                yield Joint(int(servo), joint.get("name"), name, int(direction), zero, low, high)

    @property
    def servos(self):
        """IDs in ascending order."""
        return sorted(self.joints)

    def angle(self, servo, position):
        return self.joints[servo].angle(position)

    def position(self, servo, angle):
        return self.joints[servo].position(angle)

    def xml(self):
        """The model as text, for MuJoCo."""
        return ElementTree.tostring(self.root, encoding="unicode")

    def place_mm(self, body):
        """Origin of a body in its parent: (x, y, z) in mm at angle 0."""
        return tuple(1000 * value for value in numbers(self.bodies[body].get("pos", "0 0 0")))

    def mass_g(self, body):
        """Mass of one link in g, without its children."""
        return 1000 * sum(float(geom.get("mass", 0)) for geom in self.bodies[body].findall("geom"))

    @property
    def total_g(self):
        return sum(self.mass_g(body) for body in self.bodies)

    def geom(self, name):
        """Attributes of a geom. KeyError: no such geom."""
        for element in self.root.iter("geom"):
            if element.get("name") == name:
                return element.attrib
        raise KeyError(f"{self.path} has no geom {name}")

    def _chain_mm(self, body):
        """Origin of a body relative to the trunk, in mm at angle 0."""
        at = (0.0, 0.0, 0.0)
        while self.parent[body] is not None:
            at = tuple(a + b for a, b in zip(at, self.place_mm(body)))
            body = self.parent[body]
        return at

    def leg(self, side):
        """Lengths of the leg on this side, "right" or "left"."""
        hip, knee, ankle = (self._chain_mm(f"{side}_{part}") for part in ("thigh", "shank", "ankle"))
        yaw = self._chain_mm(f"{side}_hip_yaw") if f"{side}_hip_yaw" in self.bodies else None
        foot, sole = self._chain_mm(f"{side}_foot"), self.geom(f"{side}_sole")
        (half_long, half_wide, half_high), (x, y, z) = (tuple(1000 * value for value in numbers(sole[key])) for key in ("size", "pos"))
        outward = (-1 if side == "right" else 1) * (y + foot[1] - ankle[1])
        return Leg(
            abs(hip[1]),
            -yaw[2] if yaw else 0.0,
            yaw[2] - hip[2] if yaw else 0.0,
            hip[2] - knee[2],
            hip[0] - knee[0],
            knee[2] - ankle[2],
            ankle[0] - knee[0],
            half_high - z,
            (x - half_long, x + half_long, outward - half_wide, outward + half_wide),
        )


def numbers(text):
    return tuple(float(part) for part in text.split())


def without_optional(root):
    """Removes what only a robot with more servos has: every element of class "optional"."""
    for parent in root.iter():
        for child in [child for child in parent if child.get("class") == "optional" and child.tag != "default"]:
            parent.remove(child)


def load(name="humanoid", head=False):
    """Loads a body file by its name in tools/body or by its path. BodyError: it is missing or not a body file."""
    path = pathlib.Path(name)
    path = path if path.suffix == ".xml" else FOLDER / f"{name}.xml"
    try:
        root = ElementTree.parse(path).getroot()
    except OSError as error:
        known = ", ".join(sorted(file.stem for file in FOLDER.glob("*.xml")))
        raise BodyError(f"no body file {path} ({error.strerror}); known here: {known}") from None
    except ElementTree.ParseError as error:
        raise BodyError(f"{path}: not XML: {error}") from None
    if root.tag != "mujoco" or root.find("worldbody") is None:
        raise BodyError(f"{path}: not a MuJoCo model (MJCF): it must be <mujoco> with a <worldbody>")
    if not head:
        without_optional(root)
    return Description(path, root)
