/* SPDX-License-Identifier: MIT */
#include "performer_event.h"

#define ROOM_FOR_STEPS (PERFORMER_EVENTS - 6u)  /* the rest is for more important events */
#define ROOM_FOR_OTHERS (PERFORMER_EVENTS - 1u) /* the last slot is for the end of a play */

static uint8_t room_for(uint8_t kind)
{
    return kind == PERFORMER_EV_STEP ? ROOM_FOR_STEPS : kind == PERFORMER_EV_ENDED ? PERFORMER_EVENTS : ROOM_FOR_OTHERS;
}

/* Wraps an index at the end of the array, without a division of 200 cycles. */
static uint8_t wrapped(uint8_t at)
{
    return at >= PERFORMER_EVENTS ? (uint8_t)(at - PERFORMER_EVENTS) : at;
}

void performer_event_put(performer_events_t *events, uint8_t kind, uint8_t a, uint8_t b, uint8_t c)
{
    if (events->count >= room_for(kind)) {
        events->lost = (uint8_t)(events->lost + (events->lost < UINT8_MAX ? 1 : 0));
        return;
    }
    const uint8_t at = wrapped((uint8_t)(events->first + events->count));
    events->event[at] = (performer_event_t){.kind = kind, .a = a, .b = b, .c = c};
    events->count++;
}

bool performer_event_take(performer_events_t *events, performer_event_t *event)
{
    if (events->count != 0) {
        *event = events->event[events->first];
        events->first = wrapped((uint8_t)(events->first + 1u));
        events->count--;
        return true;
    }
    if (events->lost != 0) {
        *event = (performer_event_t){.kind = PERFORMER_EV_LOST, .a = events->lost};
        events->lost = 0;
        return true;
    }
    return false;
}
