/* SPDX-License-Identifier: MIT */
#include "servo_link.h"
#include "bus.h"
#include "bus_call.h"
#include "dxl_packet.h"

#include <stddef.h>
#include <string.h>

/* Where a tick stands. A tick begins at PHASE_POLL, or at PHASE_GOALS when there are goals:
 *
 *   GOALS -> SLOPES -> DEAF -> ACTION -> POLL -> POLLING -> DONE       (each may be skipped)
 *
 * QUIET: others use the bus until the next tick. */
enum { PHASE_QUIET = 0, PHASE_GOALS, PHASE_SLOPES, PHASE_DEAF, PHASE_ACTION, PHASE_POLL, PHASE_POLLING, PHASE_DONE };

#define POS_MAX 1023
/* What a packet holds: 7 bytes around, the checksum, and per joint ID, slopes and goal. */
#define JOINTS_WITH_SLOPES ((DXL_PACKET_MAX - 8u) / 5u)
/* The health poll's stretch of the control table. */
#define POLL_AT DXL_AT_TORQUE_ENABLE
#define POLL_BYTES (DXL_AT_TEMPERATURE + 1u - POLL_AT)
#define FAULT_BITS (DXL_ERR_VOLTAGE | DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

uint32_t servo_link_bit(uint8_t id)
{
    return SERVO_LINK_BIT(id);
}

void servo_link_init(servo_link_t *link)
{
    memset(link, 0, sizeof *link);
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    link->phase = PHASE_QUIET;
}

uint32_t servo_link_drivable(const servo_link_t *link)
{
    return link->present & link->torque & ~link->silent;
}

/* ---- coordinates ---- */

static uint16_t limited(int16_t pos)
{
    return pos < 0 ? 0u : pos > POS_MAX ? (uint16_t)POS_MAX : (uint16_t)pos;
}

uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos)
{
    return limited((int16_t)((int16_t)pos + link->trim_pos[id]));
}

uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos)
{
    return limited((int16_t)((int16_t)servo_pos - link->trim_pos[id]));
}

uint32_t servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS])
{
    uint32_t refused = 0;
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        int16_t trim = trim_pos == NULL ? 0 : trim_pos[id];
        if (trim > SERVO_LINK_TRIM_MAX || trim < -SERVO_LINK_TRIM_MAX) {
            refused |= servo_link_bit(id);
            trim = 0;
        }
        link->trim_pos[id] = trim;
    }
    return refused;
}

/* ---- one tick of goals ---- */

/* Slope register values of a compliance byte: 2^nibble. */
static uint8_t slope(uint8_t nibble)
{
    return (uint8_t)(1u << (nibble >= 1u && nibble <= 7u ? nibble : 5u));
}

static void put_slopes(dxl_writer_t *writer, uint8_t compliance)
{
    dxl_put(writer, slope(compliance >> 4));
    dxl_put(writer, slope(compliance & 0x0Fu));
}

/* The tick's one packet. 31 joints: 101 bytes. */
static uint8_t build_goals(const servo_link_t *link, uint32_t joints)
{
    const uint16_t *goal = link->goals_pos;
    const int16_t *trim = link->trim_pos;
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_GOAL);
    dxl_put(&writer, 2);
    for (uint8_t id = 0; joints != 0; id++, joints >>= 1, goal++, trim++) {
        if ((uint8_t)joints & 1u) {
            uint16_t pos = limited((int16_t)((int16_t)*goal + *trim));
            dxl_put(&writer, id);
            dxl_put(&writer, (uint8_t)pos);
            dxl_put(&writer, (uint8_t)(pos >> 8));
        }
    }
    return dxl_end(&writer);
}

/* Slopes of `joints`, with the goals behind them or alone. Rare: after a page change. */
static uint8_t build_slopes(const servo_link_t *link, uint32_t joints, bool with_goals)
{
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_CW_SLOPE);
    dxl_put(&writer, with_goals ? 4 : 2);
    for (uint8_t id = 0; joints != 0; id++, joints >>= 1) {
        if (joints & 1u) {
            dxl_put(&writer, id);
            put_slopes(&writer, link->slopes[id]);
            if (with_goals) {
                uint16_t pos = servo_link_to_servo(link, id, link->goals_pos[id]);
                dxl_put(&writer, (uint8_t)pos);
                dxl_put(&writer, (uint8_t)(pos >> 8));
            }
        }
    }
    return dxl_end(&writer);
}

static uint8_t count_bits(uint32_t mask)
{
    uint8_t count = 0;
    for (; mask != 0; mask &= mask - 1u) {
        count++;
    }
    return count;
}

static void count_late(servo_link_t *link)
{
    link->late = (uint16_t)(link->late + (link->late != 0xFFFFu));
}

static void send_action(void)
{
    (void)bus_submit(dxl_build(bus_packet(), DXL_BROADCAST, DXL_ACTION, NULL, 0), BUS_NO_ANSWER, 1);
}

void servo_link_goals(servo_link_t *link, const uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints)
{
    uint8_t size;
    if (bus_is_busy()) {
        count_late(link);
        (void)bus_wait(NULL);
    }
    if (link->phase == PHASE_DEAF && link->deaf_left == 0) {
        send_action();              /* the last tick did not get to it */
        (void)bus_wait(NULL);
    }
    joints &= servo_link_drivable(link);
    link->goals_pos = goal_pos;
    link->goals_joints = joints;
    if (link->deaf_left != 0) {
        count_late(link);           /* the round begun a tick ago goes on, with the new goals */
    } else {
        link->deaf_left = joints & link->no_sync;
    }
    uint32_t hearing = joints & ~link->no_sync;
    uint32_t pending = link->slopes_pending & hearing;
    link->phase = PHASE_GOALS;
    if (hearing == 0) {
        return;
    }
    if (pending != 0 && count_bits(hearing) <= JOINTS_WITH_SLOPES) {
        size = build_slopes(link, hearing, true);
        link->slopes_pending &= ~hearing;
    } else {
        size = build_goals(link, hearing);
    }
    (void)bus_submit(size, BUS_NO_ANSWER, 1);
}

void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS])
{
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (link->slopes[id] != compliance[id]) {
            link->slopes[id] = compliance[id];
            link->slopes_pending |= servo_link_bit(id);
        }
    }
}

/* ---- servos deaf to SYNC WRITE ---- */

/* REG WRITE of slopes (when they changed) and goal to the next deaf joint. */
static void send_deaf(servo_link_t *link)
{
    uint8_t id = 0;
    while (!(link->deaf_left & servo_link_bit(id))) {
        id++;
    }
    uint32_t bit = servo_link_bit(id);
    bool with_slopes = (link->slopes_pending & bit) != 0;
    uint16_t pos = servo_link_to_servo(link, id, link->goals_pos[id]);
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), id, DXL_REG_WRITE);
    dxl_put(&writer, with_slopes ? DXL_AT_CW_SLOPE : DXL_AT_GOAL);
    if (with_slopes) {
        put_slopes(&writer, link->slopes[id]);
    }
    dxl_put(&writer, (uint8_t)pos);
    dxl_put(&writer, (uint8_t)(pos >> 8));
    link->slopes_pending &= ~bit;
    link->deaf_left &= ~bit;
    link->deaf_id = id;
    (void)bus_submit(dxl_end(&writer), link->no_reply & bit ? BUS_NO_ANSWER : 0, 1);
}

/* ---- health ---- */

/* Steps poll_id on to the next present joint; a full round publishes voltage and temperature. false: nobody is there. */
static bool next_poll(servo_link_t *link)
{
    if (link->present == 0) {
        return false;
    }
    do {
        if (++link->poll_id >= SERVO_LINK_JOINTS) {
            link->poll_id = 0;
            link->voltage_dv = link->round_voltage_dv;
            link->hottest_degrees = link->round_degrees;
            link->hottest_id = link->round_degrees_id;
            link->round_voltage_dv = 0;
            link->round_degrees = 0;
        }
    } while (!(link->present & servo_link_bit(link->poll_id)));
    return true;
}

static void send_poll(servo_link_t *link)
{
    bool again = link->poll_misses != 0 && (link->present & ~link->silent & servo_link_bit(link->poll_id)) != 0;
    if (!again) {
        link->poll_misses = 0;
        if (!next_poll(link)) {
            link->phase = PHASE_DONE;
            return;
        }
    }
    (void)bus_start_read(link->poll_id, POLL_AT, POLL_BYTES, 1);
    link->phase = PHASE_POLLING;
}

static void take_errors(servo_link_t *link, uint8_t id, uint8_t errors)
{
    errors &= FAULT_BITS;
    if (errors & (uint8_t)~link->errors[id]) {
        link->untold_errors |= servo_link_bit(id);
    }
    link->errors[id] = errors;
}

static void take_torque(servo_link_t *link, uint8_t id, const uint8_t *table)
{
    uint32_t bit = servo_link_bit(id);
    bool limit_is_zero = table[DXL_AT_TORQUE_LIMIT - POLL_AT] == 0 && table[DXL_AT_TORQUE_LIMIT + 1 - POLL_AT] == 0;
    if (table[0] != 0 && !limit_is_zero) {
        link->torque |= bit;
    } else if (link->torque & bit) {
        link->torque &= ~bit;
        link->untold_torque |= bit;
    }
}

static void take_health(servo_link_t *link, const bus_answer_t *answer)
{
    uint8_t id = answer->id;
    const uint8_t *table = answer->params;
    const uint8_t *present = table + (DXL_AT_PRESENT - POLL_AT);
    uint8_t voltage_dv = table[DXL_AT_VOLTAGE - POLL_AT], degrees = table[DXL_AT_TEMPERATURE - POLL_AT];
    link->present_pos[id] = servo_link_to_page(link, id, (uint16_t)(present[0] | (present[1] & 3u) << 8));
    if (link->silent & servo_link_bit(id)) {
        link->silent &= ~servo_link_bit(id);
        link->untold_back |= servo_link_bit(id);
        link->slopes_pending |= servo_link_bit(id);
    }
    take_errors(link, id, answer->error);
    take_torque(link, id, table);
    if (link->round_voltage_dv == 0 || voltage_dv < link->round_voltage_dv) {
        link->round_voltage_dv = voltage_dv;
    }
    if (degrees >= link->round_degrees) {
        link->round_degrees = degrees;
        link->round_degrees_id = id;
    }
    link->poll_misses = 0;
}

static void take_miss(servo_link_t *link)
{
    uint32_t bit = servo_link_bit(link->poll_id);
    if (!(link->silent & bit) && ++link->poll_misses >= SERVO_LINK_POLL_TRIES) {
        link->silent |= bit;
        link->untold_silent |= bit;
        link->poll_misses = 0;
    }
}

/* The poll's result, when there is one. */
static void end_poll(servo_link_t *link)
{
    bus_answer_t answer;
    bus_status_t status = bus_poll(&answer);
    if (status == BUS_PENDING) {
        return;
    }
    if (status == BUS_OK) {
        take_health(link, &answer);
    } else {
        take_miss(link);
    }
    link->phase = PHASE_DONE;
}

/* ---- the course of a tick ---- */

void servo_link_tick(servo_link_t *link)
{
    /* Waiting for the end costs 1 ms at most, and only when the main loop was busy elsewhere: giving up instead would put
     * our goals on the wire together with the servo's answer. */
    if (link->phase == PHASE_POLLING) {
        (void)bus_wait(NULL);
        end_poll(link);
    }
    if (link->phase != PHASE_DEAF) {
        link->phase = PHASE_POLL;
    }
}

/* Sends what comes after the goals of this tick; true while there was something. */
static bool send_rest(servo_link_t *link)
{
    uint32_t pending = link->slopes_pending & link->goals_joints & ~link->no_sync;
    if (link->phase == PHASE_GOALS && pending != 0) {
        link->slopes_pending &= ~pending;
        link->phase = PHASE_SLOPES;
        (void)bus_submit(build_slopes(link, pending, false), BUS_NO_ANSWER, 1);
        return true;
    }
    if (link->phase <= PHASE_DEAF && link->deaf_left != 0) {
        link->phase = PHASE_DEAF;
        send_deaf(link);
        return true;
    }
    if (link->phase == PHASE_DEAF) {
        link->phase = PHASE_ACTION;
        send_action();
        return true;
    }
    return false;
}

void servo_link_poll(servo_link_t *link)
{
    if (link->phase == PHASE_QUIET || link->phase == PHASE_DONE) {
        return;
    }
    if (link->phase == PHASE_POLLING) {
        end_poll(link);
        return;
    }
    if (bus_is_busy()) {
        return;
    }
    if (link->phase != PHASE_POLL && send_rest(link)) {
        return;
    }
    send_poll(link);
}

bool servo_link_is_busy(const servo_link_t *link)
{
    return link->phase != PHASE_QUIET && link->phase != PHASE_DONE && bus_is_busy();
}

void servo_link_quiet(servo_link_t *link)
{
    (void)bus_wait(NULL);
    if (link->phase == PHASE_POLLING) {
        end_poll(link);
    }
    link->deaf_left = 0;
    link->phase = PHASE_QUIET;
}

/* ---- telling ---- */

/* Takes the lowest joint out of a mask of untold things. */
static bool take_lowest(uint32_t *mask, uint8_t *id)
{
    if (*mask == 0) {
        return false;
    }
    *id = 0;
    while (!(*mask & servo_link_bit(*id))) {
        (*id)++;
    }
    *mask &= ~servo_link_bit(*id);
    return true;
}

bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault)
{
    fault->errors = 0;
    if (take_lowest(&link->untold_silent, &fault->id)) {
        fault->kind = SERVO_FAULT_SILENT;
    } else if (take_lowest(&link->untold_back, &fault->id)) {
        fault->kind = SERVO_FAULT_BACK;
    } else if (take_lowest(&link->untold_errors, &fault->id)) {
        fault->kind = SERVO_FAULT_ERRORS;
        fault->errors = link->errors[fault->id];
    } else if (take_lowest(&link->untold_torque, &fault->id)) {
        fault->kind = SERVO_FAULT_TORQUE;
    } else {
        return false;
    }
    return true;
}
