/* SPDX-License-Identifier: MIT
 * tick.h - the time base of all motion: 128 ticks per second, exactly 125,000 cycles of 16 MHz each (Timer 1).
 * The main loop takes every tick once; a tick that is not taken before the next one counts as missed.
 * Main loop only. */
#ifndef TICK_H
#define TICK_H

#include <stdbool.h>
#include <stdint.h>

#define TICK_HZ 128u
#define TICK_CYCLES 125000ul

/* Starts the timer; the first tick comes 7.8 ms later. Ticks need interrupts on. */
void tick_init(void);

/* Ticks since tick_init; wraps after 388 days. */
uint32_t tick_now(void);

/* The low 16 bits (wraps after 512 s), for differences. Cheaper. */
uint16_t tick_now16(void);

/* true once per tick: do the tick's work now. If several ticks have passed since the last call, returns true once and adds
 * the others to tick_missed. */
bool tick_take(void);

/* The ticks missed before the last one taken: how late the current tick is. */
uint16_t tick_late(void);

/* Whether tick_take would return true. */
bool tick_is_due(void);

/* Ticks since tick_init that were never taken; stops at 65535. */
uint16_t tick_missed(void);

/* Takes all ticks up to now without counting them as missed. Call it after work that blocks on purpose while nothing moves
 * (a servo search, a page write). */
void tick_forgive(void);

#endif
