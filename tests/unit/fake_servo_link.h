/* SPDX-License-Identifier: MIT
 * fake_servo_link.h - stands for servo_link.h below the performer: remembers what was sent, tells faults that a test has
 * made, and keeps the one rule that matters: nobody is driven who is not there, is silent, or has no torque. */
#ifndef FAKE_SERVO_LINK_H
#define FAKE_SERVO_LINK_H

#include "servo_link.h"

typedef struct {
    uint16_t goal_pos[SERVO_LINK_JOINTS]; /* last goal each joint was sent; 0xFFFF: none */
    uint32_t joints;                      /* of the last frame */
    uint16_t frames;                      /* since the reset */
    uint16_t ticks;                       /* servo_link_tick */
    uint16_t slopes;                      /* servo_link_slopes */
    uint8_t compliance[SERVO_LINK_JOINTS];
    uint16_t engagements;                 /* calls of servo_link_engage */
    uint32_t mute;                        /* joints that answer neither a pose nor a torque-on */
    uint16_t pose_pos[SERVO_LINK_JOINTS]; /* where the servos stand */
} fake_servo_link_t;

extern fake_servo_link_t fake_servo_link;

/* `present` servos at 512, torque off. */
void fake_servo_link_reset(servo_link_t *link, uint32_t present);

/* The next servo_link_next_fault tells this. */
void fake_servo_link_fault(servo_link_t *link, uint8_t id, uint8_t kind, uint8_t errors);

#endif
