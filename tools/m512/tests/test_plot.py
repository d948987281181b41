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


def test_a_strip_of_pictures_has_its_place_above(figure):
    told = []
    drawn = figure([plot.of_page(read_text(TEXT), 1, "exact", 4)], strip=lambda axis, curves: told.append((axis, curves)))
    assert len(drawn.axes) == 3 and told[0][0] is drawn.axes[0] and told[0][1].seconds
