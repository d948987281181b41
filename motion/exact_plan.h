/* SPDX-License-Identifier: MIT
 * exact_plan.h - the seam between the ticks of the exact law (law_exact.c) and the planning of its steps (exact_plan.c).
 * Included by these only. exact_measure and exact_plan_given are in law.h. */
#ifndef EXACT_PLAN_H
#define EXACT_PLAN_H

#include "law.h"

/* In the last tick but one of a step, once the coming step is measured: plans up to a third of the joints for `now`, fewer
 * after other work. */
void exact_plan_ahead(player_t *player);

/* Takes the coming step: the joints are on target_pos, and it begins with the next tick. Plans some more of them. */
void exact_take(player_t *player) NOINLINE;

/* In the first tick of a step, or before: plans the joints that are not planned yet. */
void exact_plan_others(player_t *player);

/* Plans all joints for the rest of an interrupted step: from where they stand to target_pos, in step_ticks. */
void exact_plan_rest(player_t *player);

#endif
