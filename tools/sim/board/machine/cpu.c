/* SPDX-License-Identifier: MIT */
#include "cpu.h"

#include <simavr/sim_core.h>
#include <simavr/sim_gdb.h>

#include "opcode.h"

#define NOTE_BEFORE (NOTE_FLASH | NOTE_SLEEP | NOTE_WRONG | NOTE_PROBE | NOTE_SWEEP | NOTE_RETURN | NOTE_STOP)

static bool sleep_now(machine_t *machine)
{
    avr_t *avr = machine->avr;
    bool is_watched = machine->events.when[EVENT_WATCHDOG] != NEVER;
    uint8_t mcucr = avr->data[M128_MCUCR];
    if (mcucr & MCUCR_SE) {
        if (mcucr & MCUCR_SM) {
            return violation_note(machine, VIOLATION_UNMODELLED, "sleep mode other than idle (MCUCR 0x%02X)", mcucr);
        }
        if (!avr->sreg[S_I] && !is_watched &&
            violation_note(machine, VIOLATION_SLEEP, "sleep with interrupts off and no watchdog: it never wakes")) {
            return true;
        }
        machine->sleeping = true;
    }
    avr->pc += 2;
    avr->cycle += 1;
    return true;
}

static bool refuse_opcode(machine_t *machine, uint32_t pc, uint16_t opcode)
{
    if (opcode == 0xFFFF) {
        return violation_note(machine, VIOLATION_ERASED, "execution ran into erased flash");
    }
    if (violation_note(machine, VIOLATION_ILLEGAL, "opcode 0x%04X at 0x%05X is no instruction", opcode, pc)) {
        return true;
    }
    machine->avr->pc = pc + 2;
    machine->avr->cycle += 1;
    return true;
}

/* Handles an instruction that has a note. true: it is done, or must not be executed. */
static bool before(cpu_t *cpu, uint32_t pc, unsigned note)
{
    machine_t *machine = &cpu->machine;
    const uint8_t *at = &machine->avr->flash[pc];
    uint16_t opcode = (uint16_t)(at[0] | at[1] << 8);
    if (note & NOTE_STOP) {
        cpu_stop_at(cpu, UINT32_MAX);
        machine_end_run(machine, BOARD_STOP_ADDRESS);
        return true;
    }
    if (note & NOTE_RETURN) {
        probe_leave(&cpu->probes, pc);
    }
    if ((note & NOTE_SWEEP) && sweep_enter(&cpu->sweeps, pc)) {
        return true; /* loop again: an interrupt may come first */
    }
    if (note & NOTE_PROBE) {
        probe_enter(&cpu->probes, pc);
    }
    if ((note & NOTE_WRONG) && refuse_opcode(machine, pc, opcode)) {
        return true;
    }
    if ((note & NOTE_FLASH) && machine->before_lpm(machine->before_lpm_context, pc, opcode)) {
        return true;
    }
    return (note & NOTE_SLEEP) && sleep_now(machine);
}

static void crashed(machine_t *machine)
{
    machine->avr->state = cpu_Running;
    violation_note(machine, VIOLATION_ADDRESS, "data access or jump outside the memory");
}

static void run_one(cpu_t *cpu)
{
    machine_t *machine = &cpu->machine;
    avr_t *avr = machine->avr;
    uint32_t pc = avr->pc & (M128_FLASH_BYTES - 1);
    avr->pc = pc;
    cpu->enabled_before = avr->sreg[S_I];
    if (pc < machine->fetch_floor &&
        violation_note(machine, VIOLATION_RWW_FETCH, "instruction fetch from 0x%05X while that flash is busy", pc)) {
        return;
    }
    unsigned note = machine->note[pc >> 1];
    if ((note & NOTE_BEFORE) && before(cpu, pc, note)) {
        return;
    }
    avr->run_cycle_count = 1; /* otherwise avr_run_one() goes on by itself */
    avr->pc = avr_run_one(avr);
    if (note & NOTE_STACK) {
        stack_moved(&cpu->stack, pc, opcode_is_push(avr->flash[pc + 1]));
    }
    if (note & NOTE_RETI) {
        interrupt_return(&cpu->interrupts);
    }
    if (avr->state != cpu_Running && (!avr->gdb || machine_take_error(machine))) {
        crashed(machine);
    }
}

/* simavr's timers set flags in the data space, where interrupt.c reads them. So simavr's own queue is discarded. */
static void run_timers(avr_t *avr)
{
    avr_cycle_timer_process(avr);
    avr_int_pending_t *queue = &avr->interrupts.pending;
    while (queue->read != queue->write) {
        queue->buffer[queue->read]->pending = 0;
        queue->read = (queue->read + 1) & (avr_int_pending_fifo_size - 1);
    }
}

static void skip_to(cpu_t *cpu, uint64_t limit)
{
    const machine_t *machine = &cpu->machine;
    avr_t *avr = machine->avr;
    uint64_t next = machine->events.next < limit ? machine->events.next : limit;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    if (timer && timer->when < next) {
        next = timer->when;
    }
    if (next > avr->cycle) {
        cpu->idle_cycles += next - avr->cycle;
        avr->cycle = next;
    }
}

/* Blocks while GDB has stopped the chip. Only board_stop() from another thread ends that. */
static void wait_for_gdb(const machine_t *machine)
{
    avr_t *avr = machine->avr;
    do {
        avr_gdb_processor(avr, avr->state == cpu_Stopped ? 1000 : 0);
    } while (avr->state == cpu_Stopped && !machine->stopped);
}

static void step_under_gdb(cpu_t *cpu)
{
    avr_t *avr = cpu->machine.avr;
    wait_for_gdb(&cpu->machine);
    if (cpu->machine.stopped) {
        return;
    }
    bool single = avr->state == cpu_Step;
    avr->state = cpu_Running;
    (void)machine_take_error(&cpu->machine); /* an older one */
    run_one(cpu);
    if (single && avr->state == cpu_Running) {
        avr->state = cpu_StepDone;
    }
}

static void run_due_timers(cpu_t *cpu)
{
    avr_t *avr = cpu->machine.avr;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    if (timer && timer->when <= avr->cycle) {
        run_timers(avr);
        waits_disturbed(&cpu->waits);
    }
}

/* Takes an interrupt, or skips to the next event while the CPU executes nothing. false: neither. */
static inline bool stands_still(cpu_t *cpu, bool is_due)
{
    const machine_t *machine = &cpu->machine;
    if (is_due && cpu->enabled_before && interrupt_take(&cpu->interrupts)) {
        waits_disturbed(&cpu->waits);
    } else if (machine->sleeping || !machine->powered || machine->held) {
        skip_to(cpu, NEVER);
    } else if (machine->halted_until > machine->avr->cycle) {
        skip_to(cpu, machine->halted_until);
    } else {
        return false;
    }
    return true;
}

static inline void execute(cpu_t *cpu)
{
    const avr_t *avr = cpu->machine.avr;
    if (avr->gdb) {
        step_under_gdb(cpu);
        return;
    }
    bool is_swept = cpu->sweeps.is_open;
    uint32_t pc = avr->pc;
    run_one(cpu);
    if (cpu->waits.on) {
        waits_passed(&cpu->waits, pc);
    }
    if (is_swept) {
        sweep_passed(&cpu->sweeps);
    }
}

/* A quick test, made before most instructions. false: certainly none. */
static inline bool interrupt_is_due(const machine_t *machine)
{
    const uint8_t *data = machine->avr->data;
    return machine->avr->sreg[S_I] &&
           (machine->lines || (data[M128_TIFR] & data[M128_TIMSK]) || (data[M128_ETIFR] & data[M128_ETIMSK]) ||
            (data[M128_EIFR] & data[M128_EIMSK]) || (data[M128_ADCSRA] & ADCSRA_ADIE));
}

/* Runs instructions that only compute, up to one with a note or the next event. Nothing that cpu_run() checks can
 * change meanwhile, and checking costs as much as executing. false: there was none. */
static bool run_plain(cpu_t *cpu)
{
    machine_t *machine = &cpu->machine;
    avr_t *avr = machine->avr;
    avr_cycle_timer_slot_p timer = avr->cycle_timers.timer;
    uint64_t end = timer && timer->when < machine->events.next ? timer->when : machine->events.next;
    unsigned stops = cpu->waits.on ? ~0u : ~(unsigned)NOTE_BACK;
    bool any = false;
    while (avr->cycle < end && avr->state == cpu_Running && !machine->stopped) {
        uint32_t pc = avr->pc & (M128_FLASH_BYTES - 1);
        if ((machine->note[pc >> 1] & stops) || pc < machine->fetch_floor) {
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
        crashed(machine);
    }
    return any;
}

void cpu_run(cpu_t *cpu)
{
    machine_t *machine = &cpu->machine;
    waits_disturbed(&cpu->waits);
    while (!machine->stopped) {
        if (machine->events.next <= machine->avr->cycle) {
            events_run(&machine->events, machine->avr->cycle);
            waits_disturbed(&cpu->waits);
            continue;
        }
        if (cpu->sweeps.is_open && sweep_raise(&cpu->sweeps)) {
            continue;
        }
        run_due_timers(cpu);
        bool is_due = interrupt_is_due(machine);
        if (stands_still(cpu, is_due)) {
            continue;
        }
        if (is_due || machine->avr->gdb || cpu->sweeps.is_open || !run_plain(cpu)) {
            execute(cpu);
        }
    }
}

uint32_t cpu_step(cpu_t *cpu)
{
    machine_t *machine = &cpu->machine;
    uint64_t from = machine->avr->cycle;
    machine->stopped = false;
    events_run(&machine->events, from);
    waits_disturbed(&cpu->waits);
    run_due_timers(cpu);
    if (!stands_still(cpu, interrupt_is_due(machine))) {
        execute(cpu);
    }
    return (uint32_t)(machine->avr->cycle - from);
}

void cpu_stop_at(cpu_t *cpu, uint32_t flash_address)
{
    if (cpu->stop_at != UINT32_MAX) {
        machine_unmark(&cpu->machine, cpu->stop_at, NOTE_STOP);
    }
    cpu->stop_at = flash_address < M128_FLASH_BYTES ? flash_address & ~1u : UINT32_MAX;
    if (cpu->stop_at != UINT32_MAX) {
        machine_mark(&cpu->machine, cpu->stop_at, NOTE_STOP);
    }
}

/* avr_reset() sets the clock to 0 and the stack pointer to the end of the SRAM. The chip does neither. */
void cpu_reset(cpu_t *cpu, uint32_t pc)
{
    machine_t *machine = &cpu->machine;
    avr_t *avr = machine->avr;
    uint64_t now = avr->cycle;
    avr->reset_pc = pc;
    avr_reset(avr);
    avr->cycle = now;
    avr->state = cpu_Running;
    avr->data[M128_SPL] = 0;
    avr->data[M128_SPH] = 0;
    machine->lines = 0;
    machine->sleeping = false;
    machine->fetch_floor = 0;
    machine->halted_until = 0;
    machine->vector_base = 0;
    cpu->enabled_before = false;
    cpu->interrupts.depth = 0;
    stack_reset(&cpu->stack);
    probe_reset(&cpu->probes);
    sweep_reset(&cpu->sweeps);
}

bool cpu_init(cpu_t *cpu, uint32_t seed)
{
    machine_t *machine = &cpu->machine;
    cpu->stack.machine = cpu->interrupts.machine = cpu->probes.machine = cpu->sweeps.machine = cpu->waits.machine = machine;
    cpu->interrupts.stack = &cpu->stack;
    cpu->probes.interrupts = cpu->sweeps.interrupts = &cpu->interrupts;
    cpu->stop_at = UINT32_MAX;
    return machine_init(machine, seed);
}
