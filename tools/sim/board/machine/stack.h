/* SPDX-License-Identifier: MIT
 * stack.h - the guard between stack and variables. */
#ifndef SIM_STACK_H
#define SIM_STACK_H

#include "machine.h"

typedef struct {
    machine_t *machine;
    bool set;
    uint16_t low, limit;
} stack_guard_t;

void stack_reset(stack_guard_t *stack);

/* Called after a change of the stack pointer. pushed: by a push, a call or an interrupt; otherwise by an OUT to SPL.
 * pc: address of the instruction. */
void stack_moved(stack_guard_t *stack, uint32_t pc, bool pushed);

/* For board_stack_low() and board_stack_headroom(). */
uint32_t stack_low(const stack_guard_t *stack);
uint32_t stack_headroom(const stack_guard_t *stack);

/* Current stack pointer of the chip. */
uint16_t stack_pointer(const avr_t *avr);

#endif
