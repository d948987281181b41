# SPDX-License-Identifier: MIT
"""The bench of the shipped Play image: it runs, and every figure is within its budget. (tools/bench --strict is the judge.)"""

import pathlib
import subprocess

BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"
KINDS, LENGTHS = 5, 9  # of plays with nothing set; of steps with everything in force


def test_bench_prints_its_table_and_every_budget_holds():
    done = subprocess.run([BENCH, "--strict"], capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    rows = done.stdout.splitlines()[1:]
    assert done.returncode == 0 and not any(row.endswith("MISSED") for row in rows)
    assert sum("<=" in row or ">=" in row for row in rows) == 2 * (2 * (KINDS + LENGTHS) + 2) + 2
