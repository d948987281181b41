# SPDX-License-Identifier: MIT
"""CHECK names the faults of a page and the speeds it needs from its servos (firmware/edit/DIFFERENCES.md)."""

import pytest

from tests.sim.edit_robot import page, robot


def test_check_knows_how_fast_a_servo_is_at_this_battery():
    """100 units in 12 ticks are 313 degrees/s: an AX-12 reaches 283 at 9.6 V and 354 at 12 V."""
    pages = {1: page("fast", [(30, {5: 400}), (12, {5: 500})], code=1)}
    for volts, too_fast in ((9.6, True), (12, False)):
        with robot(pages=pages) as r:
            r.board.battery(volts)
            r.board.run(ms=600)  # CHECK knows the supply after a whole round of polls
            r.line("check", ms=3000)
            assert ("Page   1: step 1 ID 5 too fast" in r.show()) == too_fast, r.show()


@pytest.mark.parametrize("units, said", [(90, None), (91, 284)])
def test_check_counts_units_as_the_servo_does(units, said):
    """An AX-12 reaches 59 rpm at 12 V, 300 degrees are 1024 units: 283.2 degrees/s = 90.6 units in 12 ticks at 9.6 V."""
    with robot(pages={1: page("fast", [(30, {5: 400}), (12, {5: 400 + units})], code=1)}) as r:
        r.board.battery(9.6)
        r.board.run(ms=600)
        r.line("check", ms=3000)
        assert ("too fast" in r.show()) == (said is not None), r.show()
        assert said is None or f"step 1 ID 5 too fast, {said} degrees/s" in r.show(), r.show()


def test_check_names_what_is_wrong():
    torn = page("torn", [(30, {})])
    torn.data[100] ^= 1
    pages = {
        1: page("a", [(30, {})], next=2, code=1),
        2: torn,
        3: page("alone", [(30, {}), (2, {5: 1000})]),
        4: page("b", [(30, {})], next=9, code=2),
    }
    with robot(pages=pages) as r:
        r.line("check", ms=3000)
        shown = r.show()
        assert "Page   1: leads to page 2, which is not valid" in shown
        assert "Page   2: checksum is wrong" in shown
        assert "Page   3: no code and no other page calls it" in shown
        assert "Page   3: step 1 ID 5 too fast" in shown
        assert "Page   4: leads to page 9, which has no steps" in shown or "Page   4: leads to page 9, which is not valid" in shown


def test_check_names_partners_that_cannot_be_blended():
    """Bytes 17 and 18. A partner needs neither a code nor a link."""
    two = [(30, {}), (30, {})]
    torn = page("torn", two)
    torn.data[100] ^= 1
    pages = {
        1: page("walk", two, code=1, blend_right=2, blend_left=3),
        2: page("right", two),
        3: page("left", two + two),
        4: page("x", two, code=2, blend_right=5, blend_left=9),
        5: torn,
        6: page("y", two, code=3, blend_left=200),
    }
    with robot(pages=pages) as r:
        r.line("check", ms=4000)
        lines = [line.strip() for line in r.show().splitlines() if line.startswith("Page ")]
        assert lines == [
            "Page   1: blends with page 3, which has another number of steps",
            "Page   4: blends with page 5, which is not valid",
            "Page   4: blends with page 9, which has no steps",
            "Page   5: checksum is wrong",
            "Page   6: blends with page 200, which is not valid",
        ]


def test_check_of_a_page_that_fills_many_lines_is_no_hang():
    """126 lines take longer than the watchdog time."""
    with robot(pages={5: page("far", [(30, {})] * 7, code=1)}) as r:
        for servo in r.board.servos:
            servo.write(6, [600 & 255, 600 >> 8, 700 & 255, 700 >> 8])
        r.board.forbid("unexpected-reset")
        r.line("check 5", ms=3000)
        assert r.show().count("outside the servo's limits") > 10
        r.keys("\x1b")
        r.line("list 5")
        assert "far" in r.show()
