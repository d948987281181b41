/* SPDX-License-Identifier: MIT
 * classic_plan.h - the seam between the ticks of the classic law (law_classic.c) and the planning of its steps
 * (classic_plan.c). Included by these only. */
#ifndef CLASSIC_PLAN_H
#define CLASSIC_PLAN_H

#include "law.h"

/* Takes the coming step after the last tick of a step: plans what begins with the next call. */
void classic_take(player_t *player) NOINLINE;

/* Computes v of the joints first to end - 1. */
void classic_plan_joints(player_t *player, uint8_t first, uint8_t end) NOINLINE;

/* g, the speed that a joint has at the end of the step; a skipped step (N = 0) leaves w, and one without ramps v. */
int16_t classic_speed_left(const player_t *player, const player_classic_t *classic);

#endif
