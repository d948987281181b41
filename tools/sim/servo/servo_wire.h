/* SPDX-License-Identifier: MIT
 * servo_wire.h - who occupies the wire, and when. For the files of the bus only. */
#ifndef SIM_SERVO_WIRE_H
#define SIM_SERVO_WIRE_H

#include "servo_bus.h"

#define SERVO_WIRE_BITS_PER_BYTE 10u /* start, 8 data, stop */

/* Length of a byte in controller cycles. */
static inline uint64_t servo_wire_byte_cycles(uint32_t rate_bps)
{
    return (SERVO_WIRE_BITS_PER_BYTE * 1000000u * SERVO_CYCLES_PER_US + rate_bps / 2) / rate_bps;
}

/* Whether a sender has bytes that have not passed yet. */
static inline bool servo_wire_is_talking(const servo_talk_t *talk)
{
    return talk->sent < talk->count;
}

/* End of the byte being sent; end of the last byte. */
static inline uint64_t servo_wire_byte_end(const servo_talk_t *talk)
{
    return talk->start_cycles + (talk->sent + 1u) * talk->byte_cycles;
}

static inline uint64_t servo_wire_talk_end(const servo_talk_t *talk)
{
    return talk->start_cycles + talk->count * talk->byte_cycles;
}

/* Whether anyone but self uses the wire in [start, end). *first: self began before all others. */
bool servo_wire_is_shared(const servo_bus_t *bus, const servo_talk_t *self, uint64_t start, uint64_t end, bool *first);

/* What a receiver at the right rate reads in the byte time [start, end). false: no stop bit. */
bool servo_wire_sample(const servo_bus_t *bus, uint64_t start, uint64_t end, uint8_t *byte);

#endif
