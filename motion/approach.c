/* SPDX-License-Identifier: MIT */
#include "approach.h"

#include <string.h>
#include "mul.h"

/*  speed        ________________
 *              /                \         A ramp_ticks, N total_ticks >= 2A
 *             /                  \        RISE: speed v c / A in tick c; FALL: v (A - c) / A
 *            RISE A   cruise   FALL A     distance = v (N - A)
 *
 * All joints share one plan: the part of its distance that each has covered, 0..1 as q0.32. step_q0_32 is v / A, truncated.
 * So the longest approach (1023 units at 1 degree/s, 38,363 ticks) is 0.3 units short before the last tick, which is set to
 * the target. */
#define RAMP_TICKS_MAX 32u
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
    uint32_t left = joints;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, left >>= 1) {
        const uint16_t apart = distance(from_pos[i], to_pos[i]);
        if (((uint8_t)left & 1u) != 0 && apart > longest) {
            longest = apart;
        }
    }
    memmove(approach->target_pos, to_pos, sizeof approach->target_pos);
    memcpy(approach->from_pos, from_pos, sizeof approach->from_pos);
    approach->joints = joints;
    approach->made_q0_32 = 0;
    approach->tick = approach->total_ticks = 0;
    approach->broken = false;
    if (longest <= APPROACH_NEAR_POS) {
        return 0;
    }
    /* Ticks that the longest distance would take at the limit, rounded up: N - A. */
    const uint16_t limit = (uint16_t)(LIMIT_NUMERATOR * limit_deg_s);
    const uint16_t steady = (uint16_t)(((uint32_t)longest * LIMIT_DENOMINATOR + limit - 1) / limit);
    approach->ramp_ticks = (uint8_t)(steady < RAMP_TICKS_MAX ? steady : RAMP_TICKS_MAX);
    approach->total_ticks = (uint16_t)(steady + approach->ramp_ticks);
    approach->step_q0_32 = UINT32_MAX / steady / approach->ramp_ticks;
    return approach->total_ticks;
}

/* c of this tick: how many A-ths of v the speed is. */
static uint8_t ramp_at(const approach_t *approach)
{
    uint16_t at = approach->ramp_ticks, left = (uint16_t)(approach->total_ticks - approach->tick);
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
    approach->made_q0_32 = last && !approach->broken ? UINT32_MAX
                                                     : approach->made_q0_32 + approach->step_q0_32 * ramp_at(approach);
    const uint16_t made_q0_16 = (uint16_t)(approach->made_q0_32 >> 16);
    uint32_t left = approach->joints;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, left >>= 1) {
        if (((uint8_t)left & 1u) != 0) {
            /* Rounded to the nearest; the whole distance of 0..1023 comes out exactly with 65535 / 65536, too. */
            const uint16_t from = approach->from_pos[i], to = approach->target_pos[i];
            const uint16_t moved = (uint16_t)((mul_u16_u16(distance(from, to), made_q0_16) + 0x8000u) >> 16);
            goal_pos[i] = (uint16_t)(to > from ? from + moved : from - moved);
        }
    }
    return !last;
}

void approach_break(approach_t *approach)
{
    const uint8_t ramp = approach->ramp_ticks;
    if (approach->tick + ramp >= approach->total_ticks) {
        return; /* slowing down already, or over */
    }
    /* FALL from the present speed. */
    approach->step_q0_32 = approach->step_q0_32 * ramp_at(approach) / ramp;
    approach->tick = ramp;
    approach->total_ticks = (uint16_t)(2u * ramp);
    approach->broken = true;
}
