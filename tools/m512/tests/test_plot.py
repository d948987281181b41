# SPDX-License-Identifier: MIT
"""What a plot shows: names, speeds as they are, laws told apart where they differ, labels that can be read."""
import pytest

pytest.importorskip("matplotlib")

from m512.files.text import read_text  # noqa: E402
from m512.motion import plot  # noqa: E402

TEXT = """motion512 1
joint 3 r_arm
page 1 wave
  step 1s | 1..18:512
  step 1s | 3:712
  step 1s | 3:512
"""


@pytest.fixture
def figure(monkeypatch, tmp_path):
    """figure(sets) -> the figure that would have been saved."""
    from matplotlib import pyplot

    kept = []
    monkeypatch.setattr(pyplot, "close", kept.append)

    def drawn(sets, **options):
        plot.draw(sets, tmp_path / "x.png", **options)
        return kept[-1]

    return drawn


def test_speed_is_that_of_the_trapezoid_and_no_sawtooth():
    """10 degrees/s is 0.267 units a tick: neighbouring samples say 0 or 37 degrees/s."""
    seconds = [k / 128 for k in range(1, 257)]
    values = [512 + round(k / 128 * 10 * 1024 / 300) for k in range(1, 257)]
    found = plot.speeds(seconds, values)
    assert all(abs(speed - 10) < 1.7 for speed in found[6:-6])
    turned = plot.speeds(seconds, values[:128] + values[127::-1], [1.0 + 1 / 128])
    assert all(abs(speed - 10) < 1.7 for speed in turned[6:120]) and all(abs(speed + 10) < 1.7 for speed in turned[136:-6])


def test_joints_have_their_names_and_colours_of_their_own(figure):
    image = read_text(TEXT.replace("3:712", "1..18:712"))
    drawn = figure([plot.of_page(image, 1, "exact", 4)])
    lines = drawn.axes[0].get_lines()
    labels = [line.get_label() for line in lines if not line.get_label().startswith("_")]
    assert "3 r_arm" in labels and "ID 4" in labels and len(labels) == 18
    assert len({(line.get_color(), line.get_linestyle()) for line in lines if not line.get_label().startswith("_")}) == 18


def test_laws_are_one_line_where_they_agree(figure):
    import math

    image = read_text(TEXT)
    exact, classic = plot.of_page_by_both_laws(image, 1, 4, None)
    drawn = figure([exact, classic])
    dotted = [line for line in drawn.axes[0].get_lines() if line.get_linestyle() == ":"]
    shown = [k for k, value in enumerate(dotted[0].get_ydata()) if not math.isnan(value)]
    different = [k for k, (a, b) in enumerate(zip(classic.joints[3], exact.joints[3])) if abs(a - b) > 1]
    assert [k for k in shown if k < len(exact.joints[3])] == different and len(different) < len(exact.joints[3]) / 2


def test_labels_of_steps_do_not_overlap(figure):
    image = read_text("motion512 1\npage 1 fast\n  repeat 20\n" + "".join(f"  step 2 | 1:{500 + k}\n" for k in range(7)))
    drawn = figure([plot.of_page(image, 1, "exact", 10)])
    drawn.canvas.draw()
    boxes = sorted((text.get_window_extent() for text in drawn.axes[0].texts), key=lambda box: box.x0)
    assert len(boxes) > 3 and all(a.x1 <= b.x0 for a, b in zip(boxes, boxes[1:]))


def test_a_play_begins_where_the_approach_leaves_it():
    """Not with a leap from the middle: the board brings the robot to the first step before it plays."""
    curves = plot.of_page(read_text(TEXT.replace("step 1s | 1..18:512", "step 1s | 1..18:700")), 1, "exact", 4)
    assert curves.joints[7][0] == 700 and set(curves.joints[7]) == {700}


def test_positions_of_12_bits_are_drawn_as_their_angles(m512, tmp_path):
    (tmp_path / "a.m512").write_text(TEXT)
    assert m512("convert", tmp_path / "a.m512", tmp_path / "b.bin", "--scale", "12").exit_code == 0
    done = m512("plot", tmp_path / "b.bin", "1", "-o", tmp_path / "b.png", "--body", "none")
    assert done.exit_code == 0 and "1 joints" in done.stderr


# ---- the robot above the curves ----

CHEER = """motion512 1
row 1..6
page 1 cheer
  step 1s | 512 512 512 512 512 512
  step 1s | 512 512 700 512 512 512
  step 1s | 512 512 512 512 512 512
"""


@pytest.fixture
def strip():
    pytest.importorskip("numpy")
    from m512.motion.strip import Strip

    return Strip


def robots(drawn):
    """[(left, right, top)] of the robots above the curves, from left to right, pixels."""
    from matplotlib.transforms import Bbox

    boxes = []
    for collection in drawn.axes[0].collections:
        boxes.append(Bbox.union([path.get_extents(collection.get_transform()) for path in collection.get_paths()]))
    return sorted((box.x0, box.x1, box.y1) for box in boxes)


def test_robots_stand_above_their_moments_and_do_not_overlap(figure, strip):
    drawn = figure([plot.of_page(read_text(CHEER), 1, "exact", 4)], strip=strip())
    found = robots(drawn)
    assert len(found) > 5 and all(a[1] <= b[0] for a, b in zip(found, found[1:]))
    seconds = sorted(line.get_xdata()[0] for line in drawn.axes[0].get_lines())
    middles = [drawn.axes[0].transData.transform((at, 0))[0] for at in seconds]
    assert len(middles) == len(found) and all(left < at < right for at, (left, right, _) in zip(middles, found))
    assert any(abs(at - 2) < 0.02 for at in seconds)             # where step 2 ends


def test_robots_are_in_the_pose_of_their_moment(figure, strip):
    """Joint 3 lifts the right arm to the side, to the left in the picture; at 2 s it stands out by 55 degrees."""
    drawn = figure([plot.of_page(read_text(CHEER), 1, "exact", 4)], strip=strip())
    widths = [right - left for left, right, _ in robots(drawn)]
    seconds = sorted(line.get_xdata()[0] for line in drawn.axes[0].get_lines())
    assert abs(seconds[widths.index(max(widths))] - 2) < 0.02 and max(widths) > 1.2 * widths[0]
    assert widths[0] == pytest.approx(widths[-1], abs=1)


def test_a_long_walk_shows_its_different_steps(figure, strip):
    """Steps that come round as often as a robot finds room: not the same one again and again."""
    image = read_text("motion512 1\nrow 1..6\npage 1 walk\n  next walk\n" + "".join(f"  step 0.125s | {k} 512 512 512 512 512\n"
                                                                              for k in (300, 400, 512, 650)))
    curves = plot.of_page(image, 1, "exact", 5)
    drawn = figure([curves], strip=strip())
    shown = [curves.robot[1][round(line.get_xdata()[0] * 128) - 1] for line in drawn.axes[0].get_lines()]
    assert all(any(abs(value - end) < 12 for value in shown) for end in (300, 400, 512, 650)), shown


def test_without_a_body_the_plot_is_drawn_and_it_is_said(m512, monkeypatch, tmp_path):
    from m512.motion import strip

    monkeypatch.setattr(strip, "body_sources", lambda: None)
    (tmp_path / "a.m512").write_text(CHEER)
    done = m512("plot", tmp_path / "a.m512", "cheer", "-o", tmp_path / "a.png")
    assert done.exit_code == 0 and (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert "note: no pictures of the robot: they need its body" in done.stderr
    quiet = m512("plot", tmp_path / "a.m512", "cheer", "-o", tmp_path / "b.png", "--body", "none")
    assert quiet.exit_code == 0 and "note" not in quiet.stderr
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "a.png").read_bytes()


def test_an_unknown_body_is_named(m512, tmp_path):
    (tmp_path / "a.m512").write_text(CHEER)
    done = m512("plot", tmp_path / "a.m512", "cheer", "-o", tmp_path / "a.png", "--body", "robbie")
    assert done.exit_code == 4 and "robbie" in done.stderr and "known here: gp, humanoid" in done.stderr
    assert not (tmp_path / "a.png").exists()


def test_a_strip_of_pictures_has_its_place_above(figure):
    told = []
    drawn = figure([plot.of_page(read_text(TEXT), 1, "exact", 4)], strip=lambda axis, curves: told.append((axis, curves)))
    assert len(drawn.axes) == 3 and told[0][0] is drawn.axes[0] and told[0][1].seconds
