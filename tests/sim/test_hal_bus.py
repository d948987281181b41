# SPDX-License-Identifier: MIT
"""The bus on the simulated board: cycles of a frame, half duplex, pauses in packets, servos that are deaf to SYNC WRITE."""

import pytest

from cm5sim import Board
from tests.sim.hal_board import LINE_BYTES_PER_S, bus_counts, pattern, walker, word


def test_bus_begins_at_1_mbps():
    board = Board(images=["tests/hal_words.hex"], servos=[1])
    board.expect("start")
    board.send("i")
    board.expect("ping 00000000", ms=100)


def test_frame_of_31_joints_is_one_packet_a_tick_in_under_10000_cycles(capsys):
    board = walker()
    board.run(ms=100)
    board.clear_trace()
    board.probe("servo_link_goals", "__vector_18", "__vector_20")
    board.run(ticks=128)
    frames = board.trace
    assert len(frames) in (127, 128, 129)
    assert all(len(frame.goals) == 31 for frame in frames)
    build = board.cycles("servo_link_goals").max
    # Each interrupt: its own cycles, 4 of response and 3 of the vector's jump. An interrupt sends two bytes, the last one turns the line
    # round: 51 for the goals of 31 joints. The packet that polls a servo needs 4 more, which are not in the sum.
    sent, heard = (board.cycles(name).total_mean + 7 for name in ("__vector_20", "__vector_18"))
    assert board.cycles("__vector_20").count / len(frames) == pytest.approx(51 + 4, abs=0.6)
    total = build + 51 * sent
    with capsys.disabled():
        print(f"\nhal: frame of 31 joints: build {build}, send 51 x {sent:.1f}, in all {total:.0f} cycles; a byte heard {heard:.0f}")
    assert total <= 10_000
    assert heard < 160


@pytest.mark.parametrize("kind, return_delay", [("cm5", 0), ("cm5", 254), ("cm2", 0)])
def test_turn_round_loses_no_answer(kind, return_delay):
    """With a return delay of 0 a servo answers within 20 us after our last stop bit."""
    board = walker(kind, servos=range(1, 19), table=[(5, return_delay)])
    before = bus_counts(board)
    board.run(ticks=250)
    counts = bus_counts(board)
    assert counts["answers"] - before["answers"] >= 248
    assert all(counts[name] == 0 for name in ("checksums", "framing", "overruns", "wrong_ids", "lengths", "strays")), counts
    assert counts["timeouts"] == before["timeouts"]


BUS_TURNING = 2  # bus_core.h
INTERRUPT_INSTRUCTIONS = 80  # of the transmit interrupt: it takes 82 cycles
TURN_US = 20  # DYNAMIXEL.md: with a return delay of 0 an answer begins within about 20 us


def test_turn_round_is_bounded_whatever_else_interrupts(capsys):
    """The tick, bytes of the PC in both directions and locks of the program can all delay it. First two seconds of all of them at the full
    rate. Then on purpose: a byte from the PC at every place of the interrupt that ends a packet, together with the tick."""
    board = walker()
    board.bus_turn_us(forget=True)
    board.send(pattern(int(2 * LINE_BYTES_PER_S)), wait=True)
    flooded = board.bus_turn_us(forget=True)
    longest = 0
    state = board.variable("core")
    for place in range(0, 480, 13):
        while board.ram[state] != BUS_TURNING:  # a packet is sent, except for its last two bytes
            board.run_to("__vector_20", ms=20)
            for _ in range(INTERRUPT_INSTRUCTIONS):
                if board.ram[state] != BUS_TURNING:
                    board.step()
        board.run(cycles=480 - place)
        board.interrupt("console byte", 0x55)
        board.run(cycles=20)  # its interrupt has begun: the tick's has priority over the bus's
        board.interrupt("tick")
        board.run(ms=3)
        longest = max(longest, board.bus_turn_us(forget=True))
    with capsys.disabled():
        print(f"\nhal: turning the bus round: at most {flooded:.1f} us in a flood, {longest:.1f} us on purpose")
    assert 5 < flooded <= TURN_US and 5 < longest <= TURN_US


def test_pauses_inside_a_packet_are_short_whatever_else_interrupts(capsys):
    """Two characters leave without a pause; the interrupt must be served before the next two. Servos allow far longer pauses: the simulated
    ones 100 us."""
    board = walker()
    board.send(pattern(int(LINE_BYTES_PER_S)))
    board.bus_pause_us(forget=True)
    board.run(ms=1000)
    longest = board.bus_pause_us()
    with capsys.disabled():
        print(f"\nhal: pauses in packets in a flood: at most {longest:.1f} us")
    assert 0 < longest <= 30  # 22.8 with GCC 14


@pytest.mark.parametrize("return_delay, count, late", [(250, 6, False), (0, 18, False), (250, 18, True)])
def test_servos_deaf_to_sync_write_follow_all_the_same(return_delay, count, late):
    """REG WRITE to each and one ACTION: 0.7 ms per servo, 0.2 ms with a return delay of 0. What does not fit into a tick continues in the
    next one and is counted."""
    board = walker(servos=[20, 21], deaf=range(1, count + 1), table=[(5, return_delay)])
    seen = {number: set() for number in range(1, count + 1)}
    for _ in range(120):
        board.run(ticks=1)
        for number, goals in seen.items():
            goals.add(board.servos[number].goal)
    fewest = min(len(goals) for goals in seen.values())
    assert fewest > 110 if not late else 40 < fewest < 110
    assert (word(board, "walker_late", 1) > 0) == late
    assert word(board, "walker_missed") == 0
