# SPDX-License-Identifier: MIT
"""No play of our library exceeds a servo's speed. Checked by the goals of the C player, tick by tick, for every page, walks led by a
remote, and walks blended with their curves.

The bound comes from the maker's data sheet: an AX-12 turns at 59 rpm without load at 12 V, in proportion at lower voltages; 1024 units
are 300 degrees, a tick is 1/128 s. A goal is a whole unit, so speeds are averaged over four ticks."""

import pytest

from m512.files.formats import load
from m512.files.text import read_text
from m512.motion.speed import too_fast
from tests.models.played import ENDED, EXACT, STOPPED, TOP, Played

LIBRARY = load(TOP / "tools" / "motions" / "motions.m512")
LAYERS = {"wave_over", "look", "look_ahead"}
NUMBER = {page.title: number for number, page in LIBRARY.items() if number and page.is_playable and page.title not in LAYERS}
JOINTS = range(1, 19)
ROBOT = sum(1 << joint for joint in JOINTS)
WINDOW = 4
UP, DOWN, LEFT, RIGHT, STOP = 1, 2, 4, 8, 255


def units_per_tick(volts):
    """Returns the speed of an unloaded AX-12: 1208 units per second at 12 V."""
    return 59 * 360 / 60 * 1024 / 300 / 128 * volts / 12


MOST = 0.9 * units_per_tick(11.1)


def fastest(image, number, ticks=1500, codes=(), shape=()):
    """Returns the highest speed in units per tick that a play asks of a joint. codes: {tick: code of the remote}."""
    page, codes = image[number], dict(codes)
    begin = {joint: page.word(0, joint) if page.word(0, joint) < 1024 else 512 for joint in JOINTS}
    play = Played(image.to_bytes(), number, EXACT, joints=ROBOT, positions=begin, shape=shape)
    assert play.started
    rows = [[begin[joint] for joint in JOINTS]] * WINDOW
    for tick in range(ticks):
        if tick in codes:
            play.code(codes[tick])
        happened = play.tick()
        rows.append(play.goals()[1:19])
        if happened & (ENDED | STOPPED):
            break
    return max(abs(now - then) for row, after in zip(rows, rows[WINDOW:]) for then, now in zip(row, after)) / WINDOW


def made(ticks):
    """Returns a page that moves 400 to 496 and back at one speed: 96 units in `ticks` ticks."""
    return read_text(f"motion512 1\nrow 1..18\npage 1 fast\n  accel 0\n  step 50 | 1..18:400\n  step {ticks} | 1:496\n  step {ticks} | 1:400\n")


def test_bound_is_the_sheets():
    assert units_per_tick(12) * 128 == pytest.approx(1208, abs=0.5) and MOST == pytest.approx(7.86, abs=0.005)


@pytest.mark.parametrize("ticks, speed", [(12, 8), (13, 7.5), (16, 6)])
def test_a_page_that_is_too_fast_is_found(ticks, speed):
    assert fastest(made(ticks), 1) == pytest.approx(speed, abs=1 / WINDOW) and (fastest(made(ticks), 1) > MOST) == (speed > 7.86)


@pytest.mark.parametrize("name", NUMBER)
def test_pages_keep_to_what_a_servo_can(name):
    assert fastest(LIBRARY, NUMBER[name]) <= MOST


@pytest.mark.parametrize(
    "name, keys",
    [
        ("walk", (UP, RIGHT, LEFT, UP, DOWN)),
        ("back", (DOWN, UP)),
        ("right", (RIGHT, LEFT, UP)),
        ("left", (LEFT, RIGHT, UP)),
        ("side_r", (RIGHT + 16, LEFT + 16, UP)),
        ("dance", (64, 128)),
    ],
)
def test_ways_led_by_a_remote_keep_to_it(name, keys):
    codes = {307 * (k + 1): code for k, code in enumerate((*keys, *keys[::-1]))}
    assert fastest(LIBRARY, NUMBER[name], 4000, codes | {307 * (len(codes) + 1): STOP}) <= MOST


@pytest.mark.parametrize("blend", range(-100, 101, 25))
def test_blended_walks_keep_to_it(blend):
    """Without a given voltage, so that the player's own limit does not help."""
    assert fastest(LIBRARY, NUMBER["walk"], 1500, {900: STOP}, [("blend", blend)]) <= MOST


@pytest.mark.parametrize("name", ["walk", "back", "right", "end_r", "kick_r", "bow"])
def test_m512_tells_what_a_weaker_battery_cannot_do(name):
    """It names a page exactly when the C player asks for more speed than servos have at this voltage."""
    asked = fastest(LIBRARY, NUMBER[name], 400)
    for volts in (9.6, 8.0):
        if abs(asked - units_per_tick(volts)) > 1 / WINDOW:  # otherwise rounding decides
            assert bool(too_fast(LIBRARY, NUMBER[name], volts, seconds=400 / 128)) == (asked > units_per_tick(volts)), (volts, asked)
