# SPDX-License-Identifier: MIT
"""How much faster than the robot the native board walks, without a body and with MuJoCo: the yardstick for the page's."""

import pathlib
import time

from body.description import load
from body.physics import Physics
from cm5sim import Board

SECONDS = 20
motions = (pathlib.Path(__file__).resolve().parents[4] / "build" / "motions" / "motions.bin").read_bytes()


def walk(with_body):
    board = Board(images=["boot-cm5.hex", "play-cm5.hex"], servos=range(1, 19), motions=motions, seed=1)
    board.eeprom[4095:4096] = b"\x11"
    board.run(ms=3000)
    board.send("@play 20\r")
    board.run(ms=4000)
    if with_body:
        physics = Physics(load("humanoid"))
        physics.stand({servo: board.servos[servo].position for servo in range(1, 19)})
        board.attach(physics)
    start = time.process_time()
    board.run(ms=1000 * SECONDS)
    ratio = SECONDS / (time.process_time() - start)
    print(f"walking, native board, {'body in MuJoCo' if with_body else 'no body       '}     {ratio:6.1f} x real time", flush=True)


walk(False)
walk(True)
