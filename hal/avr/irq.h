/* SPDX-License-Identifier: MIT
 * irq.h - code that must not be interrupted, AVR version (host version: hal/host/irq.h). May be included anywhere.
 *     irq_state_t state = irq_save();  ... a few instructions ...  irq_restore(state);
 * Nests. irq_enable is only for board start-up and for the sleep of board_idle. */
#ifndef IRQ_H
#define IRQ_H

#include <avr/interrupt.h>
#include <avr/io.h>
#include <stdint.h>

typedef uint8_t irq_state_t;

/* Keeps the compiler from moving memory accesses across this point. */
static inline void irq_barrier(void)
{
    __asm__ volatile("" ::: "memory");
}

static inline irq_state_t irq_save(void)
{
    irq_state_t state = SREG;
    cli();
    return state;
}

static inline void irq_restore(irq_state_t state)
{
    irq_barrier();
    SREG = state;
}

static inline void irq_disable(void)
{
    cli();
}

static inline void irq_enable(void)
{
    sei();
}

#endif
