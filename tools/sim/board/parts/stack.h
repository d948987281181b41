/* SPDX-License-Identifier: MIT
 * stack.h - the guard between stack and variables. */
#ifndef SIM_PARTS_STACK_H
#define SIM_PARTS_STACK_H

#include "board.h"

typedef struct {
    bool set;
    uint16_t low, limit;
} stack_guard_t;

void stack_reset(board_t *board);

/* The stack pointer has changed: pushed by a push, a call or an interrupt; else by an OUT to SPL. pc: who did it. */
void stack_moved(board_t *board, uint32_t pc, bool pushed);

#endif
