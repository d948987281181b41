# SPDX-License-Identifier: MIT
"""Shaping in the shipped Play image: rate, amplitude, blend, driving (SHAPING.md)."""

import re

import pytest

from tests.sim.play_robot import LEFT, UP, ask, robot
from tests.sim.walking_robot import LOOP, WAVE, looping, pages, where

# --- words ---

WRONG = [
    ("rate 9", "Rate must be 10..400"),
    ("rate 401", "Rate must be 10..400"),
    ("rate fast", "Rate must be 10..400"),
    ("amplitude 151", "Amplitude must be 0..150"),
    ("amplitude 60 31", "ID must be 0..30"),
    ("amplitude 60 25", "No answer: ID 25"),
    ("blend 101", "Blend must be -100..100"),
    ("blend -101", "Blend must be -100..100"),
    ("blend --5", "Blend must be -100..100"),
    ("drive 0 100 151", "Amplitude must be 0..150"),
    ("drive 0 9 100", "Rate must be 10..400"),
    ("drive -101 100 100", "Blend must be -100..100"),
    ("shape off", "Say shape, or shape reset"),
]


@pytest.fixture(scope="module", name="standing")
def standing_robot():
    return robot(pages=pages())


@pytest.mark.parametrize("line, said", WRONG)
def test_wrong_words_say_one_sentence_and_change_nothing(standing, line, said):
    board = standing
    before = where(board), ask(board, "shape")
    board.clear_trace()
    assert ask(board, line) == said
    answer = ask(board, "@" + line)
    assert re.fullmatch(rf"@{line.split()[0]} ERR \d+ {re.escape(said)}", answer), answer
    assert (where(board), ask(board, "shape")) == before
    board.run(ms=100)
    assert board.trace == []


def test_words_and_requests_do_the_same():
    board = robot(pages=pages())
    for word in ("rate 150", "blend -40", "amplitude 60", "amplitude 120 3 4"):
        assert ask(board, word) == " OK"
    typed = ask(board, "shape"), where(board)
    amplitudes = "3C" * 3 + "78" * 2 + "3C" * 26  # joints 3 and 4: 120
    assert typed[0] == f" rate=150 blend=-40 amplitude={amplitudes} layer=0 aim=00000000 OK"
    assert (typed[1]["rate"], typed[1]["blend"], typed[1]["amplitude"]) == ("150", "-40", amplitudes)
    assert ask(board, "shape reset") == " OK"
    assert where(board)["rate"] == "100"
    for word in ("@rate 150", "@blend -40", "@amplitude 60", "@amplitude 120 3 4"):
        assert ask(board, word) == word.split()[0] + " OK"
    assert (ask(board, "shape"), where(board)) == typed
    assert "rate=150" in ask(board, "status")


# --- rate, amplitude, blend ---


@pytest.mark.parametrize("centre", [0, 90])  # off; an empty page
def test_amplitude_is_refused_to_a_person_where_nothing_can_be_scaled(centre):
    board = robot(pages=pages())
    assert ask(board, f"settings centre {centre}") == " OK"
    assert ask(board, "amplitude 60") == ask(board, "amplitude 60 3") == "None is a joint of the centre page: settings centre"
    assert where(board)["amplitude"] == "100"
    assert ask(board, "@amplitude 60") == "@amplitude OK" and where(board)["amplitude"] == "60"
    assert ask(board, "amplitude 100") == " OK" and where(board)["amplitude"] == "100"
    assert ask(board, "drive 0 150 60") == "None is a joint of the centre page: settings centre" and where(board)["rate"] == "100"
    assert ask(board, "drive 0 150 100") == " OK" and ask(board, "@drive 0 150 60") == "@drive OK"
    assert ask(board, "settings centre 1") == ask(board, "amplitude 60") == ask(board, "drive 0 150 60") == " OK"


def test_amplitude_is_refused_to_a_person_for_joints_that_the_centre_pose_does_not_use():
    board = robot(pages=pages())
    assert ask(board, f"settings centre {WAVE}") == " OK"  # it uses joints 3 and 5
    for word in ("amplitude 60 4", "amplitude 60 1 2 6"):
        assert ask(board, word) == "None is a joint of the centre page: settings centre"
    assert where(board)["amplitude"] == "100"
    for word in ("amplitude 60 3", "amplitude 60 4 5", "amplitude 60", "amplitude 100 4"):
        assert ask(board, word) == " OK"


def test_rate_changes_the_speed_of_a_walk_from_the_next_step_on():
    board = looping()
    ask(board, "settings talk 1")
    times = {}
    for rate in (100, 200, 50):
        ask(board, f"rate {rate}")
        board.run(ms=2500)  # the steps planned before are played
        board.take()
        board.expect("Page 30 step 2", ms=5000)
        begin = board.now_ms
        board.take()
        board.expect("Page 30 step 2", ms=5000)
        times[rate] = board.now_ms - begin
    assert times[100] == pytest.approx(1000, abs=40)
    assert times[200] == pytest.approx(500, abs=40)
    assert times[50] == pytest.approx(2000, abs=60)


def test_amplitude_makes_a_walk_smaller_about_the_centre_page():
    board = looping()
    ask(board, "amplitude 50")
    board.run(ms=2000)
    board.clear_trace()
    board.run(ms=2000)
    reached = {frame.goals[11] for frame in board.trace if 11 in frame.goals}
    assert (min(reached), max(reached)) == (488, 536)  # page 1 has 512, the walk 464 and 560
    assert {frame.goals[1] for frame in board.trace if 1 in frame.goals} == {496}  # page 1 has 480, the walk 512


@pytest.mark.parametrize("blend, high", [(100, 600 - 80), (-100, 600), (50, 540), (0, 560)])
def test_blend_goes_towards_the_partner(blend, high):
    board = looping()
    ask(board, f"blend {blend}")
    board.run(ms=2000)
    board.clear_trace()
    board.run(ms=2000)
    assert max(frame.goals[11] for frame in board.trace if 11 in frame.goals) == high


# --- driving ---


def test_drive_at_20_hz_keeps_a_walk_going_and_a_pulled_cable_ends_it_on_its_exit_page():
    board = looping()
    for _ in range(60):
        board.send("@drive 30 120 80\r")
        board.run(ms=50)
    fields = where(board)
    assert (fields["state"], fields["rate"], fields["blend"], fields["amplitude"]) == ("playing", "120", "30", "80")
    board.take()
    text = board.expect("Stopped after page 33 (stand)", ms=6000)  # the cable is unplugged: no more lines arrive
    assert "Nobody drives any more: stopping" in text
    board.run(ms=100)
    # With an amplitude of 80 % about page 1 (480 and 544) the pose of the exit page is 506 and 518 for the arms.
    assert [board.servos[joint].goal for joint in (1, 2, 11, 12, 13)] == [506, 518, 512, 512, 512]
    fields = where(board)
    assert (fields["state"], fields["rate"], fields["blend"]) == ("idle", "100", "0")


def test_drive_watchdog_may_be_longer_or_off():
    board = looping()
    ask(board, "settings drive 0")
    ask(board, "@drive 0 100 100")
    board.run(ms=6000)
    assert where(board)["state"] == "playing"
    ask(board, "settings drive 30")
    ask(board, "@drive 0 100 100")
    board.run(ms=2500)
    assert where(board)["state"] == "playing"
    board.expect("Nobody drives any more", ms=1000)


def test_nobody_drives_in_a_pause_and_nothing_moves_before_the_resume():
    board = looping()
    ask(board, "@drive 0 100 100")
    assert ask(board, "@pause") == "@pause OK"
    board.run(ms=500)  # it slows down and stops
    resting = [board.servos[joint].goal for joint in range(1, 19)]
    board.run(ms=4000)
    assert where(board)["state"] == "paused"
    assert [board.servos[joint].goal for joint in range(1, 19)] == resting
    assert ask(board, "@resume") == "@resume OK"
    board.expect("Nobody drives any more", ms=1500)


def hold(board, buttons):
    """The remote repeats its packet for 1.2 s."""
    for _ in range(13):
        board.rc(buttons)
        board.run(ms=90)


def test_remote_drive_steers_the_next_play_and_comes_back_to_straight():
    board = looping()
    ask(board, "remote drive")
    hold(board, UP | LEFT)
    assert where(board)["blend"] == "0"  # a play keeps the mode with which it began
    ask(board, "break")
    board.run(ms=1000)
    ask(board, f"play {LOOP}")
    board.run(ms=3000)
    hold(board, UP | LEFT)
    assert where(board)["blend"] == "-100"
    assert where(board)["page"] == str(LOOP)
    board.rc(UP)
    board.run(ms=1100)
    assert where(board)["blend"] == "0"
