# SPDX-License-Identifier: MIT
"""TOSS, the bridge of Monitor: bytes from the PC become packets on the servo bus, answers of servos become bytes on the console, and three
ESC after a silence end it. The test builds packets from the Dynamixel protocol, without our code."""

import pytest

from tests.sim.monitor_robot import robot

PING, READ, WRITE, REG_WRITE, ACTION, SYNC_WRITE = 1, 2, 3, 4, 5, 0x83
ALL = 254


def packet(ident, instruction, *params):
    body = bytes([ident, len(params) + 2, instruction, *params])
    return b"\xff\xff" + body + bytes([~sum(body) & 0xFF])


def status(ident, *params, error=0):
    return packet(ident, error, *params)


@pytest.fixture(scope="module")
def shared():
    board = robot()
    yield board
    board.close()


@pytest.fixture
def r(shared):
    """In the bridge, before any output."""
    shared.take()
    shared.send(b"toss\r")
    shared.run(ms=60)
    assert b"Three ESC end it" in shared.take()
    shared.clear_trace()
    yield shared
    shared.run(ms=25)  # silence
    shared.send(b"\x1b\x1b\x1b")
    shared.run(ms=60)
    assert shared.take().endswith(b" [CID:001(0X01)] ")


def ask(r, sent, ms=None):
    """The output on the console."""
    r.send(sent)
    r.run(ms=len(sent) * 0.18 + 25 if ms is None else ms)
    return r.take()


def packets(r):
    return [bytes(sent) for _, sent in r.packets]


def test_every_servo_answers_through_the_bridge_and_nothing_is_added(r):
    for ident in range(1, 19):
        assert ask(r, packet(ident, PING)) == status(ident)
        low, high = r.servos[ident].table[36:38]
        assert ask(r, packet(ident, READ, 36, 2)) == status(ident, low, high)
    assert packets(r) == [made for ident in range(1, 19) for made in (packet(ident, PING), packet(ident, READ, 36, 2))]
    assert ask(r, packet(99, PING)) == b""


def test_whole_tables_pass_again_and_again(r):
    r.run(ms=200)  # nothing moves
    for _ in range(20):
        answer = ask(r, packet(7, READ, 0, 50))
        assert len(answer) == 56 and answer == status(7, *answer[5:55])
        assert answer[5:41] == bytes(r.servos[7].table[0:36])


def test_every_byte_value_passes_both_ways(r):
    for low in range(0, 256, 3):
        words = (low, 0, 0xFF, 0x03)
        assert ask(r, packet(5, WRITE, 30, *words)) == status(5)
        assert ask(r, packet(5, READ, 30, 4)) == status(5, *words)


def test_a_slow_pc_and_noise_between_packets(r):
    for noise in (b"\0", b"hello\r", b"\xff", b"\xff\xff\x01\x00", b"\xff\xff\x01\x01", b"\x1b\x1b", bytes(range(0x20, 0x7F))):
        made = packet(4, READ, 30, 2)
        for byte in noise + made:
            r.send(bytes([byte]))
            r.run(ms=3)
        r.run(ms=10)
        assert r.take() == status(4, *r.servos[4].table[30:32]), noise
    assert packets(r) == [packet(4, READ, 30, 2)] * 7


def test_escapes_inside_a_packet_are_data(r):
    assert ask(r, packet(6, WRITE, 30, 0x1B, 0, 0x1B, 0)) == status(6)
    assert ask(r, packet(0x1B, PING) + packet(6, WRITE, 26, 0x1B, 0x1B, 0x1B)) == status(6)
    assert ask(r, packet(6, READ, 30, 1)) == status(6, 0x1B)


@pytest.mark.parametrize("damage", ["lost", "length"])
def test_escapes_of_a_damaged_packet_do_not_end_it(r, damage):
    """The rest of a packet with a missing or false byte counts as outside a packet."""
    whole = packet(ALL, SYNC_WRITE, 26, 4, *(byte for ident in (1, 2, 3) for byte in (ident, 0x1B, 0x1B, 0x1B, 0x1B)))
    ask(r, whole[1:] if damage == "lost" else whole[:3] + b"\x09" + whole[4:], ms=60)
    assert ask(r, packet(2, PING)) == status(2)


def test_escapes_end_it_typed_or_sent_at_once(r):
    """The bridge begins as if after a silence: a program may send all at once."""
    for sent, pause in ((b"\x1b\x1b\x1b", 0), (b"\x1b", 100)):
        for _ in range(3 // len(sent)):
            r.send(sent)
            r.run(ms=pause + 5)
        r.run(ms=60)
        assert r.take().endswith(b" [CID:001(0X01)] ")
        r.send(b"toss\r\x1b\x1b\x1b")
        r.run(ms=100)
        assert r.take().endswith(b" [CID:001(0X01)] ")
        r.send(b"toss\r")
        r.run(ms=60)
        r.take()


def test_broadcasts_have_no_answer(r):
    positions = [word for ident in range(1, 19) for word in (ident, (500 + ident) & 0xFF, (500 + ident) >> 8)]
    assert ask(r, packet(ALL, WRITE, 24, 1)) == b""
    assert ask(r, packet(ALL, SYNC_WRITE, 30, 2, *positions)) == b""
    assert [r.servos[ident].goal for ident in range(1, 19)] == [500 + ident for ident in range(1, 19)]
    assert ask(r, packet(3, REG_WRITE, 30, 0, 2)) == status(3)
    assert ask(r, packet(ALL, ACTION)) == b"" and r.servos[3].goal == 512


def test_requests_back_to_back_are_sent_in_order(r):
    """Packets without answer may follow each other at line rate, as when a PC streams poses."""
    frames = [packet(ALL, SYNC_WRITE, 30, 2, *(byte for ident in range(1, 19) for byte in (ident, n, 2))) for n in range(30)]
    assert ask(r, b"".join(frames), ms=400) == b""
    assert packets(r) == frames


@pytest.mark.parametrize("missing", [2, 3, 5])
def test_a_packet_that_lost_a_byte_costs_itself_only(r, missing):
    """Its length announces as many bytes as 22 PINGs have. (A packet that lost its length byte may look complete: the servo reports a wrong
    checksum.)"""
    long = packet(1, WRITE, *[30] * 130)
    assert ask(r, long[:missing] + long[missing + 1 : 40], ms=60) in (b"", status(1, error=0x10))
    for ident in (1, 2, 3):
        assert ask(r, packet(ident, PING)) == status(ident)


def test_esc_ends_it_behind_a_torn_packet(r):
    r.send(packet(1, WRITE, *[30] * 130)[:20])
    r.run(ms=60)
    r.send(b"\x1b\x1b\x1b")
    r.run(ms=60)
    assert r.take().endswith(b" [CID:001(0X01)] ")
    r.send(b"toss\r")
    r.run(ms=60)


def test_a_character_without_a_stop_bit_ends_the_packet(r):
    whole = packet(1, PING)
    r.send(whole[:4], wait=True)
    r.baud(38_400)
    r.send(b"\0", wait=True)
    r.run(ms=1)
    r.baud(57_143)
    assert ask(r, whole[5:] + packet(2, PING)) == status(2)
