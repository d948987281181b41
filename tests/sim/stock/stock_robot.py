# SPDX-License-Identifier: MIT
"""A robot on the packaged simavr (stock.h), for test_stock.py. Uses nothing of tools/sim."""

import ctypes
import os
import pathlib

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))
CYCLES_PER_MS = 16_000
ABSENT = 0xFFFF


class Frame(ctypes.Structure):
    _fields_ = [("tick", ctypes.c_uint32), ("goals", ctypes.c_uint16 * 32)]


def _library():
    found = ctypes.CDLL(str(BUILD / "host" / "tests" / "sim" / "stock" / "libstock.so"))
    robot, size = ctypes.c_void_p, ctypes.c_size_t
    for name, result, *arguments in (
        ("new", robot, ctypes.POINTER(ctypes.c_char_p), size, ctypes.c_char_p, ctypes.c_uint32),
        ("free", None, robot),
        ("run", ctypes.c_bool, robot, ctypes.c_uint64),
        ("type", None, robot, ctypes.c_char_p, size),
        ("console", size, robot, ctypes.POINTER(ctypes.POINTER(ctypes.c_uint8))),
        ("frames", size, robot, ctypes.POINTER(ctypes.POINTER(Frame))),
        ("flash", ctypes.POINTER(ctypes.c_uint8), robot),
        ("answers", ctypes.c_uint32, robot),
    ):
        function = getattr(found, f"stock_{name}")
        function.restype, function.argtypes = result, arguments
    return found


class StockRobot:
    def __init__(self, images, servos, motions=None):
        files = [os.fsencode(BUILD / "firmware" / image) for image in images]
        self._c = _library()
        self._robot = self._c.stock_new((ctypes.c_char_p * len(files))(*files), len(files), motions, sum(1 << i for i in servos))
        if not self._robot:
            raise FileNotFoundError(f"no Intel HEX file: one of {images} in {BUILD / 'firmware'} (tools/dev/build makes them)")
        self._seen = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._c.stock_free(self._robot)

    def run(self, ms):
        if not self._c.stock_run(self._robot, int(ms * CYCLES_PER_MS)):
            raise AssertionError(f"the processor stopped; it said {self.console[-300:]!r}")

    def _all(self, name, kind):
        """The entries of the library's array and its length, as a list."""
        where = ctypes.POINTER(kind)()
        count = getattr(self._c, f"stock_{name}")(self._robot, ctypes.byref(where))
        return where[:count]

    @property
    def console(self):
        """All output of the robot."""
        return bytes(self._all("console", ctypes.c_uint8))

    @property
    def frames(self):
        """[(tick, {id: goal})] of every SYNC WRITE of goals."""
        return [(frame.tick, {i: goal for i, goal in enumerate(frame.goals) if goal != ABSENT}) for frame in self._all("frames", Frame)]

    @property
    def answers(self):
        return self._c.stock_answers(self._robot)

    def flash(self, start, end):
        return bytes(self._c.stock_flash(self._robot)[start:end])

    def expect(self, text, ms):
        """Runs until the robot prints this text after the previous match."""
        for _ in range(ms // 10):
            at = self.console.find(text, self._seen)
            if at >= 0:
                self._seen = at + len(text)
                return
            self.run(ms=10)
        raise AssertionError(f"{text!r} did not come within {ms} ms, but {self.console[self._seen :]!r}")

    def type(self, text):
        self._c.stock_type(self._robot, text, len(text))

    def ask(self, line, ms=1000):
        self.type(line + b"\r")
        self.expect(b"] ", ms)
