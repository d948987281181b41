/* SPDX-License-Identifier: MIT
 * handed.c - when the program hands packets to the bus, by hal/bus.h. Goals, slopes and ACTION, the packets of a tick that
 * nobody answers, go when the bus is free: the one before has left (bus_wait_free). No packet at all begins while a servo
 * that is well answers. Others may be handed over behind one without an answer: the adapter sends them one after the other,
 * and the time of an answer begins when its packet has left (hal/host/bus.c). */
#include "session.h"

#include <stddef.h>

#include "servo_wire.h"

enum { ACTION = 5, SYNC_WRITE = 0x83 };
enum { SLOPES_AT = 28 };
#define PAST (6u * SECOND)         /* what the line and servos have done is over */

void machine_bus_write(const uint8_t *bytes, uint16_t count);
void simtime_bus_write(const uint8_t *bytes, uint16_t count);   /* what simtime.c has for it */

static unsigned under_way;

static bool is_past(uint32_t tick)
{
    return tick == NEVER_TICK || session.tick - tick > PAST;
}

/* A servo of which nothing but good answers is to be expected, and that answers now or is about to. */
static bool answers_now(const joint_t *joint)
{
    return joint->servo != NULL && is_past(joint->fault_tick) && servo_wire_is_talking(&joint->servo->talk);
}

void machine_bus_write(const uint8_t *bytes, uint16_t count)
{
    const bool is_of_tick =
        bytes[4] == ACTION || (bytes[4] == SYNC_WRITE && (bytes[5] == GOAL_AT || bytes[5] == SLOPES_AT));
    if (is_of_tick && under_way > 0) {
        session_fail("one packet at a time is on the bus", "%02x to %u, while one is leaving", bytes[4], bytes[2]);
    }
    for (unsigned id = 0; id < IDS && is_past(session.trouble_tick); id++) {
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
