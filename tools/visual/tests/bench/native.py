# SPDX-License-Identifier: MIT
"""How much faster than the robot the native board walks: the yardstick for the page's."""
import os
import pathlib
import time

from cm5sim import Board

motions = (pathlib.Path(os.environ["M512_BUILD"]) / "motions" / "motions.bin").read_bytes()
board = Board(images=["boot-cm5.hex", "play-cm5.hex"], servos=range(1, 19), motions=motions, seed=1)
board.eeprom[4095:4096] = b"\x11"
board.run(ms=3000)
board.send("@play 20\r")
board.run(ms=4000)
start = time.process_time()
board.run(ms=20000)
print(f"walking, native board, no body            {20 / (time.process_time() - start):6.1f} x real time")
