/* SPDX-License-Identifier: MIT */
#include "clock.h"
#include "irq.h"

#include <avr/io.h>

_Static_assert(F_CPU / 8u == CLOCK_PER_MS * 1000ul, "prescaler 8");

void clock_init(void)
{
    TCCR3A = 0;
    TCCR3B = 0;
    TCNT3 = 0;
    ETIMSK = 0;
    TCCR3B = (1u << CS31);
}

/* Interrupts are off because both halves pass through the timer's single TEMP byte, which ISRs also use. */
uint16_t clock_now(void)
{
    irq_state_t state = irq_save();
    uint16_t now = TCNT3;
    irq_restore(state);
    return now;
}

uint16_t clock_now_noirq(void)
{
    return TCNT3;
}

void clock_wait_us(uint16_t us)
{
    while (us > 0) {
        uint16_t part = us > 10000u ? 10000u : us;
        uint16_t since = clock_now();
        while (!clock_is_past(clock_now(), since, part * CLOCK_PER_US)) {
        }
        us -= part;
    }
}
