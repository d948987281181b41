/* SPDX-License-Identifier: MIT
 * servo_wire.h - what lies on the wire when. For the files of the bus only. */
#ifndef SIM_SERVO_WIRE_H
#define SIM_SERVO_WIRE_H

#include "servo_bus.h"

#define SERVO_WIRE_BITS_PER_BYTE 10u /* start, 8 data, stop */

/* Controller cycles of a byte. */
static inline uint64_t servo_wire_byte_cycles(uint32_t rate_bps)
{
    return (SERVO_WIRE_BITS_PER_BYTE * 1000000u * SERVO_CYCLES_PER_US + rate_bps / 2) / rate_bps;
}

/* Whether a talker has bytes that have not passed. */
static inline bool servo_wire_is_talking(const servo_talk_t *talk)
{
    return talk->sent < talk->count;
}

/* When the byte that a talker sends now has passed; when all its bytes have. */
static inline uint64_t servo_wire_byte_end(const servo_talk_t *talk)
{
    return talk->start_cycles + (talk->sent + 1u) * talk->byte_cycles;
}

static inline uint64_t servo_wire_talk_end(const servo_talk_t *talk)
{
    return talk->start_cycles + talk->count * talk->byte_cycles;
}

/* Does anyone but self use the wire in [start, end)? *first: is self the one who began before all others? */
bool servo_wire_is_shared(const servo_bus_t *bus, const servo_talk_t *self, uint64_t start, uint64_t end, bool *first);

/* What a receiver of the right rate gets from the byte time [start, end). Returns false: no stop bit. */
bool servo_wire_sample(const servo_bus_t *bus, uint64_t start, uint64_t end, uint8_t *byte);

#endif
