/* SPDX-License-Identifier: MIT
 * irq.h - the PC's version of hal/avr/irq.h: there are no interrupts. */
#ifndef IRQ_H
#define IRQ_H

#include <stdint.h>

typedef uint8_t irq_state_t;

static inline void irq_barrier(void)
{
}

static inline irq_state_t irq_save(void)
{
    return 0;
}

static inline void irq_restore(irq_state_t state)
{
    (void)state;
}

static inline void irq_disable(void)
{
}

static inline void irq_enable(void)
{
}

#endif
