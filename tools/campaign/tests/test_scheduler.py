# SPDX-License-Identifier: MIT
"""Campaigns on a Dask scheduler with two workers: the same results as on this machine. Needs Dask: tools/dev/setup campaign."""

import functools
import os

import jobs
import pytest

import campaign

distributed = pytest.importorskip("distributed", reason="Dask is for campaigns on many machines: tools/dev/setup campaign")


@pytest.fixture(scope="module", name="address")
def _address():
    campaign.ANSWER_S = jobs.PATIENCE_S
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50) as cluster:
        campaign.use(cluster.scheduler_address)
        yield cluster.scheduler_address
        campaign.use(None)


def test_on_two_workers(address, tmp_path):
    assert campaign.each(jobs.number, range(12), "numbers") == [jobs.number(seed) for seed in range(12)]
    assert campaign.each(jobs.number, [], "nothing") == []
    places = set(campaign.each(functools.partial(jobs.meet, tmp_path), [2] * 8, "places", scheduler=address))
    assert len(places) == 2 and os.getpid() not in places


def test_a_bad_job_ends_the_campaign(address):
    with pytest.raises(ValueError, match="job 3 is bad"):
        campaign.each(jobs.fails, range(6), "jobs", scheduler=address)


def test_nobody_at_the_address(monkeypatch):
    monkeypatch.setattr(campaign, "ANSWER_S", 1)
    with pytest.raises(ConnectionError, match="no Dask scheduler answers at tcp://127.0.0.1:1"):
        campaign.each(jobs.number, [1], "numbers", scheduler="tcp://127.0.0.1:1")


def test_a_worker_without_the_project_says_so():
    with pytest.raises(ModuleNotFoundError, match="this worker lacks Motion512; start it with build/venv/bin/dask"):
        campaign._call(b"cnowhere_to_be_found\nwork\n.")
