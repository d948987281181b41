# SPDX-License-Identifier: MIT
"""Tests with motion sets of others, if present (../shared/data, or M512_SHARED). They may not be copied into the project; elsewhere
tests/samples takes their place."""

import os
import pathlib

import pytest
from conftest import REPO
from mtn_files import ACCIDENTS

from m512.files import mtn, scale12
from m512.files.image import from_bytes

DATA = pathlib.Path(os.environ.get("M512_SHARED", REPO.parent / "shared")) / "data"
pytestmark = pytest.mark.skipif(not DATA.is_dir(), reason=f"no motion sets of others in {DATA} (M512_SHARED)")
ROBOPLUS, ROBOT = DATA / "bio_gp_humanoid_kr.mtn", DATA / "bio_gp_humanoid_kr_128p.bin"


@pytest.mark.parametrize(
    "name", ["bio_gp_humanoid_kr_128p.bin", "hros1_10bit_256p.bin", "op3_12bit_256p.bin", "op3_derived_10bit_256p.bin", "synthetic_edge_128p.bin"]
)
@pytest.mark.parametrize("suffix", [".m512", ".hex"])
def test_every_image_to_text_and_hex_and_back(m512, tmp_path, name, suffix):
    middle, out = tmp_path / f"x{suffix}", tmp_path / "y.bin"
    assert m512("convert", DATA / name, middle, "--bits", "12" if "12bit" in name else "10").exit_code == 0
    assert m512("convert", middle, out).exit_code == 0
    assert out.read_bytes() == (DATA / name).read_bytes()


def test_the_roboplus_file_is_the_robots_image_without_a_remark_but_for_two_rates():
    image = mtn.read(ROBOPLUS.read_bytes())
    assert image.to_bytes()[:65536] == ROBOT.read_bytes()
    assert len(image.notes) == 1 and "rate 3; it becomes 32 / 10 = 3.20" in image.notes[0]


@pytest.mark.parametrize("accident", list(ACCIDENTS)[::4])
def test_the_roboplus_file_after_every_accident(accident):
    whole = ROBOPLUS.read_bytes()
    assert mtn.read(ACCIDENTS[accident][1](whole)).to_bytes() == mtn.read(whole).to_bytes()


def test_12_bit_scaled_equals_the_derived_file():
    image = from_bytes((DATA / "op3_12bit_256p.bin").read_bytes(), 12)
    dropped = scale12.keep_joints(image, range(1, 21))
    scaled, report = scale12.scaled(image, 10)
    assert "joints left out (IDs 0 21" in dropped[0]
    assert any(line.startswith("40 positions cut at the end") for line in report)  # the same count as by the author of the derived file
    derived = from_bytes((DATA / "op3_derived_10bit_256p.bin").read_bytes())
    compared = 0
    for number, page in derived.items():
        for step in range(page.steps):
            for joint in range(1, 21):
                if page.word(step, joint) < 1024:
                    assert scaled[number].word(step, joint) == page.word(step, joint), (number, step, joint)
                    compared += 1
    assert compared > 2000
