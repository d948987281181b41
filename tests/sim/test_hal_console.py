# SPDX-License-Identifier: MIT
"""The serial line to the PC on the simulated board: no loss at the full rate, flow control, changes of rate."""

from m512.crc16 import crc16
from tests.sim.hal_board import LINE_BYTES_PER_S, bus_counts, pattern, walker, word, words


def test_flood_at_line_rate_beside_31_joints_loses_nothing():
    board = walker()
    data = pattern(int(3 * LINE_BYTES_PER_S))
    before = bus_counts(board)
    board.send(data, wait=True)
    board.run(ms=50)
    assert word(board, "walker_bytes", 4) == len(data)
    assert word(board, "walker_crc") == crc16(data)
    assert board.uart(1).overruns == 0
    assert word(board, "walker_missed") == 0
    counts = bus_counts(board)
    assert counts["answers"] - before["answers"] >= 375
    for name in ("timeouts", "checksums", "framing", "overruns", "wrong_ids", "lengths", "retries", "strays"):
        assert counts[name] == before[name], counts


def test_flow_control_stops_a_sender_in_time():
    """The program reads 4,000 bytes/s, the line carries 5,714: XOFF must come early enough for a PC that sends 64 more bytes."""
    board = words()
    board.send("x", wait=True)
    data = pattern(6000, seed=7)
    at, heard, stopped_at, stops = 0, 0, None, 0
    while at < len(data):
        assert board.now_ms < 10_000, "the sender waits for an XON that does not come"
        board.run(ms=1)
        output = board.console[heard:]
        heard += len(output)
        for byte in output:
            if byte == 0x13 and stopped_at is None:
                stopped_at, stops = at, stops + 1
            elif byte == 0x11:
                stopped_at = None
        if stopped_at is None or at < stopped_at + 64:
            board.send(data[at : at + 6])
            at += 6
    assert board.take().replace(b"\x11", b"").replace(b"\x13", b"") == b" 00000000\n"  # the end of "start"
    board.expect("took ", ms=3000)
    assert board.expect("\n") == f"{6000:08X} {crc16(data):08X}\n"
    assert stops > 3
    assert board.uart(1).overruns == 0


def test_hold_keeps_the_pc_silent():
    board = words()
    board.send("h")
    board.expect("\x13")
    held = board.now_ms
    board.expect("\x11", ms=300)
    assert board.now_ms - held >= 99
    board.expect("held")


def test_rate_changes_behind_the_last_stop_bit():
    board = words()
    board.send("b", wait=True)
    board.expect("slow\n")
    board.baud(117_647)
    board.expect("fast\n")
    board.send("v")
    board.expect("adc ")
    assert board.uart(1).framing == 0
