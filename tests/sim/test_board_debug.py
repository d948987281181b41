# SPDX-License-Identifier: MIT
"""Debug features of the simulated board: probes, stack figures, symbols, image loader, GDB, target_runner."""

import os
import pathlib
import pickle
import socket
import struct
import subprocess

import pytest

from cm5sim import Board, PowerCut, Violation
from cm5sim.library import build_folder

NEGATIVE = build_folder() / "firmware" / "negative"
RUNNER = build_folder() / "host" / "tools" / "sim" / "target_runner"


def words(*values):
    return struct.pack(f"<{len(values)}H", *values)


# SP = 0x10FF; timer 1 compare A every 1,000 cycles in CTC; then calls 0x200 forever. ISR at 0x600: 10 NOPs, RETI.
MAIN = [0xE100, 0xBF0E, 0xEF0F, 0xBF0D, 0xE003, 0x9300, 0x4B, 0xEE07, 0x9300, 0x4A, 0xE009, 0x9300, 0x4E, 0xE100, 0x9300, 0x57]
SEI, NOP, RET, RETI = 0x9478, 0x0000, 0x9508, 0x9518
CALL_200_FOR_EVER = [0x940E, 0x0100, 0xCFFD]


def probed(interrupts):
    board = Board()
    main = MAIN + ([SEI] if interrupts else [NOP]) + CALL_200_FOR_EVER
    board.flash[0:4] = words(0x940C, 0x0080)
    board.flash[0x30:0x34] = words(0x940C, 0x0300)  # compare A
    board.flash[0x100 : 0x100 + 2 * len(main)] = words(*main)
    board.flash[0x200 : 0x200 + 402] = words(*[NOP] * 200, RET)
    board.flash[0x600 : 0x600 + 22] = words(*[NOP] * 10, RETI)
    board.probe("0x200")
    return board


def test_probe_counts_from_the_first_instruction_to_the_return():
    board = probed(interrupts=False)
    board.run(ms=10)
    figures = board.cycles("0x200")
    assert figures.count == pytest.approx(160_000 / (200 + 4 + 4 + 2), abs=2)
    assert figures.max == figures.mean == figures.total_max == 204, "200 NOPs and RET"


def test_probe_takes_interrupts_out_of_the_own_time():
    board = probed(interrupts=True)
    board.run(ms=10)
    figures = board.cycles("0x200")
    assert figures.max == figures.mean == 204
    assert figures.total_max == 204 + 4 + 3 + 10 + 4, "response, JMP, NOPs, RETI"
    assert board._lib.board_interrupt_count(board._pointer, 12) == pytest.approx(160, abs=1)
    assert board._lib.board_interrupt_max(board._pointer, 12) == 21


def swept(mask=0x10, off=False):
    """A loop that calls 0x200 forever: four NOPs and RET. With `off`: three NOPs and RET, CLI before the second NOP and SEI after it."""
    board = Board()
    main = MAIN[:4] + [0xE000 | mask >> 4 << 8 | mask & 15, 0x9300, 0x57, SEI] + CALL_200_FOR_EVER  # r16 = TIMSK
    body = [NOP, 0x94F8, NOP, SEI, NOP, RET] if off else [NOP] * 4 + [RET]
    board.flash[0:4] = words(0x940C, 0x0080)
    board.flash[0x30:0x34] = words(0x940C, 0x0300)
    board.flash[0x100 : 0x100 + 2 * len(main)] = words(*main)
    board.flash[0x200 : 0x200 + 2 * len(body)] = words(*body)
    board.flash[0x600:0x602] = words(RETI)
    board.sweep("0x200", "tick")
    return board


def interrupted_at(board, calls):
    """Return addresses of the first interrupts of a sweep."""
    places = []
    for _ in range(calls):
        board.run_to(0x600)
        sp = board.ram[0x5D] | board.ram[0x5E] << 8
        places.append((board.ram[sp + 1] << 8 | board.ram[sp + 2]) * 2)
        board.run(cycles=4)
    return places


def test_sweep_interrupts_before_each_instruction_once():
    board = swept()
    assert interrupted_at(board, 5) == [0x200, 0x202, 0x204, 0x206, 0x208]
    board.run_to(0x600)  # the round is over when a call ends before its interrupt is due
    done = board.swept("0x200")
    assert (done.rounds, done.calls, done.taken, done.place) == (1, 6, 5, 0)
    assert interrupted_at(board, 1) == [0x200]


def test_sweep_waits_while_interrupts_are_off():
    """An interrupt raised after CLI is served one instruction after SEI."""
    assert interrupted_at(swept(off=True), 6) == [0x200, 0x202, 0x20A, 0x20A, 0x20A, 0x20A]


def test_sweep_needs_an_enabled_interrupt():
    board = swept(mask=0)
    board.run(ms=1)
    done = board.swept("0x200")
    assert done.rounds > 10 and done.taken == 0


def test_sweep_of_nothing_is_refused():
    board = Board()
    with pytest.raises(KeyError):
        board.sweep("no_such_function", "tick")
    with pytest.raises(KeyError):
        board.sweep("0x200", 22)  # EEPROM ready: the board cannot raise it
    with pytest.raises(ValueError):
        board.interrupt(34)


def test_stack_headroom_is_what_was_never_used():
    board = Board(images=[NEGATIVE / "right-stack.hex"])
    board.expect("right")
    end = board.variable("variables") + 3000
    assert board.stack_headroom == board._lib.board_stack_low(board._pointer) - end
    assert 0 < board.stack_headroom < 900


def test_guard_of_an_image_in_the_boot_section_is_its_own():
    board = Board(images=[build_folder() / "firmware" / "lab" / "lab.hex"])
    board.run(ms=1)
    end = board.variable("starts") + 2  # the last one, in .noinit
    assert board.stack_headroom == board._lib.board_stack_low(board._pointer) - end


def test_every_instruction_of_a_function_has_its_name():
    """Local labels of the assembler do not count as functions."""
    board = Board(images=[NEGATIVE / "right-stack.hex"])
    first = board.function("dig")
    assert {board.function_at(address) for address in range(first, first + 40, 2)} == {"dig"}


def test_violation_of_another_process_says_what_was_violated():
    sent = Violation("stack", 123, 0x456, "dig", "too deep")
    came = pickle.loads(pickle.dumps(sent))
    assert str(came) == str(sent) and vars(came) == vars(sent)


def test_symbols_name_functions_and_variables():
    board = Board(images=[NEGATIVE / "right-stack.hex"])
    assert board.function_at(board.function("dig") + 2) == "dig"
    assert 0x100 <= board.variable("variables") < 0x1100
    with pytest.raises(KeyError):
        board.function("nothing_of_the_kind")


def test_elf_and_hex_load_the_same():
    one, other = Board(images=[NEGATIVE / "right-stack.hex"]), Board(images=[NEGATIVE / "right-stack.elf"])
    assert bytes(one.flash) == bytes(other.flash)


@pytest.mark.parametrize(
    "text, why",
    [
        (":00000001FE", "checksum"),
        (":0100000000FE", "checksum"),
        ("hello", "not an image"),
        (":0100000000FF", "no end"),
        (":02000004000AF0\n:0100000000FF\n:00000001FF", "beyond"),
        (":0200000600F7\n:00000001FF", "not an image"),
    ],
)
def test_bad_hex_files_are_refused(tmp_path, text, why):
    path = tmp_path / "bad.hex"
    path.write_text(text + "\n")
    with pytest.raises(FileNotFoundError, match=why):
        Board(images=[path])


def test_two_runs_with_the_same_seed_are_the_same():
    def run():
        board = Board(images=[NEGATIVE / "right-bus_overrun.hex"], servos=[1], seed=5)
        board.expect("right")
        return board.now_cycles, bytes(board.ram[0x100:0x1100]), board.packets

    assert run() == run()


def test_trace_keeps_instruction_packets():
    board = Board(images=[NEGATIVE / "right-bus_overrun.hex"], servos=[1])
    board.expect("right")
    assert [packet for _, packet in board.packets] == [b"\xff\xff\x01\x02\x01\xfb"]


def own_listeners():
    """(address, port) of every TCP socket that this process listens on, from /proc."""
    inodes = set()
    for entry in pathlib.Path("/proc/self/fd").iterdir():
        try:
            inodes.add(os.readlink(entry))
        except OSError:
            continue
    rows = [line.split() for line in pathlib.Path("/proc/self/net/tcp").read_text().splitlines()[1:]]
    return {tuple(row[1].split(":")) for row in rows if row[3] == "0A" and f"socket:[{row[9]}]" in inodes}


def test_gdb_is_served_to_this_computer_only():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    before = own_listeners()
    board = Board(images=[NEGATIVE / "right-bus_overrun.hex"], servos=[1])
    board.power_on()
    assert board._lib.board_gdb(board._pointer, port, False)
    assert own_listeners() - before == {("0100007F", f"{port:04X}")}, "127.0.0.1 and nothing else"
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", port), timeout=60)
    socket.create_connection(("127.0.0.1", port), timeout=60).close()


def test_gdb_on_a_port_in_use_is_an_error():
    with socket.socket() as holder:
        holder.bind(("127.0.0.1", 0))
        holder.listen()
        port = holder.getsockname()[1]
        board = Board(images=[NEGATIVE / "right-bus_overrun.hex"], servos=[1])
        board.power_on()
        assert not board._lib.board_gdb(board._pointer, port, True)
        board.expect("right")  # and the board runs on without GDB


def test_target_runner_wants_the_done_line(tmp_path):
    """A program fails if it ends in another way or violates a rule of the board. So does a file that is not an image."""
    for image, status in ((NEGATIVE / "wrong-stack.hex", 1), (NEGATIVE / "right-stack.hex", 1), (tmp_path / "no.hex", 2)):
        assert subprocess.run([RUNNER, image, "1"], capture_output=True, check=False, timeout=600).returncode == status


def test_violation_and_power_cut_are_exceptions_that_repeat_and_can_be_cleared():
    board = Board(images=[NEGATIVE / "wrong-break.hex"])
    for _ in range(2):
        with pytest.raises(Violation):
            board.run(ms=10)
    board.clear_violation()
    board.allow("illegal")
    board.expect("right")
    board.cut_power_at(1)
    with pytest.raises(PowerCut):
        board.run(ms=10)
    board.power_on()
    board.expect("right")
