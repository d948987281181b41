/* SPDX-License-Identifier: MIT
 * servo_motion.h - the controller of a servo and its shaft, in steps of 1/1024 s. For servo.c and servo_bus.c only.
 *
 *   duty                         error = goal - position. Nothing inside the margin (the motor brakes); from there the duty
 *   limit |        ______        starts with the punch and grows along the slope to the torque limit. The moving speed takes
 *         |      _/              duty back as soon as the shaft is faster, and gives more when a load holds it up.
 *   punch |    _/                The lag behind a steady ramp is about slope * speed / top speed.
 *       0 +---+------------
 *           margin        error
 *
 * A step is servo_motion_torque(), then a body (servo_body.h, or one inertia for this shaft alone) turns the shaft, then
 * servo_motion_turned().
 */
#ifndef SIM_SERVO_MOTION_H
#define SIM_SERVO_MOTION_H

#include "servo.h"
#include "servo_motor.h"

#define SERVO_STEP_S (1.0 / 1024)
#define SERVO_UNITS_PER_RADIAN (1024 * 180 / (300 * 3.14159265358979323846))
#define SERVO_UNITS_PER_RPM (6.0 * 1024 / 300) /* units per second at 1 rpm */
#define SERVO_SPEED_UNIT_RPM 0.111
#define SERVO_STALL_STEPS 1024                 /* full duty without moving for this long is overload */

/* Torque of the motor in this step, N m, positive towards larger positions. Notes the duty (servo->output). */
double servo_motion_torque(servo_t *servo);

/* The body has turned the shaft: angle from position 512 in radians, speed in rad/s. Load, heat and stall follow. */
void servo_motion_turned(servo_t *servo, double angle_rad, double speed_rad_s);

/* Both, with the built-in body: the rotor alone, gears with friction, ends at 0 and 1023. */
void servo_motion_step(servo_t *servo);

/* Nothing will move without an outside event: whole stretches of time may be skipped with servo_motion_rest(). */
bool servo_motion_is_at_rest(const servo_t *servo);
void servo_motion_rest(servo_t *servo, double seconds);

/* Goal position within the angle limits. */
double servo_motion_goal(const servo_t *servo);

/* Both angle limits 0: endless turn. */
bool servo_motion_is_wheel(const servo_t *servo);

#endif
