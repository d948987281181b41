# SPDX-License-Identifier: MIT
"""The bench of the shipped Play image: it runs, and every figure is within its budget. (tools/bench --strict is the judge.)"""
import pathlib
import subprocess

import pytest

BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"


@pytest.mark.parametrize("servos, per_joint", [(31, 3), (18, 0)])      # the budgets for a joint are of 31
def test_bench_prints_its_table_and_every_budget_holds(servos, per_joint):
    done = subprocess.run([BENCH, "--strict", "--servos", str(servos)], capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    rows = done.stdout.splitlines()[1:]
    assert done.returncode == 0 and not any(row.endswith("MISSED") for row in rows)
    assert sum("<=" in row or ">=" in row for row in rows) == 2 * (11 + per_joint + 38) + 2
    assert sum("per joint" in row for row in rows) == 6
