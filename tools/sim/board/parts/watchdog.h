/* SPDX-License-Identifier: MIT
 * watchdog.h - the watchdog and its timed sequence. The board handles its time-out (EVENT_WATCHDOG). */
#ifndef SIM_WATCHDOG_H
#define SIM_WATCHDOG_H

#include "machine.h"

typedef struct {
    machine_t *machine;
    uint8_t wdtcr;
    uint64_t open_until; /* end of the timed sequence */
} watchdog_t;

void watchdog_init(watchdog_t *watchdog, machine_t *machine);
void watchdog_reset(watchdog_t *watchdog);
void watchdog_feed(watchdog_t *watchdog); /* executes a WDR instruction */

#endif
