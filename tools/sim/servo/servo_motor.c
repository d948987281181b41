/* SPDX-License-Identifier: MIT */
#include "servo_motor.h"

#include <math.h>

#define RAD_S_PER_RPM (2 * 3.14159265358979323846 / 60)

/* Torque of the motor itself at a standstill and 12 V, before the gears take their part. */
static double own_stall(const servo_motor_t *motor)
{
    return motor->stall_nm + SERVO_SHEET_FRICTION_NM;
}

/* B above, N m s. Without load, the motor gives exactly what the gears take. */
static double drop(const servo_motor_t *motor)
{
    return motor->stall_nm / (motor->no_load_rpm * RAD_S_PER_RPM);
}

double servo_motor_torque(const servo_motor_t *motor, double duty, double volts, double speed_rad_s)
{
    return own_stall(motor) * duty * volts / SERVO_SHEET_V - drop(motor) * speed_rad_s;
}

double servo_motor_top_speed(const servo_motor_t *motor, double volts)
{
    return fmax(0, own_stall(motor) * volts / SERVO_SHEET_V - SERVO_SHEET_FRICTION_NM) / drop(motor);
}

double servo_motor_current(const servo_motor_t *motor, double torque_nm)
{
    return motor->stall_a * fabs(torque_nm) / own_stall(motor);
}

double servo_motor_heat(const servo_motor_t *motor, double torque_nm, double celsius, double ambient_c, double seconds)
{
    const double part = servo_motor_current(motor, torque_nm) / motor->stall_a; /* heat is proportional to its square */
    const double final = ambient_c + SERVO_HEAT_RISE_C * part * part;
    return final + (celsius - final) * exp(-seconds / SERVO_HEAT_TAU_S);
}
