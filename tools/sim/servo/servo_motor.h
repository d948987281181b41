/* SPDX-License-Identifier: MIT
 * servo_motor.h - the motor and gears of a servo: duty -> torque, current, heat. Pure; knows no control table.
 * A DC motor with a gear, described at the output shaft:
 *
 *   torque |\  duty 1            torque = A * duty * V / 12 V - B * speed, less the friction of the gears
 *    stall | \
 *          |  \                  A and B follow from the maker's data sheet: at 12 V and full duty the shaft stalls at
 *        0 +---\---- speed       stall_nm and turns at no_load_rpm, both including the friction of the gears.
 *          no load
 */
#ifndef SIM_SERVO_MOTOR_H
#define SIM_SERVO_MOTOR_H

#include <stdint.h>

#define SERVO_SHEET_V 12.0          /* supply in the makers' measurements */
#define SERVO_SHEET_FRICTION_NM 0.05 /* gears, included in the sheets' figures: an estimate (0.03..0.1) */
#define SERVO_ROTOR_KGM2 0.003      /* rotor seen through the gear: an estimate (0.001..0.01) */
#define SERVO_HEAT_RISE_C 86.0      /* final rise above ambient at the stall current of 12 V: an estimate */
#define SERVO_HEAT_TAU_S 120.0      /* time constant: an estimate */

/* One model, from its maker's data sheet at SERVO_SHEET_V. */
typedef struct {
    double no_load_rpm, stall_nm, stall_a;
} servo_motor_t;

/* Torque of the motor on the shaft, N m, without friction, which the body adds. duty -1..1, speed in rad/s. */
double servo_motor_torque(const servo_motor_t *motor, double duty, double volts, double speed_rad_s);

/* No-load speed at full duty, rad/s, positive. */
double servo_motor_top_speed(const servo_motor_t *motor, double volts);

/* Current for this motor torque, A, positive. */
double servo_motor_current(const servo_motor_t *motor, double torque_nm);

/* Temperature after `seconds` at this torque. */
double servo_motor_heat(const servo_motor_t *motor, double torque_nm, double celsius, double ambient_c, double seconds);

#endif
