# SPDX-License-Identifier: MIT
"""Blend partners (bytes 17 and 18) in text, list, check, diff and conversions."""

from m512.files import formats
from m512.files.image import from_bytes
from m512.files.text import read_text, write_text
from m512.pages import difference, operations

TEXT = """motion512 1
page 5 walk
  next self
  blend right turn_r
  blend left 7
  step 32 | 1:500
page 6 turn_r
  step 32 | 1:510
page 7 turn_l
  step 32 | 1:490
"""


def test_blend_partners_are_bytes_17_and_18():
    image = read_text(TEXT)
    assert image[5].data[17] == 6 and image[5].data[18] == 7 and not image[5].fault()
    text = write_text(image)
    assert "blend right turn_r" in text and "raw 17" not in text and read_text(text).to_bytes() == image.to_bytes()


def test_blend_partners_are_listed_told_apart_and_kept(m512, tmp_path):
    (tmp_path / "x.m512").write_text(TEXT)
    assert "right 6  left 7" in m512("pages", tmp_path / "x.m512", "list").stdout
    assert m512("pages", tmp_path / "x.m512", "check").exit_code == 0
    image = read_text(TEXT)
    other = from_bytes(image.to_bytes())
    other[5].blend_right = 0
    other[5].seal()
    assert [str(change) for change in difference.images(image, other)] == ['page 5 "walk": blend right 6 -> 0']
    assert any("blend partners are left out" in loss for loss in formats.save(tmp_path / "x.mtn", image))


def test_blend_partners_follow_pages_that_move():
    image = read_text(TEXT)
    operations.renumber(image, 6, 40)
    assert image[5].blend_right == 40 and image[5].blend_left == 7
    assert "links to page 40 (blend right)" in " ".join(operations.delete(image, [40]))


def test_check_names_partners_that_cannot_be_blended():
    found = operations.check(read_text(TEXT.replace("page 7 turn_l\n", "page 7 turn_l\n  step 9 | 1:1\n")))
    assert found == [(5, "blend left: page 7 has 2 steps and this one 1; it is not blended")]
    image = read_text(TEXT)
    operations.delete(image, [6])
    assert operations.check(image) == [(5, "blend right leads to page 6, which is damaged or has no action")]
