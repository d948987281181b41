/* SPDX-License-Identifier: MIT
 * timer.h - the 16-bit timers 1 and 3. */
#ifndef SIM_TIMER_H
#define SIM_TIMER_H

#include "machine.h"

typedef struct {
    machine_t *machine;
    uint8_t index, mode, temp; /* index 0: timer 1, 1: timer 3 */
    uint16_t count, ocr[3], icr, prescale;
    uint64_t at; /* count is valid at this cycle */
} timer16_t;

typedef struct {
    machine_t *machine;
    timer16_t timer[2];
} timers_t;

void timers_init(timers_t *timers, machine_t *machine);
void timers_reset(timers_t *timers);

#endif
