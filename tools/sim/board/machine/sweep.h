/* SPDX-License-Identifier: MIT
 * sweep.h - raises an interrupt at every place of a function. */
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
    /* The current call of a swept function */
    bool is_open;
    bool is_raised;   /* the interrupt of this call has been raised */
    uint8_t depth;    /* interrupt nesting level when the call began */
    uint16_t sp;
    uint32_t back;    /* return address */
    uint32_t passed;  /* instructions executed in it so far */
    uint64_t raised_at;
    uint64_t taken;   /* interrupts of the vector before this one was raised */
} sweeps_t;

bool sweep_enter(sweeps_t *sweeps, uint32_t pc); /* at the first instruction of a function; true: a swept call begins */
bool sweep_raise(sweeps_t *sweeps);              /* before an instruction; true: the interrupt was raised just now */
void sweep_passed(sweeps_t *sweeps);             /* after an instruction */
void sweep_reset(sweeps_t *sweeps);

/* For board_sweep() and the like. address UINT32_MAX: no such function. */
bool sweep_add(sweeps_t *sweeps, const char *function, uint32_t address, int vector, uint8_t byte);
const sweep_t *sweep_result(const sweeps_t *sweeps, const char *function);
void sweep_end(sweeps_t *sweeps);

#endif
