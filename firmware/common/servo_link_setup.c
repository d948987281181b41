/* SPDX-License-Identifier: MIT
 * servo_link_setup.c - the blocking half of servo_link.h: search, torque, poses, single writes. */
#include "bus_call.h"
#include "dxl_packet.h"
#include "servo_link.h"
#include "system.h"
#include "tick.h"

#include <stddef.h>
#include <string.h>

#define PING_TRIES 2u
#define WRITE_BYTES_MAX 4u
#define NEAR_POS 16u   /* 5 degrees */
/* The registers that the search, torque_on, read_pose and engage read: angle limits to present speed. */
#define READ_FROM DXL_AT_CW_LIMIT
#define READ_BYTES (DXL_AT_PRESENT_SPEED + 2u - READ_FROM)
STATIC_ASSERT(READ_BYTES <= DXL_ANSWER_PARAMS, "the bus takes the answer");

/* A word of a table from READ_FROM on. */
static uint16_t word_in(const uint8_t table[READ_BYTES], uint8_t at)
{
    const uint8_t *bytes = &table[at - READ_FROM];
    return bytes[0] | bytes[1] << 8;
}

/* The servo's own present position. */
static uint16_t present_in(const uint8_t table[READ_BYTES])
{
    return word_in(table, DXL_AT_PRESENT) & 1023u;
}

/* ---- one servo after the other ---- */

/* Acts on one servo. true: success. */
typedef bool (*servo_action_t)(servo_link_t *link, uint8_t id);

/* Acts on each of `ids`. Returns those with success. */
static uint32_t for_each(servo_link_t *link, uint32_t ids, servo_action_t action)
{
    uint32_t done = 0;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&ids, id)) {
            system_kick();
            servo_link_put(&done, id, action(link, id));
        }
    }
    return done;
}

/* Ends the tick's traffic, then acts on those of `ids` that are present. NOINLINE saves 40 bytes. */
static NOINLINE uint32_t for_present(servo_link_t *link, uint32_t ids, servo_action_t action)
{
    servo_link_quiet(link);
    return for_each(link, ids & link->present, action);
}

static bool read_byte(uint8_t id, uint8_t at, uint8_t *byte)
{
    return bus_call_read(id, at, byte, 1, NULL) == BUS_OK;
}

/* For a servo that answers only READ: writes and reads back. */
static bool write_and_read(servo_link_t *link, uint8_t id, const uint8_t *params, uint8_t count)
{
    uint8_t read[WRITE_BYTES_MAX];
    for (uint8_t tries = BUS_CALL_TRIES; tries > 0; tries--) {
        (void)bus_call(id, DXL_WRITE, params, count + 1u, BUS_NO_ANSWER, 1, NULL);
        if (bus_call_read(id, params[0], read, count, NULL) != BUS_OK) {
            servo_link_lost(link, id);
            return false;
        }
        if (memcmp(read, params + 1, count) == 0) {
            return true;
        }
    }
    return false;
}

bool servo_link_write(servo_link_t *link, uint8_t id, uint8_t at, const uint8_t *from, uint8_t count)
{
    const uint8_t answer = servo_link_write_answer(link, id);
    uint8_t params[1u + WRITE_BYTES_MAX] = { at };
    memcpy(&params[1], from, count);
    if (answer == BUS_NO_ANSWER) {
        return write_and_read(link, id, params, count);
    }
    const bus_status_t status = bus_call(id, DXL_WRITE, params, count + 1u, answer, BUS_CALL_TRIES, NULL);
    if (status != BUS_OK && status != BUS_ERR_REJECTED) {
        servo_link_lost(link, id);
    }
    return status == BUS_OK;
}

/* Writes one or two bytes. */
static bool write_one(servo_link_t *link, uint8_t id, uint8_t at, uint16_t value, uint8_t count)
{
    const uint8_t bytes[2] = { (uint8_t)value, (uint8_t)(value >> 8) };
    return servo_link_write(link, id, at, bytes, count);
}

/* Reads limits, torque, goal and pose of one servo; false: no answer. */
static bool read_table(servo_link_t *link, uint8_t id, uint8_t table[READ_BYTES])
{
    const bool heard = bus_call_read(id, READ_FROM, table, READ_BYTES, NULL) == BUS_OK;
    servo_link_put(&link->silent, id, !heard);
    if (!heard) {
        servo_link_put(&link->outside, id, false); /* nobody knows */
        return false;
    }
    bool on = table[DXL_AT_TORQUE_ENABLE - READ_FROM] != 0 && word_in(table, DXL_AT_TORQUE_LIMIT) != 0;
    link->present_pos[id] = servo_link_to_page(link, id, present_in(table));
    servo_link_put(&link->torque, id, on);
    return true;
}

/* ---- search ---- */

/* A PC's program that is asked to end does not search on: over an adapter the search takes seconds. */
static bool ping(servo_link_t *link, uint8_t id)
{
    return !system_is_asked_to_end() && bus_call_ping(id, PING_TRIES, NULL) == BUS_OK;
}

/* At status return level 0 a servo answers no READ, at level 1 no WRITE. One with both limits 0 would turn without end at
 * the speed of a goal: it is not used. */
static bool is_usable(servo_link_t *link, uint8_t id)
{
    uint8_t table[READ_BYTES];
    if (!read_table(link, id, table)) {
        servo_link_put(&link->silent, id, false);   /* it is not present */
        return false;
    }
    servo_link_put(&link->no_reply, id, table[DXL_AT_RETURN_LEVEL - READ_FROM] < 2u);
    const bool is_joint = (word_in(table, DXL_AT_CW_LIMIT) | word_in(table, DXL_AT_CCW_LIMIT)) != 0;
    servo_link_put(&link->endless, id, !is_joint);
    return is_joint;
}

static bool is_led_dark(servo_link_t *link, uint8_t id)
{
    uint8_t led;
    return read_byte(id, DXL_AT_LED, &led) && led == 0;
}

/* Writes one byte to the same address of many servos, by SYNC WRITE. */
static void sync_write(uint32_t ids, uint8_t at, uint8_t value)
{
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, at);
    dxl_put(&writer, 1);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, ids >>= 1) {
        if ((ids & 1u) != 0) {
            dxl_put(&writer, id);
            dxl_put(&writer, value);
        }
    }
    (void)bus_submit(dxl_end(&writer), BUS_NO_ANSWER, 1);
    (void)bus_wait(NULL);
}

void servo_link_scan(servo_link_t *link)
{
    servo_link_quiet(link);
    memset(link, 0, offsetof(servo_link_t, present_pos));
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    link->slopes_pending = SERVO_LINK_ALL;
    bus_set_rate(BUS_RATE_57142);
    link->slow = for_each(link, SERVO_LINK_ALL, ping);
    bus_set_rate(BUS_RATE_1M);
    link->present = for_each(link, for_each(link, SERVO_LINK_ALL, ping), is_usable);
    sync_write(link->present, DXL_AT_LED, 1);
    link->no_sync = for_each(link, link->present, is_led_dark);
    sync_write(link->present, DXL_AT_LED, 0);
    tick_forgive();
}

/* ---- pose and torque ---- */

static bool read_pose(servo_link_t *link, uint8_t id)
{
    uint8_t table[READ_BYTES];
    return read_table(link, id, table);
}

uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids)
{
    return for_present(link, ids, read_pose);
}

/* Whether a limp servo can be held where it stands. One that a hand has left outside its own angle limits cannot: it would
 * leap to the limit at full speed. NEAR_POS: gears have play, so it may stand a little beyond a limit to which it was
 * driven. */
static bool can_hold(servo_link_t *link, uint8_t id, const uint8_t table[READ_BYTES])
{
    const uint16_t pos = present_in(table);
    const bool inside = pos + NEAR_POS >= word_in(table, DXL_AT_CW_LIMIT) &&
                        pos <= word_in(table, DXL_AT_CCW_LIMIT) + NEAR_POS;
    servo_link_put(&link->outside, id, !inside);
    return inside;
}

/* Makes the present position the goal, so that the servo does not move, and reads it back. */
static bool hold_still(servo_link_t *link, uint8_t id, uint8_t table[READ_BYTES])
{
    const uint16_t pos = present_in(table);
    return can_hold(link, id, table) && write_one(link, id, DXL_AT_GOAL, pos, 2) && read_table(link, id, table) &&
           word_in(table, DXL_AT_GOAL) == pos;
}

/* Writes the goal first, then the torque limit, which a shutdown may have set to 0, then torque, which many servos switch on
 * by themselves with the goal. */
static bool switch_on(servo_link_t *link, uint8_t id, uint8_t table[READ_BYTES])
{
    if (!read_table(link, id, table)) {
        return false;
    }
    if (servo_link_has(&link->torque, id)) {
        return true;
    }
    if (!hold_still(link, id, table)) {
        return false;
    }
    if (word_in(table, DXL_AT_TORQUE_LIMIT) == 0 &&
        !write_one(link, id, DXL_AT_TORQUE_LIMIT, word_in(table, DXL_AT_MAX_TORQUE), 2)) {
        return false;
    }
    return servo_link_has(&link->torque, id) || (write_one(link, id, DXL_AT_TORQUE_ENABLE, 1, 1) &&
                                                 read_table(link, id, table) && servo_link_has(&link->torque, id));
}

static bool torque_on(servo_link_t *link, uint8_t id)
{
    uint8_t table[READ_BYTES];
    return switch_on(link, id, table);
}

uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids)
{
    return for_present(link, ids, torque_on);
}

static bool torque_off(servo_link_t *link, uint8_t id)
{
    const bool done = write_one(link, id, DXL_AT_TORQUE_ENABLE, 0, 1);
    servo_link_put(&link->torque, id, false);
    servo_link_put(&link->unreported[SERVO_FAULT_TORQUE - 1], id, false);
    return done;
}

uint32_t servo_link_torque_off(servo_link_t *link, uint32_t ids)
{
    servo_link_quiet(link);
    const bool none_left_on = (link->torque & ~ids) == 0; /* none that the last search has missed, either */
    sync_write(none_left_on ? UINT32_MAX : ids, DXL_AT_TORQUE_ENABLE, 0);
    return for_present(link, ids, torque_off);
}

/* A servo with a speed limit may still be on its way to a far goal. Its goal and its limit change in one packet, because
 * without the limit it would leap. One without a limit that is still moving lags behind the last play: it goes on to its
 * goal, because it will have left the position that was read before the first goal comes. */
bool servo_link_engage(servo_link_t *link, uint8_t id, uint16_t *pos)
{
    uint8_t table[READ_BYTES];
    uint8_t *goal = table + (DXL_AT_GOAL - READ_FROM), *speed = table + (DXL_AT_SPEED - READ_FROM);
    servo_link_quiet(link);
    system_kick();
    if (!switch_on(link, id, table)) {
        return false;
    }
    const bool slow = word_in(table, DXL_AT_SPEED) != 0;
    const bool lags = !slow && word_in(table, DXL_AT_PRESENT_SPEED) != 0;
    *pos = (uint16_t)((lags ? word_in(table, DXL_AT_GOAL) : present_in(table)) - (uint16_t)link->trim_pos[id]);
    if (slow) {
        memcpy(goal, table + (DXL_AT_PRESENT - READ_FROM), 2);
        memset(speed, 0, 2);
    }
    return servo_link_write(link, id, DXL_AT_GOAL, goal, 4);
}
