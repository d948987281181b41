/* SPDX-License-Identifier: MIT
 * servo_motion.h - the controller of a servo and its shaft, in steps of 1/1024 s. For servo.c and servo_bus.c only.
 *
 *   duty                         error = goal - position. Inside the margin the duty is 0 (the motor brakes). Beyond it
 *   limit |        ______        the duty starts at the punch and grows along the slope to the torque limit. The moving
 *         |      _/              speed reduces the duty of a faster shaft, and raises it when a load slows the shaft.
 *   punch |    _/                The lag behind a steady ramp is about slope * speed / top speed.
 *       0 +---+------------
 *           margin        error
 *
 * A step has three parts: servo_motion_torque(); a body (servo_body.h, or one inertia for this shaft alone) turns the
 * shaft; servo_motion_turned().
 */
#ifndef SIM_SERVO_MOTION_H
#define SIM_SERVO_MOTION_H

#include "servo.h"
#include "servo_motor.h"

#define SERVO_STEP_S (1.0 / 1024)
#define SERVO_UNITS_PER_RADIAN (1024 * 180 / (300 * 3.14159265358979323846))
#define SERVO_UNITS_PER_RPM (6.0 * 1024 / 300) /* units per second at 1 rpm */
#define SERVO_SPEED_UNIT_RPM 0.111
#define SERVO_STALL_STEPS 1024                 /* full duty without motion for this long is overload */

/* Motor torque in this step, N m, positive towards larger positions. Stores the duty in servo->output. */
double servo_motion_torque(servo_t *servo);

/* The body has turned the shaft: angle from position 512 in radians, speed in rad/s. Updates heat and stall. */
void servo_motion_turned(servo_t *servo, double angle_rad, double speed_rad_s);

/* A whole step with the built-in body: the rotor alone, gears with friction, ends at 0 and 1023. */
void servo_motion_step(servo_t *servo);

/* true: nothing moves without an outside event, and servo_motion_rest() may skip any length of time. */
bool servo_motion_is_at_rest(const servo_t *servo);
void servo_motion_rest(servo_t *servo, double seconds);

/* Goal position, clamped to the angle limits. */
double servo_motion_goal(const servo_t *servo);

/* true: both angle limits are 0 (endless turn). */
bool servo_motion_is_wheel(const servo_t *servo);

#endif
