/* SPDX-License-Identifier: MIT
 * servo_motion.h - how the horn moves: compliance, speed, load, heat. For servo.c only.
 *
 *   output                       error = goal - position. Nothing inside the margin; from there the motor output
 *   limit |        ______        starts with the punch and grows along the slope to the torque limit.
 *         |      _/              Unloaded speed is output times top speed, never more than the moving speed; the
 *   punch |    _/                motor follows with a time constant, so the present position lags as it does on
 *       0 +---+------------      the robot: about slope * speed / top speed behind a steady ramp.
 *           margin        error
 */
#ifndef SIM_SERVO_MOTION_H
#define SIM_SERVO_MOTION_H

#include "servo.h"

#define SERVO_UNITS_PER_RPM (6.0 * 1023.0 / 300.0) /* units per second at 1 rpm */
#define SERVO_SPEED_UNIT_RPM 0.111
#define SERVO_TOP_RPM 114.0   /* unloaded, at SERVO_NOMINAL_V; proportional to the supply */
#define SERVO_NOMINAL_V 9.6   /* the CM-5's battery: 8 cells of 1.2 V */
#define SERVO_MOTOR_TAU_MS 4.0
#define SERVO_FRICTION 0.02   /* of stall torque: the motor does not turn below */
#define SERVO_GEAR_HOLD 0.15  /* of stall torque: what the gears of a limp servo hold */
#define SERVO_STALL_MS 1000   /* full output without moving for this long is overload */
#define SERVO_STALL_HEAT_C 55.0 /* final rise above ambient at full output */
#define SERVO_HEAT_TAU_S 120.0

/* One step of 1 ms. */
void servo_motion_step(servo_t *servo);

/* Nothing will move without an outside event: whole stretches of time may be skipped with servo_motion_rest(). */
bool servo_motion_is_at_rest(const servo_t *servo);
void servo_motion_rest(servo_t *servo, double seconds);

/* Speed limit now in units per second: moving speed and supply. */
double servo_motion_limit(const servo_t *servo);

/* Goal position within the angle limits. */
double servo_motion_goal(const servo_t *servo);

/* Both angle limits 0: endless turn. */
bool servo_motion_is_wheel(const servo_t *servo);

#endif
