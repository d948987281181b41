/* SPDX-License-Identifier: MIT
 * handed.c - when the program hands packets to the bus, by hal/bus.h. Goals, slopes and ACTION are the unanswered
 * packets of a tick. They are sent only when the bus is free: the packet before has left (bus_wait_free). No packet
 * at all begins while a well servo answers. Other packets may be handed over after an unanswered one. The adapter
 * sends them in order, and the time for an answer begins when its packet has left (hal/host/bus.c). */
#include "session.h"

#include <stddef.h>

#include "servo_wire.h"

enum { SLOPES_AT = 28 };

void machine_bus_write(const uint8_t *bytes, uint16_t count);
void simtime_bus_write(const uint8_t *bytes, uint16_t count);   /* the original in simtime.c */

static unsigned under_way;

/* True if the servo has no fault and answers now or is about to. */
static bool answers_now(const joint_t *joint)
{
    return joint->servo != NULL && !rules_has_fault(joint) && servo_wire_is_talking(&joint->servo->talk);
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    const bool is_of_tick =
        bytes[4] == INST_ACTION || (bytes[4] == INST_SYNC_WRITE && (bytes[5] == GOAL_AT || bytes[5] == SLOPES_AT));
    if (is_of_tick && under_way > 0) {
        session_fail("one packet at a time is on the bus", "%02x to %u, while one is leaving", bytes[4], bytes[2]);
    }
    const bool is_quiet = long_ago(session.trouble_tick, TROUBLE) && !rules_somebody_is_late();
    for (unsigned id = 0; is_quiet && id < IDS; id++) {
        if (answers_now(&session.joint[id])) {
            session_fail("no packet begins in an answer", "%02x to %u, while servo %u answers", bytes[4], bytes[2], id);
        }
    }
    under_way++;
    simtime_bus_write(bytes, count);
}

void handed_left(void)
{
    under_way -= under_way > 0 ? 1 : 0;
}

void handed_lost(void)
{
    under_way = 0;
}
