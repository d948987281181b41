# SPDX-License-Identifier: MIT
"""The C player (played.c) in Python: one play at a time, tick by tick."""

import ctypes
import os
import pathlib

TOP = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
EXACT, CLASSIC = 0, 1
JOINTS = 31
OUTPUT, STEP, PAGE, LINK, ENDED, STOPPED = 1, 2, 4, 8, 32, 64  # PLAYER_EV_ bits
GOALS = ctypes.c_uint16 * JOINTS

library = ctypes.CDLL(str(BUILD / "host" / "tests" / "models" / "libplayed.so"))
library.played_goals.restype = ctypes.POINTER(ctypes.c_uint16)
library.played_start.argtypes = (ctypes.c_int, ctypes.c_int, ctypes.c_uint32, GOALS)
library.played_layer.argtypes = (ctypes.c_int, ctypes.c_uint32, ctypes.c_int)
library.played_amplitude.argtypes = (ctypes.c_int, ctypes.c_uint32)


class Played:
    """A play of `page` of a motion area. `codes` arrive before it starts. started: whether it began (player_status_t 0)."""

    def __init__(self, image, page, law, joints=0x7FFFFFFF, positions=None, call=0, codes=(), shape=()):
        library.played_load(bytes(image))
        for name, *values in shape:
            self.shape(name, *values)
        pose = GOALS(*((positions or {}).get(i, 512) for i in range(JOINTS)))
        library.played_call(call)
        for code in codes:
            self.code(code)
        self.status = library.played_start(law, page, joints, pose)
        self.started = self.status == 0

    @staticmethod
    def shape(name, *values):
        """Takes rate PERCENT, amplitude PERCENT JOINTS, blend PERCENT, centre PAGE, voltage DECIVOLTS or reset."""
        getattr(library, f"played_{name}")(*values)

    @staticmethod
    def code(code):
        library.played_code(code)

    @staticmethod
    def tick():
        """Plays one tick. Returns its PLAYER_EV_ bits."""
        return library.played_tick()

    @staticmethod
    def goals():
        return library.played_goals()[:JOINTS]
