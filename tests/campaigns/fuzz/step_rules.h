/* SPDX-License-Identifier: MIT
 * step_rules.h - what the exact law promises for each undisturbed step (LAWS.md section 2, rules 1 and 2), for the
 * harnesses that play any pages: a step and its pause take the planned ticks, and no joint leaps. Call player_plan
 * before step_rules_before, so that a due step has begun. */
#ifndef STEP_RULES_H
#define STEP_RULES_H

#include "player.h"

typedef struct {
    uint32_t ticks;                   /* including its pause */
    uint16_t step_ticks;              /* without its pause */
    uint16_t from_pos[PAGE_JOINTS], to_pos[PAGE_JOINTS];
} rules_step_t;

/* All zero: no step yet. */
typedef struct {
    bool waits;                       /* `step` has begun; its first tick is still to come */
    bool hold;                        /* nothing has disturbed it since it began */
    uint32_t made_ticks;              /* ticks of it so far */
    rules_step_t step;
    uint16_t goal_pos[PAGE_JOINTS];   /* before the tick */
} step_rules_t;

/* Call these around each tick of a play. */
void step_rules_before(step_rules_t *rules, const player_t *player);
void step_rules_behind(step_rules_t *rules, const player_t *player, uint8_t events);

/* Call this at a pause or a break. The rules hold again from the next step on. */
static inline void step_rules_disturb(step_rules_t *rules)
{
    rules->hold = false;
}

#endif
