/* SPDX-License-Identifier: MIT
 * mul.h - the host version of hal/avr/mul.h: the plain expressions that it equals. */
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

/* (a * b) >> 8 of a 16-bit product, whose upper bits are lost. */
static inline uint8_t mul_u16_u8_shift8(uint16_t a, uint8_t b)
{
    return (uint8_t)(((uint32_t)a * b) >> 8);
}

/* (a * b) >> 8. */
static inline uint8_t mul_u8_high(uint8_t a, uint8_t b)
{
    return (uint8_t)(((unsigned)a * b) >> 8);
}

/* (a * b) >> 16 of a product below 2^40, of which 24 bits are returned; b below 2^24. */
static inline uint32_t mul_u16_u24_shift16(uint16_t a, uint32_t b)
{
    return (uint32_t)(((uint64_t)a * b) >> 16);
}

/* (a * b) >> 32, 16 bits of it; a below 2^24. */
static inline uint16_t mul_u24_u32_shift32(uint32_t a, uint32_t b)
{
    return (uint16_t)(((uint64_t)a * b) >> 32);
}

static inline uint32_t shift_u32_right4(uint32_t value)
{
    return value >> 4;
}

static inline uint32_t mul_u16_u16(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

#endif
