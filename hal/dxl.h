/* SPDX-License-Identifier: MIT
 * dxl.h - the names of Dynamixel protocol 1.0: instructions, error bits, control table. No code, no RAM.
 * Source: DYNAMIXEL.md. */
#ifndef DXL_H
#define DXL_H

#define DXL_BROADCAST 254u
#define DXL_PACKET_MAX 143u  /* bytes, including header and checksum: the AX-12's limit */

enum {
    DXL_PING = 1,
    DXL_READ = 2,
    DXL_WRITE = 3,
    DXL_REG_WRITE = 4,
    DXL_ACTION = 5,
    DXL_RESET = 6,
    DXL_SYNC_WRITE = 0x83
};

/* The error byte of a status packet. */
enum {
    DXL_ERR_VOLTAGE = 1 << 0,
    DXL_ERR_ANGLE = 1 << 1,
    DXL_ERR_HEAT = 1 << 2,
    DXL_ERR_RANGE = 1 << 3,
    DXL_ERR_CHECKSUM = 1 << 4,
    DXL_ERR_OVERLOAD = 1 << 5,
    DXL_ERR_INSTRUCTION = 1 << 6
};

/* Bits of an instruction that was not obeyed. The others report the state of the servo, which has obeyed. */
#define DXL_REJECTED (DXL_ERR_RANGE | DXL_ERR_CHECKSUM | DXL_ERR_INSTRUCTION)

/* Control table. Words are low byte first. */
enum {
    DXL_AT_MODEL = 0,
    DXL_AT_FIRMWARE = 2,
    DXL_AT_ID = 3,
    DXL_AT_BAUD = 4,             /* rate = 2,000,000 / (n + 1) */
    DXL_AT_RETURN_DELAY = 5,     /* 2 us units */
    DXL_AT_CW_LIMIT = 6,
    DXL_AT_CCW_LIMIT = 8,
    DXL_AT_MAX_TORQUE = 14,
    DXL_AT_RETURN_LEVEL = 16,
    DXL_AT_ALARM_LED = 17,
    DXL_AT_ALARM_SHUTDOWN = 18,
    DXL_AT_TORQUE_ENABLE = 24,
    DXL_AT_LED = 25,
    DXL_AT_CW_MARGIN = 26,
    DXL_AT_CCW_MARGIN = 27,
    DXL_AT_CW_SLOPE = 28,
    DXL_AT_CCW_SLOPE = 29,
    DXL_AT_GOAL = 30,
    DXL_AT_SPEED = 32,
    DXL_AT_TORQUE_LIMIT = 34,
    DXL_AT_PRESENT = 36,
    DXL_AT_PRESENT_SPEED = 38,
    DXL_AT_LOAD = 40,
    DXL_AT_VOLTAGE = 42,         /* 0.1 V */
    DXL_AT_TEMPERATURE = 43,     /* degrees C */
    DXL_AT_REGISTERED = 44,
    DXL_AT_MOVING = 46,
    DXL_AT_LOCK = 47,
    DXL_AT_PUNCH = 48
};

#endif
