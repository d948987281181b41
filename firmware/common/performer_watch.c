/* SPDX-License-Identifier: MIT
 * performer_watch.c - what happens beside the play: the queue of events, faults of servos and the rule for them, battery,
 * heat. */
#include "performer_parts.h"

#include "bound.h"
#include "dxl.h"

#define EVENTS_FOR_STEPS (PERFORMER_EVENTS - 6u) /* room kept for rarer and graver events */
#define EVENTS_FOR_OTHERS (PERFORMER_EVENTS - 1u) /* and for the end: who waits for it must hear of it */

/* What the fault rule acts on. A voltage error is told but ends nothing: the battery is low long before it is empty. */
#define ERRORS_GRAVE (DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

/* ---- events ---- */

void performer_tell(performer_t *performer, uint8_t kind, uint8_t a, uint8_t b, uint8_t c)
{
    const uint8_t room_for = kind == PERFORMER_EV_STEP ? EVENTS_FOR_STEPS
                             : kind == PERFORMER_EV_ENDED ? PERFORMER_EVENTS : EVENTS_FOR_OTHERS;
    if (performer->events_count >= room_for) {
        performer->events_lost = (uint8_t)(performer->events_lost + (performer->events_lost < UINT8_MAX ? 1 : 0));
        return;
    }
    uint8_t at = (uint8_t)(performer->events_head + performer->events_count);
    if (at >= PERFORMER_EVENTS) { /* a division would take 200 cycles */
        at = (uint8_t)(at - PERFORMER_EVENTS);
    }
    performer->events[at] = (performer_event_t){.kind = kind, .a = a, .b = b, .c = c};
    performer->events_count++;
}

bool performer_next_event(performer_t *performer, performer_event_t *event)
{
    if (performer->events_count == 0) {
        if (performer->events_lost == 0) {
            return false;
        }
        *event = (performer_event_t){.kind = PERFORMER_EV_LOST, .a = performer->events_lost};
        performer->events_lost = 0;
        return true;
    }
    *event = performer->events[performer->events_head];
    performer->events_head = (uint8_t)(performer->events_head + 1u);
    if (performer->events_head >= PERFORMER_EVENTS) {
        performer->events_head = 0;
    }
    performer->events_count--;
    return true;
}

/* ---- faults ---- */

/* The rule of the settings, for one joint of this play. */
static void act_on_fault(performer_t *performer, uint32_t joint)
{
    if (performer_is_idle(performer) || ((performer->joints | performer->ready_left) & joint) == 0) {
        return;
    }
    performer_drop(performer, joint);
    if (PERFORMER_SETTINGS(performer)->fault_rule == SETTINGS_FAULT_LIMP) {
        servo_link_torque_off(PERFORMER_SERVOS(performer), joint);
        return;
    }
    performer->end = PERFORMER_END_SERVO;
    if (PERFORMER_SETTINGS(performer)->fault_rule == SETTINGS_FAULT_EXIT && performer->state == PERFORMER_PLAY) {
        performer_stop_softly(performer);
    } else {
        performer_break(performer);
    }
}

static void take_fault(performer_t *performer, const servo_fault_t *fault)
{
    const uint32_t joint = servo_link_bit(fault->id);
    const bool well = fault->kind == SERVO_FAULT_BACK ||
                      (fault->kind == SERVO_FAULT_ERRORS && fault->errors == 0 &&
                       servo_link_has(&PERFORMER_SERVOS(performer)->torque, fault->id));
    servo_link_put(&performer->faulty, fault->id, !well);
    if (fault->kind == SERVO_FAULT_ERRORS) {
        performer_tell(performer, PERFORMER_EV_ERRORS, fault->id, fault->errors, 0);
        if ((fault->errors & ERRORS_GRAVE) == 0) {
            return;
        }
    } else {
        /* The kinds of events stand in the order of the kinds of faults. */
        performer_tell(performer, (uint8_t)(PERFORMER_EV_SILENT + fault->kind - SERVO_FAULT_SILENT), fault->id, 0, 0);
    }
    if (!well) {
        act_on_fault(performer, joint);
    }
}
STATIC_ASSERT(PERFORMER_EV_BACK - PERFORMER_EV_SILENT == SERVO_FAULT_BACK - SERVO_FAULT_SILENT &&
                  PERFORMER_EV_TORQUE - PERFORMER_EV_SILENT == SERVO_FAULT_TORQUE - SERVO_FAULT_SILENT,
              "faults and events in one order");

static void take_faults(performer_t *performer)
{
    servo_fault_t fault;
    while (servo_link_next_fault(PERFORMER_SERVOS(performer), &fault)) {
        take_fault(performer, &fault);
    }
}

static void watch_battery(performer_t *performer)
{
    const uint8_t now_dv = PERFORMER_SERVOS(performer)->voltage_dv;
    if (!performer->told_battery && now_dv != 0 && now_dv < PERFORMER_SETTINGS(performer)->battery_low_dv) {
        performer->told_battery = true;
        performer_tell(performer, PERFORMER_EV_BATTERY, now_dv, 0, 0);
    }
}

static void watch_heat(performer_t *performer)
{
    const uint8_t limit = PERFORMER_SETTINGS(performer)->hot_degrees;
    const uint8_t now = PERFORMER_SERVOS(performer)->hottest_degrees;
    if (!performer->told_hot && limit != 0 && now >= limit) {
        performer->told_hot = true;
        performer_tell(performer, PERFORMER_EV_HOT, PERFORMER_SERVOS(performer)->hottest_id, now, 0);
    }
}

void performer_watch(performer_t *performer)
{
    take_faults(performer);
    watch_battery(performer);
    watch_heat(performer);
}
