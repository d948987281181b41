/* SPDX-License-Identifier: MIT
 * classic_math.h - the arithmetic of the classic law, equal to the original's bit by bit and without a division in a
 * tick. Included by law_classic.c and classic_ahead.c only. Each expression's plain form stands above it (N, A, M, v as
 * in player.md). */
#ifndef CLASSIC_MATH_H
#define CLASSIC_MATH_H

#include "fix.h"
#include "player.h"

static inline int16_t limit_pos(int16_t pos)
{
    if ((uint16_t)pos > PAGE_POS_MAX) {
        pos = pos < 0 ? 0 : (int16_t)PAGE_POS_MAX;
    }
    return pos;
}

/* acc = floor(3 * speed * c / 160) for |speed| <= 1023, c <= 255, without signs and long shifts: speed + 1120 is positive
 * and makes acc 21 c larger, and 3 / 160 is 24 / 256 / 5: a byte dropped, and an exact division by 5 of 16 bits. */
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

static inline int16_t ramp_way(int16_t speed, ramp_share_t share)
{
    uint16_t fifths = (uint16_t)(mul_u16_u16((uint16_t)(speed + RAMP_BIAS), share.factor) >> 8);
    return (int16_t)((mul_u16_high(fifths, 52429u) >> 2) - share.bias);
}

/* The same for c = 1, where 16 bits hold the product, and a byte the fifths. */
static inline int16_t first_ramp_way(int16_t speed)
{
    uint8_t fifths = mul_u16_u8_shift8((uint16_t)(speed + RAMP_BIAS), 24u);
    return (int16_t)((mul_u8_high(fifths, 205u) >> 2) - (int16_t)RAMP_BIAS_WAY);
}

/* int16((v * A * 12 / 5) >> 8): way of a FALL to a stand. The truncated and then floored quotient is 3 v A / 320, of
 * negative products (3 |v| A + 318) / 320 with a minus; 320 is 64 * 5, and / 64 is * 4 and a byte dropped. Up to
 * FALL_SHORT ticks 16 bits hold the product, and a byte the fifths. */
#define FALL_SHORT 5u
static inline int16_t fall_way(int16_t v, uint8_t ramp)
{
    uint16_t size = fix_size(v), way;
    if (ramp <= FALL_SHORT) {
        uint16_t product = (uint16_t)(size * (uint8_t)(12u * ramp));
        if (v < 0) {
            product = (uint16_t)(product + 4u * 318u);
        }
        way = mul_u8_high((uint8_t)(product >> 8), 205u) >> 2;
    } else {
        uint32_t product = mul_u16_u16(size, (uint16_t)(12u * ramp));
        if (v < 0) {
            product += 4 * 318;
        }
        way = mul_u16_high((uint16_t)(product >> 8), 52429u) >> 2;
    }
    return v < 0 ? (int16_t)-(int16_t)way : (int16_t)way;
}

/* A number of ticks that a way or a speed is shared out over. */
typedef struct {
    uint16_t num, recip16;
    uint8_t few; /* num when it is 1 or 2: these need no multiplication. Else 0 */
} spread_t;

static inline spread_t spread_over(uint16_t num)
{
    return num <= 2 ? (spread_t){num, 0, (uint8_t)num} : (spread_t){num, fix_recip16(num), 0};
}

/* x * 1 / num (toward zero), and from now on x * c / num by next_share, c = 2, 3, ... Toward zero is down for x >= 0 and up
 * below: up is down of the same plus (num - 1) / num, with which the sum of remainders then begins. */
static inline int16_t first_share(player_joint_t *joint, int16_t x, spread_t over)
{
    int16_t value = x, quotient;
    uint16_t remainder, error;
    if (over.few == 1) { /* and no next_share comes */
        joint->classic.value = value;
        return value;
    }
    if (over.few == 2) {
        quotient = value = x >> 1;
        error = remainder = (uint8_t)x & 1u;
        if (x < 0) {
            value = (int16_t)(value + (int16_t)remainder);
            error ^= 1u;
        }
    } else {
        quotient = value = (int16_t)fix_divide(fix_size(x), over.num, over.recip16, &remainder);
        error = remainder;
        if (x < 0) {
            quotient = value = (int16_t)-value;
            error = (uint16_t)(over.num - 1u - remainder);
            if (remainder != 0) {
                quotient--;
                remainder = (uint16_t)(error + 1u);
            }
        }
    }
    joint->classic.quotient = quotient;
    joint->classic.remainder = remainder;
    joint->classic.error = error;
    joint->classic.value = value;
    return value;
}

static inline int16_t next_share(player_joint_t *joint, uint16_t num)
{
    int16_t value = (int16_t)(joint->classic.value + joint->classic.quotient);
    uint16_t error = (uint16_t)(joint->classic.error + joint->classic.remainder);
    if (error >= num) {
        error = (uint16_t)(error - num);
        value++;
    }
    joint->classic.error = error;
    joint->classic.value = value;
    return value;
}

/* 16 bits more of a quotient: (rest * 2^16 + (bit != 0 ? 65535 : 0)) / divisor, rest below the divisor. 280 cycles, where
 * a division of 32 bits takes 600. */
uint16_t classic_divide_on(uint16_t rest, uint16_t divisor, uint8_t bit);

/* way * part / whole, toward zero; share = part / whole. The estimate is at most one too small, and what is left of
 * the product below 2 * whole: 16 bits are enough to see which. */
static inline int16_t share_of(int16_t way, uint16_t part, uint16_t whole, uint16_t share_q0_16)
{
    uint16_t size = fix_size(way);
    uint16_t quotient = mul_u16_high(size, share_q0_16);
    uint16_t left = (uint16_t)((uint16_t)(size * part) - (uint16_t)(quotient * whole));
    if (part != 0 && left >= whole) {
        quotient++;
    }
    return way < 0 ? (int16_t)-(int16_t)quotient : (int16_t)quotient;
}

/* Whether a joint goes on in the coming step's direction in the step behind it, whose word for it this is. */
static inline bool classic_runs_on(const player_joint_t *joint, uint16_t word)
{
    return page_pos_is_used(word) && ((joint->target_pos < joint->coming_pos && joint->coming_pos < word) ||
                                      (joint->target_pos > joint->coming_pos && joint->coming_pos > word));
}

/* The speed that a joint still has when the step playing now is over, w of the coming one, and how to know it. */
typedef enum { LEFT_NONE, LEFT_IF_THROUGH, LEFT_SPEED, LEFT_CARRIED } speed_left_t; /* in uint8_t */

uint8_t classic_left(const player_t *player);

static inline int16_t classic_speed_left(uint8_t left, const player_joint_t *joint)
{
    if (left == LEFT_NONE || (left == LEFT_IF_THROUGH && !joint->classic.through)) {
        return 0;
    }
    return left == LEFT_CARRIED ? joint->classic.carried : joint->classic.speed;
}

#endif
