/* SPDX-License-Identifier: MIT
 * servo.h - one virtual Dynamixel servo: control table, effects of register writes, alarms, power.
 * Knows no wire, no packet framing (servo_protocol.h) and no simavr. Time is counted in controller cycles (16 MHz).
 * The position is updated lazily: servo_advance() computes fixed steps of 1/1024 s on the absolute time axis, so the
 * result does not depend on how often it is called. If all servos move one body (servo_body.h), the bus makes these
 * steps for all of them together.
 * Facts: DYNAMIXEL.md; start values and ranges come from the public AX-12 manual. */
#ifndef SIM_SERVO_H
#define SIM_SERVO_H

#include <stdbool.h>
#include <stdint.h>

#include "servo_body.h"

#define SERVO_CYCLES_PER_US 16u
#define SERVO_TABLE_BYTES 50
#define SERVO_EEPROM_BYTES 24 /* addresses 0..23 survive power-off */
#define SERVO_PACKET_MAX 143  /* AX-12 receive buffer; a longer instruction packet is lost */
#define SERVO_BROADCAST 254

typedef enum { SERVO_AX12, SERVO_DX117, SERVO_AX18 } servo_model_t;

/* Addresses of the control table. Two-byte items are little endian. */
enum {
    SERVO_MODEL = 0, SERVO_VERSION = 2, SERVO_ID = 3, SERVO_BAUD = 4, SERVO_RETURN_DELAY = 5, SERVO_CW_LIMIT = 6,
    SERVO_CCW_LIMIT = 8, SERVO_TEMPERATURE_LIMIT = 11, SERVO_VOLTAGE_LOW = 12, SERVO_VOLTAGE_HIGH = 13,
    SERVO_MAX_TORQUE = 14, SERVO_RETURN_LEVEL = 16, SERVO_ALARM_LED = 17, SERVO_ALARM_SHUTDOWN = 18,
    SERVO_TORQUE_ENABLE = 24, SERVO_LED = 25, SERVO_CW_MARGIN = 26, SERVO_CCW_MARGIN = 27, SERVO_CW_SLOPE = 28,
    SERVO_CCW_SLOPE = 29, SERVO_GOAL = 30, SERVO_SPEED = 32, SERVO_TORQUE_LIMIT = 34, SERVO_PRESENT = 36,
    SERVO_PRESENT_SPEED = 38, SERVO_PRESENT_LOAD = 40, SERVO_VOLTAGE = 42, SERVO_TEMPERATURE = 43,
    SERVO_REGISTERED = 44, SERVO_MOVING = 46, SERVO_LOCK = 47, SERVO_PUNCH = 48
};

/* Bits of the status packet's error byte. */
enum {
    SERVO_ERR_VOLTAGE = 1, SERVO_ERR_ANGLE = 2, SERVO_ERR_HEAT = 4, SERVO_ERR_RANGE = 8,
    SERVO_ERR_CHECKSUM = 16, SERVO_ERR_OVERLOAD = 32, SERVO_ERR_INSTRUCTION = 64
};

/* Collects the bytes of one packet. */
typedef struct {
    uint8_t bytes[SERVO_PACKET_MAX];
    uint8_t count;
    uint64_t last_end_cycles; /* end of the newest byte's stop bit */
} servo_parser_t;

/* What this servo is sending: count bytes back to back from start_cycles on. */
typedef struct {
    uint64_t start_cycles, byte_cycles;
    uint32_t rate_bps;
    uint16_t count, sent;
    uint8_t bytes[SERVO_PACKET_MAX + 8];
} servo_talk_t;

/* Noise and errors seen by this servo. Only servo_init() resets the counters. */
typedef struct {
    uint32_t packets, answers, checksum_errors, framing_errors, gaps, oversize, deaf;
} servo_stats_t;

typedef struct servo {
    servo_model_t model;
    bool powered;
    bool shutdown; /* an alarm has cut the torque; ends when torque limit and torque enable are written again */
    bool held;     /* the horn is blocked and cannot move */
    uint8_t table[SERVO_TABLE_BYTES];
    uint8_t alarms;   /* live and latched SERVO_ERR_VOLTAGE | ANGLE | HEAT | OVERLOAD */
    bool overloaded;  /* latched until the torque limit is written or power is lost */
    uint16_t skew_us; /* extra reply delay: clock error of this servo */

    /* Physics (servo_motion.h). Positions in servo units, 1024 = 300 degrees. */
    bool in_body;                /* a body turns the shaft, not servo_advance() */
    double position, velocity;   /* units, units per second */
    double output;               /* duty of the motor -1..1, positive towards larger positions */
    double motor_nm;             /* motor torque in the last step */
    double governor;             /* upper limit of the duty for the moving speed, 0..1 */
    double held_at;              /* position at which it was blocked */
    double outside_load;         /* -1..1 of the stall torque at 12 V, from gravity or a hand */
    double temperature_c, ambient_c;
    double supply_v;
    uint32_t stalled_steps;
    uint64_t step_cycles;        /* integrated up to here: a multiple of SERVO_STEP_CYCLES */

    /* A registered write (REG WRITE). */
    uint8_t registered_address, registered_count, registered[SERVO_PACKET_MAX];

    /* Faults (servo_fault.h): fault_left[k] is the number of replies still to spoil; 0: off, UINT32_MAX: until
     * cleared. */
    uint32_t fault_left[16];
    uint32_t noise_state; /* pseudo-random generator of noise bytes, never 0 */
    uint32_t late_us;     /* delay of a late reply */
    double fault_v, fault_c; /* forced supply and temperature; 0 = none */

    servo_parser_t parser;
    servo_talk_t talk;
    servo_stats_t stats;
} servo_t;

/* Makes a new servo with factory values except ID and rate, at position 512, without power. rate_bps must be 2,000,000
 * / (n + 1), rounded, n = 0..254; n is stored at address 4. */
void servo_init(servo_t *servo, uint8_t id, servo_model_t model, uint32_t rate_bps);

/* Switches the supply. Power-on sets the RAM addresses to their start values, with torque off. The horn keeps its
 * position. Does nothing if the supply already has this state. */
void servo_power(servo_t *servo, uint64_t now_cycles, bool on);

/* The RESET instruction: sets EEPROM to factory values (ID 1, factory rate) and RAM from it. */
void servo_factory_reset(servo_t *servo);

/* Updates position, temperature, alarms and the read-only registers to now. Time never runs backwards. */
void servo_advance(servo_t *servo, uint64_t now_cycles);

/* Reads a register of one or two bytes, as of the last servo_advance(). */
static inline uint16_t servo_table_get(const uint8_t *table, uint8_t address, uint8_t bytes)
{
    return (uint16_t)(table[address] | (bytes == 2 ? table[address + 1] << 8 : 0));
}

static inline uint16_t servo_get(const servo_t *servo, uint8_t address, uint8_t bytes)
{
    return servo_table_get(servo->table, address, bytes);
}

/* Writes registers as a packet would. Call servo_advance() first. Returns error bits:
 * SERVO_ERR_RANGE : outside the table, read-only, locked, or a value out of range; nothing was written
 * SERVO_ERR_ANGLE : the goal is outside the angle limits; it was written, motion ends at the limit */
uint8_t servo_write(servo_t *servo, uint8_t address, const uint8_t *data, uint8_t count);

/* Makes the same checks without writing. */
uint8_t servo_check_write(const servo_t *servo, uint8_t address, const uint8_t *data, uint8_t count);

/* Rate set at address 4, bits per second. */
uint32_t servo_rate_bps(const servo_t *servo);

/* Turns the horn by hand (servo units, clamped to 0..1023). With torque on, the servo pulls back. Does nothing in a
 * body, where a hand pushes instead (outside_load). */
void servo_push_to(servo_t *servo, uint64_t now_cycles, double position);

#endif
