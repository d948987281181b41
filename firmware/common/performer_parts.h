/* SPDX-License-Identifier: MIT
 * performer_parts.h - how the files of the performer see each other. For performer*.c only.
 *
 *   performer.c            the tick, the work of the main loop; acts on the verdicts of performer_watch.c
 *     performer_start.c    begins a play or a move
 *     performer_stop.c     stop, break, pause, torque off: everything that ends a play or interrupts it
 *     performer_ready.c    state READY: reads pose and torque of the servos, plans the approach
 *     performer_watch.c    faults of servos, battery, heat: the verdict on each
 *       performer_layers.c, performer_drive.c    performer_shape.h: a play shaped from outside
 *         performer_state.c, performer_event.c   questions about the state; the queue of events
 *
 * Each uses only files below it. */
#ifndef PERFORMER_PARTS_H
#define PERFORMER_PARTS_H

#include "performer.h"

/* performer_stop.c */
void performer_go_idle(performer_t *performer, uint8_t reason);         /* ends everything; reports performer_end_t */
void performer_stop_softly(performer_t *performer);                     /* state PLAY: through the exit page; ends a pause */
void performer_drive_lost(performer_t *performer);                      /* performer_drive came too late: stops the play */
void performer_drop(performer_t *performer, uint32_t joints);           /* takes joints out of the play and its layers */

/* performer_start.c */
void performer_fresh_player(performer_t *performer);                    /* an idle player with the performer's shape */

/* Starts a fresh player at `page` from the present goals, by the law of the settings. */
player_status_t performer_start_player(performer_t *performer, uint8_t page, uint32_t joints) NOINLINE;

/* performer_ready.c */
typedef enum {
    READY_ASKING = 0,   /* not complete */
    READY_SILENT,       /* a servo does not answer and the rule for faults ends the play, or no joint is left */
    READY_APPROACH,     /* complete; the approach is planned */
    READY_THERE         /* complete; the joints are where the play begins, or the setting is no approach */
} performer_ready_t;

void performer_get_ready(performer_t *performer);                       /* begins the state READY */
performer_ready_t performer_ready_poll(performer_t *performer);         /* asks one servo, or plans; moves nothing */

/* performer_watch.c */
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
