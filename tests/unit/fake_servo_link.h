/* SPDX-License-Identifier: MIT
 * fake_servo_link.h - replaces servo_link.h below the performer: records what was sent and reports the faults that a
 * test sets. Enforces one rule: no goals for a joint that is absent, silent or without torque. */
#ifndef FAKE_SERVO_LINK_H
#define FAKE_SERVO_LINK_H

#include "servo_link.h"

typedef struct {
    uint16_t goal_pos[SERVO_LINK_JOINTS]; /* last goal sent to each joint; 0xFFFF: none */
    uint32_t joints;                      /* of the last frame */
    uint16_t frames;                      /* since the reset */
    uint16_t ticks;                       /* servo_link_tick */
    uint16_t slopes;                      /* servo_link_slopes */
    uint8_t compliance[SERVO_LINK_JOINTS];
    uint16_t engagements;                 /* calls of servo_link_engage */
    uint32_t mute;                        /* joints that answer neither a pose read nor a torque-on */
    uint16_t pose_pos[SERVO_LINK_JOINTS]; /* actual positions of the servos, page coordinates without limit */
} fake_servo_link_t;

extern fake_servo_link_t fake_servo_link;

/* `present` servos at 512, torque off. */
void fake_servo_link_reset(servo_link_t *link, uint32_t present);

/* The next servo_link_next_fault reports this fault. */
void fake_servo_link_fault(servo_link_t *link, uint8_t id, uint8_t kind, uint8_t errors);

#endif
