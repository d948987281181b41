/* SPDX-License-Identifier: MIT
 * mul.h - the two multiplications that the motion core lives on, AVR version (host version: tests/fake/mul.h). May be
 * included anywhere. */
#ifndef MUL_H
#define MUL_H

#include <stdint.h>

/* (a * b) >> 16 of a 32-bit product: gcc makes one call of __umulhisi3. */
static inline uint16_t mul_u16_high(uint16_t a, uint16_t b)
{
    return (uint16_t)(((uint32_t)a * b) >> 16);
}

/* (a * b) >> 16 of a 48-bit product. */
static inline uint32_t mul_u32_u16_shift16(uint32_t a, uint16_t b)
{
    return (uint32_t)(uint16_t)(a >> 16) * b + mul_u16_high((uint16_t)a, b);
}

#endif
