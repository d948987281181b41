/* SPDX-License-Identifier: MIT
 * step_plan.h - how many ticks a step takes: both laws' reading of time, speed, pause and ramp (player.md, section 1
 * rules 3, 5, 6 and section 2 rule 1). Pure functions. */
#ifndef STEP_PLAN_H
#define STEP_PLAN_H

#include <stdint.h>
#include "player.h"

/* Classic. longest_way: largest |target - start| of the joints, in servo units. */
uint16_t step_plan_classic_ticks(const player_step_t *step, uint16_t longest_way);
uint16_t step_plan_classic_hold(const player_step_t *step);
/* Cuts the ramp where the step is too short for it; a step of 1 or 2 ticks (with a ramp) is skipped: *ticks becomes 0. */
uint8_t step_plan_classic_ramp(uint8_t accel_time, uint16_t *ticks);

/* Exact: the ideal length, its whole ticks returned and its fraction carried in *carry_q5_11 to what follows. A step
 * takes at least one tick; a length above 65535 ticks is cut to that. */
uint16_t step_plan_exact_ticks(const player_step_t *step, uint16_t longest_way, uint16_t *carry_q5_11);
uint16_t step_plan_exact_hold(const player_step_t *step, uint16_t *carry_q5_11);
uint8_t step_plan_exact_ramp(uint8_t accel_time, uint16_t ticks);

/* Half a tick: with this to begin with, a page's length is right to the nearest tick. */
#define STEP_PLAN_CARRY_START 1024u

#endif
