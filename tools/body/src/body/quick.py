# SPDX-License-Identifier: MIT
"""The robot without its chip (tools/sim/quick): the firmware's player in C, virtual servos and a body."""

import ctypes
import functools
import os
import pathlib

TOP = pathlib.Path(__file__).resolve().parents[4]
LAWS = {"exact": 0, "classic": 1}
STATUS = ("", "page 0 or above 127", "a damaged page", "a page without action", "a play is on", "no such law")
IMAGE_BYTES = 128 * 512
P, I, D = ctypes.c_void_p, ctypes.c_int, ctypes.c_double


class Load(ctypes.Structure):
    """quick_load_t"""

    _fields_ = [(name, D) for name in ("torque_nm", "torque2_nm2", "most_degrees_c", "most_units_per_tick")]


class Body(ctypes.Structure):
    """servo_body_t"""

    _fields_ = [("context", P), ("look", P), ("step", P)]


_FUNCTIONS = {
    "quick_new": (P, ctypes.c_char_p),
    "quick_free": (None, P),
    "quick_bus": (P, P),
    "quick_now": (ctypes.c_uint64, P),
    "quick_torque_on": (None, P),
    "quick_start": (I, P, ctypes.c_uint8, I),
    "quick_keys": (None, P, ctypes.c_uint8),
    "quick_run": (ctypes.c_bool, P, ctypes.c_uint32),
    "quick_page": (I, P),
    "quick_step": (I, P),
    "quick_fault": (I, P),
    "quick_goal": (I, P, ctypes.c_uint8),
    "quick_load": (Load, P, I),
    "servo_mujoco_body": (Body, P),
    "servo_bus_add": (P, P, ctypes.c_uint8, I, ctypes.c_uint32),
    "servo_bus_body": (None, P, ctypes.c_uint64, P),
    "servo_bus_supply": (None, P, ctypes.c_uint64, D),
    "servo_api_model": (I, ctypes.c_char_p),
}


@functools.cache
def library():
    """Returns the library with its functions declared. Built by: cmake --build build/host --target m512quick."""
    path = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build")) / "host" / "tools" / "sim" / "libm512quick.so"
    if not path.exists():
        raise FileNotFoundError(f"{path} is missing: build target m512quick of the host preset first")
    lib = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _FUNCTIONS.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments
    return lib


class Quick:
    """A robot that plays pages of an image in a body. models: {servo: "ax12" | "ax18" | "dx117"}; the others are AX-12."""

    def __init__(self, image, physics, models=None):
        self._pointer = None  # first, because __del__ also runs when there is no library
        self._lib = library()
        if len(image) != IMAGE_BYTES:
            raise ValueError(f"a motion image has {IMAGE_BYTES} bytes, not {len(image)}")
        self._pointer = self._lib.quick_new(bytes(image))
        if not self._pointer:
            raise MemoryError("no memory for a robot")
        self.physics, self._bus = physics, self._lib.quick_bus(self._pointer)
        self.servos = physics.robot.servos
        models = models or {}
        for servo in models:
            if servo not in self.servos:
                raise ValueError(f"this body has no servo {servo}")
        for servo in self.servos:
            name = models.get(servo, "ax12")
            model = self._lib.servo_api_model(name.encode())
            if model < 0:
                raise ValueError(f"no servo model is called {name!r}: ax12, ax18, dx117")
            self._lib.servo_bus_add(self._bus, servo, model, 1_000_000)
        self._lib.servo_bus_supply(self._bus, 0, physics.variation.volts)
        self._body = self._lib.servo_mujoco_body(ctypes.addressof(physics.seam))
        self.look()

    def __del__(self):
        if self._pointer:
            self._lib.quick_free(self._pointer)

    def look(self):
        """Updates the servos after the body was moved."""
        self._lib.servo_bus_body(self._bus, self._lib.quick_now(self._pointer), ctypes.addressof(self._body))

    def torque_on(self):
        self._lib.quick_torque_on(self._pointer)

    def start(self, page, law="exact"):
        status = self._lib.quick_start(self._pointer, page, LAWS[law])
        if status:
            raise ValueError(f"page {page} cannot be played: {STATUS[status]}")

    def keys(self, code):
        """Holds these keys of the remote from now on. 0: released, 255: stop."""
        self._lib.quick_keys(self._pointer, code)

    def run(self, ticks):
        """Runs this many ticks of 1/128 s. Returns True while a play runs."""
        return self._lib.quick_run(self._pointer, ticks)

    @property
    def page(self):
        return self._lib.quick_page(self._pointer)

    @property
    def step(self):
        return self._lib.quick_step(self._pointer)

    def goal(self, servo):
        return self._lib.quick_goal(self._pointer, servo)

    def loads(self):
        """{servo: Load} since the start of the play."""
        return {servo: self._lib.quick_load(self._pointer, index) for index, servo in enumerate(self.servos)}
