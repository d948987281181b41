#!/usr/bin/env -S sh -c 'exec "${0%/*}/../dev/python" "$0" "$@"'
# SPDX-License-Identifier: MIT
"""How sure a way of going is: the least push that fells a robot whose ankles are off, in N s.

    tools/motions/margins.py walk                                      as it is: half a minute of an idle core
    tools/motions/margins.py walk height=118 ankle_slope=6,lift=12     and with other numbers of gait.json, a line each

Falls of bodies by chance are too rare to tell a good change from a bad one. This shows it at once: nearly all falls are of a robot that leans
to one side through its zeros and is pushed to that side. A cell is forward / backwards: pushed forward while it leans forward by LEAN
degrees, and the same backwards, in two moments of its cycle; the smaller counts. 0: it falls without a push. A column is a body or a
way that is harder than the nominal one. Needs `tools/dev/setup physics` and a build.
"""

import argparse
import sys
from dataclasses import dataclass, fields, replace

from body.chance import DEGREE, NOMINAL, Push, Variation
from body.description import load
from body.trial import STOP, try_motion
from campaign import each
from motions import gait
from motions.search import FIRST_PAGE, UP, image_of

LEAN = 3.0  # degrees
MOST_NEWTON_S = 0.9
HALVINGS = 5  # of 0..MOST_NEWTON_S: resolution 0.03 N s
MOMENTS_S = (3.0, 3.2)
FALLS_WITHIN_S = 2.3
LEFT = 4
FORWARD, BACKWARDS = 0, 180  # towards, in degrees


@dataclass(frozen=True)
class Case:
    """A body and a manner of going. keys: of the remote, in addition to those that start the gait. differ: degrees between the errors of
    the right and the left ankle."""

    name: str
    body: Variation = NOMINAL
    differ: float = 0.0
    keys: tuple = ()


CASES = [
    Case("nominal"),
    Case("heavy rotors", replace(NOMINAL, rotor_kgm2=0.009)),
    Case("9.2 V", replace(NOMINAL, volts=9.2)),
    Case("legs differ", differ=5.0),
    Case("stop", keys=((2.6, STOP),)),
]
OF_THE_WALK = [Case("curve", keys=((1.0, LEFT),))]


def leaning(body, degrees, differ=0.0):
    """The same body with its ankles off, so that it leans forward by this much."""
    right, left = degrees + differ / 2, degrees - differ / 2
    zeros = dict(body.zero_units)
    zeros[15] = zeros.get(15, 0.0) - right * DEGREE
    zeros[16] = zeros.get(16, 0.0) + left * DEGREE
    return replace(body, zero_units=zeros)


def stands(image, page, body, keys, at_s, newton_s, towards):
    pushed = replace(body, pushes=(Push(at_s, newton_s, towards),) if newton_s else ())
    return try_motion(image, page, at_s + FALLS_WITHIN_S, load("humanoid"), pushed, keys=keys).fell_s is None


def least_push(item):
    """The push in N s between one that it survives and one that fells it. Assumes that a body that survives a push survives all smaller
    ones. item: (image, page, body, keys, at_s, towards)"""
    image, page, body, keys, at_s, towards = item
    if not stands(image, page, body, keys, at_s, 0.0, towards):
        return 0.0
    low, high = 0.0, MOST_NEWTON_S
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if stands(image, page, body, keys, at_s, middle, towards):
            low = middle
        else:
            high = middle
    return (low + high) / 2


def items_of(kind, gaits):
    """[(case, direction)], and one item for each of them and each moment."""
    image, page = image_of(gaits), FIRST_PAGE[kind]
    first = ((0, UP),) if kind == "walk" else ()
    asked = [(case, towards) for case in CASES + (OF_THE_WALK if kind == "walk" else []) for towards in (FORWARD, BACKWARDS)]
    return asked, [
        (image, page, leaning(case.body, LEAN if towards == FORWARD else -LEAN, case.differ), (*first, *case.keys), at_s, towards)
        for case, towards in asked
        for at_s in MOMENTS_S
    ]


def margins(kind, gaits, jobs=None, scheduler=None):
    """{case: {towards: N s}}"""
    asked, items = items_of(kind, gaits)
    found = each(least_push, items, "pushes", jobs, scheduler)
    result = {}
    for k, (case, towards) in enumerate(asked):
        result.setdefault(case.name, {})[towards] = min(found[k * len(MOMENTS_S) : (k + 1) * len(MOMENTS_S)])
    return result


def change_of(text):
    """ "height=118,lift=12" -> {"height": 118.0, "lift": 12.0}"""
    kinds = {field.name: field.type for field in fields(gait.Gait)}
    change = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        if name not in kinds:
            raise argparse.ArgumentTypeError(f"{part}: give NAME=NUMBER; the names are {', '.join(kinds)}")
        try:
            change[name] = kinds[name](value)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{part}: {value or 'nothing'} is no {kinds[name].__name__}") from None
    return change


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=list(FIRST_PAGE))
    parser.add_argument("changes", nargs="*", type=change_of, metavar="NAME=NUMBER,...", help="other numbers, a line each")
    parser.add_argument("--jobs", type=int, help="processes at once (default: one a core)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask scheduler whose workers do it")
    options = parser.parse_args()
    gaits = gait.numbers()
    for change in [{}, *options.changes]:
        try:
            found = margins(options.kind, gaits | {options.kind: replace(gaits[options.kind], **change)}, options.jobs, options.scheduler)
        except ValueError as error:
            sys.exit(f"margins: {error}")
        said = ", ".join(f"{name}={value:g}" for name, value in change.items()) or "as it is"
        print(f"{said}: " + ", ".join(f"{name} {both[FORWARD]:.2f} / {both[BACKWARDS]:.2f}" for name, both in found.items()), flush=True)


if __name__ == "__main__":
    main()
