/* SPDX-License-Identifier: MIT
 * sweep.h - an interrupt at every place of a function: sweep.c. */
#ifndef SIM_PARTS_SWEEP_H
#define SIM_PARTS_SWEEP_H

#include "board_debug.h"

struct sweeps;

/* The call of a swept function that is being executed. */
typedef struct {
    bool is_open;
    bool is_raised;   /* the interrupt of this call has been raised */
    uint8_t depth;    /* of interrupts, when it began */
    uint16_t sp;
    uint32_t back;    /* where it returns to */
    uint32_t passed;  /* instructions executed in it so far */
    uint64_t raised_at;
    uint64_t taken;   /* interrupts of the vector before it was raised */
} sweep_call_t;

bool sweep_enter(board_t *board, uint32_t pc); /* first instruction of a function; true: a swept call begins */
bool sweep_raise(board_t *board);              /* before an instruction; true: the interrupt was raised just now */
void sweep_passed(board_t *board);             /* an instruction was executed */
void sweep_mark(board_t *board);               /* sets the notes again after the flash changed */
void sweep_reset(board_t *board);
void sweep_free(board_t *board);

#endif
