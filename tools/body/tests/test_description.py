# SPDX-License-Identifier: MIT
"""The body files match what is known of the robots. Expected values come from public descriptions (README.md), calculated by hand for
poses."""

import math

import mujoco
import numpy
import pytest

from body.description import BodyError, load

HUMANOID, GP = load("humanoid"), load("gp")
RIGHT = {
    "shoulder_swing": 1,
    "shoulder_lift": 3,
    "elbow": 5,
    "hip_yaw": 7,
    "hip_roll": 9,
    "hip_pitch": 11,
    "knee": 13,
    "ankle_pitch": 15,
    "ankle_roll": 17,
}


def at(robot, body, positions, root="trunk"):
    """Origin of a body in mm, in the frame of the root body, at these servo positions; and MuJoCo's data."""
    model = mujoco.MjModel.from_xml_string(robot.xml())
    data = mujoco.MjData(model)
    for servo, position in positions.items():
        data.joint(robot.joints[servo].name).qpos[0] = robot.angle(servo, position)
    mujoco.mj_forward(model, data)
    away = data.body(body).xpos - data.body(root).xpos
    return 1000 * (data.body(root).xmat.reshape(3, 3).T @ away), data


def test_servos_and_names():
    assert HUMANOID.servos == list(range(1, 19))
    assert GP.servos == [1, 2, 3, 4, 5, 6, *range(9, 19)]
    for robot in (HUMANOID, GP):
        for part, servo in RIGHT.items():
            if servo in robot.joints:
                assert robot.joints[servo].name == f"right_{part}" and robot.joints[servo + 1].name == f"left_{part}"


def test_head_servos_are_there_only_when_asked_for():
    assert load("humanoid", head=True).servos == list(range(1, 21))
    assert mujoco.MjModel.from_xml_string(load("humanoid", head=True).xml()).nu == 20
    assert mujoco.MjModel.from_xml_string(HUMANOID.xml()).nu == 18


def test_lengths_of_the_humanoid():
    leg = HUMANOID.leg("right")
    assert leg == HUMANOID.leg("left")
    assert leg.hip_to_side == pytest.approx(38.5) and leg.shoulder_to_yaw == pytest.approx(65.5) and leg.yaw_to_hip == pytest.approx(50)
    assert (leg.thigh_down, leg.thigh_back, leg.shank_down, leg.shank_forward) == pytest.approx((75, 14.5, 75, 14.5))
    assert leg.thigh_mm == pytest.approx(76.4, abs=0.05) and leg.ankle_to_sole == pytest.approx(32)
    assert leg.sole[1] - leg.sole[0] == pytest.approx(100) and leg.sole[3] - leg.sole[2] == pytest.approx(60)
    assert -16 <= (leg.sole[0] + leg.sole[1]) / 2 <= 0
    assert HUMANOID.place_mm("right_shoulder")[1] == pytest.approx(-32)
    assert at(HUMANOID, "right_upper_arm", {})[0] == pytest.approx((0, -76, -14))
    assert at(HUMANOID, "left_forearm", {})[0] == pytest.approx((0, 76, -81.5))


def test_masses_of_the_humanoid():
    links = {"hip_yaw": 15, "hip": 123, "thigh": 29, "shank": 79, "ankle": 123, "foot": 36, "shoulder": 11, "upper_arm": 69, "forearm": 72}
    for side in ("right", "left"):
        for link, grams in links.items():
            assert HUMANOID.mass_g(f"{side}_{link}") == pytest.approx(grams), link
    assert 1700 <= HUMANOID.total_g <= 1900
    model = mujoco.MjModel.from_xml_string(HUMANOID.xml())
    assert 1000 * model.body_subtreemass[1] == pytest.approx(HUMANOID.total_g)


def test_lengths_and_masses_of_the_gp_robot():
    assert at(GP, "right_hip", {})[0] == pytest.approx((0, -16, -76.5))
    assert at(GP, "left_shank", {}, "left_hip")[0] == pytest.approx((-14.5, 0, -41.8 - 74.4))
    assert at(GP, "left_ankle", {}, "left_shank")[0] == pytest.approx((14.5, 0, -75))
    assert at(GP, "right_foot", {}, "right_ankle")[0] == pytest.approx((0, -12.1, 0))
    assert at(GP, "right_upper_arm", {})[0] == pytest.approx((4, -79, -18))
    assert at(GP, "right_forearm", {}, "right_upper_arm")[0] == pytest.approx((18, 0, -57))
    outside = GP.leg("right").sole  # from the ankle's centre; the roll axis is 12.1 mm further out
    assert (outside[1], outside[0], outside[2] - 12.1, outside[3] - 12.1) == pytest.approx((50.3, -46.7, -25, 36))
    masses = {"trunk": 430, "hip": 66, "thigh": 131, "shank": 21, "ankle": 127, "foot": 30, "shoulder": 12, "upper_arm": 130, "forearm": 30}
    for link, grams in masses.items():
        assert GP.mass_g(link if link == "trunk" else f"right_{link}") == pytest.approx(grams), link
    assert GP.total_g == pytest.approx(1524)


@pytest.mark.parametrize("robot, soles", [(HUMANOID, -65.5 - 50 - 150 - 32), (GP, -76.5 - 41.8 - 149.4 - 32)])
def test_it_stands_on_its_soles_at_512_and_touches_nothing_else(robot, soles):
    _, data = at(robot, "trunk", {servo: 512 for servo in robot.servos})
    assert data.body("trunk").xpos[2] * 1000 == pytest.approx(-soles)
    for side in ("right", "left"):
        size = data.model.geom(f"{side}_sole").size
        assert data.geom(f"{side}_sole").xpos[2] == pytest.approx(size[2], abs=1e-6)
    touching = {data.model.geom(int(number)).name for contact in data.contact for number in (contact.geom1, contact.geom2)}
    assert touching <= {"floor", "right_sole", "left_sole"}


@pytest.mark.parametrize(
    "servo, above_512",
    [
        (1, lambda way: way[0] > 20),
        (3, lambda way: way[1] < -20),
        (5, lambda way: way[1] < -20),
        (9, lambda way: way[1] < -10),
        (11, lambda way: way[0] > 20),
        (13, lambda way: way[0] > 20),
    ],
)
def test_right_side_goes_the_way_the_table_says_above_512(servo, above_512):
    """Table "Joints" of the motions' README, right side, for joints that move a foot or a hand."""
    end = "right_hand" if servo < 7 else "right_foot"
    moved = {servo: 512 + 100 if servo != 13 else 512 - 100}
    model = mujoco.MjModel.from_xml_string(HUMANOID.xml())
    spots = []
    for positions in ({}, moved):
        data = mujoco.MjData(model)
        for number, position in positions.items():
            data.joint(HUMANOID.joints[number].name).qpos[0] = HUMANOID.angle(number, position)
        mujoco.mj_forward(model, data)
        spots.append(1000 * (data.geom(end).xpos if servo < 7 else data.body(end).xpos))
    way = spots[1] - spots[0]
    assert above_512(-way if servo == 13 else way)


def test_yaw_and_ankles_go_the_way_the_table_says():
    def toes(servo):
        _, data = at(HUMANOID, "trunk", {servo: 512 + 60})
        return data.body("right_foot").xmat.reshape(3, 3)

    angle = math.radians(60 * 300 / 1024)
    assert toes(7)[:, 0] == pytest.approx((math.cos(angle), -math.sin(angle), 0))  # toes outward: to the right
    assert toes(15)[:, 0] == pytest.approx((math.cos(angle), 0, math.sin(angle)))  # toes up
    hip, ankle = toes(9), toes(17)
    assert hip == pytest.approx(ankle)  # same direction as the hip


@pytest.mark.parametrize("robot", [HUMANOID, GP])
def test_left_is_the_mirror_image_of_right(robot):
    chance = numpy.random.default_rng(13)
    for _ in range(20):
        pose = {servo: 512 + chance.uniform(-80, 80) for servo in robot.servos}
        mirrored = {servo: 1024 - pose[servo + 1 if servo % 2 else servo - 1] for servo in robot.servos}
        for link in ("foot", "forearm"):
            assert at(robot, f"left_{link}", mirrored)[0] == pytest.approx(at(robot, f"right_{link}", pose)[0] * (1, -1, 1), abs=1e-6)


def test_a_bent_leg_is_as_long_as_brackets_make_it():
    """Hip 50, knee 80 degrees: 134 mm from ankle to hip. Straight links of 75 mm would give 115."""
    pose = {11: HUMANOID.position(11, math.radians(50)), 13: HUMANOID.position(13, math.radians(-80))}
    assert numpy.linalg.norm(at(HUMANOID, "right_ankle", pose, "right_thigh")[0]) == pytest.approx(134, abs=0.5)


def apart(model, positions, first, second):
    """Distance of two geoms in mm; negative if they overlap. positions: {servo: degrees}"""
    data = mujoco.MjData(model)
    for servo, degrees in positions.items():
        data.joint(HUMANOID.joints[servo].name).qpos[0] = math.radians(degrees)
    mujoco.mj_forward(model, data)
    return 1000 * mujoco.mj_geomDistance(model, data, model.geom(first).id, model.geom(second).id, 1.0, numpy.zeros(6))


def test_a_knee_at_its_stop_still_leaves_room_between_the_two_blocks_of_servos():
    model, stop = mujoco.MjModel.from_xml_string(HUMANOID.xml()), math.degrees(HUMANOID.joints[13].low)
    assert apart(model, {13: stop}, "right_hip", "right_ankle") > 5
    assert apart(model, {13: -155}, "right_hip", "right_ankle") < 0


def test_an_arm_can_turn_through_its_whole_range_beside_the_body():
    model, shoulder = mujoco.MjModel.from_xml_string(HUMANOID.xml()), HUMANOID.joints[1]
    for degrees in numpy.linspace(math.degrees(shoulder.low), math.degrees(shoulder.high), 30):
        for arm in ("right_upper_arm", "right_forearm", "right_hand"):
            for other in ("chest", "controller", "face", "right_hip", "right_thigh"):
                assert apart(model, {1: degrees}, arm, other) > 0, (degrees, arm, other)
    assert apart(model, {1: 0, 3: -15}, "right_hand", "right_hip") < 0


def test_servo_units():
    assert HUMANOID.angle(13, 512) == 0 and HUMANOID.angle(13, 0) == pytest.approx(math.radians(-150))
    assert HUMANOID.angle(14, 0) == pytest.approx(math.radians(150))
    assert GP.angle(13, 857) == pytest.approx(math.radians(-345 * 300 / 1024))  # its knees turn in the opposite direction
    assert all(HUMANOID.position(servo, HUMANOID.angle(servo, 300)) == pytest.approx(300) for servo in HUMANOID.servos)


def test_bodies_of_others_are_told_what_they_lack(tmp_path):
    with pytest.raises(BodyError, match="known here: gp, humanoid"):
        load("robocop")
    (tmp_path / "a.xml").write_text("<mujoco><worldbody><body name='b'/></worldbody></mujoco>")
    with pytest.raises(BodyError, match="ID direction zero"):
        load(tmp_path / "a.xml")
    (tmp_path / "b.xml").write_text("<robot/>")
    with pytest.raises(BodyError, match="not a MuJoCo model"):
        load(tmp_path / "b.xml")
    (tmp_path / "c.xml").write_text("<muj")
    with pytest.raises(BodyError, match="not XML"):
        load(tmp_path / "c.xml")
    (tmp_path / "d.xml").write_text("<mujoco><worldbody><body name='b'><joint user='300 1 512' range='0 1'/></body></worldbody></mujoco>")
    with pytest.raises(BodyError, match="servo ID 0..253"):
        load(tmp_path / "d.xml")


@pytest.mark.parametrize(
    "was, now, said",
    [
        ('geom name="right_sole"', 'geom name="right_shoe"', "no geom is called right_sole"),
        ('<motor name="servo_13" joint="right_knee"/>', "", "joint right_knee has servo 13 and no motor"),
        ('user="13 1 512"', 'user="13"', 'joint right_knee has user="13"; it must be a servo ID 0..253'),
        ('user="13 1 512"', 'user="x 1 512"', 'joint right_knee has user="x 1 512"'),
        ('user="13 1 512"', 'user="12 -1 512"', "joints .* and .* both have servo 12"),
        ('range="-140 0" user="13', 'user="13', 'joint right_knee needs range="LOW HIGH"'),
    ],
)
def test_one_mistake_in_a_body_of_ones_own_is_named(tmp_path, was, now, said):
    text = HUMANOID.path.read_text()
    assert was in text
    (tmp_path / "mine.xml").write_text(text.replace(was, now, 1))
    with pytest.raises(BodyError, match=f"mine.xml: {said}"):
        load(tmp_path / "mine.xml")
