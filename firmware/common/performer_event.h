/* SPDX-License-Identifier: MIT
 * performer_event.h - the events of a performer: their kinds, the reasons for an end, and the queue that holds them until
 * the image prints them (report.h has their sentences). Main loop only. The queue is caller-owned. */
#ifndef PERFORMER_EVENT_H
#define PERFORMER_EVENT_H

#include <stdbool.h>
#include <stdint.h>

#ifndef PERFORMER_EVENTS
#define PERFORMER_EVENTS 12u /* at least 7; an image may have fewer */
#endif

/* Why a play ended. */
typedef enum {
    PERFORMER_END_DONE = 0,  /* a link of 0 */
    PERFORMER_END_STOPPED,   /* after a stop, through the exit links */
    PERFORMER_END_BROKEN,    /* break */
    PERFORMER_END_LOOP,      /* after a stop: the exit links form a loop */
    PERFORMER_END_PAGE,      /* the next page is damaged */
    PERFORMER_END_SERVO,     /* ended by the fault rule */
    PERFORMER_END_THERE      /* a move has arrived */
} performer_end_t;

/* Kinds of events, and the meaning of a, b and c. */
typedef enum {
    PERFORMER_EV_NONE = 0,
    PERFORMER_EV_APPROACH,   /* a: page, b: duration in seconds, rounded up */
    PERFORMER_EV_STEP,       /* a: page, b: step 1..7, c: repetition */
    PERFORMER_EV_LINK,       /* a: the next page (0: the end), b: link_taken_t */
    PERFORMER_EV_PAUSED,     /* all joints have stopped */
    PERFORMER_EV_ENDED,      /* a: page, b: page_status_t of a damaged page, c: performer_end_t */
    PERFORMER_EV_SILENT,     /* a: servo ID */
    PERFORMER_EV_BACK,       /* a: servo ID */
    PERFORMER_EV_ERRORS,     /* a: servo ID, b: DXL_ERR_ bits, 0: no more errors */
    PERFORMER_EV_TORQUE,     /* a: servo ID that lost its torque by itself */
    PERFORMER_EV_UNREADY,    /* a: servo ID that cannot be driven: it is silent, or does not obey, such as a hot one;
                              * b: it stands outside its angle limits (servo_link_t.outside) */
    PERFORMER_EV_BATTERY,    /* a: lowest voltage of all servos, 0.1 V */
    PERFORMER_EV_HOT,        /* a: ID of the hottest servo, b: degrees C */
    PERFORMER_EV_COOL,       /* no servo is hot any more */
    PERFORMER_EV_LAYER_ENDED, /* a: the page in which it ended */
    PERFORMER_EV_TICKS_LATE, /* a tick was 0.1 s late; all motion is broken off */
    PERFORMER_EV_BUS_LOST,   /* the bus adapter was unplugged; all joints count as switched off by hand */
    PERFORMER_EV_DRIVE_LOST, /* the driving program is silent; the play is being stopped */
    PERFORMER_EV_LOST        /* a: number of events dropped because the queue was full */
} performer_event_kind_t;

typedef struct {
    uint8_t kind, a, b, c;
} performer_event_t;

typedef struct {
    uint8_t count;      /* queued events; read only for callers */
    uint8_t first, lost;
    performer_event_t event[PERFORMER_EVENTS];
} performer_events_t;

/* A queue of zero bytes is empty. */

/* Appends an event, or drops and counts it if the queue is full. One slot is reserved for the end of a play, because callers
 * wait for it; five more are for all events except steps. */
void performer_event_put(performer_events_t *events, uint8_t kind, uint8_t a, uint8_t b, uint8_t c);

/* Takes the oldest event; after the last one, PERFORMER_EV_LOST if some were dropped. false: none. */
bool performer_event_take(performer_events_t *events, performer_event_t *event);

#endif
