/* SPDX-License-Identifier: MIT
 * classic_plan.c - plans a step of the original's law: through or stop, its ticks, the speed v of each joint (player.md
 * section 1, "A step begins", rules 3 to 7; names M, N, A, P, K, v, w as there). */
#include "classic_math.h"
#include "classic_plan.h"
#include "step_plan.h"

/* In LAW_WORK_ units. AIM: of aim_joints if a layer has the other joints; alone, the tick has time for more. PLAN: of
 * classic_plan_joints, besides one a joint. */
#define AIM_WORK 10u
#define PLAN_WORK 4u

/* Whether a joint that goes `way` keeps its speed at the end of the step. next_word: its next position word;
 * PAGE_POS_UNUSED: it stays. */
static inline bool runs_on(int16_t way, int16_t to, uint16_t next_word)
{
    if (way == 0 || next_word == PAGE_POS_UNUSED) {
        return false;
    }
    return way > 0 ? (int16_t)next_word > to : (int16_t)next_word < to;
}

/* Sets the way of each joint in `now`, and the speed with which it begins. A joint starts on its last target; after a pause,
 * and in the first step, where it is. A joint that the step does not use stays. */
static NOINLINE void aim_joints(player_t *player)
{
    uint32_t used = player->coming_joints;
    const uint8_t self = player->self;
    const classic_left_t left = classic_left(player);
    const bool from_output = player->section == SECTION_HOLD;
    const bool may_run_on = player->look_page != 0 && player->now.hold_ticks == 0;
    player_joint_t *joint = player->joint;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, joint++, used >>= 1) {
        if (!law_owns(self, joint)) {
            continue;
        }
        player_classic_t *classic = &joint->classic;
        const int16_t to_pos = (int16_t)player->coming_pos[i];
        int16_t way = 0, carried = 0;
        if (((uint8_t)used & 1u) != 0) {
            way = (int16_t)(to_pos - (from_output ? classic->out_pos : (int16_t)joint->target_pos));
            carried = classic_speed_left(left, classic);
        }
        classic->carried = carried;
        classic->next_through = may_run_on && runs_on(way, to_pos, player->looked_at[i]);
        classic->next_to_go = way;
    }
    player->aimed = true;
    player->planned = 0;
    law_work(player, player->own_joints / 2u + 2u);
}

/* The joints begin to go as they are aimed. */
static NOINLINE void start_joints(player_t *player)
{
    const bool from_output = player->section == SECTION_HOLD;
    FOR_OWN_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->start_pos = from_output ? classic->out_pos : (int16_t)joint->target_pos;
        classic->to_go = classic->next_to_go;
        classic->through = classic->next_through;
    }
}

/* Of the joints that aim_joints has aimed. */
static NOINLINE uint16_t longest_way(const player_t *player)
{
    uint16_t longest = 0;
    FOR_OWN_JOINTS(player, joint) {
        uint16_t way = fix_size(joint->classic.next_to_go);
        longest = way > longest ? way : longest;
    }
    return longest;
}

typedef struct {
    uint16_t stop, through; /* 4 (N - A), 4 N - 2 A */
    uint16_t twice_ramp;    /* 2 A */
} divisors_t;

/* v = (K - w * 2A) / divisor. size: of K. */
static int16_t plan_speed(const player_classic_t *classic, uint32_t size, const divisors_t *by)
{
    bool down = classic->next_to_go < 0;
    if (classic->carried != 0) {
        uint32_t taken = mul_u16_u16(fix_size(classic->carried), by->twice_ramp);
        size = (classic->carried < 0) == down ? size - taken : size + taken;
        if ((int32_t)size < 0) {
            size = 0 - size;
            down = !down;
        }
    }
    int16_t speed = divide_speed(size, classic->next_through ? by->through : by->stop);
    return down ? (int16_t)-speed : speed;
}

/* v of a skipped step: the divisor is 1, and int16(K) may be any number. It matters if the play ends after this step. */
static int16_t skipped_speed(const player_classic_t *classic, uint16_t size)
{
    int16_t speed = classic->next_to_go < 0 ? (int16_t)(0u - size) : (int16_t)size;
    return speed > CLASSIC_SPEED_MAX ? CLASSIC_SPEED_MAX : speed < -CLASSIC_SPEED_MAX ? -CLASSIC_SPEED_MAX : speed;
}

void classic_plan_joints(player_t *player, uint8_t most)
{
    uint16_t ticks = player->now.ticks;
    const uint8_t ramp = step_plan_classic_ramp(player->now.accel_time, &ticks);
    divisors_t by = {(uint16_t)(4 * (ticks - ramp)), (uint16_t)(4 * ticks - 2 * ramp), (uint16_t)(2 * ramp)};
    uint8_t planned = player->planned;
    const uint8_t self = player->self;
    for (player_joint_t *joint = &player->joint[planned]; planned < PAGE_JOINTS && most != 0; planned++, joint++) {
        if (law_owns(self, joint)) {
            most--;
            law_work(player, 1u);
            player_classic_t *classic = &joint->classic;
            const uint32_t size = way_in_speed_units(fix_size(classic->next_to_go));
            classic->next_speed = ticks != 0 ? plan_speed(classic, size, &by) : skipped_speed(classic, (uint16_t)size);
        }
    }
    player->planned = planned;
}

/* How many joints the tick has time to plan. */
static uint8_t room_to_plan(const player_t *player)
{
    const uint8_t work = player->work;
    return work < LAW_WORK_MOST - PLAN_WORK ? (uint8_t)((LAW_WORK_MOST - PLAN_WORK - work) * 3u / 4u) : 0;
}

void classic_plan_ahead(player_t *player)
{
    if (!player->aimed && player->work + AIM_WORK <= LAW_WORK_MOST) {
        aim_joints(player);
    }
    if (player->aimed) {
        classic_plan_joints(player, room_to_plan(player));
    }
}

void classic_measure(player_t *player)
{
    player_step_t *now = &player->now;
    if (player->section == SECTION_HOLD || player->hold_ticks != 0 || sequence_looks_elsewhere(player)) {
        return;
    }
    now->hold_ticks = step_plan_classic_hold(now, &player->carry_q5_11);
    now->ticks = step_plan_classic_ticks(now, player->coming_way, &player->carry_q5_11);
    sequence_measure(player);
    player->measured = true;
}

/* How many of so many joints are planned in the last tick, if none is planned ahead: the tick that begins the step has no
 * time for all of them. A layer beside the play has half of them. */
static uint8_t planned_last(const player_t *player, uint8_t joints)
{
    if (player->work < LAW_WORK_MOST) {
        return joints / 3u;
    }
    return joints > PAGE_JOINTS / 2u + 1u ? joints / 6u : 0;
}

void classic_take(player_t *player)
{
    player_step_t *now = &player->now;
    bool from_output = player->section == SECTION_HOLD;
    player->joints |= player->coming_joints;
    if (!player->measured) {
        now->hold_ticks = step_plan_classic_hold(now, &player->carry_q5_11);
    }
    if (!player->aimed) {
        aim_joints(player);
    }
    if (!player->measured) {
        uint16_t way = player->coming_way; /* from targets: also of joints that are lent */
        if (from_output) {
            way = longest_way(player);
            way = way < player->lent_way ? player->lent_way : way;
        }
        now->ticks = step_plan_classic_ticks(now, way, &player->carry_q5_11);
        sequence_measure(player);
    }
    player->accel_time = now->accel_time;
    player->hold_ticks = now->hold_ticks;
    player->step_ticks = now->ticks;
    player->ramp_ticks = step_plan_classic_ramp(now->accel_time, &player->step_ticks);
    start_joints(player);
    const uint8_t joints = sequence_take(player);
    player->own_joints = joints;
    law_work(player, LAW_WORK_TAKE + joints / 4u);
    player->arrived = true;
    player->aimed = false;
    if (player->planned == 0) {
        classic_plan_joints(player, planned_last(player, joints));
    }
}
