/* SPDX-License-Identifier: MIT
 * fix.h - fixed-point arithmetic of the motion core. The only place where scaled numbers are multiplied and rounded.
 *
 *   pos, speed, acceleration   q12.20 in int32_t / uint32_t    +-2047.999 servo units, 1/1048576
 *   share                      q0.16 in uint16_t               0 .. 0.99998
 *   time                       q5.11 fraction of a tick        1/2048
 *
 * Why 20 fraction bits: an acceleration wrong by half a unit of 2^-20 is wrong by 255^2 / 2 * 2^-21 = 0.016 servo units
 * at the end of the longest ramp. Why not more: 16-bit multiplications, and the position is a shift by 4 of the upper
 * half. All roundings are toward zero on sizes; signs are applied afterwards, so that a mirrored motion is mirrored in
 * every bit. */
#ifndef FIX_H
#define FIX_H

#include <stdint.h>
#include "mul.h"

#define FIX_POS_BITS 20
#define FIX_POS_ONE ((int32_t)1 << FIX_POS_BITS)

/* Position in servo units of a q12.20 that is not negative: floor. Range 0..2047. The plain expression is pos >> 20. */
static inline uint16_t fix_pos(int32_t pos_q12_20)
{
    return shift_u16_right4((uint16_t)((uint32_t)pos_q12_20 >> 16));
}

static inline int32_t fix_from_pos(uint16_t pos)
{
    return (int32_t)((uint32_t)shift_u16_left4(pos) << 16);
}

/* start + one of these, then fix_pos: nearest, halves up or down. With the first for motions up and the second for those
 * down, mirrored motions are rounded to mirrored positions. */
#define FIX_ROUND_UP (FIX_POS_ONE / 2)
#define FIX_ROUND_DOWN (FIX_POS_ONE / 2 - 1)

/* 2^28 / ticks, ticks 1..65535: what fix_mean multiplies by. Floor; one 32-bit division. */
static inline uint32_t fix_recip28(uint16_t ticks)
{
    return 0x10000000u / ticks;
}

/* Mean speed q12.20 of a way 0..2047 over the ticks of fix_recip28. Floor; relative error below ticks * 2^-28. */
static inline uint32_t fix_mean(uint16_t way, uint32_t recip28)
{
    return mul_u32_u16_shift8(recip28, way);
}

/* value * share, floor; error below value * 2^-16 + 1. No overflow. */
static inline uint32_t fix_share(uint32_t value, uint16_t share_q0_16)
{
    return mul_u32_u16_shift16(value, share_q0_16);
}

/* part / whole as q0.16, 0 <= part <= whole, whole not 0; 1 becomes 65535. One 32-bit division. */
static inline uint16_t fix_ratio(uint16_t part, uint16_t whole)
{
    if (part >= whole) {
        return UINT16_MAX;
    }
    return (uint16_t)(((uint32_t)part << 16) / whole);
}

/* One over a ramp of 1..255 ticks, for fix_by_ramp: 2^16 / ticks below 16 ticks, 2^20 / ticks from there on, so that at
 * least 12 bits are significant; a little less than that (at most 2^-12 of it). Two 16-bit divisions. */
#define FIX_LONG_RAMP 16u
static inline uint16_t fix_ramp_recip(uint8_t ticks)
{
    uint16_t quotient = (uint16_t)(UINT16_MAX / ticks);
    if (ticks < FIX_LONG_RAMP) {
        return quotient;
    }
    uint16_t remainder = (uint16_t)(UINT16_MAX - quotient * ticks);
    return (uint16_t)(quotient * 16u + (remainder * 16u) / ticks);
}

/* speed / ticks, floor, relative error below 2^-12. */
static inline uint32_t fix_by_ramp(uint32_t speed, uint16_t ramp_recip, uint8_t ticks)
{
    uint32_t quotient = mul_u32_u16_shift16(speed, ramp_recip);
    return ticks < FIX_LONG_RAMP ? quotient : quotient >> 4;
}

/* dividend / divisor and the remainder, exact, by the divisor's reciprocal (fix_recip16). Costs a multiplication
 * instead of a division: the estimate is at most one too small. divisor 1..65535 */
static inline uint16_t fix_recip16(uint16_t divisor)
{
    return (uint16_t)(UINT16_MAX / divisor);
}

static inline uint16_t fix_divide(uint16_t dividend, uint16_t divisor, uint16_t recip16, uint16_t *remainder)
{
    uint16_t quotient = mul_u16_high(dividend, recip16);
    uint16_t rest = (uint16_t)(dividend - (uint16_t)(quotient * divisor));
    if (rest >= divisor) {
        rest = (uint16_t)(rest - divisor);
        quotient++;
    }
    *remainder = rest;
    return quotient;
}

static inline uint16_t fix_size(int16_t value)
{
    return (uint16_t)(value < 0 ? -value : value);
}

#endif
