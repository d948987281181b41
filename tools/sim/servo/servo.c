/* SPDX-License-Identifier: MIT */
#include "servo.h"

#include <string.h>

#include "servo_fault.h"
#include "servo_motion.h"

/* One writable item. The rest of the table is read-only. */
typedef struct {
    uint8_t address, bytes;
    uint16_t low, high;
} item_t;

static const item_t items[] = {
    {SERVO_ID, 1, 0, 253},
    {SERVO_BAUD, 1, 0, 254},
    {SERVO_RETURN_DELAY, 1, 0, 254},
    {SERVO_CW_LIMIT, 2, 0, 1023},
    {SERVO_CCW_LIMIT, 2, 0, 1023},
    {SERVO_TEMPERATURE_LIMIT, 1, 0, 150},
    {SERVO_VOLTAGE_LOW, 1, 50, 250},
    {SERVO_VOLTAGE_HIGH, 1, 50, 250},
    {SERVO_MAX_TORQUE, 2, 0, 1023},
    {SERVO_RETURN_LEVEL, 1, 0, 2},
    {SERVO_ALARM_LED, 1, 0, 127},
    {SERVO_ALARM_SHUTDOWN, 1, 0, 127},
    {SERVO_TORQUE_ENABLE, 1, 0, 1},
    {SERVO_LED, 1, 0, 1},
    {SERVO_CW_MARGIN, 1, 0, 254},
    {SERVO_CCW_MARGIN, 1, 0, 254},
    {SERVO_CW_SLOPE, 1, 1, 254},
    {SERVO_CCW_SLOPE, 1, 1, 254},
    {SERVO_GOAL, 2, 0, 1023},
    {SERVO_SPEED, 2, 0, 1023},
    {SERVO_TORQUE_LIMIT, 2, 0, 1023},
    {SERVO_REGISTERED, 1, 0, 1},
    {SERVO_LOCK, 1, 1, 1}, /* once locked, only a power cycle unlocks it */
    {SERVO_PUNCH, 2, 0, 1023},
};

#define BATTERY_V 9.6 /* battery of the CM-5: 8 cells of 1.2 V */
#define STANDSTILL 1.0 /* units per second; a slower servo counts as not moving */
#define WHEEL_SPEED_MAX 2047 /* endless turn: bit 10 is the direction */
#define LOCK_OPEN_FIRST SERVO_TORQUE_ENABLE /* a locked servo still accepts writes to addresses 24..35 */
#define LOCK_OPEN_LAST (SERVO_TORQUE_LIMIT + 1)

static const uint8_t shipped_ax12[SERVO_EEPROM_BYTES] = {
    12, 0, 24, 1, 1, 250, 0, 0, 0xFF, 3, 0, 70, 60, 140, 0xFF, 3, 2, 36, 36, 0, 0, 0, 0, 0};
static const uint8_t shipped_dx117[SERVO_EEPROM_BYTES] = {
    117, 0, 24, 1, 34, 250, 0, 0, 0xFF, 3, 0, 85, 60, 190, 0xFF, 3, 2, 36, 36, 0, 0, 0, 0, 0};
static const uint8_t shipped_ax18[SERVO_EEPROM_BYTES] = {
    18, 0, 24, 1, 1, 250, 0, 0, 0xFF, 3, 0, 75, 60, 140, 0xD7, 3, 2, 36, 36, 0, 0, 0, 0, 0};
static const uint8_t *const shipped[] = {
    [SERVO_AX12] = shipped_ax12, [SERVO_DX117] = shipped_dx117, [SERVO_AX18] = shipped_ax18};

static void put(servo_t *servo, uint8_t address, uint16_t value)
{
    servo->table[address] = (uint8_t)value;
    servo->table[address + 1] = (uint8_t)(value >> 8);
}

uint32_t servo_rate_bps(const servo_t *servo)
{
    return 2000000u / (servo->table[SERVO_BAUD] + 1u);
}

static uint16_t present_position(const servo_t *servo)
{
    const double position = servo->position > 1023 ? 1023 : servo->position < 0 ? 0 : servo->position;
    return (uint16_t)(position + 0.5);
}

/* Sets the RAM addresses to their values after power-on. */
static void start_ram(servo_t *servo)
{
    memset(servo->table + SERVO_EEPROM_BYTES, 0, SERVO_TABLE_BYTES - SERVO_EEPROM_BYTES);
    servo->table[SERVO_CW_MARGIN] = servo->table[SERVO_CCW_MARGIN] = 1;
    servo->table[SERVO_CW_SLOPE] = servo->table[SERVO_CCW_SLOPE] = 32;
    put(servo, SERVO_GOAL, present_position(servo));
    put(servo, SERVO_TORQUE_LIMIT, servo_get(servo, SERVO_MAX_TORQUE, 2));
    put(servo, SERVO_PUNCH, 32);
    servo->registered_count = 0;
    servo->overloaded = servo->shutdown = false;
    servo->alarms = 0;
    servo->stalled_steps = 0;
    servo->output = servo->motor_nm = 0;
}

void servo_init(servo_t *servo, uint8_t id, servo_model_t model, uint32_t rate_bps)
{
    memset(servo, 0, sizeof *servo);
    servo->model = model;
    servo->position = 512;
    servo->ambient_c = servo->temperature_c = 30;
    servo->supply_v = BATTERY_V;
    servo->noise_state = 0x1234567u + id;
    servo->late_us = 20000;
    servo_factory_reset(servo);
    servo->table[SERVO_ID] = id;
    servo->table[SERVO_BAUD] = (uint8_t)((2000000u + rate_bps / 2) / rate_bps - 1u);
}

void servo_factory_reset(servo_t *servo)
{
    memcpy(servo->table, shipped[servo->model], SERVO_EEPROM_BYTES);
    start_ram(servo);
}

void servo_power(servo_t *servo, uint64_t now_cycles, bool on)
{
    if (servo->powered == on) {
        return;
    }
    servo_advance(servo, now_cycles);
    servo->powered = on;
    servo->talk.count = servo->talk.sent = 0;
    servo->parser.count = 0;
    start_ram(servo);
    servo_advance(servo, now_cycles);
}

/* Updates the alarm bits, and shuts down if one of them demands it. */
static void update_alarms(servo_t *servo)
{
    const double volts = servo->fault_v > 0 ? servo->fault_v : servo->supply_v;
    const double celsius = servo->fault_c > 0 ? servo->fault_c : servo->temperature_c;
    const uint16_t goal = servo_get(servo, SERVO_GOAL, 2);
    servo->table[SERVO_VOLTAGE] = (uint8_t)(volts * 10 + 0.5);
    servo->table[SERVO_TEMPERATURE] = (uint8_t)celsius;
    uint8_t alarms = servo->overloaded ? SERVO_ERR_OVERLOAD : 0;
    if (servo->table[SERVO_VOLTAGE] < servo->table[SERVO_VOLTAGE_LOW]
        || servo->table[SERVO_VOLTAGE] > servo->table[SERVO_VOLTAGE_HIGH]) {
        alarms |= SERVO_ERR_VOLTAGE;
    }
    if (servo->table[SERVO_TEMPERATURE] > servo->table[SERVO_TEMPERATURE_LIMIT]) {
        alarms |= SERVO_ERR_HEAT;
    }
    const bool outside = servo->table[SERVO_TORQUE_ENABLE] && !servo_motion_is_wheel(servo)
        && (goal < servo_get(servo, SERVO_CW_LIMIT, 2) || goal > servo_get(servo, SERVO_CCW_LIMIT, 2));
    if (outside || servo_fault_is_on(servo, SERVO_FAULT_ANGLE_LIMIT)) {
        alarms |= SERVO_ERR_ANGLE;
    }
    servo->alarms = alarms;
    if (alarms & servo->table[SERVO_ALARM_SHUTDOWN]) {
        servo->shutdown = true;
        servo->table[SERVO_TORQUE_ENABLE] = 0;
        put(servo, SERVO_TORQUE_LIMIT, 0);
    }
}

static uint16_t magnitude_and_direction(double value, double unit)
{
    const double size = (value < 0 ? -value : value) / unit + 0.5;
    return (uint16_t)((size > 1023 ? 1023 : (uint16_t)size) | (value < 0 ? 1024 : 0));
}

/* Sets the read-only registers from the physics. */
static void update_registers(servo_t *servo)
{
    put(servo, SERVO_PRESENT, present_position(servo));
    put(servo, SERVO_PRESENT_SPEED,
        magnitude_and_direction(servo->velocity, SERVO_UNITS_PER_RPM * SERVO_SPEED_UNIT_RPM));
    /* A motor pushing towards larger positions (counterclockwise) has a counterclockwise load: bit 10 clear. */
    put(servo, SERVO_PRESENT_LOAD, magnitude_and_direction(servo->output, 1.0 / 1023));
    servo->table[SERVO_MOVING] = servo->velocity > STANDSTILL || servo->velocity < -STANDSTILL;
}

/* Makes the steps that are due, with the built-in body. */
static void turn_alone(servo_t *servo, uint64_t now_cycles)
{
    while (now_cycles >= servo->step_cycles + SERVO_STEP_CYCLES) {
        if (servo_motion_is_at_rest(servo)) {
            const uint64_t steps = (now_cycles - servo->step_cycles) / SERVO_STEP_CYCLES;
            servo_motion_rest(servo, (double)steps * SERVO_STEP_S);
            servo->step_cycles += steps * SERVO_STEP_CYCLES;
            break;
        }
        servo_motion_step(servo);
        servo->step_cycles += SERVO_STEP_CYCLES;
        if (servo->powered) {
            update_alarms(servo);
        }
    }
}

void servo_advance(servo_t *servo, uint64_t now_cycles)
{
    if (!servo->in_body) {
        turn_alone(servo, now_cycles);
    }
    if (servo->powered) {
        update_alarms(servo);
        update_registers(servo);
    }
}

static const item_t *item_at(uint8_t address)
{
    for (size_t i = 0; i < sizeof items / sizeof items[0]; i++) {
        if (address >= items[i].address && address < items[i].address + items[i].bytes) {
            return &items[i];
        }
    }
    return NULL;
}

static uint16_t item_high(const servo_t *servo, const item_t *item)
{
    return item->address == SERVO_SPEED && servo_motion_is_wheel(servo) ? WHEEL_SPEED_MAX : item->high;
}

uint8_t servo_check_write(const servo_t *servo, uint8_t address, const uint8_t *data, uint8_t count)
{
    if (count == 0 || address + count > SERVO_TABLE_BYTES) {
        return SERVO_ERR_RANGE;
    }
    uint8_t after[SERVO_TABLE_BYTES]; /* a two-byte value is checked as a whole, even if only half of it is written */
    memcpy(after, servo->table, sizeof after);
    memcpy(after + address, data, count);
    uint8_t errors = 0;
    for (uint8_t a = address; a < address + count; a++) {
        const item_t *item = item_at(a);
        const bool locked = servo->table[SERVO_LOCK] && (a < LOCK_OPEN_FIRST || a > LOCK_OPEN_LAST);
        if (item == NULL || locked) {
            return SERVO_ERR_RANGE;
        }
        const uint16_t value = servo_table_get(after, item->address, item->bytes);
        if (value < item->low || value > item_high(servo, item)) {
            return SERVO_ERR_RANGE;
        }
        if (item->address == SERVO_GOAL
            && (value < servo_table_get(after, SERVO_CW_LIMIT, 2) || value > servo_table_get(after, SERVO_CCW_LIMIT, 2))) {
            errors |= SERVO_ERR_ANGLE;
        }
    }
    return errors;
}

uint8_t servo_write(servo_t *servo, uint8_t address, const uint8_t *data, uint8_t count)
{
    const uint8_t errors = servo_check_write(servo, address, data, count);
    if (errors & SERVO_ERR_RANGE) {
        return errors;
    }
    memcpy(servo->table + address, data, count);
    const uint8_t last = (uint8_t)(address + count - 1);
    if (address <= SERVO_TORQUE_LIMIT + 1 && last >= SERVO_TORQUE_LIMIT && servo_get(servo, SERVO_TORQUE_LIMIT, 2)) {
        servo->overloaded = servo->shutdown = false;
        servo->stalled_steps = 0;
    }
    /* A goal switches the torque on, as on the real servo. So a limp joint must not receive goals. */
    if (address <= SERVO_GOAL + 1 && last >= SERVO_GOAL && !servo->shutdown) {
        servo->table[SERVO_TORQUE_ENABLE] = 1;
    }
    update_alarms(servo);
    return errors;
}

void servo_push_to(servo_t *servo, uint64_t now_cycles, double position)
{
    servo_advance(servo, now_cycles);
    if (servo->in_body) {
        return;
    }
    servo->position = position < 0 ? 0 : position > 1023 ? 1023 : position;
    servo->velocity = 0;
    update_registers(servo);
}
