/* SPDX-License-Identifier: MIT
 * step_plan.h - how many ticks a step takes: time, speed, pause and ramp under both laws (LAWS.md, section 1 rules 3, 5, 6
 * and section 2 rule 1), rate and limit (SHAPING.md). Pure functions.
 *
 * Where a length has a fraction of a tick, the fraction is carried to the next step or pause in *carry_q5_11.
 * A longer step, and a longer pause, is cut to STEP_PLAN_TICKS_MAX, 256 s: players count both together in 16 bits. */
#ifndef STEP_PLAN_H
#define STEP_PLAN_H

#include <stdint.h>
#include "player.h"

#define STEP_PLAN_TICKS_MAX 32767u

/* longest_distance: largest |target - start| of the joints, in servo units. */

/* Classic: N before rule 6. Whole ticks as stored; with a rate or a limit at most STEP_PLAN_CLASSIC_MAX, and not so few that
 * a step that would be played is skipped. */
uint16_t step_plan_classic_ticks(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11);
uint16_t step_plan_classic_hold(const player_step_t *step, uint16_t *carry_q5_11);
/* Rule 6: cuts the ramp where the step is too short for it; a step of 1 or 2 ticks (with a ramp) is skipped: *ticks
 * becomes 0. */
uint8_t step_plan_classic_ramp(uint8_t accel_time, uint16_t *ticks);
#define STEP_PLAN_CLASSIC_MAX 16383u /* 4 N is a divisor of 16 bits */

/* Exact: a step takes at least one tick. */
uint16_t step_plan_exact_ticks(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11);
uint16_t step_plan_exact_hold(const player_step_t *step, uint16_t *carry_q5_11);

/* Half a tick: begin with this carry to get a page's length to the nearest tick. */
#define STEP_PLAN_CARRY_START 1024u

#endif
