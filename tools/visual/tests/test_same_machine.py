# SPDX-License-Identifier: MIT
"""The board in the page is the board on the PC: sessions of a minute, and some made by chance, are run by libcm5sim.so
(through the Python binding, which knows nothing of the page's flat API) and by board.wasm in Node. Console bytes, goals
and positions of every tick, flash and EEPROM must be equal to the bit."""

import hashlib
import json
import os
import pathlib
import random
import struct
import subprocess

import pytest

from cm5sim import Board

HERE = pathlib.Path(__file__).parent
BUILD = pathlib.Path(os.environ["M512_BUILD"])
SERVOS = range(1, 19)
TICK = 125000
SESSIONS = json.loads((HERE / "session" / "session.json").read_text())
SEED = 20261122
WORDS = [
    "app\r",
    "GO\r",
    "play walk\r",
    "stop\r",
    "list\r",
    "page 9\r",
    "\x1b[A",
    "\x1b[B",
    "on\r",
    "off\r",
    "@pose\r",
    "@where\r",
    "x",
    "\r",
    "write\r",
    "save\r",
    "break\r",
    "servos\r",
    "\x03",
    "@play 2\r",
    "name a b\r",
    "set 700\r",
]


def chance(rng, image):
    events = []
    for ms in sorted(rng.randrange(1000, 7500) for _ in range(25)):
        kind = rng.choice(["send"] * 5 + ["rc", "push", "fault", "battery"])
        what = {
            "send": lambda: rng.choice(WORDS),
            "rc": lambda: rng.randrange(1024),
            "push": lambda: [rng.choice(SERVOS), rng.randrange(300, 700)],
            "fault": lambda: [rng.choice(SERVOS), rng.choice(["silent", "checksum", "short", "noise", "late"]), rng.randrange(5)],
            "battery": lambda: rng.choice([7.0, 9.6, 12.0]),
        }[kind]()
        events.append([ms, kind, what])
    return {
        "name": f"by chance, {image}",
        "images": ["boot-cm5", image],
        "seed": rng.randrange(1000),
        "seconds": 8,
        "events": [[500, "send", "GO\r"]] + events,
    }


def act(board, verb, what):
    if verb == "send":
        board.send(what)
    elif verb == "rc":
        board.rc(what)
    elif verb == "press":
        (board.press if what[1] else board.release)(what[0].upper())
    elif verb == "power":
        (board.power_on if what else board.power_off)()
    elif verb == "battery":
        board.battery(what)
    elif verb == "push":
        board.servos[what[0]].push_to(what[1])
    elif verb == "fault":
        name, answers = what[1], what[2]
        board.servos[what[0]].fault(name, None if answers < 0 else answers)
    else:
        raise ValueError(verb)


def run_natively(session):
    board = Board(
        images=[f"{name}.hex" for name in session["images"]],
        servos=SERVOS,
        seed=session["seed"],
        motions=(BUILD / "motions" / "motions.bin").read_bytes(),
    )
    board.power_on()
    goals, positions = hashlib.sha256(), hashlib.sha256()
    events = list(session["events"])
    for tick in range(1, session["seconds"] * 128 + 1):
        while events and events[0][0] * 16000 <= (tick - 1) * TICK:
            act(board, *events.pop(0)[1:])
        board.run(cycles=max(0, tick * TICK - board.now_cycles))
        goals.update(struct.pack("<18H", *(board.servos[i].goal for i in SERVOS)))
        positions.update(struct.pack("<18d", *(board.servos[i].position for i in SERVOS)))
    return {
        "console": hashlib.sha256(board.console).hexdigest(),
        "goals": goals.hexdigest(),
        "positions": positions.hexdigest(),
        "flash": hashlib.sha256(bytes(board.flash[0:0x20000])).hexdigest(),
        "eeprom": hashlib.sha256(bytes(board.eeprom[0:0x1000])).hexdigest(),
        "cycles": str(board.now_cycles),
        "busy": str(board.busy_cycles),
    }


@pytest.fixture(scope="module")
def sessions(tmp_path_factory):
    rng = random.Random(SEED)
    made = SESSIONS + [chance(rng, image) for image in ("play-cm5", "edit-cm5")]
    path = tmp_path_factory.mktemp("sessions") / "sessions.json"
    path.write_text(json.dumps(made))
    node = BUILD / "venv" / "bin" / "node"
    with subprocess.Popen([node, HERE / "session" / "node-session.ts", BUILD, path], stdout=subprocess.PIPE, text=True) as running:
        natively = [run_natively(session) for session in made]  # meanwhile, on the other core
        output, _ = running.communicate(timeout=800)
    assert running.returncode == 0
    return made, natively, json.loads(output)


@pytest.mark.parametrize("index", range(len(SESSIONS) + 2))
def test_native_and_webassembly_are_the_same_machine(sessions, index):
    made, natively, in_node = sessions
    assert natively[index] == in_node[index], f"seed {SEED}, {made[index]['name']}"


def test_the_sessions_do_what_they_say(sessions):
    """Else two boards that do nothing would be equal, too."""
    board_a, board_b = SESSIONS
    assert sum(s["seconds"] for s in SESSIONS) == 60
    assert any(e[1] == "rc" for e in board_a["events"]) and any(e[2] == "save\r" for e in board_b["events"])
    results = sessions[2]
    erased = hashlib.sha256(b"\xff" * 0x1000).hexdigest()
    assert results[0]["eeprom"] != erased
    assert len({r["flash"] for r in results[:2]}) == 2
