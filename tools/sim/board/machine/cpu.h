/* SPDX-License-Identifier: MIT
 * cpu.h - executes instructions and takes interrupts, with checks on each. */
#ifndef SIM_CPU_H
#define SIM_CPU_H

#include "interrupt.h"
#include "machine.h"
#include "probe.h"
#include "stack.h"
#include "sweep.h"
#include "waits.h"

typedef struct {
    machine_t machine; /* no pointer: one base register in the loop saves 4 % of all simulated time */
    bool enabled_before;  /* I was already set before the last instruction: an interrupt may be taken */
    uint64_t idle_cycles;
    uint32_t stop_at;
    interrupts_t interrupts;
    stack_guard_t stack;
    probes_t probes;
    sweeps_t sweeps;
    waits_t waits;
} cpu_t;

bool cpu_init(cpu_t *cpu, uint32_t seed); /* false: libsimavr has no ATmega128, or out of memory */
void cpu_reset(cpu_t *cpu, uint32_t pc);
void cpu_run(cpu_t *cpu);      /* until machine_end_run() */
uint32_t cpu_step(cpu_t *cpu); /* one instruction or interrupt response; its cycles */

/* Ends the run once, before the instruction at this address. UINT32_MAX: never. */
void cpu_stop_at(cpu_t *cpu, uint32_t flash_address);

#endif
