/* SPDX-License-Identifier: MIT
 * cpu.h - executing instructions and taking interrupts, with a look at each. */
#ifndef SIM_CPU_H
#define SIM_CPU_H

#include "interrupt.h"
#include "machine.h"
#include "probe.h"
#include "stack.h"
#include "sweep.h"
#include "waits.h"

typedef struct {
    machine_t machine; /* not a pointer: one base register in the loop, 4 % of all simulated time */
    bool enabled_before;  /* I was set before the last instruction too: an interrupt may come */
    uint64_t idle_cycles;
    uint32_t stop_at;
    interrupts_t interrupts;
    stack_guard_t stack;
    probes_t probes;
    sweeps_t sweeps;
    waits_t waits;
} cpu_t;

bool cpu_init(cpu_t *cpu, uint32_t seed); /* false: libsimavr has no ATmega128 or there is no memory */
void cpu_reset(cpu_t *cpu, uint32_t pc);
void cpu_run(cpu_t *cpu);      /* until machine_end_run() */
uint32_t cpu_step(cpu_t *cpu); /* one instruction or interrupt response; its cycles */

/* Ends the run before the instruction there, once. UINT32_MAX: nowhere. */
void cpu_stop_at(cpu_t *cpu, uint32_t flash_address);

#endif
