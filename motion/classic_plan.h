/* SPDX-License-Identifier: MIT
 * classic_plan.h - the seam between the ticks of the classic law (law_classic.c), the planning of its steps (classic_plan.c)
 * and its pauses (classic_pause.c). Included by these only. */
#ifndef CLASSIC_PLAN_H
#define CLASSIC_PLAN_H

#include "law.h"

/* Enters a section of so many ticks. */
static inline void classic_enter(player_t *player, uint8_t section, uint16_t ticks)
{
    player->section = section;
    player->section_ticks = ticks;
    player->tick = 0;
}

/* Takes the coming step after the last tick of a step: plans what begins with the next call. */
void classic_take(player_t *player) NOINLINE;

/* In the last ticks before that, once the step's length is known: as much of the plan as the tick has time for. */
void classic_plan_ahead(player_t *player) NOINLINE;

/* Computes v of the next `most` joints of those that are not planned yet. */
void classic_plan_joints(player_t *player, uint8_t most) NOINLINE;

/* g, the speed that a joint has at the end of the step: 0 behind a pause; a skipped step (N = 0) leaves w, and one without
 * ramps v. */
typedef enum { CLASSIC_LEFT_NONE, CLASSIC_LEFT_CARRIED, CLASSIC_LEFT_SPEED, CLASSIC_LEFT_IF_THROUGH } classic_left_t;

static inline classic_left_t classic_left(const player_t *player)
{
    return player->section == SECTION_HOLD ? CLASSIC_LEFT_NONE
           : player->step_ticks == 0       ? CLASSIC_LEFT_CARRIED
           : player->ramp_ticks == 0       ? CLASSIC_LEFT_SPEED
                                           : CLASSIC_LEFT_IF_THROUGH;
}

static inline int16_t classic_speed_left(classic_left_t left, const player_classic_t *classic)
{
    if (left == CLASSIC_LEFT_SPEED || (left == CLASSIC_LEFT_IF_THROUGH && classic->through)) {
        return classic->speed;
    }
    return left == CLASSIC_LEFT_CARRIED ? classic->carried : 0;
}

#endif
