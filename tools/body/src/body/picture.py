# SPDX-License-Identifier: MIT
"""Pictures of a body: a pose, or a strip of poses. Drawn with matplotlib from the body file; no display, no MuJoCo, no OpenGL.

    save_strip(path, [(label, scene(robot, positions)), ...])      # .png or .svg

A scene is a list of polygons in the frame of the floor (mm). The robot stands on its soles, as flat as its pose allows.
"""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy

from .description import numbers
from .kinematics import euler, places, turn

VIEW = (-55.0, 14.0)  # from the robot's right front; degrees around, degrees up
LIGHT = numpy.array((0.35, -0.5, 0.8)) / numpy.linalg.norm((0.35, -0.5, 0.8))
SIDES = 10  # of round shapes
BOX = [
    ((-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (-1, 1, -1)),
    ((1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)),
    ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)),
    ((-1, 1, -1), (-1, 1, 1), (1, 1, 1), (1, 1, -1)),
    ((-1, -1, -1), (-1, 1, -1), (1, 1, -1), (1, -1, -1)),
    ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)),
]


@dataclass
class Face:
    """A flat polygon: corners in order, mm; colour as red, green, blue 0..1."""

    corners: numpy.ndarray
    colour: tuple


def _round(size, half):
    """A prism with SIDES sides along z."""
    ring = [(size * cos(2 * numpy.pi * k / SIDES), size * sin(2 * numpy.pi * k / SIDES)) for k in range(SIDES)]
    low, high = [(*point, -half) for point in ring], [(*point, half) for point in ring]
    return [low[::-1], high] + [(low[k - 1], low[k], high[k], high[k - 1]) for k in range(SIDES)]


def _shape(geom):
    """Polygons of a geom in its own frame, mm; its origin and rotation in its body."""
    kind, size = geom.get("type", "sphere"), [1000 * value for value in numbers(geom.get("size"))]
    at, turned = 1000 * numpy.array(numbers(geom.get("pos", "0 0 0"))), euler(geom)
    if geom.get("fromto"):
        ends = 1000 * numpy.array(numbers(geom.get("fromto"))).reshape(2, 3)
        along = ends[1] - ends[0]
        at, size = ends.mean(axis=0), [size[0], numpy.linalg.norm(along) / 2]
        about = numpy.cross((0, 0, 1), along)
        if numpy.linalg.norm(about) > 1e-9:
            turned = turn(about, numpy.arccos(along[2] / numpy.linalg.norm(along)))
    if kind == "box":
        polygons = [[numpy.array(corner) * size for corner in face] for face in BOX]
    elif kind in ("capsule", "cylinder"):
        polygons = _round(size[0], size[1] + (size[0] if kind == "capsule" else 0))
    else:
        polygons = _round(size[0], size[0])
    return polygons, at, turned


def _colours(robot):
    return {material.get("name"): numbers(material.get("rgba"))[:3] for material in robot.root.iter("material")}


def scene(robot, positions):
    """Returns the robot in this pose, on its soles: [Face]."""
    found, colours, faces = places(robot, positions), _colours(robot), []
    level = sum(found[f"{side}_foot"][1][:, 2] for side in ("right", "left"))
    upright = turn((0, 1, 0), -numpy.arctan2(level[0], level[2]))
    for body, (origin, turned) in found.items():
        for geom in robot.bodies[body].findall("geom"):
            polygons, at, own = _shape(geom)
            for polygon in polygons:
                corners = numpy.array([upright @ (origin + turned @ (at + own @ numpy.array(corner))) for corner in polygon])
                faces.append(Face(corners, colours.get(geom.get("material", "bracket"), (0.7, 0.7, 0.7))))
    lowest = min(face.corners[:, 2].min() for face in faces)
    for face in faces:
        face.corners[:, 2] -= lowest
    return faces


def flat(faces, view=VIEW):
    """[(corners on the picture, colour)] from the farthest to the nearest, without faces that point away."""
    round_, up = (radians(angle) for angle in view)
    towards = numpy.array((cos(up) * cos(round_), cos(up) * sin(round_), sin(up)))
    right = numpy.array((-sin(round_), cos(round_), 0))
    above = numpy.cross(towards, right)
    seen = []
    for face in faces:
        normal = numpy.cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[1])
        size = numpy.linalg.norm(normal)
        if size == 0 or normal @ towards <= 0:
            continue
        light = 0.62 + 0.38 * max(0.0, normal @ LIGHT / size)
        seen.append(
            (
                face.corners.mean(axis=0) @ towards,
                numpy.column_stack((face.corners @ right, face.corners @ above)),
                tuple(light * part for part in face.colour),
            )
        )
    return [(corners, colour) for _, corners, colour in sorted(seen, key=lambda part: part[0])]


def polygons(parts, **how):
    """Converts the result of flat() to a matplotlib collection with the properties `how`."""
    from matplotlib.collections import PolyCollection

    return PolyCollection(
        [corners for corners, _ in parts], facecolors=[colour for _, colour in parts], edgecolors=(0, 0, 0, 0.35), linewidths=0.4, **how
    )


def save_strip(path, scenes, view=VIEW, height_inches=2.6, columns=8, dpi=120):
    """Draws [(label, faces)] in rows of `columns` into a .png or .svg file."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    drawn = [(label, flat(faces, view)) for label, faces in scenes]
    points = numpy.concatenate([corners for _, parts in drawn for corners, _ in parts])
    (left, low), (right, high) = points.min(axis=0) - 15, points.max(axis=0) + 15
    columns = min(columns, len(drawn))
    rows = -(-len(drawn) // columns)
    width = height_inches * (right - left) / (high - low)
    figure, axes = pyplot.subplots(rows, columns, squeeze=False, figsize=(columns * width, rows * (height_inches + 0.2)), layout="constrained")
    for axis in axes.flat:
        axis.set_axis_off()
    for axis, (label, parts) in zip(axes.flat, drawn):
        axis.add_collection(polygons(parts))
        axis.plot((left, right), (0, 0), color="0.6", linewidth=0.8, zorder=0)
        axis.set_xlim(left, right)
        axis.set_ylim(low, high)
        axis.set_aspect("equal")
        axis.set_title(label, fontsize=7)
    figure.savefig(path, dpi=dpi, metadata={"Date": None} if str(path).endswith(".svg") else None)
    pyplot.close(figure)
