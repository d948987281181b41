/* SPDX-License-Identifier: MIT
 * events.h - what happens at a moment of simulated time, one slot each. Events are handled between two instructions, in the
 * order of their time; simavr's own cycle timers do not survive avr_reset(). */
#ifndef SIM_PARTS_EVENTS_H
#define SIM_PARTS_EVENTS_H

#include "board.h"

#define NEVER UINT64_MAX

typedef enum {
    EVENT_LIMIT, EVENT_UART0, EVENT_UART1, EVENT_CONSOLE, EVENT_BUS, EVENT_SPM, EVENT_EEPROM, EVENT_WATCHDOG,
    EVENT_POWER, EVENT_CHARGER, EVENT_TIMER1, EVENT_TIMER3, EVENT_COUNT
} event_t;
typedef void (*event_fn)(board_t *board, uint64_t now);

typedef struct { /* events.c */
    uint64_t next; /* the smallest of when[] */
    uint64_t when[EVENT_COUNT];
} events_t;

/* when: a cycle, or NEVER. One that is due already is handled before the next instruction. */
void event_at(board_t *board, event_t event, uint64_t when);
void events_run(board_t *board); /* everything that is due by now */
void event_limit(board_t *board, uint64_t now);

#endif
