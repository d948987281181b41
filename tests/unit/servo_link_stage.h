/* SPDX-License-Identifier: MIT
 * servo_link_stage.h - fixture for the servo_link tests: joints on the fake bus, and ticks. Contains setUp and
 * tearDown. */
#ifndef SERVO_LINK_STAGE_H
#define SERVO_LINK_STAGE_H

#include "bus.h"
#include "fake_bus.h"
#include "servo_link.h"

extern servo_link_t servos;
extern uint16_t goals[SERVO_LINK_JOINTS]; /* initially 300 + ID */

/* Makes a robot with servos 1..count, found, torque on, and an empty log. */
void robot(uint8_t count);

/* Runs the main loop for the rest of a tick. */
void rest_of_tick(void);
void tick_with_goals(uint32_t joints);
void idle_ticks(uint8_t count);

/* Number of packets in the log with this instruction; *last gets the last of them. */
uint16_t logged(uint8_t instruction, const uint8_t **last);

#endif
