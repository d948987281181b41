/* SPDX-License-Identifier: MIT
 * servo_api.h - servos as flat functions, for bindings (python/cm5sim/servo.py) that know no C structs.
 * Functions with now_cycles update the servo to that time first. */
#ifndef SIM_SERVO_API_H
#define SIM_SERVO_API_H

#include "servo_bus.h"

int servo_api_count(const servo_bus_t *bus);
servo_t *servo_api_at(const servo_bus_t *bus, int index); /* in the order of servo_bus_add() */
uint8_t servo_api_id(const servo_t *servo);

/* Converts "ax12", "ax18", "dx117" to servo_model_t. -1: no such model. */
int servo_api_model(const char *name);

/* Reads a register of one or two bytes. */
uint16_t servo_api_get(servo_t *servo, uint64_t now_cycles, uint8_t address, uint8_t bytes);

/* Writes registers as a packet would. Returns error bits. */
uint8_t servo_api_write(servo_t *servo, uint64_t now_cycles, uint8_t address, const uint8_t *data, uint8_t count);

/* Error bits of the next reply, apart from errors of its own packet. */
uint8_t servo_api_alarms(servo_t *servo, uint64_t now_cycles);

/* Physical state that no register shows. Only LOAD .. LATE_US may be set. */
typedef enum {
    SERVO_API_POSITION,  /* units, with fractions */
    SERVO_API_VELOCITY,  /* units per second */
    SERVO_API_OUTPUT,    /* motor output -1..1 */
    SERVO_API_LOAD,      /* outside load, -1..1 of stall torque */
    SERVO_API_AMBIENT,   /* degrees C */
    SERVO_API_CELSIUS,   /* temperature, degrees C */
    SERVO_API_HELD,      /* not 0: blocked */
    SERVO_API_LATE_US,   /* delay of the fault "late" */
    SERVO_API_TORQUE,    /* motor torque, N m, positive towards larger positions */
    SERVO_API_POWERED    /* not 0: has power */
} servo_api_state_t;
double servo_api_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which);
void servo_api_set_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which, double value);

/* Restores the EEPROM area (addresses 0..SERVO_EEPROM_BYTES - 1). Call it before the servo gets power. */
void servo_api_restore(servo_t *servo, const uint8_t *eeprom);

/* For a trace: the goal (-1: limp) and the position, with fractions, of each of the first `count` servos. */
void servo_api_row(servo_bus_t *bus, uint64_t now_cycles, int count, double *goals_and_positions);

/* For a bus without a board: the receiver of the servos' bytes, and the time of the next event of the bus. */
void servo_api_listen(servo_bus_t *bus, servo_bus_byte_fn heard);
uint64_t servo_api_next_cycles(const servo_bus_t *bus);

/* Counters in the order of servo_stats_t: packets, answers, checksum errors, framing errors, gaps, oversize, deaf. */
uint32_t servo_api_counter(const servo_t *servo, int index);

/* Sets a fault by name, for this many replies (0: off, UINT32_MAX: until cleared). false: no such fault. */
bool servo_api_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, const char *name, uint32_t answers);
void servo_api_clear(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo);

#endif
