# SPDX-License-Identifier: MIT
"""Finds libcm5sim.so and declares its C interface (board.h) as ctypes functions."""

import ctypes
import functools
import os
import pathlib
from typing import Any

CYCLES_PER_MS = 16000
HERE = pathlib.Path(__file__).resolve().parent
ROBOT = HERE / "robot"  # in a wheel: the files from the build tree in the same folders (setup.py), and lib/


def build_folder() -> pathlib.Path:
    """The build tree: environment M512_BUILD, the one in the wheel, or build/ of the repository this file is in."""
    given = os.environ.get("M512_BUILD")
    return pathlib.Path(given) if given else ROBOT if ROBOT.exists() else HERE.parents[3] / "build"


class ViolationRecord(ctypes.Structure):
    _fields_ = [
        ("kind", ctypes.c_int),
        ("cycle", ctypes.c_uint64),
        ("pc", ctypes.c_uint32),
        ("function", ctypes.c_char * 64),
        ("text", ctypes.c_char * 192),
    ]


class UartCounts(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64) for name in ("sent", "received", "overruns", "framing", "deaf")]


class TracePacket(ctypes.Structure):
    _fields_ = [("cycle", ctypes.c_uint64), ("count", ctypes.c_uint8), ("bytes", ctypes.c_uint8 * 143)]


class ProbeResult(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint64) for name in ("calls", "total_max", "total_sum", "own_max", "own_sum", "last_total", "last_own", "max_at")]


class ServoBody(ctypes.Structure):
    """servo_body_t: the body that the shafts move."""

    _fields_ = [("context", ctypes.c_void_p), ("look", ctypes.c_void_p), ("step", ctypes.c_void_p)]


class SweepResult(ctypes.Structure):
    _fields_ = [
        ("place", ctypes.c_uint32),
        ("calls", ctypes.c_uint64),
        ("rounds", ctypes.c_uint64),
        ("taken", ctypes.c_uint64),
        ("last", ctypes.c_uint64),
    ]


P, I, B, S, D = ctypes.c_void_p, ctypes.c_int, ctypes.c_bool, ctypes.c_char_p, ctypes.c_double
U8, U16, U32, U64, Z = ctypes.c_uint8, ctypes.c_uint16, ctypes.c_uint32, ctypes.c_uint64, ctypes.c_size_t
SIZE = ctypes.POINTER(Z)
BYTE_HEARD = ctypes.CFUNCTYPE(None, P, U64, U8, U32, B)
OPERATION_DONE = ctypes.CFUNCTYPE(None, P, U64, I, U32)
_FUNCTIONS: dict[str, tuple[Any, ...]] = {  # name: result, arguments...
    # board.h
    "board_new": (P, I, U32),
    "board_free": (None, P),
    "board_load": (B, P, S, U32),
    "board_error": (S, P),
    "board_set_bootrst": (None, P, B),
    "board_power_on": (None, P),
    "board_power_off": (None, P),
    "board_is_powered": (B, P),
    "board_brown_out": (None, P),
    "board_hold_reset": (None, P, B),
    "board_resets": (U32, P),
    "board_reset_cause": (I, P),
    "board_run": (I, P, U64),
    "board_stop": (None, P),
    "board_now": (U64, P),
    "board_busy_cycles": (U64, P),
    "board_stop_on_text": (None, P, S),
    "board_stop_at": (None, P, U32),
    "board_violation": (ctypes.POINTER(ViolationRecord), P),
    "board_clear_violation": (None, P),
    "board_allow": (None, P, I, B),
    "board_violations": (U32, P, I),
    "violation_name": (S, I),
    "violation_find": (I, S),
    # board_ports.h
    "board_console_rate": (None, P, U32),
    "board_console_send": (None, P, I, S, Z),
    "board_console_pause": (None, P, U64),
    "board_console_waiting": (Z, P),
    "board_console_flush": (None, P),
    "board_console_output": (P, P, SIZE),
    "board_servo_bus": (P, P),
    "board_trace_start": (None, P),
    "board_trace": (ctypes.POINTER(TracePacket), P, SIZE),
    "board_body": (None, P, ctypes.POINTER(ServoBody)),
    "board_bus_turn": (U64, P, B),
    "board_bus_pause": (U64, P, B),
    "board_uart_counts": (None, P, I, ctypes.POINTER(UartCounts)),
    "board_press": (None, P, I, B),
    "board_set_bounce": (None, P, U64),
    "board_leds": (U8, P),
    "board_pin": (I, P, ctypes.c_char, I),
    "board_battery": (None, P, D),
    # board_memory.h
    "board_flash_read": (Z, P, U32, P, Z),
    "board_flash_write": (Z, P, U32, P, Z),
    "board_eeprom_read": (Z, P, U32, P, Z),
    "board_eeprom_write": (Z, P, U32, P, Z),
    "board_ram_read": (Z, P, U32, P, Z),
    "board_ram_write": (Z, P, U32, P, Z),
    "board_set_lock": (None, P, U8),
    "board_set_fuses": (None, P, U8, U8, U8),
    "board_flash_wear": (U32, P, U32),
    "board_eeprom_wear": (U32, P, U32),
    "board_operations": (U64, P),
    "board_age_flash": (None, P, U32, U32),
    "board_age_eeprom": (None, P, U32, U32),
    "board_operation": (B, P, U64, ctypes.POINTER(I), ctypes.POINTER(U32)),
    "board_cut_power": (None, P, U64, I, U32),
    "board_cut_power_at": (None, P, U64),
    "board_on_operation": (None, P, OPERATION_DONE, P),
    # board_debug.h
    "board_function": (U32, P, S),
    "board_variable": (U32, P, S),
    "board_function_at": (S, P, U32),
    "board_pc": (U32, P),
    "board_stack_low": (U32, P),
    "board_stack_headroom": (U32, P),
    "board_probe": (B, P, S),
    "board_probe_result": (ctypes.POINTER(ProbeResult), P, S),
    "board_probe_clear": (None, P),
    "board_interrupt_count": (U64, P, I),
    "board_interrupt_max": (U64, P, I),
    "board_interrupt": (B, P, I, U8),
    "board_sweep": (B, P, S, I, U8),
    "board_sweep_result": (ctypes.POINTER(SweepResult), P, S),
    "board_sweep_end": (None, P),
    "board_skip_waits": (None, P, B),
    "board_step": (U32, P),
    "board_gdb": (B, P, I, B),
    # the servos
    "servo_api_count": (I, P),
    "servo_api_at": (P, P, I),
    "servo_api_id": (U8, P),
    "servo_api_get": (U16, P, U64, U8, U8),
    "servo_api_write": (U8, P, U64, U8, S, U8),
    "servo_api_alarms": (U8, P, U64),
    "servo_api_state": (D, P, U64, I),
    "servo_api_set_state": (None, P, U64, I, D),
    "servo_api_counter": (U32, P, I),
    "servo_api_fault": (B, P, U64, P, S, U32),
    "servo_api_clear": (None, P, U64, P),
    "servo_api_model": (I, S),
    "servo_api_restore": (None, P, S),
    "servo_api_row": (None, P, U64, I, ctypes.POINTER(D)),
    "servo_api_listen": (None, P, BYTE_HEARD),
    "servo_api_next_cycles": (U64, P),
    "servo_bus_new": (P,),
    "servo_bus_free": (None, P),
    "servo_bus_advance": (None, P, U64),
    "servo_bus_host_byte": (None, P, U64, U8, U32),
    "servo_bus_add": (P, P, U8, I, U32),
    "servo_bus_find": (P, P, U8),
    "servo_bus_noise": (None, P, U64, S, U8, U32),
    "servo_push_to": (None, P, U64, D),
    "servo_mujoco_body": (ServoBody, P),
}


@functools.cache
def load() -> ctypes.CDLL:
    """Returns the library with its functions declared. Built by: cmake --build build/host --target cm5sim_shared."""
    path = build_folder() / "host" / "tools" / "sim" / "libcm5sim.so"
    if not path.exists():
        raise FileNotFoundError(f"{path} is missing; in the source tree tools/dev/build makes it")
    for needed in sorted(path for path in (ROBOT / "lib").glob("*.so*") if path.suffix != ".copyright"):
        ctypes.CDLL(str(needed), mode=ctypes.RTLD_GLOBAL)
    lib = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _FUNCTIONS.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments
    return lib
