/* SPDX-License-Identifier: MIT
 * fix.h - fixed-point arithmetic of the motion core. Scaled numbers are multiplied and rounded only here.
 *
 *   pos, speed, acceleration   q16.16 in int32_t / uint32_t    +-32767.999 servo units, 1/65536
 *   share                      q0.16 in uint16_t               0 .. 0.99998
 *   time                       q5.11 fraction of a tick        1/2048
 *
 * With 16 fraction bits the output is the upper word of the position, which costs a tick nothing. The price: an acceleration
 * is up to 2^-16 too small, so that after a ramp of 255 ticks a joint is half a servo unit short of the ideal (after 32
 * ticks 1/128). All roundings are toward zero, on sizes, so that a joint is late but never past its target (law_exact.c).
 * Signs are applied afterwards, so that a mirrored motion is mirrored in every bit. */
#ifndef FIX_H
#define FIX_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "mul.h"

#define FIX_POS_BITS 16
#define FIX_POS_ONE ((int32_t)1 << FIX_POS_BITS)

/* Position in servo units of a q16.16: floor, in two's complement. The plain expression is pos >> 16. */
static inline uint16_t fix_pos(int32_t pos_q16_16)
{
    return (uint16_t)((uint32_t)pos_q16_16 >> FIX_POS_BITS);
}

static inline int32_t fix_from_pos(uint16_t pos)
{
    return (int32_t)((uint32_t)pos << FIX_POS_BITS);
}

/* Added to the start, these make fix_pos round to the nearest: halves up (motions up) or halves down (motions down), so that
 * mirrored motions are rounded to mirrored positions. */
#define FIX_ROUND_UP (FIX_POS_ONE / 2)
#define FIX_ROUND_DOWN (FIX_POS_ONE / 2 - 1)

/* 2^32 / ticks, ticks 1..65535: what fix_mean multiplies by. Floor of (2^32 - 1) / ticks; one 32-bit division. */
uint32_t fix_recip32(uint16_t ticks);
ONE_COPY NOINLINE uint32_t fix_recip32(uint16_t ticks)
{
    return UINT32_MAX / ticks;
}

/* Mean speed q16.16 of a distance 0..65535 in the ticks of fix_recip32. Floor; at most 2^-16 * distance + 1 units of 2^-16
 * too small. */
ALWAYS_INLINE uint32_t fix_mean(uint16_t distance, uint32_t recip32)
{
    return mul_u32_u16_shift16(recip32, distance);
}

/* value * share, floor; error below value * 2^-16 + 1. No overflow. */
static inline uint32_t fix_share(uint32_t value, uint16_t share_q0_16)
{
    return mul_u32_u16_shift16(value, share_q0_16);
}

/* part / whole as q0.16, 0 <= part <= whole, whole not 0; 1 becomes 65535. The plain expression is (part << 16) / whole. By
 * hand it takes 350 cycles less: with the library's division the worst tick misses half a tick (tools/bench --strict). */
uint16_t fix_ratio(uint16_t part, uint16_t whole);
ONE_COPY NOINLINE uint16_t fix_ratio(uint16_t part, uint16_t whole)
{
    if (part >= whole) {
        return UINT16_MAX;
    }
    uint16_t quotient = 0;
    for (uint8_t left = 16; left != 0; left--) {
        const bool has_17_bits = part > INT16_MAX;
        part = (uint16_t)(part << 1);
        quotient = (uint16_t)(quotient << 1);
        if (has_17_bits || part >= whole) {
            part = (uint16_t)(part - whole);
            quotient++;
        }
    }
    return quotient;
}

/* The reciprocal of a ramp of 1..255 ticks, for fix_by_ramp: 2^16 / ticks below 16 ticks, 2^20 / ticks from there on, so
 * that at least 12 bits are significant. Too small by at most 2^-12 of its value. One 32-bit division. */
#define FIX_LONG_RAMP 16u
uint16_t fix_ramp_recip(uint8_t ticks);
ONE_COPY NOINLINE uint16_t fix_ramp_recip(uint8_t ticks)
{
    return (uint16_t)(ticks < FIX_LONG_RAMP ? UINT16_MAX / ticks : (uint16_t)(16ul * UINT16_MAX / ticks));
}

/* speed / ticks. Exact for 1 and 2 ticks; else never too large, with an error below 2^-12 of it plus 2^-16. */
static inline uint32_t fix_by_ramp(uint32_t speed, uint16_t ramp_recip, uint8_t ticks)
{
    if (ticks <= 2) {
        return ticks == 2 ? speed >> 1 : speed;
    }
    uint32_t quotient = mul_u32_u16_shift16(speed, ramp_recip);
    return ticks < FIX_LONG_RAMP ? quotient : quotient >> 4;
}

static inline uint16_t fix_size(int16_t value)
{
    return (uint16_t)(value < 0 ? -value : value);
}

/* Positions are compared as signed: a joint that its trim puts outside the range of pages stands below 0 or above 1023
 * (player_start). */
static inline bool fix_is_below(uint16_t pos, uint16_t other_pos)
{
    return (int16_t)pos < (int16_t)other_pos;
}

static inline uint16_t fix_distance(uint16_t from_pos, uint16_t to_pos)
{
    return fix_is_below(from_pos, to_pos) ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
}

#endif
