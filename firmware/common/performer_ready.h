/* SPDX-License-Identifier: MIT
 * performer_ready.h - the state READY of a performer: asks the servos for pose and torque one by one, then plans the
 * approach. For performer.c only. */
#ifndef PERFORMER_READY_H
#define PERFORMER_READY_H

#include "performer.h"

typedef enum {
    READY_ASKING = 0,   /* not complete */
    READY_SILENT,       /* a servo does not answer and the rule for faults ends the play, or no joint is left */
    READY_APPROACH,     /* complete; the approach is planned */
    READY_THERE         /* complete; the joints are where the play begins, or the setting is no approach */
} performer_ready_t;

/* Begins the state READY. */
void performer_get_ready(performer_t *performer);

/* Asks one servo, or plans; moves nothing. */
performer_ready_t performer_ready_poll(performer_t *performer);

#endif
