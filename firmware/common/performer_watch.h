/* SPDX-License-Identifier: MIT
 * performer_watch.h - what a performer does about faults of servos, a weak battery and hot servos. For performer.c only. */
#ifndef PERFORMER_WATCH_H
#define PERFORMER_WATCH_H

#include "performer.h"

typedef enum {
    WATCH_GO_ON = 0,
    WATCH_LIMP,         /* switch the joint's torque off; the play goes on without it */
    WATCH_EXIT,         /* a soft stop, without the joint */
    WATCH_BREAK         /* a break, without the joint */
} performer_verdict_t;

/* Reports new faults, up to the first one of a joint that takes part in the play. Returns what the rule for faults demands,
 * with the joint's bit in *joint. Call again until WATCH_GO_ON: the verdict may settle the next fault too. */
performer_verdict_t performer_watch(performer_t *performer, uint32_t *joint);

#endif
