/* SPDX-License-Identifier: MIT
 * servo_link_stage.h - what the tests of servo_link share: joints on the fake bus, and ticks. setUp and tearDown are
 * here. */
#ifndef SERVO_LINK_STAGE_H
#define SERVO_LINK_STAGE_H

#include "bus.h"
#include "fake_bus.h"
#include "servo_link.h"

extern servo_link_t servos;
extern uint16_t goals[SERVO_LINK_JOINTS]; /* 300 + ID at first */

/* A robot of `count` servos from ID 1 on, searched, torque on, log empty. */
void robot(uint8_t count);

/* The rest of a tick: the main loop goes round often. */
void rest_of_tick(void);
void tick_with_goals(uint32_t joints);
void idle_ticks(uint8_t count);

/* Packets in the log with this instruction, and the last of them. */
uint16_t logged(uint8_t instruction, const uint8_t **last);

#endif
