/* SPDX-License-Identifier: MIT
 * servo_link_goals.c - packets with goals and slopes. */
#include "servo_link_parts.h"

#include <stddef.h>
#include "bus.h"
#include "dxl_packet.h"
#include "pgm.h"

/* Joints in a packet of BUS_PACKET_BYTES: 7 bytes before them, a checksum behind; each joint has ID, slopes and goal. */
#define PACKET_BYTES (BUS_PACKET_BYTES < DXL_PACKET_MAX ? BUS_PACKET_BYTES : DXL_PACKET_MAX)
#define JOINTS_WITH_SLOPES ((PACKET_BYTES - 8u) / 5u)
STATIC_ASSERT(PACKET_BYTES >= 8u + 3u * SERVO_LINK_JOINTS, "all joints' goals fit into one packet");

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

/* Builds the SYNC WRITE of goals: 101 bytes for 31 joints, once a tick. 43 cycles a joint. */
static NOINLINE uint8_t build_goals(const uint16_t *goal, const int16_t *trim, uint32_t joints)
{
    dxl_writer_t writer;
    dxl_begin(&writer, bus_packet(), DXL_BROADCAST, DXL_SYNC_WRITE);
    dxl_put(&writer, DXL_AT_GOAL);
    dxl_put(&writer, 2);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++, goal++, trim++, joints >>= 1) {
        if ((uint8_t)joints & 1u) {
            dxl_put(&writer, id);
            put_word(&writer, limited((uint16_t)(*goal + (uint16_t)*trim)));
        }
    }
    return dxl_end(&writer);
}

/* Builds a SYNC WRITE of slopes, or of slopes and goals. */
uint8_t servo_link_build_slopes(const servo_link_t *link, uint32_t joints, bool with_goals)
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

void servo_link_send_action(void)
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
            servo_link_send_action();              /* no time for it in the last tick */
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
        size = servo_link_build_slopes(link, joints, true);
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
void servo_link_send_deaf(servo_link_t *link)
{
    uint8_t id = servo_link_take_lowest(&link->deaf_left);
    uint16_t pos = servo_link_to_servo(link, id, link->goals_pos[id]);
    uint16_t slopes = slopes_of(link->slopes[id]);
    const uint8_t params[5] = { DXL_AT_CW_SLOPE, (uint8_t)slopes, (uint8_t)(slopes >> 8), (uint8_t)pos,
                                (uint8_t)(pos >> 8) };
    servo_link_put(&link->slopes_pending, id, false);
    (void)bus_submit(dxl_build(bus_packet(), id, DXL_REG_WRITE, params, sizeof params),
                     servo_link_write_answer(link, id), 1);
}
