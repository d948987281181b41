# SPDX-License-Identifier: MIT
"""cm5sim --body NAME: the command cm5sim with a body in MuJoCo on its servos' shafts. Started by cm5sim itself:

    with_body.py BODY view|tell ARGUMENT...        the arguments are those of cm5sim, as they were typed

Tells on standard error when the robot is put down, when it falls, and at the end where it went and how it stands."""

import ctypes
import os
import pathlib
import sys
import time
import warnings

TOP = pathlib.Path(__file__).resolve().parents[3]
EXIT_USAGE, EXIT_FILE = 2, 4
LOOK_EVERY = 8  # steps of 1/1024 s
FRAME_S = 1 / 60

try:
    from body.description import BodyError, load
    from body.hand import Hand
    from body.physics import Physics
    from body.quick import Body
    from body.trial import stands
except ModuleNotFoundError as missing:
    print(f"cm5sim: --body: {missing}; run: tools/dev/setup demo test physics", file=sys.stderr)
    sys.exit(EXIT_FILE)

STEP = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int)


def library():
    build = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
    lib = ctypes.CDLL(str(build / "host" / "tools" / "sim" / "libcm5sim_body.so"))
    lib.servo_mujoco_body.restype, lib.servo_mujoco_body.argtypes = Body, [ctypes.c_void_p]
    lib.cm5sim_run.restype = ctypes.c_int
    lib.cm5sim_run.argtypes = [ctypes.c_int, ctypes.POINTER(ctypes.c_char_p), ctypes.POINTER(Body)]
    lib.keys_are_raw.restype, lib.keys_are_raw.argtypes = ctypes.c_bool, []
    return lib


class Watch:
    """Steps the body, looks at it, and shows it."""

    def __init__(self, lib, physics, view):
        self.physics, self.hand, self.view, self._lib = physics, Hand(physics), view, lib
        inner = lib.servo_mujoco_body(ctypes.addressof(physics.seam))
        self._inner_step = STEP(inner.step)
        self._step = STEP(self.step)  # kept alive as long as the board runs
        self.body = Body(inner.context, inner.look, ctypes.cast(self._step, ctypes.c_void_p))
        self._count, self._shown = 0, 0.0

    def step(self, context, shafts, count):
        self._inner_step(context, shafts, count)
        self._count += 1
        if self._count % LOOK_EVERY == 0:
            what = self.hand.look()
            if what == "down":
                self._say(f"{self.physics.time_s:.2f} s: put down on its soles")
            elif what == "fell":
                self._say(f"{self.physics.time_s:.2f} s: fell")
            self._show()

    def _say(self, text):
        """Prints a line while the board runs: a terminal in raw mode needs CR LF."""
        say(text, "\r\n" if self._lib.keys_are_raw() else "\n")

    def _show(self):
        if self.view and self.view.is_running() and time.monotonic() - self._shown > FRAME_S:
            self.view.sync()
            self._shown = time.monotonic()

    def report(self):
        physics = self.physics
        if self.hand.put_down_s is None:
            say(
                "the hand held it to the end: it puts the robot down when its knees have been driven and all joints stand still. Play "
                "`ready` and let it end"
            )
            return
        how = "stands" if stands(physics) else "lies" if physics.upright < 0.5 else "does not stand on its soles alone"
        say(
            f"{self.hand.falls} falls; {physics.x_mm:.0f} mm forward, {physics.y_mm:.0f} to the left, heading "
            f"{physics.heading:.0f} degrees in {physics.time_s - self.hand.put_down_s:.1f} s; {how}"
        )


def say(text, end="\n"):
    print(f"cm5sim: body: {text}", file=sys.stderr, end=end, flush=True)


def open_view(physics):
    """MuJoCo's viewer. OSError: there is no display (the viewer itself would end the process without a word of ours)."""
    import glfw
    import mujoco.viewer

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if not glfw.init():
            raise OSError(
                "--view needs a display, and none answers here (DISPLAY, WAYLAND_DISPLAY). Without --view falls, way and heading "
                "are told all the same"
            )
    return mujoco.viewer.launch_passive(physics.model, physics.data, show_left_ui=False, show_right_ui=False)


def main():
    name, show, *arguments = sys.argv[1:]
    try:
        physics = Physics(load(name))
        lib = library()
        watch = Watch(lib, physics, open_view(physics) if show == "view" else None)
    except (BodyError, ValueError, OSError, RuntimeError) as error:
        say(error)
        return EXIT_FILE
    words = [b"cm5sim", *map(os.fsencode, arguments)]
    code = lib.cm5sim_run(len(words), (ctypes.c_char_p * (len(words) + 1))(*words, None), watch.body)
    watch.report()
    if watch.view:
        watch.view.close()
    return code


if __name__ == "__main__":
    sys.exit(main())
