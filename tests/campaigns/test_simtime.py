# SPDX-License-Identifier: MIT
"""The shipped image on the strict board and the program in simulated time do the same: goals, text, motion pages, settings. Sessions are
repeatable, a broken rule is found, and its list of actions is shortened."""

import random

import pytest

from tests.campaigns.simtime import board, chance, runs

HOUR = 3600 * chance.SECOND


@pytest.mark.parametrize("seed", range(2))
def test_board_and_simulated_time_do_the_same(seed):
    frames, ticks, differs = board.difference(seed)
    assert frames > 500 and ticks > 128 * 20 and not differs, differs


def test_a_seed_is_the_same_session_each_time():
    first, again = (runs.play(5, chance.made(5, runs.motions())) for _ in range(2))
    assert first.ticks > 1000 and first[1:4] == again[1:4]


def test_an_hour_without_a_power_cut_keeps_every_rule():
    """The sessions last minutes, most of them with power cuts. This one outlives all counters of 16 bits."""
    person = chance.Player(random.Random("an hour"), list(range(1, 19)), {})
    names, weights = zip(*(row for row in chance.Player.WEIGHTS if row[0] != "power_fails"))
    while person.at < HOUR:
        getattr(person, person.rng.choices(names, weights)[0])()
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), *((0, f"servo {servo}") for servo in person.servos), (0, "image play")]
    outcome = runs.play(0, [*actions, *person.actions, (person.at, "end")])
    assert not outcome.fault and outcome.ticks >= HOUR


def test_a_power_cut_begins_with_fresh_memory():
    """Otherwise the earlier text would still be in the line, and a rule would report it."""
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), (0, "servo 1"), (0, "image play"), (400, chance.typed("play 8\rhalf a li"))]
    outcome = runs.play(0, [*actions, (700, "cut"), (1200, chance.typed("version\r")), (1400, "end")])
    assert not outcome.fault and outcome.marks["power cut during play"] == 1


@pytest.mark.parametrize("release", ([(640, "remote 0")], []), ids=("let go", "silent"))
def test_a_stop_that_nobody_has_typed_ends_aims(release):
    """In the mode `hold`. The joint is then on its way, and no rule is broken."""
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), (0, "servo 1"), (0, "servo 2"), (0, "image play")]
    asked = [(400, chance.typed("settings remote 1\r")), (600, "remote 1"), (610, chance.typed("aim 2 700 30\r"))]
    outcome = runs.play(0, [*actions, *asked, *release, (1400, "end")])
    assert not outcome.fault and outcome.marks["play stopped"] == 1


def test_a_joint_that_is_sent_elsewhere_need_not_come_to_where_it_was_sent_first():
    """Even if the line before it was refused a moment ago."""
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), *((0, f"servo {servo}") for servo in range(1, 19)), (0, "image play")]
    lines = [(384, "@move 60 11 17a\r"), (2168, "play 21\r"), (2936, "aim 1 600\r"), (3320, "play 1\r"), (3419, "aim 1 590\r")]
    outcome = runs.play(0, [*actions, *((tick, chance.typed(line)) for tick, line in lines), (3600, "end")])
    assert not outcome.fault


def test_a_pause_at_a_low_rate_is_longer():
    """SHAPING.md. No goal is sent in the pause, and what follows it counts as requested."""
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), (0, "servo 1"), (0, "image play")]
    lines = [(400, "@rate 10\r"), (450, "play 2\r")]
    outcome = runs.play(0, [*actions, *((tick, chance.typed(line)) for tick, line in lines), (4000, "end")])
    assert not outcome.fault and outcome.ticks > 3900


def test_a_broken_rule_is_seen_and_its_list_becomes_short():
    """An unknown action stands in for a program that fails."""
    actions = [(0, "seed 1"), (0, f"motions {runs.motions()}"), (0, "servo 1"), (0, "image play")]
    noise = [(420 + 20 * i, chance.typed("version\r")) for i in range(20)]
    others = [(900, "fault 1 dead 0"), (910, "clear 1"), (920, "no such action")]
    outcome = runs.play(0, [*actions, *noise, *others, (1000, "end")])
    assert outcome.fault.startswith("crash") and "no such action" in outcome.fault
    short = runs.shrunk([*actions, *noise, *others, (1000, "end")], "crash")
    assert [words for tick, words in short if tick > 0] == ["no such action", "end"]
