# SPDX-License-Identifier: MIT
"""What tools/prove mutation makes of ctest's output: a mistake is caught by a case that fails, not by a name that chooses no case."""
import pathlib
import sys

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "tests" / "prove"), str(TOP / "tools" / "campaign")]
import mutation  # noqa: E402  (the paths come first)

MISTAKE = mutation.Mutation("slip", "hal/x.c", "a", "b", "why", "sim.hal", "some_case")
HEAD, END = "    Start 143: sim.hal\n1/1 Test #143: sim.hal .......***Failed   10.02 sec\n\n", "\n\n0% tests passed, 1 tests failed out of 1\n"
OUTPUTS = {
    "a case fails": (HEAD + "FAILED tests/sim/test_hal.py::test_some_case - assert 1\n1 failed, 3 deselected in 7.12s" + END, 8,
                     (True, "sim.hal (test_some_case)", False)),
    "no case has that name": (HEAD + "4 deselected in 7.12s" + END, 8, (False, mutation.NO_CASE, True)),
    "all pass": ("1/1 Test #143: sim.hal .......   Passed   10.02 sec\n\n100% tests passed", 0, (False, "the tests named pass", False)),
}


@pytest.mark.parametrize("output, status, verdict", OUTPUTS.values(), ids=OUTPUTS)
def test_verdict_on_a_mistake(output, status, verdict):
    tree = mutation.Tree.__new__(mutation.Tree)
    tree.named_only = True
    tree.build_for = lambda mistake: ""
    tree.run = lambda *command, **variables: (output, status)
    assert tree.judge(MISTAKE) == verdict
