/* SPDX-License-Identifier: MIT
 * trace.h - records the instruction packets that the board sends to the servos. */
#ifndef SIM_TRACE_H
#define SIM_TRACE_H

#include "board_ports.h"
#include "servo_bus.h"

typedef struct {
    trace_packet_t *packets;
    size_t count, room;
} trace_t;

void trace_start(trace_t *trace, servo_bus_t *bus); /* drops earlier records */
void trace_free(trace_t *trace);

#endif
