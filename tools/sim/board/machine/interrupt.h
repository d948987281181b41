/* SPDX-License-Identifier: MIT
 * interrupt.h - interrupt requests, entry, return, and raising an interrupt by hand. */
#ifndef SIM_INTERRUPT_H
#define SIM_INTERRUPT_H

#include "machine.h"
#include "stack.h"

#define INTERRUPTS_NESTED 16 /* measured and checked levels */

/* What an interrupt must restore. */
typedef struct {
    uint8_t r[32], flags, rampz; /* flags: SREG without I */
} registers_t;

typedef struct {
    machine_t *machine;
    stack_guard_t *stack;
    uint8_t depth; /* nesting level */
    uint64_t entered[INTERRUPTS_NESTED];
    uint8_t vector[INTERRUPTS_NESTED];
    registers_t found[INTERRUPTS_NESTED]; /* at interrupt entry */
    uint64_t cycles;                      /* spent in interrupts that have returned */
    uint64_t count[VECTOR_COUNT], longest[VECTOR_COUNT];
} interrupts_t;

bool interrupt_take(interrupts_t *interrupts);   /* true: one was taken */
void interrupt_return(interrupts_t *interrupts); /* a RETI was executed */

/* Cycles spent in interrupts so far, including one in progress. */
uint64_t interrupt_cycles(const interrupts_t *interrupts);

/* Raises an interrupt as if its cause had just occurred (board_interrupt()). false: it cannot be raised. */
bool interrupt_can_be_raised(const machine_t *machine, int vector);
bool interrupt_raise(machine_t *machine, int vector, uint8_t byte);

#endif
