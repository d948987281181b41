/* SPDX-License-Identifier: MIT
 * servo_fault.h - faults on demand, by number and by name. */
#ifndef SIM_SERVO_FAULT_H
#define SIM_SERVO_FAULT_H

#include "servo.h"

typedef enum {
    SERVO_FAULT_SILENT,      /* hears and obeys, never answers */
    SERVO_FAULT_DEAD,        /* unplugged: neither hears nor answers, and is limp */
    SERVO_FAULT_DUPLICATE,   /* a second servo with the same ID (servo_bus_fault() plugs it in) */
    SERVO_FAULT_CHECKSUM,    /* answers with a wrong checksum */
    SERVO_FAULT_NOISE,       /* random bytes go before the answer */
    SERVO_FAULT_LATE,        /* answers late_us later than it should (20 ms unless set) */
    SERVO_FAULT_SHORT,       /* answers end in the middle */
    SERVO_FAULT_TWO_TALKERS, /* answers what is addressed to others, at the same time as they do */
    SERVO_FAULT_OVERLOAD,    /* overload alarm now */
    SERVO_FAULT_OVERHEATING, /* 85 degrees C until cleared */
    SERVO_FAULT_LOW_VOLTAGE, /* 5.5 V until cleared */
    SERVO_FAULT_ANGLE_LIMIT, /* reports the angle limit error until cleared */
    SERVO_FAULT_MISHEARS,    /* what is written to it arrives with a wrong bit: it answers with the checksum error */
    SERVO_FAULT_BLOCKED,     /* the horn is jammed; overload follows when it has to push */
    SERVO_FAULTS
} servo_fault_t;

#define SERVO_FAULT_ALWAYS UINT32_MAX

/* "silent", "dead", "duplicate", "checksum", "noise", "late", "short", "two-talkers", "overload", "overheating",
 * "low-voltage", "angle-limit", "mishears", "blocked"; '_' may stand for '-'. SERVO_FAULTS: no such name. */
servo_fault_t servo_fault_by_name(const char *name);
const char *servo_fault_name(servo_fault_t fault);

/* Turns a fault on for that many answers (SERVO_FAULT_ALWAYS: until cleared; 0: off). Faults of the body rather
 * than of answers know only on and off. servo_advance() first. */
void servo_fault_set(servo_t *servo, servo_fault_t fault, uint32_t answers);
bool servo_fault_is_on(const servo_t *servo, servo_fault_t fault);

/* One answer passes: is it to be spoiled this way? Counts down. */
bool servo_fault_take(servo_t *servo, servo_fault_t fault);

/* Next byte of the servo's own noise. */
uint8_t servo_noise_byte(servo_t *servo);

#endif
