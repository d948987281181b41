# SPDX-License-Identifier: MIT
"""After any edits, whose cells are sent one by one, the terminal shows the same as after a complete redraw."""

import random

import pytest

from tests.sim.edit_robot import page, robot

PAGES = {
    1: page("one", [(40, {1: 480, 2: 544}, 3), (50, {3: 300})], code=7, next=3),
    2: page("two", [(10 + k, {k: 100 * k}, k) for k in range(7)], joints=range(31)),
    3: page("", [(64, {})], schedule=0),
}
TORN = page("torn", [(30, {})])
TORN.data[100] ^= 1
PAGES[4] = TORN


def action(rng):
    """(typed line or keys, is a line)"""
    kind = rng.randrange(10)
    if kind < 3:
        return rng.choice(("]", "[", "}", "{", " ", "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D")) * rng.randrange(1, 5), False
    line = rng.choice(
        (
            f"page {rng.randrange(6)}",
            "next",
            "before",
            f"copy {rng.randrange(5)}",
            "new",
            "undo",
            "undo",
            "redo",
            "hex",
            "dec",
            f"goto {rng.randrange(10)} {rng.randrange(33)}",
            f"set {rng.randrange(128)}",
            f"step {rng.randrange(8)}",
            "write",
            f"write {rng.randrange(7)}",
            f"insert {rng.randrange(7)}",
            f"delete {rng.randrange(7)}",
            "time",
            "speed",
            f"move {rng.randrange(8)} {rng.randrange(8)}",
            f"swap {rng.randrange(7)} {rng.randrange(7)}",
            f"go {rng.randrange(7)}",
            f"mirror {rng.randrange(7)}",
            "on",
            "off",
            "on 3 4",
            "off 5",
            "name",
            "name xyz",
            "save 9",
            "foo",
            "list 1 2",
            "help",
            "mon",
        )
    )
    return line, True


def act(r, text, is_line):
    if not is_line:
        r.keys(text)
        return
    r.line(text)
    if text == "name":
        r.line("a name")
    elif text in ("list 1 2", "help"):
        r.keys("\x1b", ms=150)
        r.keys("\x1b", ms=150)
    elif "[y/N]" in r.command:
        r.keys("y")


def table(r):
    """The rows above the command row, without the live positions (a servo still moves after GO)."""
    return [row[:14] + "    " + row[18:] if row.startswith("Dynamixel") else row for row in r.terminal.screen.display[: r.rows - 1]]


@pytest.mark.parametrize("rows, seed", [(36, 1), (24, 2), (28, 3)])
def test_screen_after_any_edits_is_that_of_a_redraw(rows, seed):
    rng = random.Random(seed)
    with robot(pages=PAGES, rows=rows, servos=(1, 2, 3, 4, 5, 9, 17, 18, 30)) as r:
        done = []
        for _ in range(15):
            for _ in range(rng.randrange(1, 4)):
                done.append(action(rng))
                act(r, *done[-1])
            r.settle(ms=600 if "go" in done[-1][0] or "mirror" in done[-1][0] else 0)
            shown, cursor = table(r), r.cursor
            r.line("re")
            assert table(r) == shown, done[-6:]
            assert r.cursor == cursor, done[-6:]
