/* SPDX-License-Identifier: MIT */
#include "approach.h"

#include <string.h>

/*  speed        ________________
 *              /                \         A ramp_ticks, a power of two; N total_ticks >= 2A
 *             /                  \        way = v * (N - A), so v = way / (N - A)
 *            RISE A   cruise   FALL A     RISE: speed v c / A in tick c; FALL: v (A - c) / A
 *
 * The longest way takes the limit; all others take as long. v, truncated to 2^-16 units a tick, is less than 0.6 unit short
 * over the longest approach possible (1023 units at 1 degree/s, 38,363 ticks), which the last tick, exactly on target,
 * swallows. v c stays below 1024 units: A <= N - A. */
#define RAMP_TICKS_MAX 32u
#define ONE_Q16_16 ((int32_t)65536)
/* Servo units per tick at 1 degree/s: 1024 / 300 / 128 = 2 / 75. */
#define LIMIT_NUMERATOR 2u
#define LIMIT_DENOMINATOR 75u

static uint16_t distance(uint16_t a, uint16_t b)
{
    return a > b ? (uint16_t)(a - b) : (uint16_t)(b - a);
}

uint16_t approach_start(approach_t *approach, const uint16_t from_pos[PAGE_JOINTS], const uint16_t to_pos[PAGE_JOINTS],
                        uint32_t joints, uint16_t limit_deg_s)
{
    uint16_t longest = 0;
    uint32_t bit = 1;
    memset(approach, 0, sizeof *approach);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bit <<= 1) {
        const uint16_t way = distance(from_pos[i], to_pos[i]);
        if ((joints & bit) != 0 && way > longest) {
            longest = way;
        }
    }
    if (longest <= APPROACH_NEAR_POS) {
        return 0;
    }
    /* Ticks that the longest way would take at the limit, rounded up: N - A. */
    const uint16_t limit = (uint16_t)(LIMIT_NUMERATOR * limit_deg_s);
    const uint16_t steady = (uint16_t)(((uint32_t)longest * LIMIT_DENOMINATOR + limit - 1) / limit);
    approach->ramp_ticks = RAMP_TICKS_MAX;
    while (approach->ramp_ticks > steady) {
        approach->ramp_ticks >>= 1;
    }
    approach->total_ticks = (uint16_t)(steady + approach->ramp_ticks);
    approach->joints = joints;
    bit = 1;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bit <<= 1) {
        approach->target_pos[i] = to_pos[i];
        approach->pos_q16_16[i] = from_pos[i] * ONE_Q16_16;
        if ((joints & bit) != 0) {
            approach->cruise_q16_16[i] = ((int32_t)to_pos[i] - (int32_t)from_pos[i]) * ONE_Q16_16 / (int32_t)steady;
        }
    }
    return approach->total_ticks;
}

static uint16_t rounded(int32_t pos_q16_16)
{
    return (uint16_t)((pos_q16_16 + ONE_Q16_16 / 2) >> 16);
}

/* log2 of the ramp. */
static uint8_t ramp_shift(const approach_t *approach)
{
    uint8_t shift = 0;
    while ((1u << shift) < approach->ramp_ticks) {
        shift++;
    }
    return shift;
}

/* c of this tick: how many A-ths of v the speed is. */
static uint8_t ramp_at(const approach_t *approach)
{
    uint16_t left = (uint16_t)(approach->total_ticks - approach->tick), at = approach->ramp_ticks;
    at = approach->tick < at ? approach->tick : at;
    return (uint8_t)(left < at ? left : at);
}

bool approach_tick(approach_t *approach, uint16_t goal_pos[PAGE_JOINTS])
{
    if (approach->tick >= approach->total_ticks) {
        return false;
    }
    approach->tick++;
    const bool last = approach->tick == approach->total_ticks;
    const uint8_t at = ramp_at(approach), shift = ramp_shift(approach);
    uint32_t bit = 1;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bit <<= 1) {
        if ((approach->joints & bit) != 0) {
            approach->pos_q16_16[i] += approach->cruise_q16_16[i] * at >> shift;
            goal_pos[i] = last ? approach->target_pos[i] : rounded(approach->pos_q16_16[i]);
        }
    }
    return !last;
}

void approach_break(approach_t *approach)
{
    const uint16_t ramp = approach->ramp_ticks;
    if (approach->tick + ramp >= approach->total_ticks) {
        return; /* slowing down already, or over */
    }
    const uint8_t at = ramp_at(approach), shift = ramp_shift(approach);
    approach->tick = ramp; /* at the beginning of FALL */
    approach->total_ticks = (uint16_t)(2u * ramp);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        /* FALL from the present speed s: s (A - c) / A, c = 1..A, sums up to s (A - 1) / 2. */
        approach->cruise_q16_16[i] = approach->cruise_q16_16[i] * at >> shift;
        approach->target_pos[i] =
            rounded(approach->pos_q16_16[i] + approach->cruise_q16_16[i] * (int32_t)(ramp - 1) / 2);
    }
}
