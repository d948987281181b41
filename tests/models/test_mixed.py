# SPDX-License-Identifier: MIT
"""A sample of what mixed.py asks at scale, and that each of its checks can object."""

from tests.models import hand_over, mixed, mixed_cases, mixed_checks, mixed_facts, shaping
from tests.models.played import EXACT

CASES = 200


def test_everything_at_once_by_chance():
    assert not mixed.objections(1, CASES)


def objects(check, seeds=range(1, 80)):
    return any(mixed.first_objection(mixed_cases.case_by_chance(seed), [check]) for seed in seeds)


def test_a_shape_that_the_model_does_not_know_is_found(monkeypatch):
    """Positions rounded down instead of to the nearest."""
    monkeypatch.setattr(shaping, "rounded", lambda way: int(way // 1))
    assert objects("bytes") and objects("lengths")


def test_a_joint_that_the_layer_touches_is_found(monkeypatch):
    """One that the check takes for never lent."""
    real = mixed_facts.lent
    monkeypatch.setattr(mixed_checks, "lent", lambda case, run: set(sorted(real(case, run))[1:]))
    assert objects("layers")


def test_a_hand_over_that_is_too_fast_is_found(monkeypatch):
    monkeypatch.setattr(hand_over, "UNITS_A_TICK", 0.9 * hand_over.UNITS_A_TICK)
    assert objects("hands")


def test_a_play_without_layers_that_goes_otherwise_is_found(monkeypatch):
    """One whose partner is faster."""

    def faster_alone(case, alone=False, **how):
        return mixed_cases.play(case, before=[("rate", 130)], **how) if alone else mixed_cases.play(case, **how)

    monkeypatch.setattr(mixed_checks, "play", faster_alone)
    assert objects("nothing", range(1, 20))


def test_a_step_that_is_too_long_is_found(monkeypatch):
    real = shaping.ideal_step
    monkeypatch.setattr(shaping, "ideal_step", lambda *asked: real(*asked) * 100 / 108)
    assert objects("lengths")


def test_slowing_down_for_too_long_is_found(monkeypatch):
    monkeypatch.setattr(mixed_checks, "BRAKES_TICKS", 5)
    cases = [case for case in map(mixed_cases.case_by_chance, range(1, 400)) if case.law == EXACT]
    assert any(mixed.first_objection(case, ["pauses"]) for case in cases if max(case.image[512 * page + 24] for page in mixed_cases.MAIN_PAGES) < 8)


def test_a_case_is_shrunk_to_the_actions_that_matter(monkeypatch):
    real = mixed_facts.lent
    monkeypatch.setattr(mixed_checks, "lent", lambda case, run: set(sorted(real(case, run))[1:]))
    case = next(case for case in map(mixed_cases.case_by_chance, range(1, 80)) if mixed.first_objection(case, ["layers"]))
    before = len(case.actions)
    mixed.shrunk(case, "layers")
    assert len(case.actions) < before and mixed.first_objection(case, ["layers"])
