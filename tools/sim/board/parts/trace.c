/* SPDX-License-Identifier: MIT */
#include "trace.h"

#include <stdlib.h>
#include <string.h>

static void note(void *context, uint64_t now, const uint8_t *packet, uint8_t count)
{
    trace_t *trace = context;
    if (trace->count == trace->room) {
        size_t room = trace->room ? trace->room * 2 : 1024;
        trace_packet_t *packets = realloc(trace->packets, room * sizeof *packets);
        if (!packets) {
            return;
        }
        trace->packets = packets;
        trace->room = room;
    }
    trace_packet_t *place = &trace->packets[trace->count++];
    place->cycle = now;
    place->count = count < sizeof place->bytes ? count : sizeof place->bytes;
    memcpy(place->bytes, packet, place->count);
}

void trace_start(trace_t *trace, servo_bus_t *bus)
{
    trace->count = 0;
    bus->on_packet = note;
    bus->on_packet_context = trace;
}

void trace_free(trace_t *trace) { free(trace->packets); }
