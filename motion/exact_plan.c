/* SPDX-License-Identifier: MIT
 * exact_plan.c - plans a step of the exact law: its length, and the speeds of each joint (names as in law_exact.c).
 *
 * A step goes one way only (a joint that turns round has way-point speed 0), so all planning is done on sizes, and the
 * direction (`down`) gives the sign at the end. A position carries its rounding with it: going up it starts half a unit
 * above the truth, going down a hair less, so that plain floor rounds to nearest, and mirrored motions mirror.
 *
 * Speeds between steps and in CRUISE are multiples of 2^-15.
 * Ranges: way 0..1023; mean speed m = way / N; w0, w1 <= m; v = m + (m - (w0 + w1) / 2) * A / (N - A) <= 2 m <= 2046. */
#include "exact_plan.h"
#include "fix.h"
#include "step_plan.h"

static uint32_t even(uint32_t speed)
{
    return speed & ~(uint32_t)1;
}

static uint16_t way_between(uint16_t from_pos, uint16_t to_pos)
{
    return to_pos > from_pos ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
}

/* --- lengths ------------------------------------------------------------------------------------------------------ */

/* 1 / A and A / (N - A) of a step of so many ticks. Returns A. */
static NOINLINE uint8_t measure_ramp(uint8_t accel_time, uint16_t ticks, uint16_t *recip, uint16_t *share_q0_16)
{
    uint8_t ramp_ticks = step_plan_exact_ramp(accel_time, ticks);
    if (ramp_ticks != 0) {
        *recip = fix_ramp_recip(ramp_ticks);
        *share_q0_16 = fix_ratio(ramp_ticks, (uint16_t)(ticks - ramp_ticks));
    }
    return ramp_ticks;
}

/* Length, pause and ramp of the coming step. */
void exact_measure(player_t *player)
{
    player_step_t *coming = &player->coming;
    player->measured = true;
    if (coming->page != 0) {
        sequence_measure(player);
        coming->ticks = step_plan_exact_ticks(coming, player->coming_way, &player->carry_q5_11);
        coming->hold_ticks = step_plan_exact_hold(coming, &player->carry_q5_11);
        coming->recip = fix_recip32(coming->ticks);
        (void)measure_ramp(coming->accel_time, coming->ticks, &coming->ramp_recip, &coming->ramp_share_q0_16);
    }
}

/* --- joints ------------------------------------------------------------------------------------------------------- */

/* Plans RISE and the speed of CRUISE of a joint at from_pos; exit is set already. mean, entry: sizes. */
static inline void plan_joint(const player_t *player, uint8_t ramp_ticks, player_exact_t *exact, uint16_t from_pos,
                              bool down, uint32_t mean, uint32_t entry)
{
    uint32_t cruise = mean, speed = entry, accel = 0; /* without a ramp begin_cruise sets the speed */
    if (ramp_ticks != 0) {
        uint32_t more = mean - ((entry + exact->exit_q16_16) >> 1);
        cruise = even(mean + (player->ramp_share_q0_16 == UINT16_MAX ? more : fix_share(more, player->ramp_share_q0_16)));
        accel = fix_by_ramp(cruise - entry, player->ramp_recip, ramp_ticks);
        speed = entry + (accel >> 1);
    }
    exact->cruise_q16_16 = cruise;
    int32_t pos = fix_from_pos(from_pos) + FIX_ROUND_UP;
    if (down) {
        pos += FIX_ROUND_DOWN - FIX_ROUND_UP;
        speed = 0 - speed;
        accel = 0 - accel;
    }
    exact->pos_q16_16 = pos;
    exact->speed_q16_16 = (int32_t)speed;
    exact->accel_q16_16 = (int32_t)accel;
}

/* Speed at at_pos, the end of a step in which a joint's mean speed is `mean`: the smaller of both steps' means, or 0 if it
 * turns round or stays. */
static inline uint32_t exit_speed(bool runs_on, bool down, uint16_t at_pos, uint16_t next_pos, uint32_t mean,
                                  uint32_t next_recip)
{
    if (mean == 0 || !runs_on || (down ? next_pos >= at_pos : next_pos <= at_pos)) {
        return 0;
    }
    uint32_t next_mean = even(fix_mean(way_between(at_pos, next_pos), next_recip));
    return mean < next_mean ? mean : next_mean;
}

/* Plans the next `most` joints of those that are not planned yet, with the speed that the step before leaves (exit): from
 * where they are to target_pos. ahead: a step that has not been taken, from target_pos to coming_pos. */
static NOINLINE void plan_joints(player_t *player, bool ahead, uint8_t most)
{
    uint8_t planned = player->planned;
    const uint8_t self = player->self;
    const bool is_of_one = !ahead && player->step_ticks == 1; /* no time for the multiplication in such a step */
    const uint32_t next_recip = player->looked && !ahead ? player->now.recip : player->coming.recip;
    const uint32_t recip = player->recip;
    const uint8_t ramp_ticks = player->ramp_ticks;
    const bool runs_on = player->runs_on;
    uint8_t left = most;
    for (player_joint_t *joint = &player->joint[planned]; planned < PAGE_JOINTS && left != 0; planned++, joint++) {
        if (!law_owns(self, joint)) {
            continue;
        }
        left--;
        player_exact_t *exact = &joint->exact;
        uint16_t from_pos = fix_pos(exact->pos_q16_16), to_pos = joint->target_pos, next_pos = player->coming_pos[planned];
        if (PLAYER_LAYERS && ahead) {
            from_pos = to_pos;
            to_pos = next_pos;
            next_pos = player->looked_at[planned];
            if (next_pos == PAGE_POS_UNUSED) {
                next_pos = to_pos;
            }
        }
        OPAQUE(from_pos); /* two bytes to keep, not the four they come from: 30 cycles a joint */
        uint32_t entry = exact->exit_q16_16;
        const uint16_t way = way_between(from_pos, to_pos);
        const uint32_t mean = even(!is_of_one ? fix_mean(way, recip) : way != 0 ? ((uint32_t)way << 16) - 1u : 0);
        bool down = to_pos < from_pos;
        joint->down = down;
        exact->exit_q16_16 = exit_speed(runs_on, down, to_pos, next_pos, mean, next_recip);
        if (!is_of_one) {
            plan_joint(player, ramp_ticks, exact, from_pos, down, mean, entry);
        }
    }
    player->planned = planned;
    law_work(player, (uint8_t)(LAW_WORK_PLAN_JOINT * (uint8_t)(most - left)));
}

/* --- from step to step -------------------------------------------------------------------------------------------- */

/* The joints of a step are planned in three ticks: in the last but one of the step before it, at whose end nothing but the
 * target of the running step is needed any more; in the last one; in the step's own first one. A step of one tick is planned
 * in its own: it goes straight to its target, and a break before it needs the speed with which the joints come. */

/* What planning `now` needs. */
static NOINLINE void prepare_plan(player_t *player)
{
    const player_step_t *now = &player->now;
    player->recip = now->recip;
    player->ramp_recip = now->ramp_recip;
    player->ramp_share_q0_16 = now->ramp_share_q0_16;
    player->accel_time = now->accel_time;
    player->ramp_ticks = step_plan_exact_ramp(now->accel_time, now->ticks);
    player->runs_on = player->coming.page != 0 && now->pause == 0;
}

void exact_plan_ahead(player_t *player)
{
    const uint8_t third = player->own_joints / 3u;
    const uint8_t work = player->work;
    const uint8_t room = (uint8_t)(work < LAW_WORK_AHEAD ? (LAW_WORK_AHEAD - work) / LAW_WORK_PLAN_JOINT : 0u);
    if (player->now.ticks > 1) {
        player->ahead = true;
        prepare_plan(player);
        plan_joints(player, true, third < room ? third : room);
    }
}

void exact_plan_given(player_t *player, uint8_t joint)
{
    const uint8_t planned = player->planned;
    if (player->ahead && joint < planned) {
        player->planned = joint;
        plan_joints(player, true, 1);
        player->planned = planned;
    }
}

/* How many of so many joints are planned in the last tick: half of those that are not planned ahead. More if the step that
 * follows is short: the next one is looked at soon. Few if one of the two ticks that are left is a whole step. */
static uint8_t planned_last(const player_t *player, uint8_t joints, uint16_t old_ticks)
{
    uint16_t short_ticks = 2;
    if (player->step_ticks == 1) {
        return 0;
    }
    if (old_ticks == 1) {
        return joints / 7u;
    }
    if (player->planned != 0) { /* a third */
        joints = (uint8_t)(joints - joints / 3u);
        short_ticks = 4;
    }
    return player->step_ticks <= short_ticks ? (uint8_t)(joints - joints / 3u) : (uint8_t)((joints + 1u) / 2u);
}

void exact_take(player_t *player)
{
    const uint16_t old_ticks = player->step_ticks;
    player->joints |= player->coming_joints;
    player->step_ticks = player->now.ticks;
    player->hold_ticks = player->now.hold_ticks;
    prepare_plan(player);
    const uint8_t joints = sequence_take(player);
    player->own_joints = joints;
    law_work(player, LAW_WORK_TAKE + joints / 2u);
    player->tick = 0;
    player->ahead = false;
    player->arrived = true;
    plan_joints(player, false, planned_last(player, joints, old_ticks));
}

void exact_plan_others(player_t *player)
{
    plan_joints(player, false, PAGE_JOINTS);
}

void exact_plan_rest(player_t *player)
{
    player->recip = fix_recip32(player->step_ticks);
    player->ramp_ticks =
        measure_ramp(player->accel_time, player->step_ticks, &player->ramp_recip, &player->ramp_share_q0_16);
    player->planned = 0;
    exact_plan_others(player);
    player->planned = 0;
}
