/* SPDX-License-Identifier: MIT */
#include "step_ticks.h"

#define TICK_BITS 11 /* lengths are in 1/2048 tick */

/* length / rate, floor. A length above LENGTH_MAX is taken for that. */
#define LENGTH_MAX ((uint32_t)UINT16_MAX << TICK_BITS)
static uint32_t at_rate(uint32_t length, uint16_t rate_percent)
{
    if (rate_percent == SHAPE_NORMAL) {
        return length;
    }
    if (length > LENGTH_MAX) {
        length = LENGTH_MAX;
    }
    bool fits = length <= UINT32_MAX / SHAPE_NORMAL; /* a longer one loses 1/20 tick */
    uint32_t quotient = (fits ? length * SHAPE_NORMAL : length) / rate_percent;
    return fits ? quotient : quotient * SHAPE_NORMAL;
}

/* The whole ticks of a length as stored, at the rate of the step, but at least `least`; the fraction is carried on. */
static uint16_t whole_ticks(uint32_t length_q21_11, const player_step_t *step, uint16_t least, uint16_t *carry_q5_11)
{
    uint32_t length = at_rate(length_q21_11, step->rate_percent);
    if (length < (uint32_t)least << TICK_BITS) {
        length = (uint32_t)least << TICK_BITS;
    }
    length += *carry_q5_11;
    const uint32_t ticks = length >> TICK_BITS;
    if (ticks > STEP_TICKS_MAX) {
        *carry_q5_11 = 0;
        return STEP_TICKS_MAX;
    }
    *carry_q5_11 = (uint16_t)length & ((1u << TICK_BITS) - 1u);
    return (uint16_t)ticks;
}

/* The least ticks in which no joint's mean speed is above the top speed; 0: no limit. */
static uint16_t least_ticks(const player_step_t *step, uint16_t longest_distance)
{
    uint8_t top = step->top_speed_q4_4;
    return (uint16_t)(top == 0 ? 0u : (16u * longest_distance + top - 1u) / top);
}

static uint16_t stored_classic_ticks(const player_step_t *step, uint16_t longest_distance)
{
    uint16_t units = (uint16_t)((uint16_t)((uint16_t)step->time * step->page_speed) >> 5);
    if (units == 0) {
        units = 1;
    }
    if (step->schedule == PAGE_SCHEDULE_TIME) {
        return units;
    }
    uint16_t distance = (uint16_t)(40u * longest_distance), speed = (uint16_t)(3u * units);
    return (uint16_t)(distance / speed);
}

/* The shortest step that rule 6 does not skip. */
#define CLASSIC_SHORTEST 3u

uint16_t step_ticks_classic(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11)
{
    uint16_t stored = stored_classic_ticks(step, longest_distance), ticks = stored;
    uint16_t least = least_ticks(step, longest_distance);
    if (step->rate_percent != SHAPE_NORMAL) {
        ticks = whole_ticks((uint32_t)stored << TICK_BITS, step, 0, carry_q5_11);
        least = least < CLASSIC_SHORTEST && stored >= CLASSIC_SHORTEST ? CLASSIC_SHORTEST : least;
    }
    if (ticks < least) {
        ticks = least;
    }
    return ticks > STEP_TICKS_CLASSIC_MAX ? STEP_TICKS_CLASSIC_MAX : ticks;
}

uint16_t step_ticks_classic_hold(const player_step_t *step, uint16_t *carry_q5_11)
{
    if (step->pause == 0) {
        return 0; /* spares the usual case two divisions */
    }
    uint16_t pause = (uint16_t)((uint16_t)(step->pause << 5) / step->page_speed);
    if (step->rate_percent == SHAPE_NORMAL) {
        return pause;
    }
    return whole_ticks((uint32_t)pause << TICK_BITS, step, 0, carry_q5_11);
}

uint8_t step_ticks_classic_ramp(uint8_t accel_time, uint16_t *ticks)
{
    if (*ticks > 2u * accel_time) {
        return accel_time;
    }
    if (*ticks == 0) {
        return 0;
    }
    uint8_t ramp = (uint8_t)((*ticks - 1u) >> 1);
    if (ramp == 0) {
        *ticks = 0;
    }
    return ramp;
}

/* The ideal length in 1/2048 tick, as stored. */
static uint32_t stored_exact_length(const player_step_t *step, uint16_t longest_distance)
{
    uint16_t product = (uint16_t)((uint16_t)step->time * step->page_speed);
    if (step->schedule == PAGE_SCHEDULE_TIME) {
        return (uint32_t)product << 6; /* / 32, * 2048 */
    }
    if (product == 0) {
        product = step->page_speed; /* speed 0 is taken as the slowest speed there is */
    }
    return (longest_distance * (uint32_t)(1280ul << TICK_BITS)) / ((uint32_t)3 * product);
}

uint16_t step_ticks_exact(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11)
{
    const uint16_t least = least_ticks(step, longest_distance);
    return whole_ticks(stored_exact_length(step, longest_distance), step, least != 0 ? least : 1u, carry_q5_11);
}

uint16_t step_ticks_exact_hold(const player_step_t *step, uint16_t *carry_q5_11)
{
    if (step->pause == 0) {
        return 0;
    }
    uint32_t length = step->schedule == PAGE_SCHEDULE_TIME ? ((uint32_t)step->pause * step->page_speed) << 6
                                                           : ((uint32_t)step->pause << 16) / step->page_speed;
    return whole_ticks(length, step, 0, carry_q5_11);
}
