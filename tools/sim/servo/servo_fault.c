/* SPDX-License-Identifier: MIT */
#include "servo_fault.h"

#include <string.h>

static const char *const names[SERVO_FAULTS] = {
    [SERVO_FAULT_SILENT] = "silent",           [SERVO_FAULT_DEAD] = "dead",
    [SERVO_FAULT_DUPLICATE] = "duplicate",     [SERVO_FAULT_CHECKSUM] = "checksum",
    [SERVO_FAULT_NOISE] = "noise",             [SERVO_FAULT_LATE] = "late",
    [SERVO_FAULT_SHORT] = "short",             [SERVO_FAULT_TWO_TALKERS] = "two-talkers",
    [SERVO_FAULT_OVERLOAD] = "overload",       [SERVO_FAULT_OVERHEATING] = "overheating",
    [SERVO_FAULT_LOW_VOLTAGE] = "low-voltage", [SERVO_FAULT_ANGLE_LIMIT] = "angle-limit",
    [SERVO_FAULT_MISHEARS] = "mishears",       [SERVO_FAULT_BLOCKED] = "blocked",
};

_Static_assert(SERVO_FAULTS <= sizeof ((servo_t *)0)->fault_left / sizeof (uint32_t), "one counter per fault");

static bool same_name(const char *a, const char *b)
{
    for (; *a && *b; a++, b++) {
        if (*a != *b && !(*a == '_' && *b == '-')) {
            return false;
        }
    }
    return *a == *b;
}

servo_fault_t servo_fault_by_name(const char *name)
{
    int fault = 0;
    while (fault < SERVO_FAULTS && !same_name(name, names[fault])) {
        fault++;
    }
    return (servo_fault_t)fault;
}

const char *servo_fault_name(servo_fault_t fault)
{
    return fault < SERVO_FAULTS ? names[fault] : "?";
}

void servo_fault_set(servo_t *servo, servo_fault_t fault, uint32_t answers)
{
    servo->fault_left[fault] = answers;
    const bool on = answers > 0;
    switch (fault) {
    case SERVO_FAULT_OVERLOAD: servo->overloaded = on; break;
    case SERVO_FAULT_OVERHEATING: servo->fault_c = on ? 85 : 0; break;
    case SERVO_FAULT_LOW_VOLTAGE: servo->fault_v = on ? 5.5 : 0; break;
    case SERVO_FAULT_BLOCKED: servo->held = on; break;
    default: break;
    }
}

bool servo_fault_is_on(const servo_t *servo, servo_fault_t fault)
{
    return servo->fault_left[fault] > 0;
}

bool servo_fault_take(servo_t *servo, servo_fault_t fault)
{
    if (servo->fault_left[fault] == 0) {
        return false;
    }
    if (servo->fault_left[fault] != SERVO_FAULT_ALWAYS) {
        servo->fault_left[fault]--;
    }
    return true;
}

uint8_t servo_noise_byte(servo_t *servo)
{
    uint32_t x = servo->noise_state; /* xorshift32 */
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    servo->noise_state = x;
    return (uint8_t)(x >> 24);
}
