/* SPDX-License-Identifier: MIT
 * servo_link_parts.h - how the files of the servo link see each other. For servo_link*.c only.
 *
 *   servo_link_setup.c       search, torque, poses: what blocks
 *     servo_link.c           the course of a tick: goals, slopes, deaf servos, one health poll
 *       servo_link_goals.c   the packets with goals and slopes
 *       servo_link_health.c  the health poll and what its answer tells
 *         servo_link_joints.c   which joints can be driven, and their coordinates
 *           servo_link_masks.c  masks of joints
 *
 * Each uses only files below it. */
#ifndef SERVO_LINK_PARTS_H
#define SERVO_LINK_PARTS_H

#include "servo_link.h"

/* The phases of a tick. It begins at PHASE_POLL, or at PHASE_GOALS when there are goals:
 *
 *   GOALS -> SLOPES -> DEAF -> ACTION -> POLL -> POLLING -> DONE       (each may be skipped)
 *
 * QUIET: the bus is free for other callers until the next tick. */
enum { PHASE_QUIET = 0, PHASE_GOALS, PHASE_SLOPES, PHASE_DEAF, PHASE_ACTION, PHASE_POLL, PHASE_POLLING, PHASE_DONE };

/* servo_link_goals.c */
#define SLOPES_JOINTS 8u   /* joints in a packet of slopes alone: a byte of the mask */
uint8_t servo_link_build_slopes(const servo_link_t *link, uint32_t joints, bool with_goals) NOINLINE;
void servo_link_send_deaf(servo_link_t *link);   /* to the next servo that is deaf to SYNC WRITE */
void servo_link_send_action(void) NOINLINE;      /* deaf servos begin to move */

/* servo_link_health.c */
void servo_link_send_poll(servo_link_t *link);           /* asks the servo that did not answer again, or the next one */
void servo_link_end_poll(servo_link_t *link) NOINLINE;   /* handles the result of the poll, if there is one */

/* servo_link_joints.c */
/* Removes the lowest joint from a mask that is not empty, and returns it. */
uint8_t servo_link_take_lowest(uint32_t *mask) NOINLINE;

#define POS_MAX 1023u
/* pos < 0 ? 0 : pos > POS_MAX ? POS_MAX : pos, with one test of the high byte if pos is within 0..1023. */
ALWAYS_INLINE uint16_t limited(uint16_t pos)
{
    const uint8_t high = (uint8_t)(pos >> 8);
    if (high >= (POS_MAX + 1u) >> 8) {
        return (int8_t)high < 0 ? 0u : POS_MAX;
    }
    return pos;
}

#endif
