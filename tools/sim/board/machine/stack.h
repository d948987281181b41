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

/* The stack pointer has changed: pushed by a push, a call or an interrupt; else by an OUT to SPL. pc: who did it. */
void stack_moved(stack_guard_t *stack, uint32_t pc, bool pushed);

/* For board_stack_low() and board_stack_headroom(). */
uint32_t stack_low(const stack_guard_t *stack);
uint32_t stack_headroom(const stack_guard_t *stack);

/* Where the chip's stack pointer points to now. */
uint16_t stack_pointer(const avr_t *avr);

#endif
