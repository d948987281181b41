/* SPDX-License-Identifier: MIT
 * sweep.h - an interrupt at every place of a function. */
#ifndef SIM_SWEEP_H
#define SIM_SWEEP_H

#include "board_debug.h"
#include "interrupt.h"

#define SWEEPS 32

typedef struct { char name[64]; uint32_t address; int vector; uint8_t byte; sweep_t result; } sweep_entry_t;

typedef struct {
    machine_t *machine;
    const interrupts_t *interrupts;
    sweep_entry_t entries[SWEEPS];
    int count, current;
    /* The call of a swept function that is being executed */
    bool is_open;
    bool is_raised;   /* the interrupt of this call has been raised */
    uint8_t depth;    /* of interrupts, when it began */
    uint16_t sp;
    uint32_t back;    /* where it returns to */
    uint32_t passed;  /* instructions executed in it so far */
    uint64_t raised_at;
    uint64_t taken;   /* interrupts of the vector before it was raised */
} sweeps_t;

bool sweep_enter(sweeps_t *sweeps, uint32_t pc); /* first instruction of a function; true: a swept call begins */
bool sweep_raise(sweeps_t *sweeps);              /* before an instruction; true: the interrupt was raised just now */
void sweep_passed(sweeps_t *sweeps);             /* an instruction was executed */
void sweep_reset(sweeps_t *sweeps);

/* For board_sweep() and its like; address UINT32_MAX: there is no such function. */
bool sweep_add(sweeps_t *sweeps, const char *function, uint32_t address, int vector, uint8_t byte);
const sweep_t *sweep_result(const sweeps_t *sweeps, const char *function);
void sweep_end(sweeps_t *sweeps);

#endif
