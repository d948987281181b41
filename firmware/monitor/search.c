/* SPDX-License-Identifier: MIT */
#include "search.h"

#include <stddef.h>
#include "bus.h"
#include "bus_call.h"
#include "clock.h"
#include "dxl.h"
#include "packets.h"
#include "system.h"
#include "text.h"

enum { ID_MAX = 253 };
enum { ANSWER_US = 3000 };   /* at 57,142 bps and with the longest return delay, an answer to PING takes 1,560 */

static void print_id(uint8_t id)
{
    text_put(' ');
    text_padded(id, 3, '0');
}

void search_ids(uint8_t last)
{
    uint8_t found = 0;
    bool damaged = false;
    TEXT(" ID:");
    for (uint8_t id = 0; id <= last; id++) {
        system_kick();
        const bus_status_t status = bus_call_ping(id, 1, NULL);
        if (status == BUS_OK) {
            print_id(id);
            found++;
        } else if (status != BUS_ERR_TIMEOUT) {
            print_id(id);
            text_put('?');
            damaged = true;
        }
    }
    text_put(' ');
    text_padded(found, 3, '0');
    (void)packets_say(TEXT_P(" Dynamixels Found."));
    if (damaged) {
        (void)packets_say(TEXT_P(" ?: a damaged answer. Two servos have this ID, or its cable is bad"));
    }
}

void search_rates(void)
{
    bus_set_rate(BUS_RATE_57142);
    TEXT("57142 bps");
    search_ids(ID_MAX);
    bus_set_rate(BUS_RATE_1M);
    TEXT("1000000 bps");
    search_ids(ID_MAX);
}

/* Pings without expecting an answer, so that the bus counts every byte of one as a stray, whatever is wrong with it.
 * bus_call_ping reports half an answer as none. */
static bool is_heard(uint8_t id)
{
    bus_counts_t before, after;
    bus_counts(&before);
    (void)bus_call(id, DXL_PING, NULL, 0, BUS_NO_ANSWER, 1, NULL);
    clock_wait_us(ANSWER_US);
    bus_counts(&after);
    return after.strays != before.strays;
}

bool search_is_there(uint8_t id, uint8_t rate)
{
    bool is_there = false;
    bus_set_rate(rate);
    for (uint8_t tries = BUS_CALL_TRIES; tries > 0 && !is_there; tries--) {
        is_there = is_heard(id);
    }
    bus_set_rate(BUS_RATE_1M);
    return is_there;
}

/* Prints the servos that FAST has not moved: why, their IDs, and on the next line what to do. */
static void print_left(const char *why_P, const uint8_t *ids, uint8_t count, const char *do_P)
{
    if (count == 0) {
        return;
    }
    text_P(why_P);
    for (uint8_t i = 0; i < count; i++) {
        print_id(ids[i]);
    }
    text_line_end();
    (void)packets_say(do_P);
}

void search_make_fast(void)
{
    const uint8_t change[] = { DXL_AT_BAUD, BUS_RATE_1M };
    uint8_t left[ID_MAX + 1], left_count = 0;
    uint8_t lost[ID_MAX + 1], lost_count = 0;
    TEXT(" Moved to 1 Mbps:");
    for (uint8_t id = 0; id <= ID_MAX; id++) {
        system_kick();
        bus_set_rate(BUS_RATE_57142);
        if (bus_call_ping(id, 1, NULL) != BUS_OK) {
            continue;
        }
        if (search_is_there(id, BUS_RATE_1M)) {
            left[left_count++] = id;
            continue;
        }
        bus_set_rate(BUS_RATE_57142);
        /* A servo may answer at the old rate, at the new one, or not at all. */
        (void)bus_call(id, DXL_WRITE, change, sizeof change, 0, BUS_CALL_TRIES, NULL);
        if (search_is_there(id, BUS_RATE_1M)) {
            print_id(id);
        } else {
            lost[lost_count++] = id;
        }
    }
    bus_set_rate(BUS_RATE_1M);
    text_line_end();
    search_ids(ID_MAX);
    print_left(TEXT_P(" Left at 57142 bps, because 1 Mbps has that ID:"), left, left_count,
               TEXT_P(" Give the servo at 1 Mbps another ID (CID, ID), then FAST"));
    print_left(TEXT_P(" Not at 1 Mbps, did not obey:"), lost, lost_count,
               TEXT_P(" Switch the servos' power off and on, which ends a lock of their settings, then FAST"));
}
