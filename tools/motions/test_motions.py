# SPDX-License-Identifier: MIT
"""The motion library is sound: as pages, as poses of a body, and as movements that servos can follow. README.md gives the bounds.
tests/sim/test_motions.py shows that the shipped Play image plays all of it."""

import os
import pathlib
import re

import numpy
import pytest

from body.description import load as load_body
from body.kinematics import centre_of_mass, places
from m512.files.formats import load
from m512.files.image import to_hex
from m512.files.page import SCHEDULE_TIME
from m512.motion.player import play
from m512.pages.operations import check
from motions import gait

HERE = pathlib.Path(__file__).resolve().parent

JOINTS = range(1, 19)
READY = gait.stand(gait.numbers()["ready"])
LIBRARY = load(HERE / "motions.m512")
ALL_PAGES = {number: page for number, page in LIBRARY.items() if number and page.is_playable}
# Pages played as layers over others, with joints of their own.
LAYERS = {"wave_over": (1, 3, 5), "look": (19, 20), "look_ahead": (19, 20)}
PAGES = {number: page for number, page in ALL_PAGES.items() if page.title not in LAYERS}
NUMBER = {page.title: number for number, page in PAGES.items()}
SECONDS = 128

SERVO_UNITS_PER_TICK = 59 * 11.1 / 12 * 360 / 60 / SECONDS * 1024 / 300  # an AX-12 at 11.1 V, unloaded: 8.73
MOST_UNITS_PER_TICK = 0.9 * SERVO_UNITS_PER_TICK
BODY = {  # degrees of the right side, see README.md; the left side is its mirror image
    1: (-145, 145),
    3: (-20, 130),
    5: (-90, 50),
    7: (-30, 30),
    9: (-25, 25),
    11: (-30, 120),
    13: (-140, 0),
    15: (-30, 65),
    17: (-25, 25),
    19: (-90, 90),
}
HEAD_TILT = -40, 40
KEYS = {"U": 1, "D": 2, "L": 4, "R": 8, "1": 16, "2": 32, "3": 64, "4": 128}
ON_THE_FLOOR = {"pushups", "pushups_do", "pushups_up", "get_up", "up_on_arms", "get_up_back", "up_on_elbows", "up_to_seat", "up_from_seat"}
LEFT_ALONE = {("get_up", 0): {1, 2}, ("get_up_back", 0): {1, 2, 5, 6}}  # joints that a step does not use; they keep their position
CHAINS = [
    "walk walk_r walk_l walk_r walk_l end_r",
    "walk walk_r turn_l turn_l2 turn_l walk_r walk_l turn_r turn_r2 end_r",
    "back back_r back_l back_r back_end_l",
    "right right_a right_b right_a right_b right_end",
    "left left_a left_b left_end",
    "side_r side_r_a side_r_b side_r_a side_r_b side_r_end",
    "side_l side_l_a side_l_b side_l_end",
    "kick_r",
    "kick_l",
]


def left_of(name):
    """Name of the left page for a right one; None: there is none."""
    left = re.sub("^right|(?<=_)r(?=_|2?$)", lambda side: "left" if side[0] == "right" else "l", name)
    return left if left != name and left in NUMBER else None


def pose(page, step):
    """{joint: position} of the joints that the step uses."""
    return {joint: page.word(step, joint) for joint in JOINTS if page.word(step, joint) < 1024}


def first(page):
    return pose(page, 0)


def last(page):
    return pose(page, page.steps - 1)


def mirrored(row):
    return {joint: 1024 - row[joint + 1 if joint % 2 else joint - 1] for joint in row}


def links(page):
    return {page.next, page.exit, page.link1_page, page.link2_page} - {0}


def body_degrees(joint, position):
    return (1 if joint % 2 else -1) * (position - 512) * 300 / 1024


def played(names):
    """(page, step, positions) of every tick with output, page after page from the pose `ready`."""
    positions = [512] * 31
    for joint, position in READY.items():
        positions[joint] = position
    for name in names:
        page = PAGES[NUMBER[name]]
        ticks = sum(page.time(k) + page.pause(k) for k in range(page.steps)) * max(1, page.repeat)
        for tick in play(LIBRARY, NUMBER[name], positions, ticks):
            if tick.goals:
                yield tick.page, tick.step, {joint: tick.goals[joint] for joint in JOINTS}
                positions = tick.goals


# --- as pages ---


def test_all_pages_are_good():
    assert check(LIBRARY) == []
    assert set(NUMBER) >= {"ready", "bow", "wave", "clap", "sit", "stand", "pushups", "walk", "turn_r", "turn_l", "dance"}


def test_page_0_holds_no_trim():
    assert LIBRARY[0].is_empty


def test_names_and_codes_are_unique_and_names_need_no_quotes():
    codes = [page.code for page in PAGES.values() if page.code]
    assert len(set(codes)) == len(codes) and 255 not in codes
    assert len(NUMBER) == len(PAGES)
    assert all(re.fullmatch("[a-z][a-z_]{0,11}[a-z2]", name) for name in NUMBER)


def test_every_joint_is_said_in_every_step_and_no_other():
    for number, page in PAGES.items():
        assert page.schedule == SCHEDULE_TIME
        for step in range(page.steps):
            used = {joint for joint in range(31) if page.word(step, joint) < 1024}
            assert used == set(JOINTS) - LEFT_ALONE.get((page.title, step), set()), (number, step)


@pytest.mark.parametrize("name", LAYERS)
def test_a_layer_uses_its_own_joints_alone_and_keeps_to_what_they_can(name):
    page, before = LIBRARY[LIBRARY.find(name)], None
    for step in range(page.steps):
        used = {joint: page.word(step, joint) for joint in range(31) if page.word(step, joint) < 1024}
        assert tuple(used) == LAYERS[name], step
        for joint, position in used.items():
            low, high = HEAD_TILT if joint == 20 else BODY[joint]
            assert low <= (position - 512) * 300 / 1024 <= high, (step, joint)
        if before:
            assert max(abs(used[joint] - before[joint]) for joint in used) / page.time(step) <= MOST_UNITS_PER_TICK
        before = used
    assert page.code == 0 and {page.next, page.exit} <= {0, *(LIBRARY.find(other) for other in LAYERS)}


def test_no_page_is_without_a_way_to_it_and_every_stop_ends():
    """Each page has a code or a page that leads to it. From any page the exit links come to an end."""
    led_to = set().union(*(links(page) for page in PAGES.values()))
    for number, page in PAGES.items():
        assert page.code or number in led_to, page.title
        seen = [number]
        while PAGES[seen[-1]].exit:
            seen.append(PAGES[seen[-1]].exit)
            assert len(seen) < 5, seen


def test_built_image_is_this_source():
    folder = pathlib.Path(os.environ.get("M512_BUILD", HERE.parents[1] / "build")) / "motions"
    data = (folder / "motions.bin").read_bytes()
    assert len(data) == 65536 and data == LIBRARY.to_bytes()
    assert (folder / "motions.hex").read_text().split() == to_hex(LIBRARY).split()


def test_walk_is_what_the_generator_makes():
    assert (HERE / "walk.m512").read_text() == gait.text(gait.numbers()), "run tools/motions/gait.py"


def test_table_of_the_readme_is_true():
    """Number, name, keys and links of every page are as in the table."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in (HERE / "README.md").read_text().splitlines()]
    layers = {row[1].strip("`"): (int(row[0]), [int(joint) for joint in row[2].split(",")]) for row in rows if len(row) == 4 and row[0].isdigit()}
    assert layers == {name: (LIBRARY.find(name), list(joints)) for name, joints in LAYERS.items()}
    listed = {int(row[0]): (row[1].strip("`"), row[2], row[4]) for row in rows if len(row) == 5 and row[0].isdigit()}
    assert set(listed) == set(PAGES)
    for number, (name, keys, ways) in listed.items():
        page = PAGES[number]
        assert name == page.title
        assert sum(KEYS[key] for key in keys.split()) == page.code, name
        assert {NUMBER[way] for way in re.findall(r"`(\w+)`", ways)} == links(page), name


# --- as poses ---


@pytest.mark.parametrize("name", NUMBER)
def test_poses_keep_within_servo_and_body(name):
    page = PAGES[NUMBER[name]]
    for step in range(page.steps):
        for joint, position in pose(page, step).items():
            low, high = BODY[joint - (joint % 2 == 0)]
            assert low <= body_degrees(joint, position) <= high, (step + 1, joint)


def test_poses_of_both_sides_are_mirror_images():
    """Pages that do the same on both sides, such as ready, are their own mirror image. Others have a page or step for each side."""
    for name in ("ready", "bow", "clap", "cheer", "sit", "stand", *sorted(ON_THE_FLOOR), "dance", "dance_arms", "dance_end"):
        page = PAGES[NUMBER[name]]
        assert all(mirrored(pose(page, step)) == pose(page, step) for step in range(page.steps)), name
    for name in ("dance_sway", "dance_hands", "dance_pump"):
        page = PAGES[NUMBER[name]]
        all_poses = [pose(page, step) for step in range(page.steps)]
        assert all(mirrored(one) in all_poses for one in all_poses), name


@pytest.mark.parametrize("name", [name for name in NUMBER if left_of(name)])
def test_pages_of_the_other_side_are_mirror_images(name):
    page, other = PAGES[NUMBER[name]], PAGES[NUMBER[left_of(name)]]
    assert page.steps == other.steps and page.accel == other.accel
    for step in range(page.steps):
        assert mirrored(pose(page, step)) == pose(other, step), step
        assert page.time(step) == other.time(step)


def over_soles(row):
    """Position of the centre of mass in a symmetric pose on the plane of its right sole: mm in front of the rearmost corner of the soles,
    and mm behind the foremost."""
    robot = load_body("humanoid")
    found = places(robot, row)
    origin, turned = found["right_foot"]
    geom = next(geom for geom in robot.bodies["right_foot"].findall("geom") if geom.get("name") == "right_sole")
    middle, size = (1000 * numpy.array([float(value) for value in geom.get(key).split()]) for key in ("pos", "size"))
    corners = [origin + turned @ (middle + (x * size[0], y * size[1], -size[2])) for x in (-1, 1) for y in (-1, 1)]
    up = turned[:, 2]
    ahead = numpy.cross((0.0, 1.0, 0.0), up)
    ahead /= numpy.linalg.norm(ahead)
    weight = ahead @ centre_of_mass(robot, row)
    return weight - min(ahead @ corner for corner in corners), max(ahead @ corner for corner in corners) - weight


def hand_above_floor(row):
    """Height of the right hand above the plane of the right sole, in mm."""
    robot = load_body("humanoid")
    found = places(robot, row)
    (sole, flat), (elbow, turned) = found["right_foot"], found["right_forearm"]
    hand = next(geom for geom in robot.bodies["right_forearm"].findall("geom") if geom.get("name") == "right_hand")
    end = 1000 * numpy.array([float(value) for value in hand.get("fromto").split()[3:]])
    radius = 1000 * float(hand.get("size"))
    return flat[:, 2] @ (elbow + turned @ end - sole) - radius + robot.leg("right").ankle_to_sole


@pytest.mark.parametrize("name, step", [("pushups_up", 2), ("up_to_seat", 3)])
def test_hands_reach_the_floor_while_the_weight_is_above_the_feet_already(name, step):
    row = pose(PAGES[NUMBER[name]], step)
    behind, ahead = over_soles(row)
    assert behind >= 25 and ahead >= 25 and hand_above_floor(row) <= 16, (behind, ahead, hand_above_floor(row))


@pytest.mark.parametrize("name, first_step", [("pushups_up", 2), ("up_to_seat", 3), ("up_from_seat", 0)])
def test_the_weight_is_above_the_feet_before_the_hands_leave_the_floor(name, first_step):
    """From this step on, a robot whose zeros, floor and masses are a little off still stands."""
    page = PAGES[NUMBER[name]]
    for step in range(first_step, page.steps):
        behind, ahead = over_soles(pose(page, step))
        assert behind >= 20 and ahead >= 25, (step + 1, behind, ahead)


# --- as movements ---


def test_loops_close():
    for name, after in (("walk_l", "walk"), ("back_l", "back"), ("right_b", "right"), ("side_l_b", "side_l")):
        assert last(PAGES[NUMBER[name]]) == last(PAGES[NUMBER[after]])
    for name in (
        "right_end",
        "left_end",
        "side_r_end",
        "side_l_end",
        "kick_r",
        "kick_l",
        "bow",
        "wave",
        "clap",
        "cheer",
        "stand",
        "pushups_up",
        "up_from_seat",
        "dance_end",
        "end_r",
        "end_l",
        "back_end_r",
        "back_end_l",
    ):
        assert last(PAGES[NUMBER[name]]) == READY, name


@pytest.mark.parametrize("name", NUMBER)
def test_mean_speed_leaves_the_servo_a_margin_in_steps_and_over_links(name):
    page = PAGES[NUMBER[name]]
    for step in range(1, page.steps):
        assert mean_speed(pose(page, step - 1), pose(page, step), page.time(step)) <= MOST_UNITS_PER_TICK, step + 1
    for number in links(page) | ({NUMBER[name]} if page.repeat > 1 else set()):
        follower = PAGES[number]
        assert mean_speed(last(page), first(follower), follower.time(0)) <= MOST_UNITS_PER_TICK, follower.title


def mean_speed(before, after, ticks):
    return max(abs(after[joint] - before[joint]) for joint in before.keys() & after.keys()) / ticks


@pytest.mark.parametrize("names", CHAINS + [name for name in NUMBER if PAGES[NUMBER[name]].code])
def test_no_joint_is_asked_more_than_the_servo_has(names):
    """Goals are whole units, so speeds are means of four ticks. `classic` overshoots by design and is exempt."""
    rows = [now for _, _, now in played(names.split())]
    for before, now in zip(rows, rows[4:]):
        assert max(abs(now[joint] - before[joint]) for joint in JOINTS) / 4 <= MOST_UNITS_PER_TICK
