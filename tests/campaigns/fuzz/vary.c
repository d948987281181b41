/* SPDX-License-Identifier: MIT */
#include "vary.h"

#include <string.h>

static uint32_t state = 1;

void vary_seed(uint32_t seed)
{
    state = seed * 2654435761u | 1u;
}

/* xorshift32 (Marsaglia, 2003) */
static uint32_t number(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

size_t vary_chance(size_t below)
{
    return below ? (number() >> 3) % below : 0;
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void remove_range(input_t *input, size_t at, size_t count)
{
    count = smaller(count, input->size - at);
    memmove(input->bytes + at, input->bytes + at + count, input->size - at - count);
    input->size -= count;
}

/* from: `count` bytes outside of the input */
static void insert(input_t *input, size_t size_max, size_t at, const uint8_t *from, size_t count)
{
    count = smaller(count, size_max - input->size);
    memmove(input->bytes + at + count, input->bytes + at, input->size - at);
    memcpy(input->bytes + at, from, count);
    input->size += count;
}

static void repeat(input_t *input, size_t size_max, size_t at, size_t count)
{
    uint8_t copy[32];
    count = smaller(smaller(count, sizeof copy), input->size - at);
    memcpy(copy, input->bytes + at, count);
    insert(input, size_max, vary_chance(input->size + 1), copy, count);
}

static void splice(input_t *input, size_t size_max, size_t at, const input_t *other)
{
    const size_t from = vary_chance(other->size);
    insert(input, size_max, at, other->bytes + from, smaller(vary_chance(64), other->size - from));
}

static void change(input_t *input, size_t size_max, const input_t *other)
{
    static const uint8_t edges[] = {0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF, 0x55, 0x0D};
    const size_t at = vary_chance(input->size), kind = input->size ? vary_chance(6) : 5;
    switch (kind) {
    case 0: input->bytes[at] ^= (uint8_t)(1u << vary_chance(8)); break;
    case 1: input->bytes[at] = (uint8_t)vary_chance(256); break;
    case 2: input->bytes[at] = edges[vary_chance(sizeof edges)]; break;
    case 3: remove_range(input, at, 1 + vary_chance(16)); break;
    case 4: repeat(input, size_max, at, 1 + vary_chance(32)); break;
    default: splice(input, size_max, at, other); break;
    }
}

void vary(input_t *input, size_t size_max, const input_t *other)
{
    for (size_t left = 1 + vary_chance(4); left > 0; left--) {
        change(input, size_max, other);
    }
}
