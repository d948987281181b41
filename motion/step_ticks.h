/* SPDX-License-Identifier: MIT
 * step_ticks.h - how many ticks a step, its pause and its ramps take under both laws (LAWS.md, section 1 rules 3, 5, 6 and
 * section 2 rule 1), with rate and limit (SHAPING.md). Pure functions.
 *
 * The fraction of a tick that a length has left over goes on to the next step or pause in *carry_q5_11. A step or a pause
 * that would be longer than STEP_TICKS_MAX, 256 s, takes that: players count both together in 16 bits.
 * longest_distance: largest |target - start| of the joints, in servo units. */
#ifndef STEP_TICKS_H
#define STEP_TICKS_H

#include <stdint.h>
#include "player_state.h"

#define STEP_TICKS_MAX 32767u

/* Classic: N before rule 6. As stored it is whole; a rate or a limit makes it at most STEP_TICKS_CLASSIC_MAX, and not so
 * small that a step that would be played is skipped. */
uint16_t step_ticks_classic(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11);
uint16_t step_ticks_classic_hold(const player_step_t *step, uint16_t *carry_q5_11);
/* Rule 6: returns the ramp, which is shorter than accel_time where the step is too short for that. A step of 1 or 2 ticks
 * that has a ramp is skipped: *ticks becomes 0. */
uint8_t step_ticks_classic_ramp(uint8_t accel_time, uint16_t *ticks);
#define STEP_TICKS_CLASSIC_MAX 16383u /* 4 N is a divisor of 16 bits */

/* Exact: a step takes at least one tick. */
uint16_t step_ticks_exact(const player_step_t *step, uint16_t longest_distance, uint16_t *carry_q5_11);
uint16_t step_ticks_exact_hold(const player_step_t *step, uint16_t *carry_q5_11);

/* Half a tick: begin with this carry to get a page's length to the nearest tick. */
#define STEP_TICKS_CARRY_START 1024u

#endif
