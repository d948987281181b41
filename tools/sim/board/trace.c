/* SPDX-License-Identifier: MIT */
#include <stdlib.h>
#include <string.h>

#include "board_private.h"
#include "servo_bus.h"

struct trace {
    trace_packet_t *packets;
    size_t count, room;
};

static void note(void *context, uint64_t now, const uint8_t *packet, uint8_t count)
{
    board_t *board = context;
    struct trace *trace = board->trace;
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

bool board_trace_start(board_t *board)
{
    if (!board->trace) {
        board->trace = calloc(1, sizeof *board->trace);
    }
    if (board->trace) {
        board->trace->count = 0;
        board->wire.bus->on_packet = note;
        board->wire.bus->on_packet_context = board;
    }
    return board->trace != NULL;
}

const trace_packet_t *board_trace(const board_t *board, size_t *count)
{
    *count = board->trace ? board->trace->count : 0;
    return board->trace ? board->trace->packets : NULL;
}

void trace_free(board_t *board)
{
    if (board->trace) {
        free(board->trace->packets);
        free(board->trace);
    }
}
