# SPDX-License-Identifier: MIT
"""The bench of the shipped Play image: it runs, and every figure is within its budget but for those named here. (tools/bench
--strict is the judge.)"""
import pathlib
import subprocess

BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"
# What does not hold, and why: all 31 joints in steps that short leave no tick in which to work ahead (motion/README.md).
KNOWN = {"exact: frame, steps of 2, most", "exact: frame, steps of 1, most", "exact: frame, no way, most",
         "classic: frame, steps of 3, most"}


def test_bench_prints_its_table_and_every_other_budget_holds():
    done = subprocess.run([BENCH, "--strict"], capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    rows = done.stdout.splitlines()[1:]
    missed = {row[:44].rstrip() for row in rows if row.endswith("MISSED")}
    assert missed <= KNOWN
    assert done.returncode == (1 if missed else 0)
    assert sum("<=" in row or ">=" in row for row in rows) == 2 * 14 + 2
