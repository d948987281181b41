/* SPDX-License-Identifier: MIT
 * mul.h - the PC's version of hal/avr/mul.h: the equivalent plain expressions. */
#ifndef MUL_H
#define MUL_H

#include <stdint.h>

/* (a * b) >> 16 of a 48-bit product; the result must fit 32 bits (it always does). */
static inline uint32_t mul_u32_u16_shift16(uint32_t a, uint16_t b)
{
    return (uint32_t)(((uint64_t)a * b) >> 16);
}

/* (a * b) >> 16 of a 32-bit product. */
static inline uint16_t mul_u16_high(uint16_t a, uint16_t b)
{
    return (uint16_t)(((uint32_t)a * b) >> 16);
}

static inline uint32_t mul_u16_u8(uint16_t a, uint8_t b)
{
    return (uint32_t)a * b;
}

static inline uint32_t mul_u16_u16(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

#endif
