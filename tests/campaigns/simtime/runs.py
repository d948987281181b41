# SPDX-License-Identifier: MIT
"""Runs lists of actions in simulated time, and shortens a failing list."""

import pathlib
import resource
import subprocess
from typing import NamedTuple

from tests.campaigns import proof
from tests.campaigns.simtime import chance

FOLDER = proof.BUILD / "host" / "tests" / "campaigns" / "simtime"
PROGRAM = FOLDER / "simtime_session"
MOTIONS = FOLDER / "motions.bin"
MOST_TRIES = 600


class Outcome(NamedTuple):
    """The result of a session. fault: "" or "RULE at tick N: what happened"."""

    seed: int
    ticks: int
    marks: dict
    fault: str
    cpu_s: float


def motions():
    """Writes the file of motion pages that all sessions begin with. Returns its path."""
    if not MOTIONS.exists() or MOTIONS.read_bytes() != chance.motions():
        MOTIONS.write_bytes(chance.motions())
    return MOTIONS


def play(seed, actions):
    """Runs a list of actions."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([PROGRAM, FOLDER], input=chance.text(actions), capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    ticks, marks, fault = 0, {}, ""
    for line in done.stdout.splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "ticks":
            ticks = int(rest)
        elif kind == "mark":
            count, _, name = rest.partition(" ")
            marks[name] = int(count)
        elif kind == "fault":
            fault = rest
    if done.returncode not in (0, 1) or (done.returncode == 1) != bool(fault):
        fault = f"crash at tick {ticks}: exit status {done.returncode} {done.stderr.strip()[-300:]}"
    elif fault and done.stderr:
        fault += f" ({done.stderr.strip()[-300:]})"
    return Outcome(seed, ticks, marks, fault, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def rule_of(fault):
    """Returns the rule that was broken."""
    return fault.partition(" at tick ")[0]


def shrunk(actions, rule):
    """Returns a shorter list that still breaks this rule. Leaves out halves, quarters, and so on, in at most MOST_TRIES tries."""
    setup, rest, end = [a for a in actions if a[0] == 0], [a for a in actions if a[0] > 0][:-1], actions[-1:]
    tries, size = 0, max(1, len(rest) // 2)
    while tries < MOST_TRIES:
        at, dropped = 0, False
        while at < len(rest) and tries < MOST_TRIES:
            without = rest[:at] + rest[at + size :]
            tries += 1
            if rule_of(play(0, setup + without + end).fault) == rule:
                rest, dropped = without, True
            else:
                at += size
        if size == 1 and not dropped:
            break
        size = max(1, size // 2)
    return setup + rest + end


def read(path):
    """Reads a list from a file."""
    lines = [line for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return [(int(tick), words) for tick, _, words in (line.partition(" ") for line in lines)]


def shown(actions):
    """Returns the list in readable form: typed bytes appear as text."""

    def readable(words):
        return f"type {bytes.fromhex(words[5:])!r}" if words.startswith("type ") else words

    return "\n".join(f"{tick:7} {readable(words)}" for tick, words in actions)
