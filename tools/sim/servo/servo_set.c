/* SPDX-License-Identifier: MIT
 * servo_set.c - the servos on the bus: adding, supply, faults. */
#include "servo_bus.h"

#include <stdlib.h>

servo_bus_t *servo_bus_new(void)
{
    servo_bus_t *bus = calloc(1, sizeof *bus);
    if (bus) {
        bus->powered = true;
        bus->supply_v = 9.6;
        bus->next_cycles = SERVO_BUS_NEVER;
    }
    return bus;
}

void servo_bus_free(servo_bus_t *bus)
{
    if (bus) {
        for (int i = 0; i < bus->count; i++) {
            free(bus->servos[i]);
        }
        free(bus->servos);
        free(bus->shafts);
        free(bus);
    }
}

servo_t *servo_bus_find(const servo_bus_t *bus, uint8_t id)
{
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i]->table[SERVO_ID] == id) {
            return bus->servos[i];
        }
    }
    return NULL;
}

servo_t *servo_bus_add(servo_bus_t *bus, uint8_t id, servo_model_t model, uint32_t rate_bps)
{
    servo_t *servo = malloc(sizeof *servo);
    servo_t **servos = realloc(bus->servos, (size_t)(bus->count + 1) * sizeof *servos);
    if (servos) {
        bus->servos = servos;
    }
    servo_shaft_t *shafts = realloc(bus->shafts, (size_t)(bus->count + 1) * sizeof *shafts);
    if (shafts) {
        bus->shafts = shafts;
    }
    if (servo == NULL || servos == NULL || shafts == NULL) {
        free(servo);
        return NULL;
    }
    servo_init(servo, id, model, rate_bps);
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i]->table[SERVO_ID] == id) {
            servo->skew_us = (uint16_t)(servo->skew_us + SERVO_TWIN_SKEW_US);
        }
    }
    servo->supply_v = bus->supply_v;
    servo->step_cycles = bus->now_cycles - bus->now_cycles % SERVO_STEP_CYCLES;
    shafts[bus->count] = (servo_shaft_t){.id = id};
    bus->servos[bus->count++] = servo;
    if (bus->body.step) {
        servo_bus_look_at_body(bus);
    }
    servo_power(servo, bus->now_cycles, bus->powered);
    return servo;
}

void servo_bus_power(servo_bus_t *bus, uint64_t now_cycles, bool on)
{
    servo_bus_advance(bus, now_cycles);
    bus->powered = on;
    for (int i = 0; i < bus->count; i++) {
        servo_power(bus->servos[i], now_cycles, on && !servo_fault_is_on(bus->servos[i], SERVO_FAULT_DEAD));
    }
    servo_bus_update_next(bus);
}

void servo_bus_supply(servo_bus_t *bus, uint64_t now_cycles, double volts)
{
    servo_bus_advance(bus, now_cycles);
    bus->supply_v = volts;
    for (int i = 0; i < bus->count; i++) {
        servo_advance(bus->servos[i], now_cycles);
        bus->servos[i]->supply_v = volts;
    }
}

static void set_fault(servo_bus_t *bus, servo_t *servo, servo_fault_t fault, uint32_t answers)
{
    servo_fault_set(servo, fault, answers);
    servo_power(servo, bus->now_cycles, bus->powered && !servo_fault_is_on(servo, SERVO_FAULT_DEAD));
    servo_advance(servo, bus->now_cycles);
}

/* The twin of a duplicate ID stays on the bus; without the fault it is dead. */
static void set_twin(servo_bus_t *bus, const servo_t *servo, bool on)
{
    const uint8_t id = servo->table[SERVO_ID];
    servo_t *twin = NULL;
    for (int i = 0; i < bus->count; i++) {
        if (bus->servos[i] != servo && bus->servos[i]->table[SERVO_ID] == id) {
            twin = bus->servos[i];
        }
    }
    if (twin == NULL && on) {
        twin = servo_bus_add(bus, id, servo->model, servo_rate_bps(servo));
    }
    if (twin) {
        set_fault(bus, twin, SERVO_FAULT_DEAD, on ? 0 : SERVO_FAULT_ALWAYS);
    }
}

void servo_bus_fault(servo_bus_t *bus, uint64_t now_cycles, servo_t *servo, servo_fault_t fault, uint32_t answers)
{
    servo_bus_advance(bus, now_cycles);
    servo_advance(servo, now_cycles);
    if (fault == SERVO_FAULT_DUPLICATE) {
        set_twin(bus, servo, answers > 0);
    }
    set_fault(bus, servo, fault, answers);
    servo_bus_update_next(bus);
}
