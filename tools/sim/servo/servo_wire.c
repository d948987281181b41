/* SPDX-License-Identifier: MIT
 * servo_wire.c - the level of the wire (the AND of all senders), and what a receiver samples. */
#include "servo_wire.h"

/* Level that one sender puts on the wire. */
static unsigned level_of(const servo_talk_t *talk, uint64_t at_cycles)
{
    if (talk->count == 0 || at_cycles < talk->start_cycles || at_cycles >= servo_wire_talk_end(talk)) {
        return 1;
    }
    const uint64_t since = at_cycles - talk->start_cycles;
    const uint8_t byte = talk->bytes[since / talk->byte_cycles];
    const uint64_t bit = since % talk->byte_cycles * SERVO_WIRE_BITS_PER_BYTE / talk->byte_cycles;
    return bit == 0 ? 0 : bit == SERVO_WIRE_BITS_PER_BYTE - 1 ? 1 : (unsigned)(byte >> (bit - 1)) & 1;
}

static unsigned level(const servo_bus_t *bus, uint64_t at_cycles)
{
    unsigned level = level_of(&bus->host, at_cycles) & level_of(&bus->noise, at_cycles);
    for (int i = 0; i < bus->count; i++) {
        level &= level_of(&bus->servos[i]->talk, at_cycles);
    }
    return level;
}

static bool overlaps(const servo_talk_t *talk, uint64_t start_cycles, uint64_t end_cycles)
{
    return talk->count > 0 && talk->start_cycles < end_cycles && servo_wire_talk_end(talk) > start_cycles;
}

bool servo_wire_is_shared(const servo_bus_t *bus, const servo_talk_t *self, uint64_t start, uint64_t end, bool *first)
{
    bool shared = self != &bus->host && overlaps(&bus->host, start, end);
    bool self_seen = false; /* of senders that began together, the first in this order wins */
    *first = true;
    for (int i = -1; i < bus->count; i++) {
        const servo_talk_t *talk = i < 0 ? &bus->noise : &bus->servos[i]->talk;
        if (talk == self || !overlaps(talk, start, end)) {
            self_seen = self_seen || talk == self;
            continue;
        }
        shared = true;
        if (talk->start_cycles < self->start_cycles || (talk->start_cycles == self->start_cycles && !self_seen)) {
            *first = false;
        }
    }
    return shared;
}

bool servo_wire_sample(const servo_bus_t *bus, uint64_t start, uint64_t end, uint8_t *byte)
{
    uint8_t value = 0;
    for (unsigned bit = 1; bit <= 8; bit++) {
        value |= (uint8_t)(level(bus, start + (end - start) * (2 * bit + 1) / 20) << (bit - 1));
    }
    *byte = value;
    return level(bus, start + (end - start) * 19 / 20) == 1;
}
