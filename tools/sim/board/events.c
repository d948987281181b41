/* SPDX-License-Identifier: MIT */
#include "board_private.h"

static void uart0_event(board_t *board, uint64_t now) { uart_event(&board->uart[0], now); }
static void uart1_event(board_t *board, uint64_t now) { uart_event(&board->uart[1], now); }

static void timer1_event(board_t *board, uint64_t now) { timer_event(&board->timer[0], now); }
static void timer3_event(board_t *board, uint64_t now) { timer_event(&board->timer[1], now); }

/* Ties are settled in this order: what arrives comes before what is sent, the end of the run last. */
static const struct { event_t event; event_fn run; } order[EVENT_COUNT] = {
    { EVENT_POWER, power_event },   { EVENT_BUS, bus_wire_event },  { EVENT_CONSOLE, console_event },
    { EVENT_UART0, uart0_event },   { EVENT_UART1, uart1_event },   { EVENT_SPM, flash_event },
    { EVENT_EEPROM, eeprom_event }, { EVENT_WATCHDOG, reset_event }, { EVENT_CHARGER, panel_event },
    { EVENT_TIMER1, timer1_event }, { EVENT_TIMER3, timer3_event }, { EVENT_LIMIT, event_limit },
};

static void find_next(events_t *events)
{
    uint64_t next = NEVER;
    for (int i = 0; i < EVENT_COUNT; i++) {
        if (events->when[i] < next) {
            next = events->when[i];
        }
    }
    events->next = next;
}

void event_at(board_t *board, event_t event, uint64_t when)
{
    board->events.when[event] = when;
    find_next(&board->events);
}

void event_limit(board_t *board, uint64_t now)
{
    (void)now;
    board_end_run(board, BOARD_STOP_TIME);
}

void events_run(board_t *board)
{
    events_t *events = &board->events;
    uint64_t now = board->avr->cycle;
    while (events->next <= now) { /* also when one of them ended the run: time has passed for all */
        uint64_t due = events->next;
        for (int i = 0; i < EVENT_COUNT; i++) {
            event_t event = order[i].event;
            if (events->when[event] == due) {
                event_at(board, event, NEVER);
                order[i].run(board, due);
                break;
            }
        }
    }
}
