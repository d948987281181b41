# SPDX-License-Identifier: MIT
"""The body in the page falls and walks as the body on the PC: the same scenarios in MuJoCo's WebAssembly (Node) and in Python's
MuJoCo (tools/body), each with its own board and its own way to hang the servos on it. Two releases of MuJoCo on two kinds of
machine do not agree to the bit, and walking is not a stable thing: the same falls, distances to 5 % or 10 mm, headings to
5 degrees, heights to 2 mm."""
import json
import os
import pathlib
import subprocess
import sys

import pytest
from cm5sim import Board

HERE = pathlib.Path(__file__).parent
BUILD = pathlib.Path(os.environ["M512_BUILD"])
sys.path.insert(0, str(HERE.parents[1] / "body" / "src"))
from body.description import load  # noqa: E402
from body.physics import Physics  # noqa: E402

SERVOS = range(1, 19)
TICK = 125000
SCENARIOS = {
    "walks": {"seed": 3, "page": 20, "approachTicks": 500, "ticks": 1280, "send": []},
    "bows": {"seed": 4, "page": 2, "approachTicks": 500, "ticks": 640, "send": []},
    "falls when its torque is cut": {"seed": 5, "page": 1, "approachTicks": 600, "ticks": 512, "send": [[64, "@torque off\r"]]},
}


def natively(scenario):
    board = Board(images=["boot-cm5.hex", "play-cm5.hex"], servos=SERVOS, seed=scenario["seed"],
                  motions=(BUILD / "motions" / "motions.bin").read_bytes())
    board.eeprom[4095:4096] = b"\x11"
    start = 3 * 128 + scenario["approachTicks"]

    def to(tick):
        board.run(cycles=max(0, tick * TICK - board.now_cycles))
    to(3 * 128)
    board.send(f"@play {scenario['page']}\r")
    to(start)
    physics = Physics(load("humanoid"))
    physics.stand({servo: board.servos[servo].position for servo in SERVOS})
    board.attach(physics)
    x, y = physics.x_mm, physics.y_mm
    fallen = False
    for tick in range(1, scenario["ticks"] + 1):
        for at, text in scenario["send"]:
            if at == tick:
                board.send(text)
        to(start + tick)
        fallen = fallen or physics.upright < 0.55
    return {"x": physics.x_mm - x, "y": physics.y_mm - y, "heading": physics.heading, "fallen": fallen, "height": physics.z_mm}


@pytest.fixture(scope="module")
def in_node(tmp_path_factory):
    path = tmp_path_factory.mktemp("physics") / "scenarios.json"
    path.write_text(json.dumps(list(SCENARIOS.values())))
    node = BUILD / "venv" / "bin" / "node"
    done = subprocess.run([node, HERE / "session" / "node-physics.ts", BUILD, path], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return dict(zip(SCENARIOS, json.loads(done.stdout)))


@pytest.mark.parametrize("name", SCENARIOS)
def test_same_falls_and_distances(in_node, name):
    here, there = natively(SCENARIOS[name]), in_node[name]
    print(here, there)
    assert here["fallen"] == there["fallen"] == name.startswith("falls")
    if not here["fallen"]:
        for way in ("x", "y"):
            assert there[way] == pytest.approx(here[way], rel=0.05, abs=10)
        assert there["heading"] == pytest.approx(here["heading"], abs=5)
        assert there["height"] == pytest.approx(here["height"], abs=2)
