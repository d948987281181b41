/* SPDX-License-Identifier: MIT
 * servo_fault.h - faults by number and by name. */
#ifndef SIM_SERVO_FAULT_H
#define SIM_SERVO_FAULT_H

#include "servo.h"

typedef enum {
    SERVO_FAULT_SILENT,      /* receives and obeys, never replies */
    SERVO_FAULT_DEAD,        /* unplugged: neither receives nor replies, and is limp */
    SERVO_FAULT_DUPLICATE,   /* a second servo with the same ID (servo_bus_fault() adds it) */
    SERVO_FAULT_CHECKSUM,    /* replies with a wrong checksum */
    SERVO_FAULT_NOISE,       /* random bytes precede the reply */
    SERVO_FAULT_LATE,        /* replies late_us too late (20 ms by default) */
    SERVO_FAULT_SHORT,       /* replies end in the middle */
    SERVO_FAULT_TWO_TALKERS, /* replies to requests for others, at the same time as they do */
    SERVO_FAULT_OVERLOAD,    /* overload alarm */
    SERVO_FAULT_OVERHEATING, /* 85 degrees C until cleared */
    SERVO_FAULT_LOW_VOLTAGE, /* 5.5 V until cleared */
    SERVO_FAULT_ANGLE_LIMIT, /* reports the angle limit error until cleared */
    SERVO_FAULT_MISHEARS,    /* writes arrive with a wrong bit: it replies with the checksum error */
    SERVO_FAULT_BLOCKED,     /* the horn is jammed; overload follows when it has to push */
    SERVO_FAULTS
} servo_fault_t;

#define SERVO_FAULT_ALWAYS UINT32_MAX

/* "silent", "dead", "duplicate", "checksum", "noise", "late", "short", "two-talkers", "overload", "overheating",
 * "low-voltage", "angle-limit", "mishears", "blocked"; '_' also matches '-'. SERVO_FAULTS: no such name. */
servo_fault_t servo_fault_by_name(const char *name);
const char *servo_fault_name(servo_fault_t fault);

/* Turns a fault on for this many replies (SERVO_FAULT_ALWAYS: until cleared; 0: off). Faults that do not affect replies
 * are only on or off. Call servo_advance() first. */
void servo_fault_set(servo_t *servo, servo_fault_t fault, uint32_t answers);
bool servo_fault_is_on(const servo_t *servo, servo_fault_t fault);

/* Counts one reply down. true: spoil this reply. */
bool servo_fault_take(servo_t *servo, servo_fault_t fault);

/* Next byte of this servo's random noise. */
uint8_t servo_noise_byte(servo_t *servo);

#endif
