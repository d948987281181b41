/* SPDX-License-Identifier: MIT
 * classic_math.h - the products and quotients of the classic law that each tick needs for each joint: the results of the
 * original, bit by bit, with one division a tick instead of one or two a joint (650 cycles each). Above each function stands
 * the plain expression that it equals. For law_classic.c and its test. */
#ifndef CLASSIC_MATH_H
#define CLASSIC_MATH_H

#include "fix.h"

static inline int16_t with_sign(uint16_t size, bool is_negative)
{
    return is_negative ? (int16_t)-(int16_t)size : (int16_t)size;
}

/* int16((speed * c * 144 / 15) >> 9) for |speed| <= 1023, c <= 255, which is floor(3 * speed * c / 160). speed + 1120 is
 * positive and makes that 21 c larger. 3 / 160 = 24 / 256 / 5: one byte is dropped, and 16 bits are divided by 5 exactly. */
#define RAMP_BIAS 1120
#define RAMP_BIAS_DISTANCE 21u

typedef struct {
    uint16_t factor; /* 24 c */
    uint16_t bias;   /* 21 c */
} ramp_share_t;

static inline ramp_share_t ramp_share(uint8_t c)
{
    return (ramp_share_t){(uint16_t)(24u * c), (uint16_t)(RAMP_BIAS_DISTANCE * c)};
}

ALWAYS_INLINE int16_t ramp_distance(int16_t speed, ramp_share_t share)
{
    const uint16_t fifths = (uint16_t)(mul_u16_u16((uint16_t)(speed + RAMP_BIAS), share.factor) >> 8);
    return (int16_t)((mul_u16_high(fifths, 52429u) >> 2) - share.bias);
}

/* c / num, 0 < c <= num <= 32767, for all joints of a tick. */
typedef struct {
    uint16_t c, num, share_q0_16;
} part_t;

static inline part_t part_of(uint16_t c, uint16_t num)
{
    return (part_t){c, num, fix_ratio(c, num)};
}

/* x * c / num, toward zero, |x| <= 32767. share_q0_16 is at most 2^-16 too small, so the estimate is at most one too small,
 * the remainder below 2 * num, and 16 bits are enough to correct it. */
ALWAYS_INLINE int16_t share_of(int16_t x, part_t part)
{
    const uint16_t size = fix_size(x);
    uint16_t quotient = mul_u16_high(size, part.share_q0_16);
    const uint16_t left = (uint16_t)((uint16_t)(size * part.c) - (uint16_t)(quotient * part.num));
    if (left >= part.num) {
        quotient++;
    }
    return with_sign(quotient, x < 0);
}

/* K = M * 2560 / 12 = 213 M + M / 3, of a distance 0..1023. */
static inline uint32_t speed_units_of(uint16_t distance)
{
    return mul_u16_u8(distance, 213) + mul_u16_high(distance, 21846u);
}

/* size / divisor, the lower 16 bits. size below 2^20, and below 2^16 * divisor unless that is 1; recip32 =
 * fix_recip32(divisor). The estimate leaves out the lowest four bits of size, so it may be a few too small. */
static inline uint16_t divide_speed(uint32_t size, uint16_t divisor, uint32_t recip32)
{
    if (divisor == 1) {
        return (uint16_t)size;
    }
    uint16_t quotient = (uint16_t)(mul_u32_u16_shift16(recip32, (uint16_t)(size >> 4)) >> 12);
    uint32_t left = size - mul_u16_u16(quotient, divisor);
    while (left >= divisor) {
        left -= divisor;
        quotient++;
    }
    return quotient;
}

#endif
