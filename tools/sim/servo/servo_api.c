/* SPDX-License-Identifier: MIT */
#include "servo_api.h"

#include <stddef.h>
#include <string.h>

int servo_api_count(const servo_bus_t *bus)
{
    return bus->count;
}

servo_t *servo_api_at(const servo_bus_t *bus, int index)
{
    return index >= 0 && index < bus->count ? bus->servos[index] : NULL;
}

uint8_t servo_api_id(const servo_t *servo)
{
    return servo->table[SERVO_ID];
}

int servo_api_model(const char *name)
{
    static const char *const names[] = {[SERVO_AX12] = "ax12", [SERVO_DX117] = "dx117", [SERVO_AX18] = "ax18"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(name, names[i]) == 0) {
            return (int)i;
        }
    }
    return -1;
}

uint16_t servo_api_get(servo_t *servo, uint64_t now_cycles, uint8_t address, uint8_t bytes)
{
    servo_advance(servo, now_cycles);
    return address + bytes <= SERVO_TABLE_BYTES ? servo_get(servo, address, bytes) : 0;
}

uint8_t servo_api_write(servo_t *servo, uint64_t now_cycles, uint8_t address, const uint8_t *data, uint8_t count)
{
    servo_advance(servo, now_cycles);
    return servo_write(servo, address, data, count);
}

uint8_t servo_api_alarms(servo_t *servo, uint64_t now_cycles)
{
    servo_advance(servo, now_cycles);
    return servo->alarms;
}

double servo_api_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which)
{
    servo_advance(servo, now_cycles);
    switch (which) {
    case SERVO_API_POSITION: return servo->position;
    case SERVO_API_VELOCITY: return servo->velocity;
    case SERVO_API_OUTPUT: return servo->output;
    case SERVO_API_LOAD: return servo->outside_load;
    case SERVO_API_AMBIENT: return servo->ambient_c;
    case SERVO_API_CELSIUS: return servo->temperature_c;
    case SERVO_API_HELD: return servo->held;
    case SERVO_API_LATE_US: return servo->late_us;
    case SERVO_API_TORQUE: return servo->motor_nm;
    case SERVO_API_POWERED: return servo->powered;
    }
    return 0;
}

void servo_api_set_state(servo_t *servo, uint64_t now_cycles, servo_api_state_t which, double value)
{
    servo_advance(servo, now_cycles);
    switch (which) {
    case SERVO_API_LOAD: servo->outside_load = value; break;
    case SERVO_API_AMBIENT: servo->ambient_c = value; break;
    case SERVO_API_CELSIUS: servo->temperature_c = value; break;
    case SERVO_API_HELD: servo->held = value != 0; break;
    case SERVO_API_LATE_US: servo->late_us = (uint32_t)value; break;
    default: break;
    }
    servo_advance(servo, now_cycles);
}

void servo_api_restore(servo_t *servo, const uint8_t *eeprom)
{
    memcpy(servo->table, eeprom, SERVO_EEPROM_BYTES);
}

void servo_api_row(servo_bus_t *bus, uint64_t now_cycles, int count, double *goals_and_positions)
{
    for (int i = 0; i < count; i++) {
        servo_t *servo = bus->servos[i];
        servo_advance(servo, now_cycles);
        const bool driven = servo->powered && servo->table[SERVO_TORQUE_ENABLE];
        goals_and_positions[2 * i] = driven ? servo_get(servo, SERVO_GOAL, 2) : -1;
        goals_and_positions[2 * i + 1] = servo->position;
    }
}

void servo_api_listen(servo_bus_t *bus, servo_bus_byte_fn heard)
{
    bus->on_byte = heard;
}

uint64_t servo_api_next_cycles(const servo_bus_t *bus)
{
    return servo_bus_next_cycles(bus);
}

uint32_t servo_api_counter(const servo_t *servo, int index)
{
    const uint32_t counters[] = {servo->stats.packets, servo->stats.answers, servo->stats.checksum_errors,
                                 servo->stats.framing_errors, servo->stats.gaps, servo->stats.oversize,
                                 servo->stats.deaf};
    return index >= 0 && index < (int)(sizeof counters / sizeof counters[0]) ? counters[index] : 0;
}

bool servo_api_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, const char *name, uint32_t answers)
{
    const servo_fault_t fault = servo_fault_by_name(name);
    if (fault == SERVO_FAULTS) {
        return false;
    }
    servo_bus_fault(bus, now_cycles, servo, fault, answers);
    return true;
}

void servo_api_clear(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo)
{
    for (int fault = 0; fault < SERVO_FAULTS; fault++) {
        if (servo_fault_is_on(servo, (servo_fault_t)fault)) {
            servo_bus_fault(bus, now_cycles, servo, (servo_fault_t)fault, 0);
        }
    }
}
