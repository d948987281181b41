/* SPDX-License-Identifier: MIT
 * performer_watch.c - servo faults and the fault rule, battery, heat. */
#include "performer_watch.h"

#include "dxl.h"
#include "performer_shape.h"

/* Errors that trigger the fault rule. A voltage error is only reported: the battery is low long before it is empty. */
#define ERRORS_GRAVE (DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

/* A reading that wavers at the limit is not news each time. */
enum { HEAT_BAND_DEGREES = 2 };

static void tell(performer_t *performer, uint8_t kind, uint8_t a, uint8_t b)
{
    performer_event_put(&performer->events, kind, a, b, 0);
}

/* ---- faults ---- */

STATIC_ASSERT(PERFORMER_EV_BACK - PERFORMER_EV_SILENT == SERVO_FAULT_BACK - SERVO_FAULT_SILENT &&
                  PERFORMER_EV_ERRORS - PERFORMER_EV_SILENT == SERVO_FAULT_ERRORS - SERVO_FAULT_SILENT &&
                  PERFORMER_EV_TORQUE - PERFORMER_EV_SILENT == SERVO_FAULT_TORQUE - SERVO_FAULT_SILENT,
              "faults and events in one order");

/* Reports one fault. true: the fault rule applies to it. */
static bool take_fault(performer_t *performer, const servo_fault_t *fault)
{
    const bool is_errors = fault->kind == SERVO_FAULT_ERRORS;
    const bool well = fault->kind == SERVO_FAULT_BACK ||
                      (is_errors && fault->errors == 0 &&
                       servo_link_has(&performer->servos->torque, fault->id));
    servo_link_put(&performer->faulty, fault->id, !well);
    tell(performer, (uint8_t)(PERFORMER_EV_SILENT + fault->kind - SERVO_FAULT_SILENT), fault->id,
         is_errors ? fault->errors : 0);
    return !well && (!is_errors || (fault->errors & ERRORS_GRAVE) != 0);
}

static performer_verdict_t rule(const performer_t *performer)
{
    switch (performer->settings->fault_rule) {
    case SETTINGS_FAULT_LIMP:
        return WATCH_LIMP;
    case SETTINGS_FAULT_EXIT:
        return performer->state == PERFORMER_PLAY && !performer_is_paused(performer) ? WATCH_EXIT : WATCH_BREAK;
    default:
        return WATCH_BREAK;
    }
}

static bool takes_part(const performer_t *performer, uint32_t joint)
{
    const uint32_t of_play = performer_is_idle(performer) ? 0 : performer->joints | performer->ready_left;
    return ((of_play | performer_layers_joints(performer)) & joint) != 0;
}

static performer_verdict_t take_faults(performer_t *performer, uint32_t *joint)
{
    servo_fault_t fault;
    while (servo_link_next_fault(performer->servos, &fault)) {
        *joint = servo_link_bit(fault.id);
        if (take_fault(performer, &fault) && takes_part(performer, *joint)) {
            return rule(performer);
        }
    }
    return WATCH_GO_ON;
}

/* ---- battery, heat ---- */

static void watch_battery(performer_t *performer)
{
    const uint8_t now_dv = performer->servos->voltage_dv;
    if (!performer->battery_reported && now_dv != 0 && now_dv < performer->settings->battery_low_dv) {
        performer->battery_reported = true;
        tell(performer, PERFORMER_EV_BATTERY, now_dv, 0);
    }
}

static void watch_heat(performer_t *performer)
{
    const uint8_t limit = performer->settings->hot_degrees;
    const uint8_t now = performer->servos->hottest_degrees;
    const uint8_t band = performer->is_hot ? HEAT_BAND_DEGREES : 0;
    const bool is_hot = (uint8_t)(now + band) > (uint8_t)(limit - 1u);   /* limit 0, off: nothing is above 255 */
    if (is_hot != performer->is_hot) {
        performer->is_hot = is_hot;
        tell(performer, is_hot ? PERFORMER_EV_HOT : PERFORMER_EV_COOL, performer->servos->hottest_id, now);
    }
}

performer_verdict_t performer_watch(performer_t *performer, uint32_t *joint)
{
    const performer_verdict_t verdict = take_faults(performer, joint);
    if (verdict == WATCH_GO_ON) {
        watch_battery(performer);
        watch_heat(performer);
        performer_shape_follow(performer);
    }
    return verdict;
}
