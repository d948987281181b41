/* SPDX-License-Identifier: MIT */
#include "search.h"

#include <stddef.h>
#include "bus.h"
#include "bus_call.h"
#include "dxl.h"
#include "packets.h"
#include "system.h"
#include "text.h"

enum { ID_MAX = 253 };

void search_ids(uint8_t last)
{
    uint8_t found = 0;
    TEXT(" ID:");
    for (uint8_t id = 0; id <= last; id++) {
        system_kick();
        if (bus_call_ping(id, 1, NULL) == BUS_OK) {
            text_put(' ');
            text_padded(id, 3, '0');
            found++;
        }
    }
    text_put(' ');
    text_padded(found, 3, '0');
    (void)packets_say(TEXT_P(" Dynamixels Found."));
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

void search_make_fast(void)
{
    const uint8_t change[] = { DXL_AT_BAUD, BUS_RATE_1M };
    bus_set_rate(BUS_RATE_57142);
    TEXT(" Moved to 1 Mbps:");
    for (uint8_t id = 0; id <= ID_MAX; id++) {
        system_kick();
        if (bus_call_ping(id, 1, NULL) == BUS_OK) {
            /* A servo may answer at the old rate, at the new one, or not at all. The final search shows the result. */
            (void)bus_call(id, DXL_WRITE, change, sizeof change, 0, BUS_CALL_TRIES, NULL);
            text_put(' ');
            text_padded(id, 3, '0');
        }
    }
    bus_set_rate(BUS_RATE_1M);
    text_line_end();
    search_ids(ID_MAX);
}
