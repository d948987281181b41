/* SPDX-License-Identifier: MIT
 * servo_api.h - servos as flat functions, for bindings (python/cm5sim/servo.py) that know no C structs.
 * Every reading is as of now_cycles: the servo is brought up to it first. */
#ifndef SIM_SERVO_API_H
#define SIM_SERVO_API_H

#include "servo_bus.h"

int servo_api_count(const servo_bus_t *bus);
servo_t *servo_api_at(const servo_bus_t *bus, int index); /* in order of plugging in */
uint8_t servo_api_id(const servo_t *servo);

/* "ax12", "ax18", "dx117" as servo_model_t; -1: no such model. */
int servo_api_model(const char *name);

/* Register of the control table, one or two bytes. */
uint16_t servo_api_get(servo_t *servo, uint64_t now_cycles, uint8_t address, uint8_t bytes);

/* Writes registers as a packet would; returns error bits. */
uint8_t servo_api_write(servo_t *servo, uint64_t now_cycles, uint8_t address, const uint8_t *data, uint8_t count);

/* Error bits that the next answer will carry, other than of its own packet. */
uint8_t servo_api_alarms(servo_t *servo, uint64_t now_cycles);

/* The body, beyond what registers show. Only LOAD .. LATE_US may be set. */
typedef enum {
    SERVO_API_POSITION,  /* units, with fractions */
    SERVO_API_VELOCITY,  /* units per second */
    SERVO_API_OUTPUT,    /* motor output -1..1 */
    SERVO_API_LOAD,      /* outside load -1..1 of stall torque */
    SERVO_API_AMBIENT,   /* degrees C */
    SERVO_API_CELSIUS,   /* temperature, degrees C */
    SERVO_API_HELD,      /* not 0: blocked */
    SERVO_API_LATE_US,   /* how late the fault "late" answers */
    SERVO_API_TORQUE,    /* of the motor, N m, positive towards larger positions */
    SERVO_API_POWERED    /* not 0: it has power */
} servo_api_state_t;
double servo_api_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which);
void servo_api_set_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which, double value);

/* Puts the EEPROM area (addresses 0..SERVO_EEPROM_BYTES - 1) back as it was kept. Before the servo gets power. */
void servo_api_restore(servo_t *servo, const uint8_t *eeprom);

/* For a trace: of each of the first `count` servos its goal (-1: limp) and its position, with fractions. */
void servo_api_row(servo_bus_t *bus, uint64_t now_cycles, int count, double *goals_and_positions);

/* The bus without a board: who hears the servos' bytes, and when the bus has its next event by itself. */
void servo_api_listen(servo_bus_t *bus, servo_bus_byte_fn heard);
uint64_t servo_api_next_cycles(const servo_bus_t *bus);

/* Counters in the order of servo_stats_t: packets, answers, checksum errors, framing errors, gaps, oversize, deaf. */
uint32_t servo_api_counter(const servo_t *servo, int index);

/* A fault by its name, for so many answers (0: off, UINT32_MAX: until cleared). false: no such fault. */
bool servo_api_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, const char *name, uint32_t answers);
void servo_api_clear(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo);

#endif
