# SPDX-License-Identifier: MIT
"""Positions of a body's links in a pose, and its centre of mass. From the body file alone: no MuJoCo."""

from math import cos, radians, sin

import numpy

from .description import Description, numbers


def turn(axis, angle):
    """Rotation matrix about an axis; angle in radians."""
    x, y, z = numpy.asarray(axis, float) / numpy.linalg.norm(axis)
    c, s = cos(angle), sin(angle)
    return numpy.array(
        (
            (c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s),
            (y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s),
            (z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)),
        )
    )


def euler(element):
    """Rotation matrix of an element's euler angles, degrees about its own x, y, z in turn."""
    turned = numpy.eye(3)
    for axis, degrees in zip(numpy.eye(3), numbers(element.get("euler", "0 0 0"))):
        turned = turned @ turn(axis, radians(degrees))
    return turned


def places(robot: Description, positions):
    """{body: (origin in mm, rotation)} in the frame of the trunk. Servos not named in `positions` are at angle 0."""
    angles = {robot.joints[servo].name: robot.angle(servo, position) for servo, position in positions.items() if servo in robot.joints}
    found = {}
    for body, element in robot.bodies.items():  # parents come before their children
        parent = robot.parent[body]
        at, turned = found[parent] if parent else (numpy.zeros(3), numpy.eye(3))
        at = at + turned @ (numpy.array(robot.place_mm(body)) if parent else numpy.zeros(3))
        for joint in element.findall("joint"):
            turned = turned @ turn(numbers(joint.get("axis")), angles.get(joint.get("name"), 0.0))
        found[body] = at, turned
    return found


def centre_of_mass(robot, positions):
    """Centre of mass of the whole robot in this pose, mm in the frame of the trunk."""
    found, total, sum_ = places(robot, positions), 0.0, numpy.zeros(3)
    for body, (origin, turned) in found.items():
        for geom in robot.bodies[body].findall("geom"):
            mass = float(geom.get("mass", 0))
            sum_ += mass * (origin + turned @ _middle_mm(geom))
            total += mass
    return sum_ / total


def _middle_mm(geom):
    if geom.get("fromto"):
        return 1000 * numpy.array(numbers(geom.get("fromto"))).reshape(2, 3).mean(axis=0)
    return 1000 * numpy.array(numbers(geom.get("pos", "0 0 0")))
