# SPDX-License-Identifier: MIT
"""A campaign of bodies gives the same outcomes on this machine and on a cluster of two workers."""
import pathlib
import sys

from distributed import LocalCluster

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[2] / name) for name in ("campaign", "motions")]
import campaign  # noqa: E402
import promises  # noqa: E402
from m512.files.formats import load as load_motions  # noqa: E402

MOTIONS = pathlib.Path(__file__).resolve().parents[2] / "motions" / "motions.m512"
BOW = promises.Stands("bow", 4)


def bow(seed):
    library = load_motions(MOTIONS)
    return promises.stands(library.to_bytes(), promises.number_of(library, "bow"), BOW, seed)


def test_outcomes_do_not_depend_on_where_a_job_ran(monkeypatch):
    here = campaign.each(bow, range(1, 5), "bodies", jobs=2)
    assert len({said for _, said in here}) == 4                      # four different bodies
    monkeypatch.setenv("PYTHONPATH", "")                             # workers find the project by themselves
    monkeypatch.setattr(campaign, "ANSWER_S", 300)                   # however busy this machine is
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50) as cluster:
        assert campaign.each(bow, range(1, 5), "bodies", scheduler=cluster.scheduler_address) == here
