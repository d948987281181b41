/* SPDX-License-Identifier: MIT
 * approach.h - from the present pose to a page's first pose, within a speed limit, ramped (LAWS.md section 2, rule 6).
 * All joints take the same time, set by the longest distance. Pure; caller-owned state; main loop only.
 * RAM: sizeof(approach_t), 142 bytes on the AVR. */
#ifndef APPROACH_H
#define APPROACH_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"

#define APPROACH_SPEED_DEFAULT 60u   /* degrees per second */
#define APPROACH_NEAR_POS 3u         /* servo units: a pose this near needs no approach */

typedef struct {
    uint32_t joints;
    uint16_t tick, total_ticks;
    uint8_t ramp_ticks;
    bool broken;                        /* stops short of the target */
    /* The part of its distance that every joint has covered; more of it each tick of RISE. */
    uint32_t made_q0_32, step_q0_32;
    uint16_t from_pos[PAGE_JOINTS], target_pos[PAGE_JOINTS];
} approach_t;

/* Plans the approach of `joints` (bit per joint) from from_pos to to_pos with at most `limit_deg_s` degrees/s (1..360).
 * to_pos may be approach->target_pos. Returns the number of ticks; 0 when every joint is within APPROACH_NEAR_POS
 * already. */
uint16_t approach_start(approach_t *approach, const uint16_t from_pos[PAGE_JOINTS],
                        const uint16_t to_pos[PAGE_JOINTS], uint32_t joints, uint16_t limit_deg_s);

/* One tick: writes the goals of the joints. Returns false with the last tick, which is exactly on target, and
 * after it. */
bool approach_tick(approach_t *approach, uint16_t goal_pos[PAGE_JOINTS]);

/* Stops all joints within 32 ticks, without turning round. approach_tick returns false when they have stopped. */
void approach_break(approach_t *approach);

#endif
