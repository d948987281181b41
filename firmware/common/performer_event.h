/* SPDX-License-Identifier: MIT
 * performer_event.h - what a performer tells: kinds of events and reasons for an end. report.h turns them into sentences. */
#ifndef PERFORMER_EVENT_H
#define PERFORMER_EVENT_H

#include <stdint.h>

/* Why a play ended. */
typedef enum {
    PERFORMER_END_DONE = 0,  /* a link of 0 */
    PERFORMER_END_STOPPED,   /* after a stop, through the exit links */
    PERFORMER_END_BROKEN,    /* break */
    PERFORMER_END_LOOP,      /* after a stop, the exit pages came back to themselves */
    PERFORMER_END_PAGE,      /* the page that was to follow is damaged */
    PERFORMER_END_SERVO,     /* the rule for faults ended it */
    PERFORMER_END_THERE      /* a move has arrived */
} performer_end_t;

/* What happened; a and b by kind. */
typedef enum {
    PERFORMER_EV_NONE = 0,
    PERFORMER_EV_APPROACH,   /* a: page; b: seconds it takes, rounded up */
    PERFORMER_EV_STEP,       /* a: page, b: step 1..7, c: repetition */
    PERFORMER_EV_LINK,       /* a: page it leads to (0: the end), b: link_taken_t */
    PERFORMER_EV_PAUSED,     /* all joints stand */
    PERFORMER_EV_ENDED,      /* a: page, b: page_status_t of a damaged page, c: performer_end_t */
    PERFORMER_EV_SILENT,     /* a: servo ID */
    PERFORMER_EV_BACK,       /* a: servo ID */
    PERFORMER_EV_ERRORS,     /* a: servo ID, b: DXL_ERR_ bits, 0: none any more */
    PERFORMER_EV_TORQUE,     /* a: servo ID: its torque went off by itself */
    PERFORMER_EV_BATTERY,    /* a: lowest voltage of all servos, 0.1 V */
    PERFORMER_EV_HOT,        /* a: servo ID, b: degrees C */
    PERFORMER_EV_LOST        /* a: how many events found the queue full */
} performer_event_kind_t;

typedef struct {
    uint8_t kind, a, b, c;
} performer_event_t;

#endif
