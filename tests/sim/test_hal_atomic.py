# SPDX-License-Identifier: MIT
"""Data that main loop and interrupts share, with an interrupt at every place: before the first instruction, after the first, and so on to
the last (board_sweep in tools/sim/board/board_debug.h). Program: hal/hal_atomic.c."""

import struct

import pytest

from cm5sim import Board

JOBS = (
    "",
    "tick",
    "clock",
    "counts",
    "tap",
    "eeprom",
    "idle",
    "get",
    "put",
    "flush",
    "retry",
    "flow on",
    "hold",
    "resume",
    "submit",
    "stars",
    "drain",
    "packet",
)
TAP_BYTES, TAPS = 21, 14  # a ring and its 16 bytes; both address bytes of the first and the last tap differ
XON, XOFF = 0x11, 0x13


class Atomic(Board):
    def __init__(self, servos=()):
        super().__init__(images=["tests/hal_atomic.hex"], servos=servos)
        self.run(ms=10)

    def do(self, job, ms=100):
        """Runs one job of the program to its end."""
        self.poke("atomic_job", JOBS.index(job))
        self.run_to("atomic_done", ms=ms)
        self.run(cycles=100)

    def peek(self, name, count=1):
        address = self.variable(name)
        return int.from_bytes(self.ram[address : address + count], "little")

    def poke(self, name, value, count=1):
        address = self.variable(name)
        self.ram[address : address + count] = value.to_bytes(count, "little")

    @property
    def unread(self):
        """Bytes in the console's input ring (ring.h: storage, mask, head, tail)."""
        address = self.variable("line")
        return self.ram[address + 3] - self.ram[address + 4] & 0xFF

    def places(self, function, vector, byte=0):
        """Yields each place of a function in turn; the loop's body must make the function run once. Checks that interrupts were served
        inside the function."""
        self.sweep(function, vector, byte)
        while not self.swept(function).rounds:
            calls = self.swept(function).calls
            yield self.swept(function).place
            assert self.swept(function).calls == calls + 1, f"{function} did not run"
        done = self.swept(function)
        assert done.taken >= 2, f"{done.taken} interrupts in {done.calls} calls of {function}"
        self.end_sweeps()


# ---- time ----


@pytest.mark.parametrize("ticks", [0xFF, 0xFFFF, 0xFFFFFF])
def test_ticks_are_read_whole(ticks):
    board = Atomic()
    for place in board.places("try_tick_now", "tick"):
        board.poke("ticks", ticks, 4)
        board.do("tick")
        assert board.peek("atomic_tick", 4) in (ticks, ticks + 1, ticks + 2), place


@pytest.mark.parametrize("ticks", [0xFF, 0xFFFF])
def test_ticks_are_read_whole_in_16_bits(ticks):
    board = Atomic()
    for place in board.places("try_tick_now16", "tick"):
        board.poke("ticks", ticks, 4)
        board.do("tick")
        assert board.peek("atomic_tick16", 2) in (ticks & 0xFFFF, ticks + 1 & 0xFFFF, ticks + 2 & 0xFFFF), place


def test_a_tick_is_given_once_and_none_is_missed():
    board = Atomic()
    for place in board.places("try_tick_take", "tick"):
        board.poke("ticks", 0x100FF, 4)
        board.poke("taken", 0x00FF, 2)
        board.do("tick")
        assert board.peek("missed", 2) == 0, place
        assert board.peek("taken", 2) in (0xFF, 0x100), place


@pytest.mark.parametrize("before", range(0x12F8, 0x1300))
def test_clock_is_read_whole_while_a_packet_ends(before):
    """The transmit complete interrupt reads the same timer through the same high-byte buffer, which changes meanwhile."""
    board = Atomic()
    for place in board.places("try_clock_now", "bus sent"):
        board.poke("atomic_before", before, 2)
        board.do("clock")
        clock, after = (board.peek(f"atomic_{name}", 2) for name in ("clock", "after"))
        assert before <= clock <= after < 0x1400, place


# ---- bus ----


def bus_counts(board):
    names = ("packets", "answers", "timeouts", "checksums", "framing", "overruns", "wrong_ids", "lengths", "rejected", "retries", "strays")
    address = board.variable("atomic_counts")
    return dict(zip(names, struct.unpack("<IIHHHHHHHHH", board.ram[address : address + 26])))


def test_counts_are_read_whole():
    board = Atomic()
    strays = board.variable("core") + board.peek("atomic_strays_at", 2)
    for place in board.places("try_bus_counts", "bus byte"):
        board.ram[strays : strays + 2] = b"\xff\x00"
        board.do("counts")
        assert bus_counts(board)["strays"] in (0xFF, 0x100), place


def test_a_byte_goes_to_the_old_tap_or_to_the_new_one():
    board = Atomic()
    for place in board.places("try_bus_set_tap", "bus byte", 0x5A):
        board.do("tap")
        old, new = (board.variable("atomic_taps") + at * TAP_BYTES for at in (0, TAPS - 1))
        assert board.ram[old + 3] + board.ram[new + 3] == (board.swept("try_bus_set_tap").last > 0), place


def test_noise_in_the_moment_of_a_retry_spoils_nothing():
    board = Atomic(servos=[1])
    retries = 0
    for byte in (0xFF, 0x00):
        for place in board.places("try_bus_poll", "bus byte", byte):
            board.servos[1].fault("checksum", times=1)
            board.do("retry")
            retries += 1
            assert (board.peek("atomic_status"), board.peek("atomic_params")) == (0, 1), place
            counts = bus_counts(board)
            assert (counts["retries"], counts["checksums"], counts["answers"]) == (retries, retries, retries), place
            assert counts["framing"] == counts["timeouts"] == 0


def test_noise_in_the_moment_of_sending_spoils_nothing():
    board = Atomic(servos=[1])
    for place in board.places("try_bus_submit", "bus byte", 0xFF):
        board.do("submit")
        assert board.peek("atomic_status") == 0, place


def numbered_packet(size):
    """Builds the packet of hal_atomic.c."""
    body = bytes([254, size - 4, 0x55, *range(1, size - 5)])
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


def test_packets_of_every_length_leave_whole():
    """Two bytes at a time; an odd packet starts with a single one."""
    board = Atomic(servos=[1])
    for size in range(6, 144):  # servos accept at most 143
        board.clear_trace()
        board.poke("atomic_byte", size)
        board.do("packet")
        assert board.peek("atomic_status") == 0
        assert [packet for _, packet in board.packets] == [numbered_packet(size)]


@pytest.mark.parametrize("size", [9, 10])
def test_packets_leave_whole_whatever_interrupts_their_first_bytes(size):
    """A byte from the PC and the tick together take longer than a character of the bus."""
    board = Atomic(servos=[1])
    inside = 0
    for place in range(120):
        board.clear_trace()
        board.poke("atomic_byte", size)
        board.poke("atomic_job", JOBS.index("packet"))
        board.run_to("try_bus_send", ms=100)
        for _ in range(place):
            board.step()
        inside += board.ram[board.variable("core")] == 0  # IDLE: not yet submitted
        board.interrupt("console byte", 0x55)
        board.interrupt("tick")
        board.run_to("atomic_done", ms=100)
        board.run(cycles=100)
        assert board.peek("atomic_status") == 0, place
        assert [packet for _, packet in board.packets] == [numbered_packet(size)], place
    assert 10 < inside < 80


# ---- EEPROM ----


@pytest.mark.parametrize("vector", ["tick", "console byte", "bus byte"])
def test_eeprom_write_begins_at_once_or_not_at_all(vector):
    """The chip accepts a write within four cycles; the board model reports a later one (eeprom-sequence)."""
    board = Atomic()
    for place in board.places("try_eeprom_start", vector):
        board.poke("atomic_byte", place & 0x7F)
        board.do("eeprom")
        assert board.eeprom[0x123] == place & 0x7F


# ---- sleep ----


@pytest.mark.parametrize("vector", ["tick", "console byte"])
def test_nothing_slips_in_between_looking_and_sleeping(vector):
    """An event while board_idle() looks for work must not wait for the next tick."""
    board = Atomic()
    for place in board.places("try_board_idle", vector):
        board.do("idle")
        assert board.swept("try_board_idle").last < 1000, place


# ---- console ----


def test_bytes_come_once_and_in_order():
    board = Atomic()
    sent, got = [], []
    for place in board.places("try_console_get", "console byte", 0xC3):
        board.do("get")
        if board.swept("try_console_get").last:
            sent.append(0xC3)
        if board.peek("atomic_got"):
            got.append(board.peek("atomic_byte"))
        board.send(bytes([place & 0x7F]), wait=True)
        board.run(ms=1)
        sent.append(place & 0x7F)
    while board.unread:
        board.do("get")
        got.append(board.peek("atomic_byte"))
    assert got == sent


def test_bytes_leave_once_and_in_order():
    board = Atomic()
    board.take()
    put = bytearray()
    for place in board.places("try_console_put", "console room"):
        board.do("stars")  # one is being sent, one waits, one is in the ring
        board.poke("atomic_byte", place & 0x7F)
        board.do("put")
        assert board.peek("atomic_got") == 1
        put += b"***" + bytes([place & 0x7F])
        board.run(ms=1)
    board.run(ms=40)
    assert board.take() == bytes(put)


def test_flush_waits_for_the_last_stop_bit():
    board = Atomic()
    for place in board.places("try_console_flush", "console room"):
        board.poke("atomic_byte", 0x55)
        board.do("flush")
        assert board.peek("atomic_flushed") == 1, place
        board.run(ms=1)


@pytest.mark.parametrize("job, function", [("get", "try_console_get"), ("resume", "try_console_resume")])
def test_a_sender_is_never_left_waiting(job, function):
    """At the level where XON is due: whatever arrives meanwhile, XON must have been sent when everything has been read."""
    board = Atomic()
    board.do("flow on")
    for place in board.places(function, "console byte", 0x21):
        board.do("hold")
        count = 32 if job == "resume" else 33
        board.send(bytes(count), wait=True)
        board.run(ms=1)
        if job == "get":
            board.do("resume")  # no XON yet: 33 are unread
        board.do(job)
        board.do("drain")
        board.run(ms=2)
        flow = [byte for byte in board.take() if byte in (XON, XOFF)]
        assert flow[-1] == XON, place
