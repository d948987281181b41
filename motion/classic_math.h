/* SPDX-License-Identifier: MIT
 * classic_math.h - the arithmetic of the classic law: the original's results, bit by bit. A tick divides once, for
 * all joints. Included by the law's files only. Above each function is the plain expression that it equals (N, A, M, v as in
 * player.md). */
#ifndef CLASSIC_MATH_H
#define CLASSIC_MATH_H

#include "fix.h"
#include "player.h"

#define CLASSIC_SPEED_MAX 1023

ALWAYS_INLINE int16_t limit_pos(int16_t pos)
{
    if ((uint16_t)pos > PAGE_POS_MAX) {
        pos = pos < 0 ? 0 : (int16_t)PAGE_POS_MAX;
    }
    return pos;
}

static inline int16_t with_sign(uint16_t size, bool negative)
{
    return negative ? (int16_t)-(int16_t)size : (int16_t)size;
}

/* acc = floor(3 * speed * c / 160) for |speed| <= 1023, c <= 255, without signs and long shifts. speed + 1120 is positive
 * and makes acc 21 c larger. 3 / 160 = 24 / 256 / 5: one byte is dropped, and 16 bits are divided by 5 exactly. */
#define RAMP_BIAS 1120
#define RAMP_BIAS_WAY 21u

typedef struct {
    uint16_t factor; /* 24 c */
    uint16_t bias;   /* 21 c */
} ramp_share_t;

static inline ramp_share_t ramp_share(uint8_t c)
{
    return (ramp_share_t){(uint16_t)(24u * c), (uint16_t)(RAMP_BIAS_WAY * c)};
}

ALWAYS_INLINE int16_t ramp_way(int16_t speed, ramp_share_t share)
{
    uint16_t fifths = (uint16_t)(mul_u16_u16((uint16_t)(speed + RAMP_BIAS), share.factor) >> 8);
    return (int16_t)((mul_u16_high(fifths, 52429u) >> 2) - share.bias);
}

/* int16((v * A * 12 / 5) >> 8): the way of a FALL to a stand. For v >= 0 that is 3 v A / 320, for v < 0
 * -((3 |v| A + 318) / 320). 320 is 64 * 5, and / 64 is * 4 and a byte dropped. */
static inline int16_t fall_way(int16_t v, uint8_t ramp)
{
    uint32_t product = mul_u16_u16(fix_size(v), (uint16_t)(12u * ramp));
    if (v < 0) {
        product += 4 * 318;
    }
    return with_sign(mul_u16_high((uint16_t)(product >> 8), 52429u) >> 2, v < 0);
}

/* --- x * c / num ---------------------------------------------------------------------------------------------------- */

/* c / num, 0 < c <= num <= 32767, for all joints of a tick. */
typedef struct {
    uint16_t c, num, share_q0_16;
} part_t;

static inline part_t part_of(uint16_t c, uint16_t num)
{
    return (part_t){c, num, fix_ratio(c, num)};
}

/* x * c / num, toward zero, |x| <= 32767. share_q0_16 is at most 2^-16 small, so the estimate is at most one too small.
 * The remainder is then below 2 * num, so 16 bits are enough to correct it. */
ALWAYS_INLINE int16_t share_of(int16_t x, part_t part)
{
    uint16_t size = fix_size(x);
    uint16_t quotient = mul_u16_high(size, part.share_q0_16);
    uint16_t left = (uint16_t)((uint16_t)(size * part.c) - (uint16_t)(quotient * part.num));
    if (left >= part.num) {
        quotient++;
    }
    return with_sign(quotient, x < 0);
}

/* --- the speed of a step ---------------------------------------------------------------------------------------------- */

/* K = M * 2560 / 12 = M * 640 / 3 = 213 M + M / 3, for a way 0..1023. */
ALWAYS_INLINE uint32_t way_in_speed_units(uint16_t size)
{
    return mul_u16_u8(size, 213) + mul_u16_high(size, 21846);
}

/* size / divisor, limited to CLASSIC_SPEED_MAX, by long division of ten bits. size below 2^20, divisor not 0. A quotient
 * from 32768 on gives -CLASSIC_SPEED_MAX, because the original has it in 16 bits, negative, before it is limited. */
static inline int16_t divide_speed(uint32_t size, uint16_t divisor)
{
    uint16_t upper = (uint16_t)(size >> 8), rest = upper >> 2;
    if (rest >= divisor) {
        return upper >> 7 >= divisor ? -CLASSIC_SPEED_MAX : CLASSIC_SPEED_MAX;
    }
    if ((divisor & 0x8000u) != 0) { /* steps of more than 8191 ticks: the quotient is below 32 */
        int16_t few = 0;
        for (; size >= divisor; size -= divisor) {
            few++;
        }
        return few;
    }
    uint16_t bits = (uint16_t)size; /* the dividend's last ten bits leave at bit 10, the quotient's enter at bit 0 */
    for (uint8_t left = 10; left != 0; left--) {
        bits = (uint16_t)(bits << 1);
        rest = (uint16_t)(rest << 1);
        if ((bits & 0x400u) != 0) {
            rest |= 1u;
        }
        if (rest >= divisor) {
            rest = (uint16_t)(rest - divisor);
            bits |= 1u;
        }
    }
    return (int16_t)(bits & 0x3FFu);
}

#endif
