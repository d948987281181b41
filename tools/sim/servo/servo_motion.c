/* SPDX-License-Identifier: MIT */
#include "servo_motion.h"

#include <math.h>

#define WHEEL_UNITS (360.0 * 1024 / 300) /* one turn */
#define CENTRE 512.0
#define GOVERNOR_PER_S 20.0              /* gain of the speed governor: settles in 0.1 s */
#define HOLD_NM_PER_RADIAN 100.0         /* a blocked horn in a physical body; 1 N m bends it by 0.6 degrees */
#define HOLD_NM_S 0.5

static const servo_motor_t motors[] = {
    [SERVO_AX12] = {.no_load_rpm = 59, .stall_nm = 1.5, .stall_a = 1.5},
    [SERVO_DX117] = {.no_load_rpm = 58, .stall_nm = 2.8, .stall_a = 1.2},
    [SERVO_AX18] = {.no_load_rpm = 97, .stall_nm = 1.8, .stall_a = 2.2},
};

static const servo_motor_t *motor_of(const servo_t *servo)
{
    return &motors[servo->model];
}

bool servo_motion_is_wheel(const servo_t *servo)
{
    return servo_get(servo, SERVO_CW_LIMIT, 2) == 0 && servo_get(servo, SERVO_CCW_LIMIT, 2) == 0;
}

static double volts_of(const servo_t *servo)
{
    return servo->fault_v > 0 ? servo->fault_v : servo->supply_v;
}

/* Units per second. */
static double top_speed(const servo_t *servo)
{
    return servo_motor_top_speed(motor_of(servo), volts_of(servo)) * SERVO_UNITS_PER_RADIAN;
}

/* The moving speed in units per second; INFINITY: no limit. */
static double moving_speed(const servo_t *servo)
{
    const uint16_t units = servo_get(servo, SERVO_SPEED, 2) & 1023;
    if (units == 0 && !servo_motion_is_wheel(servo)) {
        return INFINITY;
    }
    return units * SERVO_SPEED_UNIT_RPM * SERVO_UNITS_PER_RPM;
}

double servo_motion_goal(const servo_t *servo)
{
    const double low = servo_get(servo, SERVO_CW_LIMIT, 2), high = servo_get(servo, SERVO_CCW_LIMIT, 2);
    const double goal = servo_get(servo, SERVO_GOAL, 2);
    return goal < low ? low : goal > high ? high : goal;
}

static bool has_torque(const servo_t *servo)
{
    return servo->powered && servo->table[SERVO_TORQUE_ENABLE] && servo_get(servo, SERVO_TORQUE_LIMIT, 2) > 0;
}

/* Duty -1..1 from the compliance curve (servo_motion.h). */
static double wanted_duty(const servo_t *servo)
{
    if (!has_torque(servo)) {
        return 0;
    }
    const double limit = servo_get(servo, SERVO_TORQUE_LIMIT, 2) / 1023.0;
    if (servo_motion_is_wheel(servo)) {
        const uint16_t speed = servo_get(servo, SERVO_SPEED, 2);
        return (speed & 1023) == 0 ? 0 : speed & 1024 ? -limit : limit;
    }
    const double error = servo_motion_goal(servo) - servo->position;
    const bool up = error > 0;
    const double margin = servo->table[up ? SERVO_CCW_MARGIN : SERVO_CW_MARGIN];
    const double slope = servo->table[up ? SERVO_CCW_SLOPE : SERVO_CW_SLOPE];
    const double punch = servo_get(servo, SERVO_PUNCH, 2) / 1023.0;
    if (fabs(error) <= margin) {
        return 0;
    }
    const double duty = fmin(punch + (fabs(error) - margin) / slope * (1 - punch), limit);
    return up ? duty : -duty;
}

/* Limits the duty so that the shaft does not exceed the moving speed. Starts with the duty that turns the unloaded
 * shaft that fast, then follows the load. */
static double governed(servo_t *servo, double duty)
{
    const double top = top_speed(servo), limit = moving_speed(servo);
    const double unloaded = top > 0 ? fmin(1, limit / top) : 1;
    if (unloaded == 1 || servo->output == 0) {
        servo->governor = unloaded;
    } else {
        const double too_slow = (limit - copysign(servo->velocity, duty * servo->velocity)) / top;
        /* Not more than now: at rest nothing has lowered it from an earlier, higher limit. */
        servo->governor = fmin(servo->governor, fmax(unloaded, fabs(servo->output)));
        servo->governor += too_slow * GOVERNOR_PER_S * SERVO_STEP_S;
        servo->governor = fmin(fmax(servo->governor, 0), fmax(unloaded, fabs(duty)));
    }
    return copysign(fmin(fabs(duty), servo->governor), duty);
}

double servo_motion_torque(servo_t *servo)
{
    const double speed = servo->velocity / SERVO_UNITS_PER_RADIAN;
    servo->output = governed(servo, wanted_duty(servo));
    /* Without torque the bridge is open: the motor neither drives nor brakes. */
    servo->motor_nm = has_torque(servo) ? servo_motor_torque(motor_of(servo), servo->output, volts_of(servo), speed) : 0;
    const double outside = servo->outside_load * motor_of(servo)->stall_nm;
    if (!servo->held) {
        servo->held_at = servo->position;
        return servo->motor_nm + outside;
    }
    const double bent = (servo->position - servo->held_at) / SERVO_UNITS_PER_RADIAN;
    return servo->motor_nm + outside - HOLD_NM_PER_RADIAN * bent - HOLD_NM_S * speed;
}

static void watch_stall(servo_t *servo)
{
    const double limit = servo_get(servo, SERVO_TORQUE_LIMIT, 2) / 1023.0;
    const bool stalled = has_torque(servo) && fabs(servo->output) >= 0.99 * limit
        && servo->velocity * servo->output < 0.02 * top_speed(servo) * fabs(servo->output);
    servo->stalled_steps = stalled ? servo->stalled_steps + 1 : 0;
    if (servo->stalled_steps >= SERVO_STALL_STEPS) {
        servo->overloaded = true;
    }
}

static void shaft_turned(servo_t *servo)
{
    watch_stall(servo);
    servo->temperature_c =
        servo_motor_heat(motor_of(servo), servo->motor_nm, servo->temperature_c, servo->ambient_c, SERVO_STEP_S);
}

void servo_motion_turned(servo_t *servo, double angle_rad, double speed_rad_s)
{
    servo->position = CENTRE + angle_rad * SERVO_UNITS_PER_RADIAN;
    servo->velocity = speed_rad_s * SERVO_UNITS_PER_RADIAN;
    shaft_turned(servo);
}

/* Speed after a step with this torque. Friction in the gears reduces it, but never reverses it. */
static double speed_after(const servo_t *servo, double torque_nm)
{
    const double free = servo->velocity + torque_nm / SERVO_ROTOR_KGM2 * SERVO_STEP_S * SERVO_UNITS_PER_RADIAN;
    const double friction = SERVO_SHEET_FRICTION_NM / SERVO_ROTOR_KGM2 * SERVO_STEP_S * SERVO_UNITS_PER_RADIAN;
    return copysign(fmax(0, fabs(free) - friction), free);
}

static void move(servo_t *servo)
{
    servo->position += servo->velocity * SERVO_STEP_S;
    if (servo->powered && servo_motion_is_wheel(servo)) {
        servo->position = fmod(servo->position + WHEEL_UNITS, WHEEL_UNITS);
    } else if (servo->position < 0 || servo->position > 1023) { /* mechanical end */
        servo->position = servo->position < 0 ? 0 : 1023;
        servo->velocity = 0;
    }
}

void servo_motion_step(servo_t *servo)
{
    const double torque_nm = servo_motion_torque(servo);
    servo->velocity = servo->held ? 0 : speed_after(servo, torque_nm);
    move(servo);
    shaft_turned(servo);
}

bool servo_motion_is_at_rest(const servo_t *servo)
{
    return servo->velocity == 0 && servo->output == 0 && servo->motor_nm == 0 && wanted_duty(servo) == 0
        && fabs(servo->outside_load) * motor_of(servo)->stall_nm <= SERVO_SHEET_FRICTION_NM;
}

void servo_motion_rest(servo_t *servo, double seconds)
{
    servo->temperature_c = servo_motor_heat(motor_of(servo), 0, servo->temperature_c, servo->ambient_c, seconds);
}
