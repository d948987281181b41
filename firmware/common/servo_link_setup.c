/* SPDX-License-Identifier: MIT
 * The half of servo_link.h that blocks: search, torque, poses, changes on request. */
#include "bus_call.h"
#include "dxl_packet.h"
#include "servo_link.h"
#include "system.h"
#include "tick.h"

#include <stddef.h>
#include <string.h>

#define PING_TRIES 2u
#define READ_FROM DXL_AT_TORQUE_ENABLE
#define READ_BYTES (DXL_AT_PRESENT + 2u - READ_FROM)

/* for each bit of a mask */
#define FOR_EACH(id, mask) for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) if ((mask) & servo_link_bit(id))

static uint16_t word_at(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] | bytes[1] << 8);
}

/* ---- writing to many ---- */

/* One value of `count` bytes (1 or 2) to the same address of many: SYNC WRITE to those that hear it. */
static void sync_write(const servo_link_t *link, uint32_t ids, uint8_t at, uint16_t value, uint8_t count)
{
    dxl_writer_t writer;
    ids &= ~link->no_sync;
    if (ids == 0) {
        return;
    }
    (void)bus_wait(NULL);
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, at);
    dxl_put(&writer, count);
    FOR_EACH(id, ids) {
        dxl_put(&writer, id);
        dxl_put(&writer, (uint8_t)value);
        if (count == 2u) {
            dxl_put(&writer, (uint8_t)(value >> 8));
        }
    }
    (void)bus_submit(dxl_end(&writer), BUS_NO_ANSWER, 1);
    (void)bus_wait(NULL);
}

/* WRITE to one servo, whether it answers or not. */
static void write_one(const servo_link_t *link, uint8_t id, uint8_t at, uint16_t value, uint8_t count)
{
    const uint8_t params[3] = { at, (uint8_t)value, (uint8_t)(value >> 8) };
    uint8_t answer = link->no_reply & servo_link_bit(id) ? BUS_NO_ANSWER : 0;
    (void)bus_call(id, DXL_WRITE, params, (uint8_t)(count + 1u), answer, BUS_CALL_TRIES, NULL);
}

static void write_many(const servo_link_t *link, uint32_t ids, uint8_t at, uint16_t value, uint8_t count)
{
    sync_write(link, ids, at, value, count);
    FOR_EACH(id, ids & link->no_sync) {
        write_one(link, id, at, value, count);
        system_kick();
    }
}

/* ---- search ---- */

static uint32_t ping_all(uint8_t rate)
{
    uint32_t found = 0;
    bus_set_rate(rate);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        system_kick();
        if (bus_call_ping(id, PING_TRIES, NULL) == BUS_OK) {
            found |= servo_link_bit(id);
        }
    }
    return found;
}

/* Status return levels of those who answered: no READ answered is level 0, no WRITE answered level 1. */
static void look_at_levels(servo_link_t *link)
{
    uint8_t level;
    link->mute = 0;
    link->no_reply = 0;
    FOR_EACH(id, link->present) {
        system_kick();
        if (bus_call_read(id, DXL_AT_RETURN_LEVEL, &level, 1, NULL) != BUS_OK) {
            link->mute |= servo_link_bit(id);
        } else if (level < 2u) {
            link->no_reply |= servo_link_bit(id);
        }
    }
    link->present &= ~link->mute;
}

/* Who does not take a SYNC WRITE: the LED is told to change by one and does not. Restored by WRITE where it was lit. */
static void find_deaf(servo_link_t *link)
{
    uint32_t lit = 0;
    uint8_t led;
    link->no_sync = 0;
    FOR_EACH(id, link->present) {
        system_kick();
        if (bus_call_read(id, DXL_AT_LED, &led, 1, NULL) == BUS_OK && led != 0) {
            lit |= servo_link_bit(id);
        }
    }
    sync_write(link, link->present & ~lit, DXL_AT_LED, 1, 1);
    sync_write(link, link->present & lit, DXL_AT_LED, 0, 1);
    uint32_t deaf = 0;
    FOR_EACH(id, link->present) {
        system_kick();
        bool was_lit = (lit & servo_link_bit(id)) != 0;
        if (bus_call_read(id, DXL_AT_LED, &led, 1, NULL) == BUS_OK && (led != 0) == was_lit) {
            deaf |= servo_link_bit(id);
        }
    }
    sync_write(link, link->present & ~lit, DXL_AT_LED, 0, 1);
    sync_write(link, link->present & lit, DXL_AT_LED, 1, 1);
    link->no_sync = deaf;
}

void servo_link_scan(servo_link_t *link)
{
    servo_link_quiet(link);
    link->slow = ping_all(BUS_RATE_57142);
    link->present = ping_all(BUS_RATE_1M);
    look_at_levels(link);
    find_deaf(link);
    link->torque = 0;
    link->silent = 0;
    link->slopes_pending = SERVO_LINK_ALL;
    memset(link->errors, 0, sizeof link->errors);
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    link->untold_silent = 0;
    link->untold_back = 0;
    link->untold_errors = 0;
    link->untold_torque = 0;
    link->voltage_dv = 0;
    link->round_voltage_dv = 0;
    link->hottest_degrees = 0;
    link->round_degrees = 0;
    (void)servo_link_read_pose(link, link->present);
    tick_forgive();
}

/* ---- changes of a servo's EEPROM area, on request ---- */

uint32_t servo_link_fast_baud(servo_link_t *link, uint32_t ids)
{
    const uint8_t params[2] = { DXL_AT_BAUD, BUS_RATE_1M };
    ids &= link->slow;
    servo_link_quiet(link);
    bus_set_rate(BUS_RATE_57142);
    FOR_EACH(id, ids) {
        system_kick();
        /* It may answer at either rate, or not at all: the search afterwards tells. */
        (void)bus_call(id, DXL_WRITE, params, 2, 0, 1, NULL);
    }
    servo_link_scan(link);
    return ids & link->present;
}

uint32_t servo_link_fast_answers(servo_link_t *link, uint32_t ids)
{
    uint32_t done = 0;
    uint8_t delay;
    ids &= link->present;
    servo_link_quiet(link);
    FOR_EACH(id, ids) {
        system_kick();
        write_one(link, id, DXL_AT_RETURN_DELAY, 0, 1);
        if (bus_call_read(id, DXL_AT_RETURN_DELAY, &delay, 1, NULL) == BUS_OK && delay == 0) {
            done |= servo_link_bit(id);
        }
    }
    tick_forgive();
    return done;
}

/* ---- pose and torque ---- */

/* Reads torque, goal, limit and pose of one servo; false: no answer. */
static bool read_one(servo_link_t *link, uint8_t id, uint8_t table[READ_BYTES])
{
    uint32_t bit = servo_link_bit(id);
    system_kick();
    if (bus_call_read(id, READ_FROM, table, READ_BYTES, NULL) != BUS_OK) {
        return false;
    }
    uint16_t pos = word_at(table + (DXL_AT_PRESENT - READ_FROM)) & 1023u;
    bool on = table[0] != 0 && word_at(table + (DXL_AT_TORQUE_LIMIT - READ_FROM)) != 0;
    link->present_pos[id] = servo_link_to_page(link, id, pos);
    link->torque = on ? link->torque | bit : link->torque & ~bit;
    link->silent &= ~bit;
    return true;
}

uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids)
{
    uint8_t table[READ_BYTES];
    uint32_t answered = 0;
    servo_link_quiet(link);
    FOR_EACH(id, ids & link->present) {
        if (read_one(link, id, table)) {
            answered |= servo_link_bit(id);
        }
    }
    return answered;
}

/* Torque on for one servo that is off: the goal first, so that it stays where it is. */
static bool torque_on_one(servo_link_t *link, uint8_t id, const uint8_t table[READ_BYTES])
{
    uint8_t check[READ_BYTES];
    uint8_t maximum[2];
    uint16_t pos = word_at(table + (DXL_AT_PRESENT - READ_FROM)) & 1023u;
    if (word_at(table + (DXL_AT_TORQUE_LIMIT - READ_FROM)) == 0) {
        if (bus_call_read(id, DXL_AT_MAX_TORQUE, maximum, 2, NULL) != BUS_OK) {
            return false;
        }
        write_many(link, servo_link_bit(id), DXL_AT_GOAL, pos, 2);
        write_many(link, servo_link_bit(id), DXL_AT_TORQUE_LIMIT, word_at(maximum), 2);
    }
    write_many(link, servo_link_bit(id), DXL_AT_GOAL, pos, 2);
    write_many(link, servo_link_bit(id), DXL_AT_TORQUE_ENABLE, 1, 1);
    return read_one(link, id, check) && (link->torque & servo_link_bit(id)) != 0;
}

uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids)
{
    uint8_t table[READ_BYTES];
    uint32_t on = 0;
    servo_link_quiet(link);
    FOR_EACH(id, ids & link->present) {
        if (read_one(link, id, table) && ((link->torque & servo_link_bit(id)) || torque_on_one(link, id, table))) {
            on |= servo_link_bit(id);
        }
    }
    return on;
}

void servo_link_torque_off(servo_link_t *link, uint32_t ids)
{
    ids &= link->present;
    servo_link_quiet(link);
    sync_write(link, ids, DXL_AT_TORQUE_ENABLE, 0, 1);
    write_many(link, ids, DXL_AT_TORQUE_ENABLE, 0, 1);
    link->torque &= ~ids;
    link->untold_torque &= ~ids;
}

void servo_link_full_speed(servo_link_t *link, uint32_t ids)
{
    servo_link_quiet(link);
    write_many(link, ids & link->present, DXL_AT_SPEED, 0, 2);
}
