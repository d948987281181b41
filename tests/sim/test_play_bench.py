# SPDX-License-Identifier: MIT
"""The bench of the shipped Play image runs, and every figure is within its budget. (tools/bench --strict decides.)"""

import importlib.machinery
import importlib.util
import pathlib
import subprocess

BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools" / "bench"
KINDS, LENGTHS = 5, 9  # kinds of plays without shaping; step lengths with all shaping


def test_bench_prints_its_table_and_every_budget_holds():
    done = subprocess.run([BENCH, "--strict"], capture_output=True, text=True, check=False)
    print(done.stdout, done.stderr)
    rows = done.stdout.splitlines()[1:]
    assert done.returncode == 0 and not any(row.endswith("MISSED") for row in rows)
    assert sum("<=" in row or ">=" in row for row in rows) == 2 * (2 * (KINDS + LENGTHS) + 2) + 2


def test_bench_does_not_call_a_play_without_a_frame_good(capsys):
    loader = importlib.machinery.SourceFileLoader("bench", str(BENCH))
    bench = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", loader))
    loader.exec_module(bench)
    table, most = bench.Table(), bench.Most()
    most.take(1584, None)
    bench.rows_of(table, "skipped", most)
    assert table.missed and "no frame  MISSED" in capsys.readouterr().out
