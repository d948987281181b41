/* SPDX-License-Identifier: MIT
 * fake_time.h - time for tick.h and clock.h. It advances only when a test advances it, by clock_wait_us, and by a
 * settable step at each clock_now (default 2 half us), so that loops with a time-out end. */
#ifndef FAKE_TIME_H
#define FAKE_TIME_H

#include <stdint.h>

void fake_time_reset(void);
void fake_time_ticks(uint16_t ticks);             /* lets that many ticks pass */
void fake_time_half_us(uint32_t half_us);         /* advances the clock and, every 15,625 half us, the tick */
void fake_time_set_step(uint16_t half_us);

#endif
