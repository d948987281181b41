/* SPDX-License-Identifier: MIT
 * classic_plan.c - plans a step of the original's law: through or stop, its ticks, the speed v of each joint (player.md
 * section 1, "A step begins", rules 3 to 7; names M, N, A, P, K, v, w as there). */
#include "classic_math.h"
#include "classic_plan.h"
#include "step_plan.h"

int16_t classic_speed_left(const player_t *player, const player_classic_t *classic)
{
    if (player->section == SECTION_HOLD) {
        return 0;
    }
    if (player->step_ticks == 0) {
        return classic->carried;
    }
    return player->ramp_ticks == 0 || classic->through ? classic->speed : 0;
}

/* Whether the joint keeps its speed at the end of the step. next_word: its next position word; PAGE_POS_UNUSED: it stays. */
static bool runs_on(int16_t from, int16_t to, uint16_t next_word)
{
    int16_t next = (int16_t)next_word;
    return next_word != PAGE_POS_UNUSED && ((from < to && to < next) || (from > to && to > next));
}

/* Sets start and way of each joint. A joint starts on its last target; after a pause, and in the first step, where it is. A
 * joint that the step does not use keeps its place and target. */
static NOINLINE void aim_joints(player_t *player, bool may_run_on)
{
    uint32_t used = player->coming_joints;
    const uint16_t *coming = player->coming_pos, *next = player->looked_at;
    const uint8_t self = player->self;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++, coming++, next++, used >>= 1) {
        if (!law_owns(self, joint)) {
            continue;
        }
        player_classic_t *classic = &joint->classic;
        int16_t from = player->section == SECTION_HOLD ? classic->out_pos : (int16_t)joint->target_pos, to = from;
        int16_t carried = 0;
        if (((uint8_t)used & 1u) != 0) {
            to = (int16_t)*coming;
            carried = classic_speed_left(player, classic);
        }
        classic->carried = carried;
        classic->through = may_run_on && runs_on(from, to, *next);
        classic->start_pos = from;
        classic->to_go = (int16_t)(to - from);
    }
}

/* Of the joints that aim_joints has aimed. */
static NOINLINE uint16_t longest_way(const player_t *player)
{
    uint16_t longest = 0;
    FOR_OWN_JOINTS(player, joint) {
        uint16_t way = fix_size(joint->classic.to_go);
        longest = way > longest ? way : longest;
    }
    return longest;
}

typedef struct {
    uint16_t stop, through; /* 4 (N - A), 4 N - 2 A */
    uint16_t twice_ramp;    /* 2 A */
} divisors_t;

/* v = (K - w * 2A) / divisor. */
static int16_t plan_speed(const player_classic_t *classic, const divisors_t *by)
{
    bool down = classic->to_go < 0;
    uint32_t size = way_in_speed_units(fix_size(classic->to_go));
    if (classic->carried != 0) {
        uint32_t taken = mul_u16_u16(fix_size(classic->carried), by->twice_ramp);
        size = (classic->carried < 0) == down ? size - taken : size + taken;
        if ((int32_t)size < 0) {
            size = 0 - size;
            down = !down;
        }
    }
    int16_t speed = divide_speed(size, classic->through ? by->through : by->stop);
    return down ? (int16_t)-speed : speed;
}

/* v of a skipped step: the divisor is 1, and int16(K) may be any number. It matters if the play ends after this step. */
static int16_t skipped_speed(const player_classic_t *classic)
{
    uint16_t size = (uint16_t)way_in_speed_units(fix_size(classic->to_go));
    int16_t speed = classic->to_go < 0 ? (int16_t)(0u - size) : (int16_t)size;
    return speed > CLASSIC_SPEED_MAX ? CLASSIC_SPEED_MAX : speed < -CLASSIC_SPEED_MAX ? -CLASSIC_SPEED_MAX : speed;
}

void classic_plan_joints(player_t *player, uint8_t first, uint8_t end)
{
    uint16_t ticks = player->step_ticks;
    uint8_t ramp = player->ramp_ticks;
    divisors_t by = {(uint16_t)(4 * (ticks - ramp)), (uint16_t)(4 * ticks - 2 * ramp), (uint16_t)(2 * ramp)};
    const player_joint_t *const behind = &player->joint[end];
    const uint8_t self = player->self;
    for (player_joint_t *joint = &player->joint[first]; joint < behind; joint++) {
        if (law_owns(self, joint)) {
            player_classic_t *classic = &joint->classic;
            classic->speed = ticks != 0 ? plan_speed(classic, &by) : skipped_speed(classic);
        }
    }
    player->planned = end;
}

/* Joints that are planned in the tick before their step begins. */
#define PLANNED_AHEAD 5u

void classic_take(player_t *player)
{
    bool from_output = player->section == SECTION_HOLD;
    player->joints |= player->coming_joints;
    uint16_t hold_ticks = step_plan_classic_hold(&player->now, &player->carry_q5_11);
    aim_joints(player, player->look_page != 0 && hold_ticks == 0);
    uint16_t way = player->coming_way; /* from targets: also of joints that are lent */
    if (from_output) {
        way = longest_way(player);
        way = way < player->lent_way ? player->lent_way : way;
    }
    player->hold_ticks = hold_ticks;
    player->step_ticks = step_plan_classic_ticks(&player->now, way, &player->carry_q5_11);
    player->ramp_ticks = step_plan_classic_ramp(player->now.accel_time, &player->step_ticks);
    sequence_take(player);
    player->arrived = true;
    classic_plan_joints(player, 0, PLANNED_AHEAD);
}
