/* SPDX-License-Identifier: MIT */
#include "events.h"

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

void events_init(events_t *events)
{
    for (int i = 0; i < EVENT_COUNT; i++) {
        events->when[i] = NEVER;
    }
    events->next = NEVER;
}

void events_handle(events_t *events, event_t event, event_fn run, void *context)
{
    events->handler[event].run = run;
    events->handler[event].context = context;
}

void event_at(events_t *events, event_t event, uint64_t when)
{
    events->when[event] = when;
    find_next(events);
}

void events_run(events_t *events, uint64_t now)
{
    while (events->next <= now) { /* even if one of them ended the run: the time has passed for all */
        uint64_t due = events->next;
        for (int i = 0; i < EVENT_COUNT; i++) {
            if (events->when[i] == due) {
                event_at(events, (event_t)i, NEVER);
                events->handler[i].run(events->handler[i].context, due);
                break;
            }
        }
    }
}
