/* SPDX-License-Identifier: MIT */
#include "servo_motion.h"

#include <math.h>

#define STEP_S 0.001
#define FOLLOW (1.0 - 0.77880078307140486) /* 1 - exp(-1 ms / SERVO_MOTOR_TAU_MS) */
#define STANDSTILL 1.0                     /* units per second: slower is standing */
#define WHEEL_UNITS (360.0 * 1023 / 300)   /* one turn */

bool servo_motion_is_wheel(const servo_t *servo)
{
    return servo_get(servo, SERVO_CW_LIMIT, 2) == 0 && servo_get(servo, SERVO_CCW_LIMIT, 2) == 0;
}

static double top_speed(const servo_t *servo)
{
    const double volts = servo->fault_v > 0 ? servo->fault_v : servo->supply_v;
    return SERVO_TOP_RPM * SERVO_UNITS_PER_RPM * volts / SERVO_NOMINAL_V;
}

double servo_motion_limit(const servo_t *servo)
{
    const double top = top_speed(servo);
    const uint16_t units = servo_get(servo, SERVO_SPEED, 2);
    const double set = (units & 1023) * SERVO_SPEED_UNIT_RPM * SERVO_UNITS_PER_RPM;
    if (servo_motion_is_wheel(servo)) {
        return fmin(set, top); /* endless turn: 0 stands */
    }
    return units == 0 ? top : fmin(set, top);
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

/* Motor output -1..1 that the compliance curve (servo_motion.h) asks for. */
static double wanted_output(const servo_t *servo)
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
    const double output = fmin(punch + (fabs(error) - margin) / slope * (1 - punch), limit);
    return up ? output : -output;
}

/* Speed that this output and the outside load lead to; *used is the output really needed for it. */
static double wanted_speed(const servo_t *servo, double output, double *used)
{
    const double top = top_speed(servo), limit = servo_motion_limit(servo);
    const double force = output + servo->outside_load;
    *used = output;
    if (output == 0) { /* limp or on target: only more than the gears hold moves the horn */
        const double beyond = fabs(servo->outside_load) - SERVO_GEAR_HOLD;
        return beyond <= 0 ? 0 : copysign(beyond * top, servo->outside_load);
    }
    if (fabs(force) < SERVO_FRICTION) {
        return 0;
    }
    const double speed = force * top;
    if (fabs(speed) > limit && speed * output > 0) { /* the speed control takes output back */
        *used = copysign(limit / top, output) - servo->outside_load;
        return copysign(limit, speed);
    }
    return speed;
}

static void watch_stall(servo_t *servo)
{
    const uint16_t limit = servo_get(servo, SERVO_TORQUE_LIMIT, 2);
    const bool stalled = has_torque(servo) && fabs(servo->output) >= 0.99 * limit / 1023.0
        && servo->velocity * servo->output < 0.02 * top_speed(servo) * fabs(servo->output);
    servo->stalled_ms = stalled ? servo->stalled_ms + 1 : 0;
    if (servo->stalled_ms >= SERVO_STALL_MS) {
        servo->overloaded = true;
    }
}

static void move(servo_t *servo)
{
    servo->position += servo->velocity * STEP_S;
    if (servo->powered && servo_motion_is_wheel(servo)) {
        servo->position = fmod(servo->position + WHEEL_UNITS, WHEEL_UNITS);
    } else if (servo->position < 0 || servo->position > 1023) { /* mechanical end */
        servo->position = servo->position < 0 ? 0 : 1023;
        servo->velocity = 0;
    }
}

void servo_motion_step(servo_t *servo)
{
    double used;
    const double output = wanted_output(servo), speed = wanted_speed(servo, output, &used);
    servo->output = servo->held ? output : used;
    servo->velocity += (speed - servo->velocity) * FOLLOW;
    if (servo->held || (speed == 0 && fabs(servo->velocity) < STANDSTILL)) {
        servo->velocity = 0;
    }
    move(servo);
    watch_stall(servo);
    const double target = servo->ambient_c + SERVO_STALL_HEAT_C * servo->output * servo->output;
    servo->temperature_c += (target - servo->temperature_c) * STEP_S / SERVO_HEAT_TAU_S;
}

bool servo_motion_is_at_rest(const servo_t *servo)
{
    double used;
    return servo->velocity == 0 && servo->output == 0 && wanted_output(servo) == 0
        && wanted_speed(servo, 0, &used) == 0;
}

void servo_motion_rest(servo_t *servo, double seconds)
{
    servo->temperature_c =
        servo->ambient_c + (servo->temperature_c - servo->ambient_c) * exp(-seconds / SERVO_HEAT_TAU_S);
}
