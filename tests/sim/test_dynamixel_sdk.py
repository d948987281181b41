# SPDX-License-Identifier: MIT
"""Third-party code against our servos: the real dynamixel-sdk (PyPI), protocol 1.0, on cm5sim --bus-pty."""

import itertools
import signal
import time

import pytest
from dynamixel_sdk import COMM_RX_CORRUPT, COMM_RX_TIMEOUT, COMM_SUCCESS, GroupSyncWrite, PacketHandler, PortHandler

from tests.sim.sim_command import Running

GOAL, SPEED, PRESENT, LED, ID, BAUD, TORQUE = 30, 32, 36, 25, 3, 4, 24
AX12, DX117 = 12, 117
PATIENCE_S = 300  # the bus runs in real time, on a PC that may be busy


class PatientPort(PortHandler):
    """Waits three seconds longer than the SDK, so that a busy PC does not change a result. It sleeps where the SDK polls."""

    patience_ms = 3000

    def setupPort(self, cflag_baud):  # noqa: N802 (the SDK's name)
        done = super().setupPort(cflag_baud)
        self.ser.timeout = 0.01
        return done

    def setPacketTimeout(self, packet_length):  # noqa: N802 (the SDK's name)
        super().setPacketTimeout(packet_length)
        self.packet_timeout += self.patience_ms


class Bus:
    """SDK handlers on a running cm5sim."""

    def __init__(self, *arguments, rate=1_000_000):
        self.sim = Running("--bus-pty", *arguments)
        self.port = PatientPort(self.sim.message(r"servo bus: (/dev/pts/\d+)"))
        assert self.port.openPort() and self.port.setBaudRate(rate)
        self.packets = PacketHandler(1.0)

    def ping(self, number):
        return self.packets.ping(self.port, number)

    def unheard(self, number):
        """The result of a ping without an answer, which is not worth three seconds."""
        self.port.patience_ms = 300
        result = self.ping(number)[1]
        self.port.patience_ms = PatientPort.patience_ms
        return result

    def read1(self, number, address):
        value, result, error = self.packets.read1ByteTxRx(self.port, number, address)
        assert (result, error) == (COMM_SUCCESS, 0)
        return value

    def read2(self, number, address):
        value, result, error = self.packets.read2ByteTxRx(self.port, number, address)
        assert (result, error) == (COMM_SUCCESS, 0)
        return value

    def until_at(self, number, goal):
        """Waits until the servo reports its goal position, within one unit."""
        end = time.monotonic() + PATIENCE_S
        while abs(self.read2(number, PRESENT) - goal) > 1:
            assert time.monotonic() < end, f"servo {number} stands at {self.read2(number, PRESENT)}, not {goal}"

    def close(self):
        self.port.closePort()
        self.sim.__exit__()


@pytest.fixture(name="make")
def _make():
    buses = []

    def make(*arguments, **options):
        buses.append(Bus(*arguments, **options))
        return buses[-1]

    yield make
    for bus in buses:
        bus.close()


def test_ping_names_the_model(make):
    bus = make("--servos", "1-3")
    assert bus.ping(2) == (AX12, COMM_SUCCESS, 0)


def test_wrong_id_times_out(make):
    bus = make("--servos", "1-3")
    assert bus.unheard(4) == COMM_RX_TIMEOUT
    assert bus.ping(3)[1] == COMM_SUCCESS  # and no late bytes are left


def test_read_and_write(make):
    bus = make("--servos", "1-3")
    assert bus.read2(1, PRESENT) == 512
    assert bus.packets.write1ByteTxRx(bus.port, 1, LED, 1) == (COMM_SUCCESS, 0)
    assert bus.read1(1, LED) == 1 and bus.read1(2, LED) == 0
    assert bus.packets.write2ByteTxRx(bus.port, 1, GOAL, 600) == (COMM_SUCCESS, 0)
    bus.until_at(1, 600)
    assert bus.read2(2, PRESENT) == 512


def test_motion_takes_real_time(make):
    bus = make("--servos", "1")
    bus.packets.write2ByteTxRx(bus.port, 1, SPEED, 100)  # 227.1 units a second
    end = time.monotonic() + PATIENCE_S
    for way in itertools.cycle((1, -1)):
        start = bus.read2(1, PRESENT)
        before_order = time.monotonic()
        bus.packets.write2ByteTxRx(bus.port, 1, GOAL, start + 300 * way)
        after_order = time.monotonic()
        time.sleep(1)
        before_look = time.monotonic()
        gone = way * (bus.read2(1, PRESENT) - start)
        after_look = time.monotonic()
        at_most = 227.1 * (after_look - before_order) + 5
        assert min(227.1 * (before_look - after_order) - 5, 298) < gone < at_most
        if at_most < 300:  # still moving: neither bound came from the goal
            return
        assert time.monotonic() < end, "no look came while the servo was moving"
        bus.until_at(1, start + 300 * way)


def test_sync_write_moves_all_at_once(make):
    bus = make("--servos", "1-18")
    group = GroupSyncWrite(bus.port, bus.packets, GOAL, 4)
    for number in range(1, 19):
        goal = 400 + 10 * number
        assert group.addParam(number, [goal & 255, goal >> 8, 0, 0])
    assert group.txPacket() == COMM_SUCCESS
    for number in range(1, 19):
        bus.until_at(number, 400 + 10 * number)


def test_registered_write_waits_for_action(make):
    bus = make("--servos", "1-2")
    assert bus.packets.regWriteTxRx(bus.port, 1, GOAL, 2, [0, 2])[0] == COMM_SUCCESS
    assert bus.read1(1, TORQUE) == 0
    bus.packets.action(bus.port, 254)
    assert bus.read1(1, TORQUE) == 1


def test_error_byte_reaches_the_user(make):
    bus = make("--servos", "1-3", "--fault", "2:overheating")
    assert bus.ping(1)[2] == 0
    error = bus.ping(2)[2]
    assert bus.packets.getRxPacketError(error) == "[RxPacketError] Overheat error!"
    result, error = bus.packets.write2ByteTxRx(bus.port, 1, GOAL, 2000)
    assert result == COMM_SUCCESS
    assert bus.packets.getRxPacketError(error) == "[RxPacketError] Out of range error!"


def test_faults_look_like_faults(make):
    bus = make("--servos", "1-4", "--fault", "1:silent", "--fault", "2:checksum", "--fault", "3:noise")
    assert bus.unheard(1) == COMM_RX_TIMEOUT
    assert bus.ping(2)[1] in (COMM_RX_CORRUPT, COMM_RX_TIMEOUT)
    assert bus.ping(3)[1] == COMM_SUCCESS  # the SDK finds the header after noise
    assert bus.ping(4)[1] == COMM_SUCCESS


def test_rates_must_agree(make):
    bus = make("--servos", "1,20:dx117", rate=57_600)  # the SDK's rate for 57,142
    assert bus.unheard(1) != COMM_SUCCESS
    assert bus.ping(20) == (DX117, COMM_SUCCESS, 0)
    assert bus.packets.write1ByteTxRx(bus.port, 20, BAUD, 1)[0] == COMM_SUCCESS  # moved to 1 Mbps
    assert bus.unheard(20) != COMM_SUCCESS
    bus.port.setBaudRate(1_000_000)
    assert bus.ping(20) == (DX117, COMM_SUCCESS, 0)
    assert bus.ping(1) == (AX12, COMM_SUCCESS, 0)


def test_new_id_and_factory_reset(make):
    bus = make("--servos", "7")
    assert bus.packets.write1ByteTxRx(bus.port, 7, ID, 9)[0] == COMM_SUCCESS
    assert bus.unheard(7) == COMM_RX_TIMEOUT
    assert bus.ping(9)[1] == COMM_SUCCESS
    assert bus.packets.factoryReset(bus.port, 9)[0] == COMM_SUCCESS
    assert bus.ping(1)[1] == COMM_SUCCESS


def test_idle_bus_costs_no_cpu(make):
    bus = make("--servos", "1-18")
    bus.ping(1)
    before, begun = bus.sim.cpu_seconds(), time.monotonic()
    time.sleep(1.5)
    assert bus.sim.cpu_seconds() - before < 0.07 * (time.monotonic() - begun)


def rows_of(trace):
    """The rows in the file so far, as numbers, without an unfinished last line."""
    head, *rows = trace.read_text().splitlines(keepends=True)
    assert head == "tick,ms,goal1,present1,goal2,present2\n"
    return [[float(field or "nan") for field in row.split(",")] for row in rows if row.endswith("\n")]


def until_traced(trace, seen):
    """Waits until a row of the trace satisfies `seen`. The bus makes one row per tick of its clock and writes them to the file somewhat
    later."""
    end = time.monotonic() + PATIENCE_S
    while not (trace.read_text() and any(seen(row) for row in rows_of(trace))):
        assert time.monotonic() < end, trace.read_text()[-500:]
        time.sleep(0.05)


def test_trace_and_servo_eeprom_of_the_bus(make, tmp_path):
    trace, kept = tmp_path / "trace.csv", tmp_path / "servos.bin"
    bus = make("--servos", "1-2", "--trace", trace, "--servo-eeprom", kept)
    bus.packets.write1ByteTxRx(bus.port, 2, ID, 5)
    bus.packets.write2ByteTxRx(bus.port, 1, GOAL, 600)
    until_traced(trace, lambda row: row[3] >= 599)
    assert bus.sim.stop() == 0
    rows = rows_of(trace)
    assert [row[0] for row in rows] == list(range(len(rows)))  # one row per tick
    assert rows[0][3] == 512
    assert rows[-1][2] == 600 and abs(rows[-1][3] - 600) <= 1  # the motor rests within the compliance margin
    assert kept.read_bytes()[24 + 3] == 5


def test_rows_of_the_trace_are_of_their_time(make, tmp_path):
    """Even if the bus is late: it is stopped for a second while the servo moves, and a packet is the first input afterwards."""
    trace, units_a_tick = tmp_path / "trace.csv", 5 * 2.271 / 128  # SPEED 5, Dynamixel's 0.111 rpm a unit
    bus = make("--servos", "1-2", "--trace", trace)
    bus.packets.write2ByteTxRx(bus.port, 1, SPEED, 5)
    end = time.monotonic() + PATIENCE_S
    for goal in itertools.cycle((1000, 24)):
        bus.packets.write2ByteTxRx(bus.port, 1, GOAL, goal)
        begun = bus.read2(1, PRESENT)
        while abs(bus.read2(1, PRESENT) - begun) < 10:  # it is moving
            time.sleep(0.05)
        bus.sim.process.send_signal(signal.SIGSTOP)
        time.sleep(1)
        bus.port.writePort([0xFF, 0xFF, 1, 4, 2, PRESENT, 2, 0xD2])
        bus.sim.process.send_signal(signal.SIGCONT)
        answer = b""
        while len(answer) < 8:
            answer += bytes(bus.port.readPort(8 - len(answer)))
        found = answer[5] | answer[6] << 8
        if abs(goal - found) > 20:  # still moving when the bus continued
            break
        assert time.monotonic() < end, "no look came while the servo was moving"
        bus.until_at(1, goal)
    assert bus.sim.stop() == 0
    rows, way = rows_of(trace), 1 if goal > 512 else -1
    moving = [(row[0], way * row[3]) for row in rows if row[2] == goal and 3 < abs(row[3] - begun) and 3 < abs(goal - row[3])]
    assert moving[-1][1] - moving[0][1] > 10
    off = [(tick, at) for tick, at in moving if abs(at - moving[0][1] - (tick - moving[0][0]) * units_a_tick) > 1.6]
    assert not off, off[:5]
