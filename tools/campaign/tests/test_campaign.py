# SPDX-License-Identifier: MIT
"""Campaigns: the same results in the same order wherever jobs run; faults are told."""
import functools
import os
import pathlib
import sys

import pytest
from distributed import LocalCluster

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parents[1])]
import campaign  # noqa: E402
import jobs  # noqa: E402

EXPECTED = [jobs.number(seed) for seed in range(12)]


@pytest.fixture(scope="module", name="address")
def _address():
    campaign.ANSWER_S = jobs.PATIENCE_S
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50) as cluster:
        yield cluster.scheduler_address


@pytest.mark.parametrize("processes", [1, 2])
def test_on_this_machine(processes):
    assert campaign.each(jobs.number, range(12), "numbers", processes) == EXPECTED


def test_on_a_cluster_of_two_workers(address, tmp_path):
    assert campaign.each(jobs.number, range(12), "numbers", scheduler=address) == EXPECTED
    places = set(campaign.each(functools.partial(jobs.meet, tmp_path), [2] * 8, "places", scheduler=address))
    assert len(places) == 2 and os.getpid() not in places


def test_scheduler_of_the_whole_program(address):
    campaign.use(address)
    try:
        assert os.getpid() not in campaign.each(jobs.where, range(1), "places")
    finally:
        campaign.use(None)


def test_partials_and_no_items(address):
    assert campaign.each(functools.partial(jobs.scaled, 3), [1, 2], "x", scheduler=address) == [3, 6]
    assert campaign.each(jobs.number, [], "nothing") == campaign.each(jobs.number, [], "nothing", scheduler=address) == []


def test_a_bad_job_ends_the_campaign(address):
    for how in ({"jobs": 2}, {"scheduler": address}):
        with pytest.raises(ValueError, match="job 3 is bad"):
            campaign.each(jobs.fails, range(6), "jobs", **how)


def test_nobody_at_the_address(monkeypatch):
    monkeypatch.setattr(campaign, "ANSWER_S", 1)
    with pytest.raises(ConnectionError, match="no Dask scheduler answers at tcp://127.0.0.1:1"):
        campaign.each(jobs.number, [1], "numbers", scheduler="tcp://127.0.0.1:1")


def test_a_worker_without_the_project_says_so(monkeypatch, tmp_path):
    monkeypatch.setenv("M512_TOP", str(tmp_path))
    with pytest.raises(FileNotFoundError, match="set its environment variable M512_TOP"):
        campaign._call(b"", str(tmp_path), [])


def test_progress_says_how_far_it_is(capfd):
    campaign.each(jobs.number, range(4), "numbers", 1)
    assert "numbers: 4 of 4" in capfd.readouterr().err
