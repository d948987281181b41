/* SPDX-License-Identifier: MIT
 * servo_link.c - the bus traffic of a tick: goals, slopes, servos that ignore SYNC WRITE, one health poll.
 *
 * The phases of a tick. It begins at POLL, or at GOALS if there are goals; DEAF and ACTION may be skipped:
 *
 *   GOALS -> DEAF -> ACTION -> POLL -> DONE
 *
 * The poll's answer may come after DONE. If it takes longer than a tick, the next ticks send goals but no poll.
 * QUIET: the bus is free for other callers until the next tick. */
#include "servo_link.h"

#include <stddef.h>
#include <string.h>
#include "bus.h"
#include "bus_call.h"
#include "dxl_packet.h"
#include "pgm.h"
#include "target.h"

enum { PHASE_QUIET = 0, PHASE_GOALS, PHASE_DEAF, PHASE_ACTION, PHASE_POLL, PHASE_DONE };

#define POS_MAX 1023
/* A SYNC WRITE of two bytes per joint: 7 bytes before the joints, a checksum after them. */
STATIC_ASSERT(BUS_PACKET_BYTES >= 8u + 3u * SERVO_LINK_JOINTS, "all joints fit into one packet");

/* The part of the control table that the health poll reads. */
#define POLL_AT DXL_AT_TORQUE_ENABLE
#define POLL_BYTES (DXL_AT_TEMPERATURE + 1u - POLL_AT)
STATIC_ASSERT(POLL_BYTES <= DXL_ANSWER_PARAMS, "the bus takes the poll's answer");
#define FAULT_BITS (DXL_ERR_VOLTAGE | DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

void servo_link_init(servo_link_t *link)
{
    memset(link, 0, sizeof *link);
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
}

/* ---- joints and their coordinates ---- */

uint32_t servo_link_drivable(const servo_link_t *link)
{
    return link->present & link->torque & ~link->silent;
}

uint16_t servo_link_limited(uint16_t pos)
{
    return (int16_t)pos < 0 ? 0 : pos > POS_MAX ? POS_MAX : pos;
}

uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos)
{
    return servo_link_limited((uint16_t)(pos + (uint16_t)link->trim_pos[id]));
}

uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos)
{
    return servo_link_limited((uint16_t)(servo_pos - (uint16_t)link->trim_pos[id]));
}

void servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS])
{
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        const int16_t trim = trim_pos == NULL ? 0 : trim_pos[id];
        link->trim_pos[id] = trim > SERVO_LINK_TRIM_MAX || trim < -SERVO_LINK_TRIM_MAX ? 0 : trim;
    }
}

/* ---- goals and slopes ---- */

void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS])
{
    uint32_t joint = 1;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, joint <<= 1) {
        if (link->slopes[id] != compliance[id]) {
            link->slopes[id] = compliance[id];
            link->slopes_pending |= joint;
        }
    }
}

/* The slope registers of a compliance byte: 2^nibble, CW in the low byte. Nibbles 0 and above 7 count as 5. */
static uint16_t slopes_of(uint8_t compliance)
{
    static const uint8_t slope[16] PROGMEM = { 32, 2, 4, 8, 16, 32, 64, 128, 32, 32, 32, 32, 32, 32, 32, 32 };
    return pgm_read_byte(&slope[compliance >> 4]) | pgm_read_byte(&slope[compliance & 0x0Fu]) << 8;
}

/* Sends one word to each of `joints` by SYNC WRITE: at DXL_AT_GOAL its goal, at DXL_AT_CW_SLOPE its slopes. */
static void send_words(const servo_link_t *link, uint8_t at, uint32_t joints)
{
    dxl_writer_t writer;
    const uint16_t *goals_pos = link->goals_pos;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, at);
    dxl_put(&writer, 2);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, joints >>= 1) {
        if (joints & 1u) {
            const uint16_t word = at == DXL_AT_GOAL ? servo_link_to_servo(link, id, goals_pos[id])
                                                    : slopes_of(link->slopes[id]);
            dxl_put(&writer, id);
            dxl_put(&writer, (uint8_t)word);
            dxl_put(&writer, (uint8_t)(word >> 8));
        }
    }
    (void)bus_submit(dxl_end(&writer), BUS_NO_ANSWER, 1);
}

/* ---- servos that ignore SYNC WRITE ---- */

uint8_t servo_link_write_answer(const servo_link_t *link, uint8_t id)
{
    return servo_link_has(&link->no_reply, id) ? BUS_NO_ANSWER : 0;
}

/* Sends slopes and goal as REG WRITE to the next deaf servo. */
static void send_deaf(servo_link_t *link)
{
    const uint8_t id = servo_link_lowest(&link->deaf_left);
    const uint16_t pos = servo_link_to_servo(link, id, link->goals_pos[id]);
    const uint16_t slopes = slopes_of(link->slopes[id]);
    const uint8_t params[5] = { DXL_AT_CW_SLOPE, (uint8_t)slopes, (uint8_t)(slopes >> 8), (uint8_t)pos,
                                (uint8_t)(pos >> 8) };
    servo_link_put(&link->deaf_left, id, false);
    servo_link_put(&link->slopes_pending, id, false);
    (void)bus_submit(dxl_build(bus_packet(), id, DXL_REG_WRITE, params, sizeof params),
                     servo_link_write_answer(link, id), 1);
}

/* Starts the deaf servos. */
static void send_action(void)
{
    (void)bus_submit(dxl_build(bus_packet(), DXL_BROADCAST, DXL_ACTION, NULL, 0), BUS_NO_ANSWER, 1);
}

static void count_late(servo_link_t *link)
{
    if (link->late != UINT8_MAX) {
        link->late++;
    }
}

/* Begins a round of REG WRITEs. If the last tick could not finish its round, that round continues with the new goals. */
static void begin_deaf(servo_link_t *link, uint32_t joints)
{
    if (link->phase == PHASE_DEAF && link->deaf_left == 0) {
        send_action();
        bus_wait_free();
    }
    if (link->deaf_left != 0) {
        count_late(link);
    } else {
        link->deaf_left = joints;
    }
}

/* ---- the health poll ---- */

/* Publishes the lowest voltage and highest temperature of the round. */
static void end_round(servo_link_t *link)
{
    link->voltage_dv = link->round_voltage_dv;
    link->hottest_degrees = link->round_degrees;
    link->hottest_id = link->round_degrees_id;
    link->round_voltage_dv = 0;
    link->round_degrees = 0;
}

/* Polls the next servo, or again the one that did not answer. */
static void send_poll(servo_link_t *link)
{
    link->phase = PHASE_DONE;
    if (link->present == 0 || bus_is_busy()) {
        return;
    }
    if (link->poll_misses == 0) {
        do {
            if (++link->poll_id >= SERVO_LINK_JOINTS) {
                link->poll_id = 0;
                end_round(link);
            }
        } while (!servo_link_has(&link->present, link->poll_id));
    }
    (void)bus_start_read(link->poll_id, POLL_AT, POLL_BYTES, 1);
    link->poll_waits = true;
}

static void note_fault(servo_link_t *link, uint8_t id, servo_fault_kind_t kind)
{
    servo_link_put(&link->unreported[kind - 1], id, true);
}

static void take_torque(servo_link_t *link, uint8_t id, const uint8_t *table)
{
    const uint8_t *limit = table + (DXL_AT_TORQUE_LIMIT - POLL_AT);
    bool on = table[0] != 0 && (limit[0] | limit[1]) != 0;
    if (!on && servo_link_has(&link->torque, id)) {
        note_fault(link, id, SERVO_FAULT_TORQUE);
    }
    servo_link_put(&link->torque, id, on);
}

/* A servo that lost power has lost its slopes, even if it was off too briefly to count as silent. */
static void take_slopes(servo_link_t *link, uint8_t id, const uint8_t *slope)
{
    const uint16_t slopes = slopes_of(link->slopes[id]);
    if (slope[0] != (uint8_t)slopes || slope[1] != (uint8_t)(slopes >> 8)) {
        servo_link_put(&link->slopes_pending, id, true);
    }
}

static void take_health(servo_link_t *link, const bus_answer_t *answer)
{
    uint8_t id = link->poll_id;
    const uint8_t *table = answer->params;
    const uint8_t *present = table + (DXL_AT_PRESENT - POLL_AT);
    uint8_t voltage_dv = table[DXL_AT_VOLTAGE - POLL_AT], degrees = table[DXL_AT_TEMPERATURE - POLL_AT];
    uint8_t errors = answer->error & FAULT_BITS;
    link->poll_misses = 0;
    link->present_pos[id] = servo_link_to_page(link, id, present[0] | (present[1] & 3u) << 8);
    if (servo_link_has(&link->silent, id)) {
        servo_link_put(&link->silent, id, false);
        note_fault(link, id, SERVO_FAULT_BACK);
    }
    if (errors != link->errors[id]) {
        note_fault(link, id, SERVO_FAULT_ERRORS);
    }
    link->errors[id] = errors;
    take_torque(link, id, table);
    take_slopes(link, id, table + (DXL_AT_CW_SLOPE - POLL_AT));
    if (link->round_voltage_dv == 0 || voltage_dv < link->round_voltage_dv) {
        link->round_voltage_dv = voltage_dv;
    }
    if (degrees >= link->round_degrees) {
        link->round_degrees = degrees;
        link->round_degrees_id = id;
    }
}

static void take_miss(servo_link_t *link, bus_status_t status)
{
    uint8_t id = link->poll_id;
    if (!servo_link_has(&link->silent, id)) {
        link->poll_misses = (uint8_t)(link->poll_misses + TARGET_POLL_GARBLED);
        if (status == BUS_ERR_TIMEOUT) {
            link->poll_misses = (uint8_t)(link->poll_misses + TARGET_POLL_SILENT - TARGET_POLL_GARBLED);
        }
        if (link->poll_misses < TARGET_POLL_LIMIT) {
            return;
        }
        servo_link_lost(link, id);
        note_fault(link, id, SERVO_FAULT_SILENT);
    }
    link->poll_misses = 0;
}

/* Takes the result of the poll, if there is one. */
static void end_poll(servo_link_t *link)
{
    bus_answer_t answer;
    bus_status_t status = link->poll_waits ? bus_poll(&answer) : BUS_PENDING;
    if (status == BUS_PENDING) {
        return;
    }
    link->poll_waits = false;
    if (status == BUS_OK) {
        take_health(link, &answer);
    } else {
        take_miss(link, status);
    }
}

bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault)
{
    for (uint8_t kind = 1; kind <= SERVO_FAULT_KINDS; kind++) {
        uint32_t *joints = &link->unreported[kind - 1];
        if (*joints != 0) {
            fault->kind = kind;
            fault->id = servo_link_lowest(joints);
            fault->errors = link->errors[fault->id];
            servo_link_put(joints, fault->id, false);
            return true;
        }
    }
    return false;
}

/* ---- the tick ---- */

void servo_link_tick(servo_link_t *link)
{
    /* Without this wait, our goals could collide with a servo's answer. It takes 1 ms at most, and only if the main loop was
     * busy elsewhere. */
    if (link->poll_waits) {
        bus_wait_free();
        end_poll(link);
    }
    if (link->phase != PHASE_DEAF) {
        link->phase = PHASE_POLL;
    }
}

void servo_link_goals(servo_link_t *link, const uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints)
{
    if (!bus_is_free()) {
        count_late(link);
        bus_wait_free();
    }
    joints &= servo_link_drivable(link);
    link->goals_pos = goal_pos;
    link->goals_joints = joints;
    begin_deaf(link, joints & link->no_sync);
    link->phase = PHASE_GOALS;
    joints &= ~link->no_sync;
    if (joints != 0) {
        send_words(link, DXL_AT_GOAL, joints);
    }
}

/* Sends the next packet that follows the goals, if the bus is free. false: no packet is left. */
static bool send_rest(servo_link_t *link)
{
    const uint32_t slopes = link->slopes_pending & link->goals_joints & ~link->no_sync;
    if (slopes != 0) {
        link->slopes_pending &= ~slopes;
        send_words(link, DXL_AT_CW_SLOPE, slopes);
    } else if (link->deaf_left != 0) {
        link->phase = PHASE_DEAF;
        if (!bus_is_busy()) {
            send_deaf(link);
        }
    } else if (link->phase == PHASE_DEAF) {
        link->phase = PHASE_ACTION;
        send_action();
    } else {
        return false;
    }
    return true;
}

void servo_link_poll(servo_link_t *link)
{
    end_poll(link);
    if (link->phase == PHASE_QUIET || link->phase == PHASE_DONE) {
        return;
    }
    if (bus_is_free() && (link->phase == PHASE_POLL || !send_rest(link))) {
        send_poll(link);
    }
}

void servo_link_quiet(servo_link_t *link)
{
    (void)bus_wait(NULL);
    end_poll(link);
    link->deaf_left = 0;
    link->phase = PHASE_QUIET;
}
