# SPDX-License-Identifier: MIT
"""Campaigns on this machine: results in the order of the items for any number of processes, and errors are reported."""

import functools
import sys

import jobs
import pytest

import campaign

EXPECTED = [jobs.number(seed) for seed in range(12)]


@pytest.mark.parametrize("processes", [1, 2])
def test_on_this_machine(processes):
    assert campaign.each(jobs.number, range(12), "numbers", processes) == EXPECTED


def test_partials_and_no_items():
    assert campaign.each(functools.partial(jobs.scaled, 3), [1, 2], "x", 1) == [3, 6]
    assert campaign.each(jobs.number, [], "nothing") == []


def test_a_bad_job_ends_the_campaign():
    with pytest.raises(ValueError, match="job 3 is bad"):
        campaign.each(jobs.fails, range(6), "jobs", 2)


def test_progress_says_how_far_it_is(capfd):
    campaign.each(jobs.number, range(4), "numbers", 1)
    assert "numbers: 4 of 4" in capfd.readouterr().err


def test_without_dask_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ConnectionError, match="run: tools/dev/setup campaign"):
        campaign.each(jobs.number, [1], "numbers", scheduler="tcp://127.0.0.1:1")
