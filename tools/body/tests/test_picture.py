# SPDX-License-Identifier: MIT
"""Pictures: links are where MuJoCo puts them, the robot stands on the floor, and the command makes a file without a display."""

import importlib.machinery
import importlib.util
import pathlib
import runpy
import subprocess
import sys

import mujoco
import numpy
import pytest

from body.description import load
from body.kinematics import centre_of_mass, places
from body.picture import flat, scene

PICTURE = pathlib.Path(__file__).resolve().parents[1] / "picture"


def poses(name, seed, count):
    """(robot, pose, MuJoCo's data in it) for random poses."""
    robot, chance = load(name), numpy.random.default_rng(seed)
    model = mujoco.MjModel.from_xml_string(robot.xml())
    data = mujoco.MjData(model)
    for _ in range(count):
        pose = {servo: 512 + chance.uniform(-150, 150) for servo in robot.servos}
        for servo, position in pose.items():
            data.joint(robot.joints[servo].name).qpos[0] = robot.angle(servo, position)
        mujoco.mj_forward(model, data)
        yield robot, pose, data


@pytest.mark.parametrize("name", ["humanoid", "gp"])
def test_links_stand_where_mujoco_has_them(name):
    for robot, pose, data in poses(name, seed=6, count=20):
        for body, (origin, turned) in places(robot, pose).items():
            away = 1000 * (data.body(body).xpos - data.body("trunk").xpos)
            assert origin == pytest.approx(away, abs=1e-6) and turned == pytest.approx(data.body(body).xmat.reshape(3, 3), abs=1e-9)


@pytest.mark.parametrize("name", ["humanoid", "gp"])
def test_weight_is_where_mujoco_has_it(name):
    for robot, pose, data in poses(name, seed=7, count=10):
        assert centre_of_mass(robot, pose) == pytest.approx(1000 * (data.subtree_com[1] - data.body("trunk").xpos), abs=1e-6)


def test_shapes_are_as_large_as_their_geoms():
    """The sole is 100 x 60 x 6 mm, on the floor. The hand ends 110 mm below the elbow."""
    robot = load("humanoid")
    faces = scene(robot, {})
    corners = numpy.concatenate([face.corners for face in faces])
    assert corners[:, 2].min() == pytest.approx(0)
    sole = numpy.concatenate([face.corners for face in faces if face.colour == (0.10, 0.10, 0.11)])
    right = sole[sole[:, 1] < 0]
    assert numpy.ptp(right, axis=0) == pytest.approx((100, 60, 6))
    assert corners[:, 2].max() > 297.5 + 36  # the head is above the shoulders
    hand = numpy.concatenate([face.corners for face in faces if face.colour == (0.16, 0.42, 0.68) and abs(face.corners[:, 1]).min() > 60])
    assert hand[:, 2].min() == pytest.approx(297.5 - 14 - 67.5 - 110, abs=1)


def test_the_nearest_is_drawn_last_and_backs_are_left_out():
    robot = load("humanoid")
    faces = scene(robot, {})
    from_front, from_behind = flat(faces, (0, 0)), flat(faces, (180, 0))
    eyes = (0.98, 0.78, 0.20)

    def first_eye(parts):
        hues = [numpy.array(colour) / max(colour) for _, colour in parts]
        return min(k for k, hue in enumerate(hues) if numpy.allclose(hue, numpy.array(eyes) / eyes[0])) / len(parts)

    assert first_eye(from_front) > 0.5 > first_eye(from_behind)
    assert len(from_front) < len(faces)


def test_command_makes_a_file_without_a_display(tmp_path):
    """A .png: test_readmes_makes_all_pictures_of_the_motions_readme."""
    path = tmp_path / "a.svg"
    subprocess.run([sys.executable, str(PICTURE), "ready", "walk", "bow:2", "-o", str(path)], check=True, env={"PATH": "/usr/bin:/bin"})
    assert path.read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize(
    "words, says", [(["nix"], "no page is called 'nix'"), (["bow:9"], "has steps 1.."), (["bow", "--body", "x"], "known here: gp, humanoid")]
)
def test_command_says_what_is_wrong(monkeypatch, tmp_path, words, says):
    monkeypatch.setattr(sys, "argv", ["picture", *words, "-o", str(tmp_path / "a.png")])
    with pytest.raises(SystemExit, match=f"^picture: .*{says}"):
        runpy.run_path(str(PICTURE), run_name="__main__")


def test_readmes_makes_all_pictures_of_the_motions_readme(tmp_path):
    loader = importlib.machinery.SourceFileLoader("picture", str(PICTURE))
    picture = importlib.util.module_from_spec(importlib.util.spec_from_loader("picture", loader))
    loader.exec_module(picture)
    tree, picture.TOP = picture.TOP, tmp_path
    (tmp_path / "tools" / "motions").mkdir(parents=True)
    assert picture.readmes() == 0
    made = sorted(path.relative_to(tmp_path) for path in tmp_path.rglob("*.png"))
    assert made == sorted(path.relative_to(tree) for path in (tree / "tools" / "motions").glob("*.png"))
