/* SPDX-License-Identifier: MIT
 * performer_parts.h - how the files of the performer see each other. For performer*.c only.
 *
 *   performer.c          start, the loop, the tick; carries out what the others find
 *     performer_stop.c   stop, break, pause, torque off: everything that ends a play or interrupts it
 *     performer_ready.c  state READY: asks the servos for pose and torque, plans the approach
 *     performer_watch.c  faults of servos, battery, heat: says what has to be done about them
 *       performer_event.c  the queue of events
 *
 * Each uses only files below it. */
#ifndef PERFORMER_PARTS_H
#define PERFORMER_PARTS_H

#include "performer.h"

/* performer_stop.c */
void performer_go_idle(performer_t *performer, uint8_t reason);         /* tells why: performer_end_t */
void performer_stop_softly(performer_t *performer);                     /* state PLAY: through the exit page; a pause ends */
void performer_drive_lost(performer_t *performer);                      /* no performer_drive in time: ends what is on */
void performer_drop(performer_t *performer, uint32_t joints);           /* out of what is going on */

/* performer_ready.c */
typedef enum {
    READY_ASKING = 0,   /* not through yet */
    READY_SILENT,       /* a servo does not answer and the rule for faults ends the play, or nobody is left */
    READY_APPROACH,     /* everybody is ready, the approach is planned */
    READY_THERE         /* everybody is ready and stands where the play begins, or there is to be no approach */
} performer_ready_t;

void performer_get_ready(performer_t *performer);                       /* begins the state READY */
performer_ready_t performer_ready_poll(performer_t *performer);         /* one servo, or the plan; nobody has moved yet */

/* performer_watch.c */
typedef enum {
    WATCH_GO_ON = 0,
    WATCH_LIMP,         /* the joint's torque goes off, the play goes on without it */
    WATCH_EXIT,         /* a soft stop, without the joint */
    WATCH_BREAK         /* everybody slows down and holds, without the joint */
} performer_verdict_t;

/* Tells what is new, up to the first fault of a joint that takes part: what the rule for faults demands then, and the
 * joint's bit in *joint. Again until WATCH_GO_ON: what the caller did may have settled the next fault. */
performer_verdict_t performer_watch(performer_t *performer, uint32_t *joint);

#endif
