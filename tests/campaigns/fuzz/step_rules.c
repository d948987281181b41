/* SPDX-License-Identifier: MIT */
#include "step_rules.h"
#include "trap.h"

static int distance(int from, int to)
{
    return from < to ? to - from : from - to;
}

void step_rules_before(step_rules_t *rules, const player_t *player)
{
    player_goals(player, UINT32_MAX, rules->goal_pos);
    if ((player->begun_events & PLAYER_EV_STEP) == 0 || rules->waits) {
        return;
    }
    ASSERT(!rules->hold || rules->made_ticks == rules->step.ticks);
    rules->step.step_ticks = player->now.ticks;
    rules->step.ticks = (uint32_t)player->now.ticks + player->now.hold_ticks;
    player_goals(player, UINT32_MAX, rules->step.from_pos);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        rules->step.to_pos[joint] = player->joint[joint].target_pos;
    }
    rules->made_ticks = 0;
    rules->waits = true;
    rules->hold = player->brake_ticks == 0; /* otherwise a break or a pause begins with the step */
}

/* Rule 2: the speed stays below 2 |M| / N. One unit more is rounding. */
static void must_not_leap(const step_rules_t *rules, const player_t *player)
{
    const rules_step_t *step = &rules->step;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if ((player->present >> joint & 1u) != 0) {
            const int most = 2 * distance(step->from_pos[joint], step->to_pos[joint]) / step->step_ticks + 1;
            ASSERT(distance(rules->goal_pos[joint], player_goal(player, joint)) <= most);
        }
    }
}

void step_rules_behind(step_rules_t *rules, const player_t *player, uint8_t events)
{
    if (player->law != PLAYER_LAW_EXACT) {
        return;
    }
    rules->waits = rules->waits && (events & PLAYER_EV_STEP) == 0;
    rules->made_ticks++;
    if (rules->hold) {
        must_not_leap(rules, player);
        ASSERT((events & PLAYER_EV_ENDED) == 0 || rules->made_ticks == rules->step.ticks);
    }
}
