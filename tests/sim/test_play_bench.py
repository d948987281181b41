# SPDX-License-Identifier: MIT
"""The bench of the shipped Play image: it runs, and what a robot's safety hangs on is within its budget. (tools/bench
--strict is the judge of every figure.)"""
import pathlib
import subprocess

BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"
MUST_HOLD = ["exact: rise", "exact: cruise", "exact: fall", "exact: frame with packet and sending, mean",
             "classic: frame with packet and sending, mean", "variables in RAM", "stack headroom"]


def test_bench_prints_its_table_and_the_steady_figures_hold():
    done = subprocess.run([BENCH], capture_output=True, text=True, check=True)
    print(done.stdout)
    for what in MUST_HOLD:
        row = next(line for line in done.stdout.splitlines() if line.startswith(what))
        assert "MISSED" not in row, row
