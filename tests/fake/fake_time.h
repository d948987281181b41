/* SPDX-License-Identifier: MIT
 * fake_time.h - time for tick.h and clock.h: it stands still unless a test moves it. clock_wait_us moves it; so does each
 * clock_now, by a settable step (default 2 half us), so that loops with a time-out end. */
#ifndef FAKE_TIME_H
#define FAKE_TIME_H

#include <stdint.h>

void fake_time_reset(void);
void fake_time_ticks(uint16_t ticks);             /* that many ticks go by */
void fake_time_half_us(uint32_t half_us);         /* moves the clock and, every 15,625 of them, the tick */
void fake_time_set_step(uint16_t half_us);

#endif
