# SPDX-License-Identifier: MIT
"""cm5sim --body: a MuJoCo body on the servo shafts. Reports on standard error when the robot is put down, when it falls, and at the end
where it is and how it stands."""

from __future__ import annotations

import ctypes
import sys
import time
import warnings
from collections.abc import Callable, Collection
from typing import Any

from . import library
from .board import Board

if library.ROBOT.exists():
    sys.path.append(str(library.ROBOT / "tools" / "body" / "src"))  # the wheel contains the package `body` and its files

LOOK_EVERY = 8  # steps of 1/1024 s
FRAME_S = 1 / 60
HEAD = frozenset({19, 20})  # servos that a body has only if they are plugged in
STEP = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int)


class Watch:
    """Steps the body, watches it and shows it."""

    def __init__(self, name: str, view: bool, ids: Collection[int] = ()) -> None:
        """ids: of the servos that are plugged in. OSError, with a text for the user: no such body, no MuJoCo, or no display."""
        try:
            from body.description import BodyError, load
            from body.hand import Hand
            from body.physics import Physics
        except ModuleNotFoundError as missing:
            raise OSError(f"--body: {missing}; run: tools/dev/setup demo test physics, or pip install mujoco") from None
        try:
            self._physics = Physics(load(name, head=not HEAD.isdisjoint(ids)))
            self._hand = Hand(self._physics)
            self._view = _open_view(self._physics) if view else None
        except (BodyError, ValueError, RuntimeError) as error:
            raise OSError(f"body: {error}") from None
        self._count, self._shown = 0, 0.0

    def attach(self, board: Board, say: Callable[[str], None]) -> None:
        """say: prints a line for the user."""
        lib, self._print = library.load(), say
        inner = lib.servo_mujoco_body(ctypes.addressof(self._physics.seam))
        self._inner_step = STEP(inner.step)
        self._step = STEP(self._one_step)  # keeps the callback alive while the board runs
        seam = library.ServoBody(inner.context, inner.look, ctypes.cast(self._step, ctypes.c_void_p))
        lib.board_body(board._pointer, seam)

    def _say(self, text: str) -> None:
        self._print(f"body: {text}")

    def _one_step(self, context: int, shafts: int, count: int) -> None:
        self._inner_step(context, shafts, count)
        self._count += 1
        if self._count % LOOK_EVERY == 0:
            what = self._hand.look()
            if what == "down":
                self._say(f"{self._physics.time_s:.2f} s: put down on its soles")
            elif what == "fell":
                self._say(f"{self._physics.time_s:.2f} s: fell")
            if self._view and self._view.is_running() and time.monotonic() - self._shown > FRAME_S:
                self._view.sync()
                self._shown = time.monotonic()

    def report(self) -> None:
        """Call this after the end of the board's run."""
        from body.trial import stands

        physics, hand = self._physics, self._hand
        if hand.put_down_s is None:
            self._say("the hand held it to the end: it puts the robot down when its knees have been driven and all joints stand still. Play "
                      "`ready` and let it end")  # fmt: skip
        else:
            how = "stands" if stands(physics) else "lies" if physics.upright < 0.5 else "does not stand on its soles alone"
            self._say(f"{hand.falls} falls; {physics.x_mm:.0f} mm forward, {physics.y_mm:.0f} to the left, heading "
                      f"{physics.heading:.0f} degrees in {physics.time_s - hand.put_down_s:.1f} s; {how}")  # fmt: skip
        if self._view:
            self._view.close()


def _open_view(physics: Any) -> Any:
    """Opens MuJoCo's viewer. RuntimeError: no display. (The viewer itself would end the process without our message.)"""
    import glfw
    import mujoco.viewer

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if not glfw.init():
            raise RuntimeError("--view needs a display, and none answers here (DISPLAY, WAYLAND_DISPLAY). Without --view falls, way and "
                               "heading are told all the same")  # fmt: skip
    return mujoco.viewer.launch_passive(physics.model, physics.data, show_left_ui=False, show_right_ui=False)
