/* SPDX-License-Identifier: MIT
 * fake_time.h - time for tick.h and clock.h. It advances only when a test advances it, by clock_wait_us, and by 2 half us
 * at each clock_now, so that loops with a time-out end. */
#ifndef FAKE_TIME_H
#define FAKE_TIME_H

#include <stdint.h>

void fake_time_reset(void);
void fake_time_ticks(uint16_t ticks);             /* lets that many ticks pass */

#endif
