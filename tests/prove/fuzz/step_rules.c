/* SPDX-License-Identifier: MIT */
#include "step_rules.h"
#include "trap.h"

#include <string.h>

static int distance(int from, int to)
{
    return from < to ? to - from : from - to;
}

static uint32_t own_joints(const player_t *player)
{
    uint32_t joints = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const player_joint_t *of_joint = &player->joint[joint];
        joints |= (uint32_t)(of_joint->owner == player->self && of_joint->hand_over == 0) << joint;
    }
    return joints;
}

void step_rules_before(step_rules_t *rules, const player_t *player)
{
    rules->own_joints = own_joints(player);
    memcpy(rules->goal_pos, player->goal_pos, sizeof rules->goal_pos);
    if (player->arrived) { /* a step begins with this tick, at whose end another one may be planned */
        rules_step_t *next = &rules->next;
        next->step_ticks = player->step_ticks;
        next->ticks = (uint32_t)player->step_ticks + player->hold_ticks;
        memcpy(next->from_pos, player->goal_pos, sizeof next->from_pos);
        for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
            next->to_pos[joint] = player->joint[joint].target_pos;
        }
    }
}

/* Rule 2: the speed stays below 2 |M| / N. A unit more is the rounding. */
static void must_not_leap(const step_rules_t *rules, const player_t *player)
{
    const rules_step_t *step = &rules->step;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if ((rules->joints >> joint & 1u) == 0) {
            continue;
        }
        const int most = 2 * distance(step->from_pos[joint], step->to_pos[joint]) / step->step_ticks + 1;
        ASSERT(distance(rules->goal_pos[joint], player->goal_pos[joint]) <= most);
    }
}

void step_rules_behind(step_rules_t *rules, const player_t *player, uint8_t events)
{
    if (player->law != PLAYER_LAW_EXACT) {
        return;
    }
    if ((events & PLAYER_EV_STEP) != 0) {
        ASSERT(!rules->hold || rules->made_ticks == rules->step.ticks);
        rules->step = rules->next;
        rules->made_ticks = 0;
        rules->joints = rules->own_joints;
        rules->hold = true;
    }
    rules->joints &= own_joints(player);
    rules->made_ticks++;
    if (rules->hold) {
        must_not_leap(rules, player);
        ASSERT((events & PLAYER_EV_ENDED) == 0 || rules->made_ticks == rules->step.ticks);
    }
}
