/* SPDX-License-Identifier: MIT
 * clock.h - a free-running count of half microseconds (Timer 3), for time-outs and measurements.
 * 16 bits, wraps every 32.768 ms: use it for shorter spans, and ticks (tick.h) for longer ones. Main loop only (an ISR may
 * call clock_now_noirq). No RAM. */
#ifndef CLOCK_H
#define CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#define CLOCK_PER_US 2u
#define CLOCK_PER_MS 2000u

void clock_init(void);

/* Half microseconds, modulo 65536. */
uint16_t clock_now(void);

/* The same, for ISRs and for code that runs with interrupts off. */
uint16_t clock_now_noirq(void);

/* Whether more than `span` half microseconds (below 32768) have passed since `since`; meaningless if called less often than
 * every 16 ms. */
static inline bool clock_is_past(uint16_t now, uint16_t since, uint16_t span)
{
    return (uint16_t)(now - since) > span;
}

/* Busy wait; interrupts stay on. */
void clock_wait_us(uint16_t us);

#endif
