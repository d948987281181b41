# SPDX-License-Identifier: MIT
"""The hal and the common half of the firmware on the simulated board: times, line rates, half duplex, EEPROM, resets.

Programs: hal/hal_walker.c (31 joints for ever) and hal/hal_words.c (does what a byte says)."""
import struct

import pytest

from cm5sim import Board, PowerCut

TICK = 125_000
LINE_BYTES_PER_S = 2_000_000 / 35 / 10


def crc16(data):
    """CRC-16/CCITT-FALSE, bit by bit: known answer 0x29B1 for "123456789"."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def pattern(count, seed=1):
    """Bytes of every value, the same each time."""
    out = bytearray()
    for _ in range(count):
        seed = (seed * 1103515245 + 12345) & 0x7FFFFFFF
        out.append(seed >> 16 & 0xFF)
    return bytes(out)


def word(board, name, count=2):
    address = board.variable(name)
    return int.from_bytes(bytes(board.ram[address:address + count]), "little")


def bus_counts(board):
    """bus_counts_t as a dict."""
    names = ("packets", "answers", "timeouts", "checksums", "framing", "overruns", "wrong_ids", "lengths", "retries",
             "cancelled", "strays")
    address = board.variable("walker_bus")
    return dict(zip(names, struct.unpack("<IIHHHHHHHHH", bytes(board.ram[address:address + 26]))))


def walker(kind="cm5", servos=range(31), deaf=(), table=()):
    """A walking robot. deaf: IDs of DX-117, which ignore SYNC WRITE; table: (address, value) written to all servos."""
    board = Board(kind=kind, images=[f"tests/hal_walker_{kind}.hex"], servos=servos)
    for number in deaf:
        board.servos.add(number, model="dx117", rate=1_000_000)
    for address, value in table:
        for servo in board.servos:
            servo.write(address, [value])
    board.expect("walking", ms=3000)
    board.run(ms=100)
    return board


def words():
    board = Board(images=["tests/hal_words.hex"])
    board.expect("start 00000001")
    return board


def test_crc_known_answer():
    assert crc16(b"123456789") == 0x29B1


# ---- time ----

def test_tick_is_exact_over_a_minute_and_none_is_missed():
    board = walker(servos=range(1, 19))
    board.run_to("__vector_12", ms=20)
    start, ticks = board.now_cycles, word(board, "walker_ticks")
    board.run(cycles=7679 * TICK + TICK // 2)
    board.run_to("__vector_12", ms=20)
    assert board.now_cycles - start == 7680 * TICK
    assert word(board, "walker_ticks") - ticks == 7680
    assert word(board, "walker_missed") == 0
    assert word(board, "walker_late", 1) == 0


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
    # Each interrupt: its own cycles, 4 of response and 3 of the vector's jump. One sends two bytes, the last one turns the line
    # round: 51 for the goals of 31 joints. The packet that asks a servo needs 4 more, which the sum leaves out.
    sent, heard = (board.cycles(name).total_mean + 7 for name in ("__vector_20", "__vector_18"))
    assert board.cycles("__vector_20").count / len(frames) == pytest.approx(51 + 4, abs=0.6)
    total = build + 51 * sent
    with capsys.disabled():
        print(f"\nhal: frame of 31 joints: build {build}, send 51 x {sent:.1f}, in all {total:.0f} cycles;"
              f" a byte heard {heard:.0f}")
    assert total <= 10_000
    assert heard < 160


# ---- serial line ----

def test_flood_at_line_rate_beside_31_joints_loses_nothing():
    board = walker()
    data = pattern(int(10 * LINE_BYTES_PER_S))
    before = bus_counts(board)
    board.send(data, wait=True)
    board.run(ms=50)
    assert word(board, "walker_bytes", 4) == len(data)
    assert word(board, "walker_crc") == crc16(data)
    assert board.uart(1).overruns == 0
    assert word(board, "walker_missed") == 0
    counts = bus_counts(board)
    assert counts["answers"] - before["answers"] >= 1270
    for name in ("timeouts", "checksums", "framing", "overruns", "wrong_ids", "lengths", "retries", "strays"):
        assert counts[name] == before[name], counts


def test_flow_control_stops_a_sender_in_time():
    """The reader takes 4,000 bytes/s, the line carries 5,714: XOFF must come early enough for a PC that sends on for 64
    more bytes."""
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
            board.send(data[at:at + 6])
            at += 6
    assert board.take().replace(b"\x11", b"").replace(b"\x13", b"") == b" 00000000\n"   # the end of "start"
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


# ---- bus ----

@pytest.mark.parametrize("kind", ["cm5", "cm2"])
@pytest.mark.parametrize("return_delay", [0, 250, 254])
def test_turn_round_loses_no_answer(kind, return_delay):
    """With a return delay of 0 a servo answers within 20 us of our last stop bit."""
    board = walker(kind, servos=range(1, 19), table=[(5, return_delay)])
    before = bus_counts(board)
    board.run(ticks=500)
    counts = bus_counts(board)
    assert counts["answers"] - before["answers"] >= 498
    assert all(counts[name] == 0 for name in ("checksums", "framing", "overruns", "wrong_ids", "lengths", "strays")), counts
    assert counts["timeouts"] == before["timeouts"]


BUS_TURNING = 2   # bus_core.h
TURN_US = 20   # dynamixel.md: with a return delay of 0 an answer begins within about 20 us


def test_turn_round_is_bounded_whatever_else_interrupts(capsys):
    """The tick, bytes of the PC in both directions and the program's own locks may all stand in its way. Ten seconds of all
    of them at the full rate, and then the same on purpose: a byte comes from the PC at every place of the interrupt that
    ends a packet, and the tick with it."""
    board = walker()
    board.bus_turn_us(forget=True)
    board.send(pattern(int(10 * LINE_BYTES_PER_S)), wait=True)
    flooded = board.bus_turn_us(forget=True)
    longest = 0
    state = board.variable("core")
    for place in range(0, 480, 3):
        board.run_to("__vector_20", ms=20)           # a packet is being sent
        while board._lib.board_pin(board._pointer, b"E", 2) == 1 and board.ram[state] != BUS_TURNING:
            board.step()                             # up to its last two bytes
        board.run(cycles=480 - place)
        board.interrupt("console byte", 0x55)
        board.run(cycles=20)                         # its interrupt has begun: the tick's comes before that of the bus
        board.interrupt("tick")
        board.run(ms=3)
        longest = max(longest, board.bus_turn_us(forget=True))
    with capsys.disabled():
        print(f"\nhal: turning the bus round: at most {flooded:.1f} us in a flood, {longest:.1f} us on purpose")
    assert 5 < flooded <= TURN_US and 5 < longest <= TURN_US


def pauses_us(path):
    """The pauses between the characters of our packets, from a recording of the line."""
    pauses, now, ended, driven = [], 0, None, False
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            now = int(line[1:])
        elif line in ("0h", "1h"):              # bus_drive
            driven, ended = line == "1h", None
        elif line == "bzzzzzzzz B":             # bus_tx
            ended = now
        elif line.startswith("b") and line.endswith(" B") and driven and ended is not None:
            pauses.append((now - ended) / 1000)
    return pauses


def test_pauses_inside_a_packet_are_short_whatever_else_interrupts(tmp_path, capsys):
    """Two characters leave without a pause; before the next two the interrupt must be served. Servos allow far more:
    the simulated ones 100 us."""
    board = walker()
    board.send(pattern(int(LINE_BYTES_PER_S)))
    board.vcd(tmp_path / "line.vcd")
    board.run(ms=1000)
    board.stop_vcd()
    pauses = pauses_us(tmp_path / "line.vcd")
    real = [pause for pause in pauses if pause > 0]
    with capsys.disabled():
        print(f"\nhal: pauses in packets in a flood: {sum(real) / len(real):.1f} us on the average, at most {max(real):.1f} us")
    assert len(pauses) > 127 * (100 + 7)
    assert len(real) <= len(pauses) / 2 + 1
    assert max(real) <= 20


def test_silent_servo_is_named_within_a_second_and_the_others_walk_on():
    board = walker()
    board.run(ms=300)
    board.servos[17].fault("silent")
    board.run(ms=1000)
    assert (word(board, "walker_fault_id", 1), word(board, "walker_fault_kind", 1)) == (17, 1)
    board.clear_trace()
    board.run(ticks=20)
    assert all(set(frame.goals) == set(range(31)) - {17} for frame in board.trace)
    board.servos[17].clear()
    board.run(ms=1000)
    assert (word(board, "walker_fault_id", 1), word(board, "walker_fault_kind", 1)) == (17, 2)
    assert word(board, "walker_missed") == 0
    assert word(board, "walker_late", 1) == 0


@pytest.mark.parametrize("fault", ["checksum", "noise", "late", "short", "two-talkers", "duplicate"])
def test_bad_answers_are_counted_and_never_stop_the_walk(fault):
    board = walker(servos=range(1, 19))
    board.run(ms=300)
    board.servos[5].fault(fault)
    board.clear_trace()
    board.run(ticks=500)
    assert len(board.trace) in (499, 500, 501)
    assert word(board, "walker_missed") == 0
    counts = bus_counts(board)
    bad = sum(counts[name] for name in ("timeouts", "checksums", "framing", "wrong_ids", "lengths"))
    assert fault == "noise" or bad > 0, counts


@pytest.mark.parametrize("fault, bit", [("overload", 32), ("overheating", 4), ("low-voltage", 1), ("angle-limit", 2)])
def test_errors_of_a_servo_are_named_within_a_second(fault, bit):
    board = walker()
    board.run(ms=300)
    board.servos[9].fault(fault)
    faults = word(board, "walker_faults", 1)
    board.run(ms=1000)
    assert word(board, "walker_faults", 1) > faults
    assert word(board, "walker_fault_id", 1) == 9
    assert word(board, "walker_fault_kind", 1) in (3, 4)


@pytest.mark.parametrize("return_delay, count, late", [(250, 6, False), (0, 18, False), (250, 18, True)])
def test_servos_deaf_to_sync_write_follow_all_the_same(return_delay, count, late):
    """REG WRITE to each and one ACTION: 0.7 ms each, 0.2 ms with a return delay of 0. What does not fit into a tick goes
    on in the next, and is counted."""
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


def test_slow_servos_are_left_alone():
    board = Board(images=["tests/hal_walker_cm5.hex"], servos=[1])
    board.servos.add(7, model="dx117")
    before = bytes(board.servos[7].table)
    board.expect("walking", ms=3000)
    board.run(ms=300)
    assert bytes(board.servos[7].table)[:24] == before[:24]
    assert word(board, "walker_slow", 4) == 1 << 7
    assert word(board, "walker_present", 4) == 1 << 1
    assert word(board, "walker_faults", 1) == 0


# ---- panel ----

def test_buttons_count_after_three_ticks():
    board = walker(servos=[1])
    board.press("UP")
    board.run(ticks=1)
    assert word(board, "walker_buttons", 1) == 0
    board.run(ticks=4)
    assert word(board, "walker_buttons", 1) == 1
    board.press("START")
    board.release("UP")
    board.run(ticks=5)
    assert word(board, "walker_buttons", 1) == 16


def test_pins_are_safe_from_the_start():
    board = walker(servos=[1])
    assert board.leds == {"power"}
    assert board.pin("B5") == 1   # charger off
    assert board.pin("D4") == 1   # ZigBee out of reset
    assert (board.pin("D5"), board.pin("D6")) == (1, 1)


# ---- flash ----

def test_far_reads_cross_64_kib():
    board = words()
    data = pattern(512)
    board.flash[0x0FF20:0x10120] = data
    backwards = b"".join(data[at:at + 64] for at in range(448, -1, -64))   # one block lies across the border
    board.send("f")
    board.expect(f"flash {crc16(backwards):08X}")


def test_all_pages_are_checked_in_under_200_ms(capsys):
    board = words()
    page = bytearray(512)
    page[22], page[20] = 32, 1
    page[31] = 0xFF - sum(page) & 0xFF
    for number in (0, 15, 16, 127):
        board.flash[0xE000 + 512 * number:0xE200 + 512 * number] = page
    start = board.now_ms
    board.send("p")
    board.expect(f"pages {4:08X}")
    took = board.now_ms - start
    with capsys.disabled():
        print(f"\nhal: 128 pages checked in {took:.0f} ms")
    assert took < 200


# ---- settings ----

def loaded(board):
    board.send("l")
    board.expect("load ")
    status, law, approach = (int(value, 16) for value in board.expect("\n").split())
    return status, law, approach


def test_eeprom_is_read_behind_a_write_and_beyond_256():
    board = words()
    board.eeprom[0x7A5:0x7A6] = b"\x11"
    board.eeprom[0x0A5:0x0A6] = b"\x22"
    board.send("e")
    board.expect("eeprom 00000012 00000022", ms=100)
    assert (board.eeprom[0x7A5], board.eeprom[0x0A5]) == (0x12, 0x22)


def test_bus_begins_at_1_mbps():
    board = Board(images=["tests/hal_words.hex"], servos=[1])
    board.expect("start")
    board.send("i")
    board.expect("ping 00000000", ms=100)


def test_settings_are_kept_over_a_power_cycle_and_stay_in_their_area():
    board = words()
    assert loaded(board) == (1, 0, 60)
    board.send("s")
    board.expect("saved")
    board.power_off()
    board.power_on()
    board.expect("start 00000001")
    assert loaded(board) == (0, 1, 77)
    assert all(board.eeprom_wear(address) == 0 for address in range(0x100, 0x1000))


def test_power_cut_at_every_eeprom_write_leaves_old_or_new_settings(capsys):
    cuts, old, new = 0, 0, 0
    for phase in ("before", "during", "after"):
        op = 1
        while True:
            board = words()
            board.send("S")
            board.expect("saved")
            board.send("S")
            board.expect("saved")
            board.cut_power(op=op, phase=phase, tear=op)
            board.send("s")
            try:
                board.expect("saved", ms=2000)
                break
            except PowerCut:
                cuts += 1
            board.power_on()
            board.expect("start 00000001")
            outcome = loaded(board)
            assert outcome in ((0, 0, 33), (0, 1, 77)), (phase, op, outcome)
            old += outcome == (0, 0, 33)
            new += outcome == (0, 1, 77)
            board.send("s")
            board.expect("saved", ms=2000)
            assert loaded(board) == (0, 1, 77)
            op += 1
    with capsys.disabled():
        print(f"\nhal: settings: {cuts} power cuts, {old} old, {new} new, 0 other")
    assert cuts >= 15 and old and new


# ---- resets ----

def test_application_takes_over_from_the_boot_loader():
    """The loader hands over with both UARTs running and receive interrupts enabled (bootloader-original.md, 5)."""
    board = Board(images=["boot-cm5.hex", "tests/hal_walker_cm5.hex"], servos=range(1, 19))
    board.eeprom[0xFFF:0x1000] = b"\x11"   # start the application
    board.send("typed too early")
    board.expect("walking", ms=3000)
    board.run(ms=500)
    assert word(board, "walker_missed") == 0
    assert word(board, "walker_bytes", 4) == 0
    assert word(board, "walker_faults", 1) == 0



def test_hang_ends_in_a_watchdog_reset_that_is_named():
    board = words()
    board.send("w")
    board.expect("start 00000008", ms=1500)


def test_restart_comes_within_30_ms():
    board = words()
    board.send("r", wait=True)
    start = board.now_ms
    board.expect("start 00000008")
    assert board.now_ms - start < 40


def test_failed_assert_is_told_after_the_restart():
    board = words()
    board.send("a")
    board.expect("start 00000008")
    board.expect("assert ")
    line, address = (int(value, 16) for value in board.expect("\n").split())
    assert 100 < line < 300
    assert board.function_at(address) in ("main", "obey")


def test_reset_causes():
    board = words()
    board.reset()
    board.expect("start 00000002")
    board.brown_out()
    board.expect("start ", ms=2000)
    assert int(board.expect("\n").split()[0], 16) & 4


def test_adc_reads_the_battery_pin():
    board = words()
    board.battery(9.6)
    board.send("v")
    board.expect("adc ")
    assert int(board.expect("\n").split()[0], 16) == pytest.approx(9.6 * 0.25 / 5 * 1024, abs=2)
