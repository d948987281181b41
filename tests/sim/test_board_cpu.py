# SPDX-License-Identifier: MIT
"""The simulated CPU against the ATmega128's data sheet: instruction cycles, interrupts, timers, reset."""

import struct

import pytest

from cm5sim import Board, Violation

# Cycles from the Instruction Set Summary of the data sheet (2467), 16-bit program counter. The words are at 0x100; r30:r31 point to 0x0200,
# SP to 0x1000, all flags are clear.
CYCLES = {
    "nop": ([0x0000], 1),
    "add r0,r1": ([0x0C01], 1),
    "adiw r24,1": ([0x9601], 2),
    "sbiw r24,1": ([0x9701], 2),
    "mul r16,r17": ([0x9F01], 2),
    "muls r16,r17": ([0x0201], 2),
    "mulsu r16,r17": ([0x0301], 2),
    "fmul r16,r17": ([0x0309], 2),
    "fmuls r16,r17": ([0x0381], 2),
    "fmulsu r16,r17": ([0x0389], 2),
    "movw r0,r2": ([0x0101], 1),
    "ldi r16,1": ([0xE001], 1),
    "com r0": ([0x9400], 1),
    "swap r0": ([0x9402], 1),
    "rjmp +0": ([0xC000], 2),
    "jmp 0x110": ([0x940C, 0x0088], 3),
    "ijmp": ([0x9409], 2),
    "rcall +0": ([0xD000], 3),
    "call 0x110": ([0x940E, 0x0088], 4),
    "icall": ([0x9509], 3),
    "ret": ([0x9508], 4),
    "reti": ([0x9518], 4),
    "cpse equal, skips one word": ([0x1000, 0x0000], 2),
    "cpse equal, skips two words": ([0x1000, 0x940C, 0], 3),
    "cpse different": ([0x1001, 0x0000], 1),
    "sbrc skips": ([0xFC00, 0x0000], 2),
    "sbrs stays": ([0xFE00, 0x0000], 1),
    "sbrc skips two": ([0xFC00, 0x940C, 0], 3),
    "sbic stays": ([0x9930, 0x0000], 2),
    "sbis skips": ([0x9B30, 0x0000], 1),
    "brne taken": ([0xF409], 2),
    "breq not taken": ([0xF009], 1),
    "ld r0,X": ([0x900C], 2),
    "ld r0,X+": ([0x900D], 2),
    "ld r0,-X": ([0x900E], 2),
    "ld r0,Y": ([0x8008], 2),
    "ld r0,Y+": ([0x9009], 2),
    "ld r0,-Y": ([0x900A], 2),
    "ldd r0,Y+1": ([0x8009], 2),
    "ld r0,Z": ([0x8000], 2),
    "ld r0,Z+": ([0x9001], 2),
    "ld r0,-Z": ([0x9002], 2),
    "ldd r0,Z+1": ([0x8001], 2),
    "lds r0": ([0x9000, 0x0200], 2),
    "sts r0": ([0x9200, 0x0200], 2),
    "st X,r0": ([0x920C], 2),
    "st X+,r0": ([0x920D], 2),
    "st -X,r0": ([0x920E], 2),
    "st Z+,r0": ([0x9201], 2),
    "std Z+1,r0": ([0x8201], 2),
    "st -Y,r0": ([0x920A], 2),
    "lpm": ([0x95C8], 3),
    "lpm r0,Z": ([0x9004], 3),
    "lpm r0,Z+": ([0x9005], 3),
    "elpm": ([0x95D8], 3),
    "elpm r0,Z": ([0x9006], 3),
    "elpm r0,Z+": ([0x9007], 3),
    "in r0": ([0xB600], 1),
    "out": ([0xBA0B], 1),
    "push r0": ([0x920F], 2),
    "pop r0": ([0x900F], 2),
    "sbi": ([0x9AD8], 2),
    "cbi": ([0x98D8], 2),
    "bset": ([0x9408], 1),
    "bst": ([0xFA00], 1),
    "bld": ([0xF800], 1),
    "lsr": ([0x9406], 1),
    "asr": ([0x9405], 1),
    "ror": ([0x9407], 1),
    "wdr": ([0x95A8], 1),
}
RJMP_SELF = 0xCFFF


def words(*values):
    return struct.pack(f"<{len(values)}H", *values)


def bare(program, at=0):
    """A board with only these words in flash, just out of reset."""
    board = Board(seed=7)
    board.flash[at : at + 2 * len(program)] = words(*program)
    board.power_on()
    return board


def ready(program):
    """The same after instructions that set the pointers: SP = 0x1000, X = Y = Z = 0x0200, r0 = 0, r1 = 1."""
    setup = [
        0xE100,
        0xBF0E,
        0xE000,
        0xBF0D,  # ldi r16,0x10; out SPH; ldi r16,0; out SPL
        0xE0B2,
        0xE0A0,
        0xE0D2,
        0xE0C0,
        0xE0F2,
        0xE0E0,  # X, Y, Z
        0x2400,
        0x2411,
        0x9413,
        0xE001,
        0xE012,
        0x2422,
        0x2433,  # r0, r1 = 1, r16, r17, r2, r3
        0x94F8,
        0x9488,
        0x9498,
        0x94A8,
        0x94B8,
        0x94C8,
        0x94D8,
        0x94E8,
    ]  # flags
    board = bare(setup + [0] * (128 - len(setup)) + list(program) + [0] * 8)
    for _ in range(128):
        board.step()
    assert board.pc == 0x100
    return board


@pytest.mark.parametrize("name", CYCLES)
def test_instruction_takes_the_cycles_of_the_data_sheet(name):
    program, cycles = CYCLES[name]
    assert ready(program).step() == cycles


def test_far_reads_cross_the_64_kib_line():
    board = ready([0xE001, 0xBF0B, 0xEFFF, 0xEFEF, 0x94F8, 0xE000, 0xBF0B, 0x9007, 0x9017])
    # RAMPZ = 1 then 0; Z = 0xFFFF; elpm r0,Z+ ; elpm r1,Z+
    board.flash[0xFFFF:0x10001] = b"\xa5\x5a"
    for _ in range(9):
        board.step()
    assert (board.ram[0], board.ram[1]) == (0xA5, 0x5A)
    assert board.ram[0x5B] == 1, "RAMPZ counts on"


def test_rampz_is_one_bit_wide():
    board = ready([0xEF0F, 0xBF0B, 0xE0E0, 0xE0F0, 0x9006])
    # RAMPZ = 0xFF; Z = 0; elpm r0,Z
    board.flash[0x10000] = 0xA5
    for _ in range(5):
        board.step()
    assert board.ram[0x5B] == 1
    assert board.ram[0] == 0xA5


def test_reset_leaves_the_stack_pointer_at_zero_and_the_ram_random():
    board = bare([RJMP_SELF])
    assert board.ram[0x5D] == 0 and board.ram[0x5E] == 0
    assert len(set(board.ram[0x100:0x1100])) > 200
    other = Board(seed=8)
    other.power_on()
    assert other.ram[0x100:0x1100] != board.ram[0x100:0x1100]
    again = Board(seed=7)
    again.power_on()
    assert again.ram[0x100:0x1100] == board.ram[0x100:0x1100], "same seed, same garbage"


def test_sram_survives_a_reset_but_not_a_power_cut():
    board = bare([RJMP_SELF])
    board.run(ms=1)
    before = board.ram[0x100:0x1100]
    board.reset()
    board.run(ms=1)
    assert board.ram[0x100:0x1100] == before
    board.power_off()
    board.power_on()
    assert board.ram[0x100:0x1100] != before


# Timer 1 or 3 in CTC; the test measures the time between interrupts: OCR1A, prescaler bits, cycles of one period.
@pytest.mark.parametrize("top, select, period", [(15624, 2, 125000), (1249, 3, 80000), (999, 1, 1000), (61, 5, 63488)])
@pytest.mark.parametrize("timer", [1, 3])
def test_ctc_timers_keep_their_period_to_the_cycle(timer, top, select, period):
    ocr_high, ocr_low, control, mask, flag, vector = (0x4B, 0x4A, 0x4E, 0x57, 0x10, 12) if timer == 1 else (0x87, 0x86, 0x8A, 0x7D, 0x10, 26)
    sts = lambda address, value: [0xE000 | (value >> 4) << 8 | (value & 15), 0x9300, address]  # noqa: E731
    main = (
        [0xE100, 0xBF0E, 0xEF0F, 0xBF0D]
        + sts(ocr_high, top >> 8)
        + sts(ocr_low, top & 0xFF)
        + sts(control, 0x08 | select)
        + sts(mask, flag)
        + [0x9478, RJMP_SELF]
    )
    board = Board(seed=1)
    board.flash[0:4] = words(0x940C, 0x0080)
    board.flash[4 * vector : 4 * vector + 2] = words(0x9518)
    board.flash[0x100 : 0x100 + 2 * len(main)] = words(*main)
    times = []
    for _ in range(20):
        board.run_to(4 * vector)
        times.append(board.now_cycles)
        board.step()
    assert times[-1] - times[0] == pytest.approx(19 * period, abs=2), "RJMP takes two cycles: jitter of one"
    if select >= 3:  # the prescaler's first edge comes after the 22 cycles of the program so far, so the phase is known too
        assert times[0] == pytest.approx(period, abs=12), "the flag is set when the count returns to 0"
    assert max(abs(b - a - period) for a, b in zip(times, times[1:])) <= 2


# Timer 1 overflows 256 counts after this: TCNT1 = 0xFF00, clock / 1.
START_TIMER = [0xEF0F, 0x9300, 0x4D, 0xE000, 0x9300, 0x4C, 0xE001, 0x9300, 0x4E]
ENABLE_OVERFLOW = [0xE004, 0x9300, 0x57]
OVERFLOW_VECTOR = 14 * 4


def steps(board, count):
    return [board.step() for _ in range(count)]


def test_interrupt_comes_one_instruction_after_sei_and_takes_four_cycles():
    """The flag was set before its mask and before SEI: interrupt requests of the chip are levels."""
    program = START_TIMER + [0] * 300 + ENABLE_OVERFLOW + [0x9478, 0x0000, 0x0000]
    board = ready(program)
    steps(board, 6 + 300 + 2)
    assert steps(board, 2) == [1, 1], "SEI and the instruction behind it"
    assert board.step() == 4 and board.pc == OVERFLOW_VECTOR
    assert board.ram[0x5D] | board.ram[0x5E] << 8 == 0x1000 - 2, "return address pushed"


def test_interrupt_mask_set_late_is_not_forgotten_and_reti_lets_one_instruction_pass():
    program = START_TIMER + [0] * 300 + ENABLE_OVERFLOW + [0x9478, 0x0000, 0x0000]
    board = ready(program)
    board.flash[OVERFLOW_VECTOR : OVERFLOW_VECTOR + 2] = words(0x9518)
    steps(board, 6 + 300 + 2 + 2 + 1)
    assert board.step() == 4, "RETI"
    assert board.pc == 0x100 + 2 * (len(program) - 1), "behind the NOP that followed SEI"


def test_out_of_sleep_the_response_takes_eight_cycles():
    program = START_TIMER + ENABLE_OVERFLOW + [0xE200, 0xBF05, 0x9478, 0x9588, 0x0000]
    board = ready(program)
    steps(board, 6 + 2 + 2 + 1)
    overflow = board.now_cycles
    board.run_to(OVERFLOW_VECTOR)
    slept = board.now_cycles - overflow
    plain = ready(START_TIMER + ENABLE_OVERFLOW + [0xE200, 0xBF05, 0x9478] + [0] * 400)
    steps(plain, 6 + 2 + 2 + 1)
    overflow = plain.now_cycles
    plain.run_to(OVERFLOW_VECTOR)
    assert slept == plain.now_cycles - overflow + 4


def test_timer_counts_can_be_read():
    """TCNT1 is read twice, 10 cycles apart; IN reads the low byte first."""
    board = ready(START_TIMER + [0xB40C, 0xB41D] + [0] * 8 + [0xB42C, 0xB43D])
    steps(board, 6 + 12)
    first, second = board.ram[0] | board.ram[1] << 8, board.ram[2] | board.ram[3] << 8
    assert second - first == 10


def test_execution_wraps_from_the_last_word_to_the_first():
    board = ready([])
    board.flash[0x100:0x104] = words(0x940C, 0x0000)[:0] + words(0x940D, 0xFFFF)  # jmp 0x1FFFE
    board.flash[0x1FFFE:0x20000] = words(0x0000)
    steps(board, 2)
    assert board.pc & 0x1FFFF == 0


def test_registers_are_random_at_power_on():
    assert len(set(bare([RJMP_SELF]).ram[0:32])) > 20


def test_reset_causes_add_up_until_they_are_cleared():
    board = bare([RJMP_SELF])
    assert board.ram[0x54] == 0x01
    board.reset()
    board.run(ms=1)
    assert board.ram[0x54] == 0x03
    board.power_off()
    board.power_on()
    assert board.ram[0x54] == 0x01


def test_sleep_with_interrupts_off_ends_by_the_watchdog():
    board = ready([0xE008, 0xBD01, 0xE200, 0xBF05, 0x94F8, 0x9588, RJMP_SELF])
    board.run(ms=15)
    assert board.reset_cause == "watchdog" and board.resets == 2


def test_interrupts_wait_while_ivsel_may_be_changed():
    program = START_TIMER + [0] * 300 + ENABLE_OVERFLOW + [0xE001, 0x9478, 0xBF05] + [0] * 8
    board = ready(program)
    steps(board, 6 + 300 + 2 + 3)
    taken = steps(board, 6)
    assert taken.index(4) in (4, 5), "four cycles of NOPs first"


def test_compare_register_written_below_the_count_is_missed_for_a_turn():
    """CTC, clock / 1, OCR1A = 0x0FFF; at a count of about 300 OCR1A becomes 0x0010: the next match is after 0xFFFF."""
    program = [0xE000, 0x9300, 0x4D, 0x9300, 0x4C, 0xE00F, 0x9300, 0x4B, 0xEF0F, 0x9300, 0x4A, 0xE009, 0x9300, 0x4E]
    program += [0] * 300 + [0xE000, 0x9300, 0x4B, 0xE100, 0x9300, 0x4A, 0xE100, 0x9300, 0x57, 0x9478, RJMP_SELF]
    board = ready(program)
    steps(board, 9)
    start = board.now_cycles
    board.run_to(12 * 4)
    assert board.now_cycles - start == pytest.approx(0x10000 + 0x10 + 1, abs=8)


def test_wild_stores_end_the_run_and_leave_the_process_whole():
    """simavr performs the store anyway; the memory after its SRAM belonged to other data."""
    for high in range(0x11, 0x100, 0x0D):
        with bare([0xE0E0, 0xE0F0 | (high & 0xF0) << 4 | high & 0x0F, 0x8300, RJMP_SELF]) as board:
            with pytest.raises(Violation, match="outside the memory"):
                board.run(ms=1)
