# SPDX-License-Identifier: MIT
"""Plays the same session in simulated time and on the strict board with the shipped image, and compares goals, text and memories.

Actions are ("type", text), ("remote", buttons), ("goal",), ("wait", ticks) and ("push", servo). Each line ends at the same point of a tick
in both, because a break or pause received one tick later leaves the joints elsewhere.
"""

import random
import re
import subprocess
import tempfile
from typing import NamedTuple

from cm5sim import Board
from cm5sim.board import rc_packet, sync_goals
from tests.campaigns.simtime import chance, runs
from tests.sim.play_robot import shown

TICK = 15625  # half microseconds
BYTE = 347  # of the serial line at 57,600 baud, half microseconds
ENDS_AT = 5000  # the last byte of a line ends this long after the start of a tick
CYCLES = 8  # per half microsecond
START = 4 * 128  # ticks until the robot has found its servos
MOST_WAIT = 3 * 128
SERVOS = range(1, 19)
SHORT = (1, 2, 9, 12, 13, 15, 21, 22)
LOOPS = (3, 4, 6, 7, 8)  # endless: after an end, a code would start a play whose first frame is not waited for
PAGES_AT, PAGES_BYTES = 0xE000, 128 * 512
SETTINGS_AT, SETTINGS_BYTES = 0, 256


class Trace(NamedTuple):
    """The results of a session."""

    goals: list
    text: bytes
    pages: bytes
    settings: bytes
    ticks: int


def made(seed):
    """Returns random plays with random events. Each play begins with a frame of goals; both sides count ticks from it.

    Before each play the joints are pushed to 512: a servo's resting place depends on the microsecond of its last goal, and `on` reads it.
    """
    rng = random.Random(f"both {seed}")
    actions = []

    def line(text, wait):
        actions.extend((("type", text + "\r"), ("wait", wait)))

    for _ in range(5):
        if rng.random() < 0.7:
            line(rng.choice(("settings low 100", "settings talk 0", "settings talk 1", "law exact", "law classic", "settings hot 71")), 256)
        page = rng.choice(rng.choice((SHORT, LOOPS, LOOPS)))
        ends = False  # a second without @drive ends the play
        actions.extend((("type", f"play {page}\r"), ("goal",), ("wait", rng.randrange(200, 300))))
        for _ in range(rng.randrange(4)):
            kind = rng.random()
            if kind < 0.3 and page in LOOPS:
                button = rng.choice((4, 8, 512))
                pressed = (("wait", 8),) if ends else (("remote", button), ("wait", 8), ("remote", 0))
                actions.extend((*pressed, ("wait", rng.randrange(64, 128))))
                if button == 512:
                    break
            else:
                words = (f"rate {rng.choice((50, 150))}", f"amplitude {rng.randrange(151)}", f"blend {rng.randrange(-100, 101)}", "pause", "resume")
                words += (
                    f"layer 8 {rng.randrange(1, 19)}",
                    f"aim {rng.randrange(1, 19)} {rng.randrange(300, 700)}",
                    "free",
                    "layer off",
                    "@drive 20 120 80",
                )
                word = rng.choice(words)
                ends = ends or word[0] == "@"
                line(word, rng.randrange(64, 200))
        line("break", 256)
        line("free", 256)
        line("shape reset", 128)
        line("off", 128)
        actions.extend(("push", servo) for servo in SERVOS)
        line("on", 128)
    return actions


def data_of(action):
    """Returns the bytes on the console's line."""
    return action[1].encode("latin-1") if action[0] == "type" else rc_packet(action[1])


def pause_of(count, into_tick):
    """Returns the silence before `count` bytes so that they end at ENDS_AT. into_tick: the present time since the start of a tick."""
    return (ENDS_AT - into_tick - count * BYTE) % TICK


# ---- in simulated time ----


def simulated(actions, servos=SERVOS):
    """Returns the Trace, and how long after the start of the program's tick the ticks of simulated time begin."""

    def session(lines):
        head = ["0 seed 1", f"0 motions {runs.motions()}", *(f"0 servo {servo}" for servo in servos), "0 image play"]
        return subprocess.run(
            [runs.PROGRAM, runs.FOLDER, "--show"], input="\n".join([*head, *lines, ""]).encode(), capture_output=True, check=False
        ).stdout

    first = re.findall(rb"\nbus (\d+) .. 04 02 ", session([f"{START} end"]))
    into_tick = (START * TICK - (int(first[-1]) - 8 * 20)) % TICK  # a READ is eight bytes of 10 us
    lines, at = [], START
    with tempfile.NamedTemporaryFile() as memories:
        for action in actions:
            if action[0] == "wait":
                at += action[1]
            elif action[0] == "goal":
                lines.append(f"{at} goal")
            elif action[0] == "push":
                lines.append(f"{at} push {action[1]} 512")
            else:
                data = data_of(action)
                lines.append(f"{at} pause {pause_of(len(data), into_tick)}")
                lines.append(f"{at} " + (f"remote {action[1]}" if action[0] == "remote" else f"type {data.hex()}"))
        out = session([*lines, f"{at} memories {memories.name}", f"{at} end"])
        kept = memories.read()
    fault = re.search(rb"\nfault .*", out)
    assert not fault, fault[0]
    goals = [sync_goals(b"\xff\xff" + bytes.fromhex(found.decode())) for found in re.findall(rb"\nbus \d+ ([0-9a-f ]+)\n", out)]
    text = re.sub(rb"\nbus \d+ [0-9a-f ]+\n", b"", out).partition(b"ticks ")[0]
    eeprom = kept[-0x1000:]
    settings = eeprom[SETTINGS_AT : SETTINGS_AT + SETTINGS_BYTES]
    ticks = int(re.search(rb"ticks (\d+)", out)[1])
    return Trace([goal for goal in goals if goal], text, kept[:PAGES_BYTES], settings, ticks), into_tick


# ---- on the board ----


def tick_at(cycles):
    """Returns the number of the tick at this cycle."""
    return cycles // (TICK * CYCLES)


def on_board(actions, into_tick, servos=SERVOS):
    """Returns the Trace on the board. Its ticks are aligned to those of simulated time."""
    with Board(images=["play-cm5.hex"], motions=chance.motions(), servos=servos) as board:
        board.run(ticks=START)
        board.run_to("__vector_12")
        began = board.now_cycles
        board.run(cycles=into_tick * CYCLES)
        board.clear_trace()
        ahead = 0  # ticks of the next wait that have already passed
        for action in actions:
            if action[0] == "wait":
                board.run(ticks=action[1] - ahead)
                ahead = 0
            elif action[0] == "push":
                board.servos[action[1]].push_to(512)
            elif action[0] == "goal":
                before = len(board.trace)
                for _ in range(MOST_WAIT):
                    board.run(ticks=1)
                    if len(board.trace) > before:
                        # Simulated time computes instantly and sees the frame in its own tick. The board may see it in the next tick.
                        ahead = tick_at(board.now_cycles - began) - tick_at(board.trace[before].cycle - began)
                        break
            else:
                data = data_of(action)
                board.pause(pause_of(len(data), into_tick) / 2000)
                (board.remote if action[0] == "remote" else board.send)(data)
        goals = [frame.goals for frame in board.trace]
        flash, eeprom = bytes(board.flash), bytes(board.eeprom)
        text = board.console.translate(None, b"\x11\x13")
        ticks = tick_at(board.now_cycles)
    return Trace(goals, text, flash[PAGES_AT : PAGES_AT + PAGES_BYTES], eeprom[SETTINGS_AT : SETTINGS_AT + SETTINGS_BYTES], ticks)


def lines_of(text):
    """Returns what a terminal shows, without the line that names the board."""
    return [line.rstrip() for line in shown(text).split("\n") if "Motion512 Play" not in line]


def difference(seed):
    """Plays a session in both. Returns (frames of goals, ticks, difference or "")."""
    actions = made(seed)
    here, into_tick = simulated(actions)
    return len(here.goals), here.ticks, differs(here, on_board(actions, into_tick))


def differs(here, there):
    """Returns the first difference of two traces as text; "" if there is none."""
    for frame, (ours, theirs) in enumerate(zip(here.goals, there.goals)):
        if ours != theirs:
            return f"goals of frame {frame}: {ours}, on the board {theirs}"
    if len(here.goals) != len(there.goals):
        return f"{len(here.goals)} frames, on the board {len(there.goals)}"
    if lines_of(here.text) != lines_of(there.text):
        return "the console"
    return "" if (here.pages, here.settings) == (there.pages, there.settings) else "motion pages or settings"


# ---- a list of sessions.py ----


def replay(actions):
    """Plays a list of simulated time on the board and prints the console. Actions of the adapter and the computer are skipped."""
    servos = [int(words.split()[1]) for tick, words in actions if words.startswith("servo ")]
    passed = set()
    with Board(images=["play-cm5.hex"], motions=chance.motions(), servos=servos) as board:
        for tick, words in actions:
            board.run(ticks=max(0, tick - round(board.now_cycles / 125_000)))
            verb, *rest = words.split()
            if verb == "type":
                board.send(bytes.fromhex(rest[0]))
            elif verb == "remote":
                board.rc(int(rest[0]))
            elif verb == "fault":
                board.servos[int(rest[0])].fault(rest[1], int(rest[2]) or None)
            elif verb == "clear":
                board.servos[int(rest[0])].clear()
            elif verb == "push":
                board.servos[int(rest[0])].push_to(int(rest[1]))
            elif verb == "cut":
                board.power_off()
                board.power_on()
            elif verb not in ("seed", "motions", "servo", "end"):
                passed.add(verb)
        print("\n".join(shown(board.console.translate(None, b"\x11\x13")).split("\n")))
        print(f"{len(board.trace)} frames of goals; passed over: {', '.join(sorted(passed)) or 'nothing'}")
