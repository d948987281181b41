/* SPDX-License-Identifier: MIT */
#include "servo_link.h"
#include "bus.h"
#include "bus_call.h"
#include "dxl_packet.h"
#include "pgm.h"

#include <stddef.h>
#include <string.h>

/* The phases of a tick. It begins at PHASE_POLL, or at PHASE_GOALS when there are goals:
 *
 *   GOALS -> SLOPES -> DEAF -> ACTION -> POLL -> POLLING -> DONE       (each may be skipped)
 *
 * QUIET: the bus is free for other callers until the next tick. */
enum { PHASE_QUIET = 0, PHASE_GOALS, PHASE_SLOPES, PHASE_DEAF, PHASE_ACTION, PHASE_POLL, PHASE_POLLING, PHASE_DONE };

#define POS_MAX 1023u
/* Joints in a packet of BUS_PACKET_BYTES: 7 bytes before them, a checksum behind; each joint has ID, slopes and goal. */
#define PACKET_BYTES (BUS_PACKET_BYTES < DXL_PACKET_MAX ? BUS_PACKET_BYTES : DXL_PACKET_MAX)
#define JOINTS_WITH_SLOPES ((PACKET_BYTES - 8u) / 5u)
#define SLOPES_JOINTS 8u   /* joints in a packet of slopes alone: a byte of the mask */
STATIC_ASSERT(PACKET_BYTES >= 8u + 3u * SERVO_LINK_JOINTS, "all joints' goals fit into one packet");
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

/* Removes the lowest joint from a mask that is not empty, and returns it. */
static NOINLINE uint8_t take_lowest(uint32_t *mask)
{
    const uint8_t id = servo_link_lowest(mask);
    servo_link_put(mask, id, false);
    return id;
}

uint32_t servo_link_drivable(const servo_link_t *link)
{
    return link->present & link->torque & ~link->silent;
}

/* ---- coordinates ---- */

/* pos < 0 ? 0 : pos > POS_MAX ? POS_MAX : pos, with one test of the high byte if pos is within 0..1023. */
ALWAYS_INLINE uint16_t limited(uint16_t pos)
{
    const uint8_t high = (uint8_t)(pos >> 8);
    if (high >= (POS_MAX + 1u) >> 8) {
        return (int8_t)high < 0 ? 0u : POS_MAX;
    }
    return pos;
}

NOINLINE uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos)
{
    return limited((uint16_t)(pos + (uint16_t)link->trim_pos[id]));
}

NOINLINE uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos)
{
    return limited((uint16_t)(servo_pos - (uint16_t)link->trim_pos[id]));
}

uint32_t servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS])
{
    uint32_t refused = 0;
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        int16_t trim = trim_pos == NULL ? 0 : trim_pos[id];
        if (trim > SERVO_LINK_TRIM_MAX || trim < -SERVO_LINK_TRIM_MAX) {
            servo_link_put(&refused, id, true);
            trim = 0;
        }
        link->trim_pos[id] = trim;
    }
    return refused;
}

/* ---- one tick of goals ---- */

/* The slope registers of a compliance byte: 2^nibble, CW in the low byte. Nibbles 0 and above 7 count as 5. */
static NOINLINE uint16_t slopes_of(uint8_t compliance)
{
    static const uint8_t slope[16] PROGMEM = { 32, 2, 4, 8, 16, 32, 64, 128, 32, 32, 32, 32, 32, 32, 32, 32 };
    return (uint16_t)(pgm_read_byte(&slope[compliance >> 4]) | pgm_read_byte(&slope[compliance & 0x0Fu]) << 8);
}

ALWAYS_INLINE void put_word(dxl_writer_t *writer, uint16_t word)
{
    dxl_put(writer, (uint8_t)word);
    dxl_put(writer, (uint8_t)(word >> 8));
}

/* Builds the SYNC WRITE of goals: 101 bytes for 31 joints, once a tick. A single loop that only moves pointers: 31 cycles a
 * joint. */
static NOINLINE uint8_t build_goals(const uint16_t *goal, const int16_t *trim, uint32_t joints)
{
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_GOAL);
    dxl_put(&writer, 2);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, joints >>= 1) {
        uint16_t pos = (uint16_t)(*goal++ + (uint16_t)*trim++);
        if ((uint8_t)joints & 1u) {
            dxl_put(&writer, id);
            pos = limited(pos);
            put_word(&writer, pos);
        }
    }
    return dxl_end(&writer);
}

/* Builds a SYNC WRITE of slopes, or of slopes and goals. */
static NOINLINE uint8_t build_slopes(const servo_link_t *link, uint32_t joints, bool with_goals)
{
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_CW_SLOPE);
    dxl_put(&writer, with_goals ? 4 : 2);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, joints >>= 1) {
        if (((uint8_t)joints & 1u) == 0) {
            continue;
        }
        dxl_put(&writer, id);
        put_word(&writer, slopes_of(link->slopes[id]));
        if (with_goals) {
            put_word(&writer, servo_link_to_servo(link, id, link->goals_pos[id]));
        }
    }
    return dxl_end(&writer);
}

static void count_late(servo_link_t *link)
{
    link->late = (uint8_t)(link->late + (link->late != 0xFFu));
}

static NOINLINE void send_action(void)
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
    joints &= servo_link_drivable(link);
    link->goals_pos = goal_pos;
    link->goals_joints = joints;
    if (link->no_sync != 0) {
        if (link->phase == PHASE_DEAF && link->deaf_left == 0) {
            send_action();              /* no time for it in the last tick */
            (void)bus_wait(NULL);
        }
        if (link->deaf_left != 0) {
            count_late(link);           /* the round of the last tick continues with the new goals */
        } else {
            link->deaf_left = joints & link->no_sync;
        }
        joints &= ~link->no_sync;
    }
    link->phase = PHASE_GOALS;
    if (joints == 0) {
        return;
    }
    if (link->slopes_wait != 0 && (link->slopes_pending & joints) != 0 && servo_link_count(joints) <= JOINTS_WITH_SLOPES) {
        size = build_slopes(link, joints, true);
        link->slopes_pending &= ~joints;
    } else {
        size = build_goals(goal_pos, link->trim_pos, joints);
    }
    (void)bus_submit(size, BUS_NO_ANSWER, 1);
}

void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS])
{
    uint8_t *pending = (uint8_t *)&link->slopes_pending, *known = link->slopes, bit = 1;
    for (uint8_t left = SERVO_LINK_JOINTS; left != 0; left--, known++, compliance++) {
        if (*known != *compliance) {
            *known = *compliance;
            *pending |= bit;
        }
        bit = (uint8_t)(bit << 1);
        if (bit == 0) {
            bit = 1;
            pending++;
        }
    }
    link->slopes_wait = 2;
    link->slopes_delayed = 0;
}

uint8_t servo_link_write_answer(const servo_link_t *link, uint8_t id)
{
    return servo_link_has(&link->no_reply, id) ? BUS_NO_ANSWER : 0;
}

/* Sends slopes and goal as REG WRITE to the next servo that is deaf to SYNC WRITE. */
static void send_deaf(servo_link_t *link)
{
    uint8_t id = take_lowest(&link->deaf_left);
    uint16_t pos = servo_link_to_servo(link, id, link->goals_pos[id]);
    uint16_t slopes = slopes_of(link->slopes[id]);
    const uint8_t params[5] = { DXL_AT_CW_SLOPE, (uint8_t)slopes, (uint8_t)(slopes >> 8), (uint8_t)pos,
                                (uint8_t)(pos >> 8) };
    servo_link_put(&link->slopes_pending, id, false);
    (void)bus_submit(dxl_build(bus_packet(), id, DXL_REG_WRITE, params, sizeof params),
                     servo_link_write_answer(link, id), 1);
}

/* ---- health ---- */

/* At the end of a round, publishes its lowest voltage and highest temperature. */
static void end_round(servo_link_t *link)
{
    link->voltage_dv = link->round_voltage_dv;
    link->hottest_degrees = link->round_degrees;
    link->hottest_id = link->round_degrees_id;
    link->round_voltage_dv = 0;
    link->round_degrees = 0;
}

/* Asks the servo that did not answer again, or the next one. */
static void send_poll(servo_link_t *link)
{
    link->phase = PHASE_DONE;
    if (link->present == 0) {
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
    link->phase = PHASE_POLLING;
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

static void take_health(servo_link_t *link, const bus_answer_t *answer)
{
    uint8_t id = link->poll_id;
    const uint8_t *table = answer->params;
    const uint8_t *present = table + (DXL_AT_PRESENT - POLL_AT);
    uint8_t voltage_dv = table[DXL_AT_VOLTAGE - POLL_AT], degrees = table[DXL_AT_TEMPERATURE - POLL_AT];
    uint8_t errors = answer->error & FAULT_BITS;
    link->poll_misses = 0;
    link->present_pos[id] = servo_link_to_page(link, id, (uint16_t)(present[0] | (present[1] & 3u) << 8));
    if (servo_link_has(&link->silent, id)) {
        servo_link_put(&link->silent, id, false);
        servo_link_put(&link->slopes_pending, id, true);
        note_fault(link, id, SERVO_FAULT_BACK);
    }
    if (errors != link->errors[id]) {
        note_fault(link, id, SERVO_FAULT_ERRORS);
    }
    link->errors[id] = errors;
    take_torque(link, id, table);
    if (link->round_voltage_dv == 0 || voltage_dv < link->round_voltage_dv) {
        link->round_voltage_dv = voltage_dv;
    }
    if (degrees >= link->round_degrees) {
        link->round_degrees = degrees;
        link->round_degrees_id = id;
    }
}

static void take_miss(servo_link_t *link)
{
    uint8_t id = link->poll_id;
    if (!servo_link_has(&link->silent, id)) {
        if (++link->poll_misses < SERVO_LINK_POLL_TRIES) {
            return;
        }
        servo_link_lost(link, id);
        note_fault(link, id, SERVO_FAULT_SILENT);
    }
    link->poll_misses = 0;
}

/* Handles the result of the poll, if there is one. */
static NOINLINE void end_poll(servo_link_t *link)
{
    bus_answer_t answer;
    bus_status_t status = bus_poll(&answer);
    if (status == BUS_PENDING) {
        return;
    }
    link->phase = PHASE_DONE;
    if (status == BUS_OK) {
        take_health(link, &answer);
    } else {
        take_miss(link);
    }
}

/* ---- the course of a tick ---- */

void servo_link_tick(servo_link_t *link)
{
    /* The wait takes 1 ms at most, and only when the main loop was busy elsewhere. Without it our goals could collide with a
     * servo's answer. */
    if (link->phase == PHASE_POLLING) {
        (void)bus_wait(NULL);
        end_poll(link);
    }
    if (link->phase != PHASE_DEAF) {
        link->phase = PHASE_POLL;
    }
    if (link->slopes_wait != 0) {
        link->slopes_wait--;
    }
}

/* Sends the next packet after the goals of this tick. true: a packet was sent. */
static bool send_rest(servo_link_t *link)
{
    uint32_t pending = link->slopes_pending & link->goals_joints & ~link->no_sync;
    if (link->phase == PHASE_GOALS && pending != 0 && link->slopes_wait == 0) {
        uint32_t first = (1ul << SLOPES_JOINTS) - 1u;
        while ((pending & first) == 0) {
            first <<= SLOPES_JOINTS;
        }
        pending &= first;
        link->slopes_pending &= ~pending;
        link->phase = PHASE_SLOPES;
        (void)bus_submit(build_slopes(link, pending, false), BUS_NO_ANSWER, 1);
    } else if (link->phase <= PHASE_DEAF && link->deaf_left != 0) {
        link->phase = PHASE_DEAF;
        send_deaf(link);
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
    if (link->phase == PHASE_QUIET || link->phase == PHASE_DONE) {
        return;
    }
    if (link->phase == PHASE_POLLING) {
        end_poll(link);
    } else if (!bus_is_busy() && (link->phase == PHASE_POLL || !send_rest(link))) {
        send_poll(link);
    }
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

bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault)
{
    for (uint8_t kind = 1; kind <= SERVO_FAULT_KINDS; kind++) {
        if (link->unreported[kind - 1] != 0) {
            fault->kind = kind;
            fault->id = take_lowest(&link->unreported[kind - 1]);
            fault->errors = link->errors[fault->id];
            return true;
        }
    }
    return false;
}
