/* SPDX-License-Identifier: MIT
 * performer_watch.h - how a performer reacts to servo faults, a low battery and hot servos. For performer.c only. */
#ifndef PERFORMER_WATCH_H
#define PERFORMER_WATCH_H

#include "performer.h"

typedef enum {
    WATCH_GO_ON = 0,
    WATCH_LIMP,         /* switch the joint's torque off; the play continues without it */
    WATCH_EXIT,         /* a soft stop, without the joint */
    WATCH_BREAK         /* a break, without the joint */
} performer_verdict_t;

/* Reports new faults, up to the first one of a joint that takes part in the play. Returns what the fault rule demands,
 * with the joint's bit in *joint. Call again until WATCH_GO_ON: the verdict may settle the next fault too. */
performer_verdict_t performer_watch(performer_t *performer, uint32_t *joint);

#endif
