/* SPDX-License-Identifier: MIT
 * performer_parts.h - how the three files of the performer see each other. For performer*.c only.
 *
 *   performer.c        start, stop, pause, torque, the tick
 *   performer_ready.c  state READY: pose, torque, approach, binding the player
 *   performer_watch.c  events, faults of servos and their rule, battery, heat */
#ifndef PERFORMER_PARTS_H
#define PERFORMER_PARTS_H

#include "performer.h"

/* performer.c */
void performer_finish(performer_t *performer, uint8_t end);             /* IDLE, and tells why */
void performer_stop_softly(performer_t *performer);                     /* state PLAY: through the exit page; a pause ends */
void performer_drop(performer_t *performer, uint32_t joints);           /* out of what is going on */

/* performer_ready.c */
player_status_t performer_start_player(performer_t *performer, uint8_t page, uint32_t joints);
void performer_begin_page(performer_t *performer);                      /* from pose_pos into the first step */
void performer_ready_poll(performer_t *performer);                      /* state READY: one joint, or the beginning */

/* performer_watch.c */
void performer_tell(performer_t *performer, uint8_t kind, uint8_t a, uint8_t b, uint8_t c);
void performer_watch(performer_t *performer);

#endif
