/* SPDX-License-Identifier: MIT
 * servo_link_health.c - the health poll: one servo a tick. */
#include "servo_link_parts.h"

#include "bus.h"
#include "bus_call.h"
#include "dxl_packet.h"

/* The part of the control table that the health poll reads. */
#define POLL_AT DXL_AT_TORQUE_ENABLE
#define POLL_BYTES (DXL_AT_TEMPERATURE + 1u - POLL_AT)
STATIC_ASSERT(POLL_BYTES <= DXL_ANSWER_PARAMS, "the bus takes the poll's answer");
#define FAULT_BITS (DXL_ERR_VOLTAGE | DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

/* At the end of a round, publishes its lowest voltage and highest temperature. */
static void end_round(servo_link_t *link)
{
    link->voltage_dv = link->round_voltage_dv;
    link->hottest_degrees = link->round_degrees;
    link->hottest_id = link->round_degrees_id;
    link->round_voltage_dv = 0;
    link->round_degrees = 0;
}

void servo_link_send_poll(servo_link_t *link)
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

void servo_link_end_poll(servo_link_t *link)
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
