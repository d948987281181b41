# SPDX-License-Identifier: MIT
"""Runs lists of actions in simulated time, and makes a failing one short."""

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
    """How a session went. fault: "" or "RULE at tick N: what happened"."""

    seed: int
    ticks: int
    marks: dict
    fault: str
    cpu_s: float


def motions():
    """The file of motion pages that all sessions begin with."""
    if not MOTIONS.exists() or MOTIONS.read_bytes() != chance.motions():
        MOTIONS.write_bytes(chance.motions())
    return MOTIONS


def play(seed, actions):
    """Runs a list."""
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
    """The rule that was broken."""
    return fault.partition(" at tick ")[0]


def shrunk(actions, rule):
    """The list without what can be left out: it still breaks this rule. Halves, quarters, ... of it are tried first."""
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
    """A list from a file."""
    lines = [line for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    return [(int(tick), words) for tick, _, words in (line.partition(" ") for line in lines)]


def shown(actions):
    """The list for people: what is typed as text."""

    def readable(words):
        return f"type {bytes.fromhex(words[5:])!r}" if words.startswith("type ") else words

    return "\n".join(f"{tick:7} {readable(words)}" for tick, words in actions)
