#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the two files of the body that the page loads: body_files.py NAME FOLDER

FOLDER/body.xml   the MJCF of tools/body without what is optional, for MuJoCo
FOLDER/body.json  the same as numbers, for the picture and for kinematics: links with their places, joints with their servos,
                  shapes with their colours and masses. Metres, kilograms, radians, quaternions as w x y z. There is no number here that is not in
                  the body file.
"""

import json
import pathlib
import sys
from math import cos, radians, sin, sqrt

from body.description import UNITS_PER_RADIAN, load, numbers


def multiplied(a, b):
    (aw, ax, ay, az), (bw, bx, by, bz) = a, b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def quaternion(element):
    """The quaternion of `euler` (degrees), which is about x, then the new y, then the new z: the default of MJCF."""
    result = (1.0, 0.0, 0.0, 0.0)
    for axis, angle in enumerate(numbers(element.get("euler", "0 0 0"))):
        half = radians(angle) / 2
        turn = [cos(half), 0.0, 0.0, 0.0]
        turn[axis + 1] = sin(half)
        result = multiplied(result, turn)
    return result


def from_to(ends):
    """Centre, half length and quaternion of a capsule or cylinder between two points; its z axis points along them."""
    a, b = ends[:3], ends[3:]
    way = [q - p for p, q in zip(a, b)]
    length = sqrt(sum(w * w for w in way))
    x, y, z = (w / length for w in way)
    turn = (1 + z, -y, x, 0.0) if z > -1 + 1e-9 else (0.0, 1.0, 0.0, 0.0)
    size = sqrt(sum(t * t for t in turn))
    return [(p + q) / 2 for p, q in zip(a, b)], length / 2, [t / size for t in turn]


def shape(geom, body):
    kind = geom.get("type", "sphere")
    size, place, turn = list(numbers(geom.get("size"))), list(numbers(geom.get("pos", "0 0 0"))), list(quaternion(geom))
    if geom.get("fromto"):
        place, half, turn = from_to(numbers(geom.get("fromto")))
        size.append(half)
    return {
        "name": geom.get("name"),
        "body": body,
        "type": kind,
        "size": size,
        "pos": place,
        "quat": turn,
        "material": geom.get("material", "bracket"),
        "mass": float(geom.get("mass", "0")),
    }


def described(body):
    root = body.root
    links, shapes = [], []
    for name, element in body.bodies.items():
        links.append(
            {"name": name, "parent": body.parent[name], "pos": list(numbers(element.get("pos", "0 0 0"))), "quat": list(quaternion(element))}
        )
        shapes += [shape(geom, name) for geom in element.findall("geom")]
    axes = {joint.get("name"): list(numbers(joint.get("axis", "0 0 1"))) for joint in root.iter("joint")}
    joints = [
        {
            "servo": j.servo,
            "name": j.name,
            "body": j.body,
            "direction": j.direction,
            "zero": j.zero,
            "radiansPerUnit": 1 / UNITS_PER_RADIAN,
            "low": j.low,
            "high": j.high,
            "axis": axes[j.name],
        }
        for j in body.joints.values()
    ]
    materials = {m.get("name"): list(numbers(m.get("rgba"))) for m in root.iter("material")}
    return {"name": body.name, "links": links, "joints": joints, "shapes": shapes, "materials": materials}


def main(name, folder):
    body = load(name, head=False)
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "body.json").write_text(json.dumps(described(body)))
    (folder / "body.xml").write_text(body.xml())


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__.split("\n")[0])
    main(*sys.argv[1:])
