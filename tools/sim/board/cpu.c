/* SPDX-License-Identifier: MIT */
#include "board_private.h"

#define NOTE_BEFORE (NOTE_FLASH | NOTE_SLEEP | NOTE_WRONG | NOTE_PROBE | NOTE_RETURN | NOTE_STOP)

void cpu_flash_changed(board_t *board, uint32_t address, uint32_t count)
{
    const uint8_t *flash = board->avr->flash;
    for (uint32_t word = address / 2; word < (address + count + 1) / 2; word++) {
        board->cpu.note[word] = opcode_note((uint16_t)(flash[2 * word] | flash[2 * word + 1] << 8));
    }
    if (board->stop_at != UINT32_MAX) {
        board->cpu.note[board->stop_at / 2] |= NOTE_STOP;
    }
    probe_mark(board);
    sweep_mark(board);
    waits_flash_changed(board, address, count);
}

/* Cycles of the instructions that can write a register and can be part of a timed sequence: OUT 1, the others 2. */
uint64_t cpu_instruction_end(const board_t *board)
{
    const uint8_t *at = &board->avr->flash[board->avr->pc];
    uint16_t opcode = (uint16_t)(at[0] | at[1] << 8);
    return board->avr->cycle + ((opcode & 0xF800u) == 0xB800u ? 1 : 2);
}

static bool sleep_now(board_t *board)
{
    avr_t *avr = board->avr;
    uint8_t mcucr = avr->data[M128_MCUCR];
    if (mcucr & MCUCR_SE) {
        if (mcucr & MCUCR_SM) {
            return violation_note(board, VIOLATION_UNMODELLED, "sleep mode other than idle (MCUCR 0x%02X)", mcucr);
        }
        if (!avr->sreg[S_I] && !reset_watchdog_runs(board) &&
            violation_note(board, VIOLATION_SLEEP, "sleep with interrupts off and no watchdog: it never wakes")) {
            return true;
        }
        board->cpu.sleeping = true;
    }
    avr->pc += 2;
    avr->cycle += 1;
    return true;
}

static bool refuse_opcode(board_t *board, uint32_t pc, uint16_t opcode)
{
    if (opcode == 0xFFFF) {
        return violation_note(board, VIOLATION_ERASED, "execution ran into erased flash");
    }
    if (violation_note(board, VIOLATION_ILLEGAL, "opcode 0x%04X at 0x%05X is no instruction", opcode, pc)) {
        return true;
    }
    board->avr->pc = pc + 2;
    board->avr->cycle += 1;
    return true;
}

/* Everything about an instruction that has a note. true: it is done or must not be executed. */
static bool before(board_t *board, uint32_t pc, unsigned note)
{
    const uint8_t *at = &board->avr->flash[pc];
    uint16_t opcode = (uint16_t)(at[0] | at[1] << 8);
    if (note & NOTE_STOP) {
        board->cpu.note[pc / 2] &= (uint16_t)~NOTE_STOP;
        board->stop_at = UINT32_MAX;
        board_end_run(board, BOARD_STOP_ADDRESS);
        return true;
    }
    if (note & NOTE_RETURN) {
        probe_leave(board, pc);
    }
    if ((note & NOTE_PROBE) && sweep_enter(board, pc)) {
        return true; /* once more: an interrupt may come first */
    }
    if (note & NOTE_PROBE) {
        probe_enter(board, pc);
    }
    if ((note & NOTE_WRONG) && refuse_opcode(board, pc, opcode)) {
        return true;
    }
    if ((note & NOTE_FLASH) && flash_before_lpm(board, pc, opcode)) {
        return true;
    }
    return (note & NOTE_SLEEP) && sleep_now(board);
}

static void crashed(board_t *board)
{
    board->avr->state = cpu_Running;
    violation_note(board, VIOLATION_ADDRESS, "data access or jump outside the memory");
}

static void cpu_step(board_t *board)
{
    avr_t *avr = board->avr;
    cpu_t *cpu = &board->cpu;
    uint32_t pc = avr->pc & (M128_FLASH_BYTES - 1);
    avr->pc = pc;
    cpu->enabled_before = avr->sreg[S_I];
    if (pc < cpu->fetch_floor &&
        violation_note(board, VIOLATION_RWW_FETCH, "instruction fetch from 0x%05X while that flash is busy", pc)) {
        return;
    }
    unsigned note = cpu->note[pc >> 1];
    if ((note & NOTE_BEFORE) && before(board, pc, note)) {
        return;
    }
    avr->run_cycle_count = 1; /* or avr_run_one() runs on by itself */
    avr->pc = avr_run_one(avr);
    if (note & NOTE_STACK) {
        stack_moved(board, pc, opcode_is_push(avr->flash[pc + 1]));
    }
    if (note & NOTE_RETI) {
        interrupt_return(board);
    }
    if (avr->state != cpu_Running) {
        crashed(board);
    }
}

/* simavr's own timers set flags in the data space; interrupt.c looks there, so simavr's queue is thrown away. */
static void run_timers(avr_t *avr)
{
    avr_cycle_timer_process(avr);
    avr_int_pending_t *queue = &avr->interrupts.pending;
    while (queue->read != queue->write) {
        queue->buffer[queue->read]->pending = 0;
        queue->read = (queue->read + 1) & (avr_int_pending_fifo_size - 1);
    }
}

static void skip_to(board_t *board, uint64_t limit)
{
    avr_t *avr = board->avr;
    uint64_t next = board->events.next < limit ? board->events.next : limit;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    if (timer && timer->when < next) {
        next = timer->when;
    }
    if (next > avr->cycle) {
        board->cpu.idle_cycles += next - avr->cycle;
        avr->cycle = next;
    }
}

/* Stands still as long as GDB wants it to; only board_stop(), from another thread, ends that. */
static void wait_for_gdb(board_t *board)
{
    avr_t *avr = board->avr;
    do {
        avr_gdb_processor(avr, avr->state == cpu_Stopped ? 1000 : 0);
    } while (avr->state == cpu_Stopped && !board->stopped);
}

static void step_under_gdb(board_t *board)
{
    avr_t *avr = board->avr;
    wait_for_gdb(board);
    if (board->stopped) {
        return;
    }
    bool single = avr->state == cpu_Step;
    avr->state = cpu_Running;
    cpu_step(board);
    if (single) {
        avr->state = cpu_StepDone;
    }
}

static void run_due_timers(board_t *board)
{
    avr_t *avr = board->avr;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    if (timer && timer->when <= avr->cycle) {
        run_timers(avr);
        waits_disturbed(board);
    }
}

/* Takes an interrupt, or skips to the next thing that can happen when no instruction is executed now. false: neither. */
static inline bool stands_still(board_t *board, bool is_due)
{
    avr_t *avr = board->avr;
    const cpu_t *cpu = &board->cpu;
    if (is_due && cpu->enabled_before && interrupt_take(board)) {
        waits_disturbed(board);
    } else if (cpu->sleeping || !board->power.on || board->reset.held) {
        skip_to(board, NEVER);
    } else if (cpu->halted_until > avr->cycle) {
        skip_to(board, cpu->halted_until);
    } else {
        return false;
    }
    return true;
}

static inline void execute(board_t *board)
{
    avr_t *avr = board->avr;
    if (avr->gdb) {
        step_under_gdb(board);
        return;
    }
    bool is_swept = board->sweep.is_open;
    uint32_t pc = avr->pc;
    cpu_step(board);
    if (board->waits.on) {
        waits_passed(board, pc);
    }
    if (is_swept) {
        sweep_passed(board);
    }
}

/* Quick, for it is asked before most instructions: false means surely not. */
static inline bool interrupt_is_due(const board_t *board)
{
    const uint8_t *data = board->avr->data;
    return board->avr->sreg[S_I] &&
           (board->cpu.lines || (data[M128_TIFR] & data[M128_TIMSK]) || (data[M128_ETIFR] & data[M128_ETIMSK]) ||
            (data[M128_EIFR] & data[M128_EIMSK]) || (data[M128_ADCSRA] & ADCSRA_ADIE));
}

/* Runs instructions that only compute, up to one with a note or the next thing that can happen: nothing that cpu_run()
 * looks at changes meanwhile. Looking costs as much as executing. false: there is none. */
static bool run_plain(board_t *board)
{
    avr_t *avr = board->avr;
    cpu_t *cpu = &board->cpu;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    uint64_t end = timer && timer->when < board->events.next ? timer->when : board->events.next;
    unsigned stops = board->waits.on ? ~0u : ~(unsigned)NOTE_BACK;
    bool any = false;
    while (avr->cycle < end && avr->state == cpu_Running && !board->stopped) {
        uint32_t pc = avr->pc & (M128_FLASH_BYTES - 1);
        if ((cpu->note[pc >> 1] & stops) || pc < cpu->fetch_floor) {
            break;
        }
        avr->pc = pc;
        avr->run_cycle_count = 1;
        avr->pc = avr_run_one(avr);
        any = true;
    }
    if (any) {
        cpu->enabled_before = avr->sreg[S_I];
    }
    if (avr->state != cpu_Running) {
        crashed(board);
    }
    return any;
}

void cpu_run(board_t *board)
{
    waits_disturbed(board);
    while (!board->stopped) {
        if (board->events.next <= board->avr->cycle) {
            events_run(board);
            waits_disturbed(board);
            continue;
        }
        if (board->sweep.is_open && sweep_raise(board)) {
            continue;
        }
        run_due_timers(board);
        bool is_due = interrupt_is_due(board);
        if (stands_still(board, is_due)) {
            continue;
        }
        if (is_due || board->avr->gdb || board->sweep.is_open || !run_plain(board)) {
            execute(board);
        }
    }
}

uint32_t board_step(board_t *board)
{
    uint64_t from = board->avr->cycle;
    board->stopped = false;
    events_run(board);
    run_due_timers(board);
    if (!stands_still(board, interrupt_is_due(board))) {
        execute(board);
    }
    return (uint32_t)(board->avr->cycle - from);
}

/* avr_reset() sets the clock to 0 and the stack pointer to the end of the SRAM; the chip does neither. */
void cpu_reset(board_t *board, uint32_t pc)
{
    avr_t *avr = board->avr;
    uint64_t now = avr->cycle;
    avr->reset_pc = pc;
    avr_reset(avr);
    avr->cycle = now;
    avr->state = cpu_Running;
    avr->data[M128_SPL] = 0;
    avr->data[M128_SPH] = 0;
    board->cpu.lines = 0;
    board->cpu.sleeping = false;
    board->cpu.enabled_before = false;
    board->cpu.fetch_floor = 0;
    board->cpu.halted_until = 0;
    board->cpu.vector_base = 0;
    board->cpu.depth = 0;
}

void cpu_init(board_t *board)
{
    board->stop_at = UINT32_MAX;
    cpu_flash_changed(board, 0, M128_FLASH_BYTES);
}
