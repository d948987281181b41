/* SPDX-License-Identifier: MIT */
#include "step_plan.h"

/* Nominal: 40 units of way at speed 1 take 40 * 40 / 3 ticks (720 degrees/s = 256 speed units; 1024 units = 300 deg). */

uint16_t step_plan_classic_ticks(const player_step_t *step, uint16_t longest_way)
{
    uint16_t units = (uint16_t)((uint16_t)((uint16_t)step->time * step->page_speed) >> 5);
    if (units == 0) {
        units = 1;
    }
    if (step->schedule == PAGE_SCHEDULE_TIME) {
        return units;
    }
    uint16_t way = (uint16_t)(40u * longest_way), speed = (uint16_t)(3u * units);
    return (uint16_t)(way / speed);
}

uint16_t step_plan_classic_hold(const player_step_t *step)
{
    if (step->pause == 0) {
        return 0; /* spares the usual case a division */
    }
    uint16_t pause = (uint16_t)(step->pause << 5);
    return (uint16_t)(pause / step->page_speed);
}

uint8_t step_plan_classic_ramp(uint8_t accel_time, uint16_t *ticks)
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

/* length in 1/2048 tick; what is left after the whole ticks is carried on */
static uint16_t whole_ticks(uint32_t length_q21_11, uint16_t *carry_q5_11)
{
    length_q21_11 += *carry_q5_11;
    uint32_t ticks = length_q21_11 >> 11;
    if (ticks > UINT16_MAX) {
        *carry_q5_11 = 0;
        return UINT16_MAX;
    }
    *carry_q5_11 = (uint16_t)(length_q21_11 & 0x7FF);
    return (uint16_t)ticks;
}

uint16_t step_plan_exact_ticks(const player_step_t *step, uint16_t longest_way, uint16_t *carry_q5_11)
{
    uint16_t product = (uint16_t)((uint16_t)step->time * step->page_speed);
    uint32_t length;
    if (step->schedule == PAGE_SCHEDULE_TIME) {
        length = (uint32_t)product << 6; /* / 32, * 2048 */
    } else {
        if (product == 0) {
            product = step->page_speed; /* speed 0 counts as the slowest speed there is */
        }
        length = (longest_way * (uint32_t)(1280ul << 11)) / ((uint32_t)3 * product);
    }
    if (length < 2048) {
        length = 2048;
    }
    return whole_ticks(length, carry_q5_11);
}

uint16_t step_plan_exact_hold(const player_step_t *step, uint16_t *carry_q5_11)
{
    if (step->pause == 0) {
        return 0;
    }
    uint32_t length = step->schedule == PAGE_SCHEDULE_TIME ? ((uint32_t)step->pause * step->page_speed) << 6
                                                           : ((uint32_t)step->pause << 16) / step->page_speed;
    return whole_ticks(length, carry_q5_11);
}

uint8_t step_plan_exact_ramp(uint8_t accel_time, uint16_t ticks)
{
    return accel_time <= ticks / 2 ? accel_time : (uint8_t)(ticks / 2);
}
