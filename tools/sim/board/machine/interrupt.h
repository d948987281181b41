/* SPDX-License-Identifier: MIT
 * interrupt.h - requests, taking an interrupt, coming back from one, and raising one by hand. */
#ifndef SIM_INTERRUPT_H
#define SIM_INTERRUPT_H

#include "machine.h"
#include "stack.h"

#define INTERRUPTS_NESTED 16 /* that are measured and checked */

/* What an interrupt must leave as it found it. */
typedef struct {
    uint8_t r[32], flags, rampz; /* flags: SREG without I */
} registers_t;

typedef struct {
    machine_t *machine;
    stack_guard_t *stack;
    uint8_t depth; /* interrupts nested */
    uint64_t entered[INTERRUPTS_NESTED];
    uint8_t vector[INTERRUPTS_NESTED];
    registers_t found[INTERRUPTS_NESTED]; /* when the interrupt was taken */
    uint64_t cycles;                      /* spent in those that are over */
    uint64_t count[VECTOR_COUNT], longest[VECTOR_COUNT];
} interrupts_t;

bool interrupt_take(interrupts_t *interrupts);   /* true: one was taken */
void interrupt_return(interrupts_t *interrupts); /* a RETI was executed */

/* Cycles in interrupts up to now, one in progress included. */
uint64_t interrupt_cycles(const interrupts_t *interrupts);

/* As if its cause had just come (board_interrupt()). false: it cannot be raised. */
bool interrupt_can_be_raised(const machine_t *machine, int vector);
bool interrupt_raise(machine_t *machine, int vector, uint8_t byte);

#endif
