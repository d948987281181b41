# SPDX-License-Identifier: MIT
"""The library's motions end on the feet on bodies on which earlier versions fell, each for a different reason."""

import pytest

from body.physics import Physics
from body.quick import Quick
from body.trial import first_pose
from m512.motion.player import play
from motions import promises
from motions.promises import IMAGE, LIBRARY

THROUGH_MM = 10  # a depth that only presses a hand against a hip
AIRBORNE_TICKS = 72  # a kick holds its foot up for longer than this


def promise_of(page):
    return next(promise for promise in promises.STANDS if promise.page == page)


@pytest.mark.parametrize(
    "page, seed",
    [
        ("kick_r", 30),
        ("kick_r", 52),  # fell while still on two feet, too far to the side
        ("kick_r", 206),  # its hip gave way; the foot touched the floor too early and pushed the body over the other one
        ("cheer", 13),  # its arms pushed it forward as they came down
        ("get_up", 39),  # could not pull its feet to its hands: 9.2 V, a rough floor
        ("get_up", 1095),  # rolled onto its back as an arm came out from below
        ("get_up", 1070),  # a hand caught below the belly, until its servo was overloaded
        ("get_up_back", 31),
        ("get_up_back", 1081),  # rolled onto its face
        ("back", 394),  # leaned back because of its soles and trunk, and was pushed: hips too high, steps too long
        ("side_l", 394),
        ("right", 773),  # sagged backwards on soft ankles, without a push
    ],
)
def test_stands_on_a_body_on_which_it_fell(page, seed):
    kept, said = promises.stands(IMAGE, LIBRARY.find(page), promise_of(page), seed)
    assert kept, said


@pytest.mark.parametrize("page, side", [("kick_r", "right"), ("kick_l", "left")])
def test_a_kick_is_a_kick(page, side):
    """Rules out a kick that stands because it hardly moves: the foot leaves the floor, goes back, then 40 mm forward."""
    physics, number = Physics(promises.ROBOT), LIBRARY.find(page)
    physics.stand(first_pose(IMAGE, number, promises.ROBOT))
    quick = Quick(IMAGE, physics)
    quick.torque_on()
    quick.start(number)
    ways = []
    while quick.run(4):
        if not any({"floor", f"{side}_sole"} <= set(pair) for pair in physics.touching()):
            ways.append(1000 * physics.data.body(f"{side}_foot").xpos[0])
    assert 4 * len(ways) > AIRBORNE_TICKS and ways[-1] > min(ways) and max(ways) - min(ways) > 40, ways


def deepest_mm(number):
    """The deepest overlap of the robot's links under the goals of a play: mm, and the two geoms."""
    physics, deepest = Physics(promises.ROBOT), (0.0, ())
    floor = physics.model.geom("floor").id
    begin = first_pose(IMAGE, number, promises.ROBOT)
    physics.data.qpos[2] = 5  # far above the floor
    for tick in play(LIBRARY, number, [begin.get(joint, 512) for joint in range(31)], 512):
        if tick.goals and tick.number % 4 == 0:
            physics.pose({servo: tick.goals[servo] for servo in promises.ROBOT.servos})
            for contact in physics.data.contact[: physics.data.ncon]:
                geoms = contact.geom1, contact.geom2
                if floor not in geoms and -1000 * contact.dist > deepest[0]:
                    deepest = -1000 * contact.dist, tuple(physics.model.geom(geom).name for geom in geoms)
    return deepest


@pytest.mark.parametrize("page", sorted({promise.page for promise in promises.STANDS}))
def test_goals_do_not_drive_links_through_each_other(page):
    depth, geoms = deepest_mm(LIBRARY.find(page))
    assert depth <= (0 if page.startswith("kick") else THROUGH_MM), geoms
