/* SPDX-License-Identifier: MIT
 * events.h - events at a point of simulated time, one slot each. They are handled between two instructions, in the
 * order of their time. simavr's own cycle timers do not survive avr_reset(). */
#ifndef SIM_EVENTS_H
#define SIM_EVENTS_H

#include <stdint.h>

#define NEVER UINT64_MAX

/* Order of simultaneous events: arrivals before transmissions, the end of the run last. */
typedef enum {
    EVENT_POWER, EVENT_BUS, EVENT_CONSOLE, EVENT_UART0, EVENT_UART1, EVENT_SPM, EVENT_EEPROM, EVENT_WATCHDOG, EVENT_CHARGER,
    EVENT_TIMER1, EVENT_TIMER3, EVENT_LIMIT, EVENT_COUNT
} event_t;
typedef void (*event_fn)(void *context, uint64_t now);

typedef struct {
    uint64_t next; /* the smallest of when[] */
    uint64_t when[EVENT_COUNT];
    struct { event_fn run; void *context; } handler[EVENT_COUNT];
} events_t;

void events_init(events_t *events); /* all NEVER */
void events_handle(events_t *events, event_t event, event_fn run, void *context);

/* when: a cycle, or NEVER. An event that is already due is handled before the next instruction. */
void event_at(events_t *events, event_t event, uint64_t when);
void events_run(events_t *events, uint64_t now); /* handles everything that is due by now */

#endif
