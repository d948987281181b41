/* SPDX-License-Identifier: MIT
 * servo_link.c - the course of a tick. */
#include "servo_link_parts.h"

#include <stddef.h>
#include "bus.h"

void servo_link_tick(servo_link_t *link)
{
    /* The wait takes 1 ms at most, and only when the main loop was busy elsewhere. Without it our goals could collide with a
     * servo's answer. */
    if (link->phase == PHASE_POLLING) {
        (void)bus_wait(NULL);
        servo_link_end_poll(link);
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
        (void)bus_submit(servo_link_build_slopes(link, pending, false), BUS_NO_ANSWER, 1);
    } else if (link->phase <= PHASE_DEAF && link->deaf_left != 0) {
        link->phase = PHASE_DEAF;
        servo_link_send_deaf(link);
    } else if (link->phase == PHASE_DEAF) {
        link->phase = PHASE_ACTION;
        servo_link_send_action();
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
        servo_link_end_poll(link);
    } else if (!bus_is_busy() && (link->phase == PHASE_POLL || !send_rest(link))) {
        servo_link_send_poll(link);
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
        servo_link_end_poll(link);
    }
    link->deaf_left = 0;
    link->phase = PHASE_QUIET;
}

bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault)
{
    for (uint8_t kind = 1; kind <= SERVO_FAULT_KINDS; kind++) {
        if (link->unreported[kind - 1] != 0) {
            fault->kind = kind;
            fault->id = servo_link_take_lowest(&link->unreported[kind - 1]);
            fault->errors = link->errors[fault->id];
            return true;
        }
    }
    return false;
}
