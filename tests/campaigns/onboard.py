# SPDX-License-Identifier: MIT
"""One motion on one body, driven by the shipped image on the simulated board: trial.py with the chip, the bus and the console.

    outcome = try_on_board(image, page=20, seconds=12, ready=1)

The robot plays `ready` while held, is put on its soles, then plays. Runs about eight times faster than real time.
"""

from body.chance import NOMINAL
from body.description import Description, load
from body.hand import Hand
from body.physics import Physics
from body.trial import STOP, watch
from cm5sim import Board

BOOT_MS, HAND_TICKS, APPROACH_MS = 4000, 128 * 12, 12000
KEYS_EVERY_TICKS = 4  # a remote repeats its packet while keys are held


class OnBoard:
    """A board with Play, and a body on its servos. Has the interface of quick.Quick, for trial.watch()."""

    def __init__(self, image, physics, models=None, firmware="play-cm5.hex", seed=1):
        self.physics, self._code, self._said = physics, None, b""
        self.board = Board(images=[firmware], motions=image, seed=seed)
        for servo in physics.robot.servos:
            self.board.servos.add(servo, (models or {}).get(servo, "ax12"))
        self.board.battery(physics.variation.volts)
        self.hand = Hand(physics)
        self.board.attach(physics)
        self.board.expect("] ", ms=BOOT_MS)

    def stand_up(self, page):
        """Plays a page while held, then stands on its soles when that page ends."""
        self.board.send(f"play {page}\r")
        for _ in range(HAND_TICKS):
            self.board.run(ticks=1)
            if self.hand.look() == "down":
                self.board.attach(self.physics)
                break
        else:
            raise RuntimeError(f"page {page} did not bring the robot to a stand in the hand")
        self.board.expect("Ended after", ms=APPROACH_MS)
        self.board.run(ms=250)

    def start(self, page):
        """Starts the page; returns when the approach is over."""
        self.board.send(f"play {page}\r")
        self.board.expect("Playing page", ms=APPROACH_MS)
        self._playing, self._said = True, b""

    def keys(self, code):
        if code == STOP:
            self.board.send("stop\r")
            self._code = None
        else:
            self._code = code

    def run(self, ticks):
        for _ in range(0, ticks, KEYS_EVERY_TICKS):
            if self._code is not None:
                self.board.rc(self._code)
                self._code = self._code or None  # a release is sent once
            self.board.run(ticks=min(ticks, KEYS_EVERY_TICKS))
        self._said += self.board.take()  # a line may come in two pieces
        self._playing = self._playing and b"Ended after" not in self._said and b"Stopped after" not in self._said
        return self._playing

    def loads(self):
        return {}


def try_on_board(image, page, seconds, ready, robot="humanoid", variation=NOMINAL, keys=(), models=None, falls=True):
    """Like trial.try_motion(), with the exact law. ready: the page that brings the robot to its feet first."""
    robot = robot if isinstance(robot, Description) else load(str(robot))
    player = OnBoard(image, Physics(robot, variation), models)
    player.stand_up(ready)
    player.start(page)
    return watch(player, player.physics, seconds, keys, falls)
