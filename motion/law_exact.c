/* SPDX-License-Identifier: MIT
 * law_exact.c - the law that robots run (LAWS.md, "The exact law"): plans a step, moves its joints, slows them down.
 *
 *   speed        cruise                  RISE    ticks 1 .. A          speed grows by (cruise - entry) / A a tick
 *               ________                 CRUISE  ticks A+1 .. N-A      speed = cruise
 *              /        \                FALL    ticks N-A+1 .. N      speed falls by (cruise - exit) / A a tick
 *  entry -----/          \----- exit     pause   P ticks without goals
 *
 * speed_q16_16 is what the coming tick adds to the position. In a ramp it therefore differs by half an acceleration from the
 * speed at the border of two ticks: entry + a/2, entry + 3a/2, ...; A of these add up to exactly (entry + cruise) A / 2.
 * Tick N is not computed: it sets the target.
 *
 * A joint keeps its direction during a step (one that turns round has exit 0), so a step is planned with sizes, and the
 * direction gives the sign at the end. A position carries its rounding: upward it starts half a unit high, downward a hair
 * less, so that dropping the fraction rounds to the nearest and mirrored motions give mirrored goals.
 *
 * Ranges: distance 0..1323; mean = distance / N; entry, exit <= mean;
 * cruise = mean + (mean - (entry + exit) / 2) A / (N - A) <= 2 mean <= 2646. entry, exit and cruise are multiples of
 * 2^-15. */
#include "law.h"
#include "step_ticks.h"

#define BRAKE_TICKS_MIN 8u

/* Rounds down to a multiple of 2^-15, so that half the sum of two speeds is exact. */
static uint32_t even(uint32_t speed)
{
    return speed & ~(uint32_t)1;
}

static uint32_t size_of(int32_t value)
{
    return (uint32_t)(value < 0 ? -value : value);
}

static int32_t with_sign_of(bool down, uint32_t size)
{
    return down ? -(int32_t)size : (int32_t)size;
}

/* Half, toward zero. */
static int32_t half_of(int32_t value)
{
    return with_sign_of(value < 0, size_of(value) >> 1);
}

void exact_start(player_t *player)
{
    player->tick = player->now.ticks = player->now.hold_ticks = 0;
    FOR_ALL_JOINTS(player, joint) {
        joint->exact = (player_exact_t){.pos_q16_16 = fix_from_pos(joint->target_pos)};
    }
}

void exact_measure_next(player_t *player)
{
    player_step_t *next = &player->next;
    if (next->page == 0) {
        return;
    }
    const bool depends_on_distance = next->schedule == PAGE_SCHEDULE_SPEED || next->top_speed_q4_4 != 0;
    uint16_t longest = 0;
    FOR_JOINTS(player, depends_on_distance ? next->joints : 0, i, joint) {
        const uint16_t distance = fix_distance(joint->target_pos, player->next_pos[i]);
        longest = distance > longest ? distance : longest;
    }
    next->ticks = step_ticks_exact(next, longest, &player->carry_q5_11);
    next->hold_ticks = step_ticks_exact_hold(next, &player->carry_q5_11);
    next->recip32 = fix_recip32(next->ticks);
}

/* What planning a joint needs to know of the step. */
typedef struct {
    uint32_t recip, next_recip;      /* 2^32 / N, of this step and of the next */
    uint16_t ramp_recip, share_q0_16; /* 1 / A; A / (N - A) */
    uint8_t ramp_ticks;
    bool runs_on;                    /* a joint may keep its speed at the end */
} plan_t;

/* Speed at the end of the step at at_pos: the smaller mean speed of the two steps, or 0 if the joint stops there. */
static uint32_t exit_speed(const plan_t *plan, bool down, uint16_t at_pos, uint16_t next_pos, uint32_t mean)
{
    if (!plan->runs_on || !(down ? fix_is_below(next_pos, at_pos) : fix_is_below(at_pos, next_pos))) {
        return 0;
    }
    const uint32_t next_mean = even(fix_mean(fix_distance(at_pos, next_pos), plan->next_recip));
    return mean < next_mean ? mean : next_mean;
}

static void plan_joint(const plan_t *plan, player_joint_t *joint, uint16_t next_pos)
{
    player_exact_t *exact = &joint->exact;
    const uint16_t from_pos = fix_pos(exact->pos_q16_16), to_pos = joint->target_pos;
    const bool down = fix_is_below(to_pos, from_pos);
    const uint32_t mean = even(fix_mean(fix_distance(from_pos, to_pos), plan->recip));
    const uint32_t entry = size_of(exact->exit_q16_16);
    const uint32_t exit = mean != 0 ? exit_speed(plan, down, to_pos, next_pos, mean) : 0;
    uint32_t cruise = mean, speed = entry, accel = 0;
    if (plan->ramp_ticks != 0) {
        const uint32_t missing = mean - ((entry + exit) >> 1);
        /* A share of 65535 means 1. */
        cruise = even(mean + (plan->share_q0_16 == UINT16_MAX ? missing : fix_share(missing, plan->share_q0_16)));
        accel = fix_by_ramp(cruise - entry, plan->ramp_recip, plan->ramp_ticks);
        speed = entry + (accel >> 1);
    }
    exact->pos_q16_16 = fix_from_pos(from_pos) + (down ? FIX_ROUND_DOWN : FIX_ROUND_UP);
    exact->speed_q16_16 = with_sign_of(down, speed);
    exact->accel_q16_16 = with_sign_of(down, accel);
    exact->cruise_q16_16 = with_sign_of(down, cruise);
    exact->exit_q16_16 = with_sign_of(down, exit);
}

/* The exit speed that a joint has from the step before is its entry speed. */
void exact_plan(player_t *player)
{
    const player_step_t *now = &player->now;
    const uint16_t half = now->ticks / 2;
    plan_t plan = {.recip = now->recip32,
                   .next_recip = player->next.recip32,
                   .ramp_ticks = now->accel_time <= half ? now->accel_time : (uint8_t)half,
                   .runs_on = player->law == PLAYER_LAW_EXACT && player->next.page != 0 && now->pause == 0};
    if (plan.ramp_ticks != 0) {
        plan.ramp_recip = fix_ramp_recip(plan.ramp_ticks);
        plan.share_q0_16 = fix_ratio(plan.ramp_ticks, (uint16_t)(now->ticks - plan.ramp_ticks));
    }
    player->ramp_ticks = plan.ramp_ticks;
    player->tick = 0;
    FOR_JOINTS(player, player->present, i, joint) {
        plan_joint(&plan, joint, player->next_pos[i]);
    }
}

bool exact_is_over(const player_t *player)
{
    return player->tick >= player->now.ticks + player->now.hold_ticks;
}

static void move_joints(player_t *player)
{
    FOR_JOINTS(player, player->present, i, joint) { /* one that was dropped keeps an acceleration, which would add up */
        joint->exact.pos_q16_16 += joint->exact.speed_q16_16;
        joint->exact.speed_q16_16 += joint->exact.accel_q16_16;
    }
}

static void begin_cruise(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        joint->exact.speed_q16_16 = joint->exact.cruise_q16_16;
        joint->exact.accel_q16_16 = 0;
    }
}

static void begin_fall(player_t *player)
{
    uint16_t recip = fix_ramp_recip(player->ramp_ticks);
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* slow down a hair too early, not past the target */
    FOR_JOINTS(player, player->present, i, joint) {
        player_exact_t *exact = &joint->exact;
        const bool down = exact->cruise_q16_16 < 0;
        const uint32_t accel = fix_by_ramp(size_of(exact->cruise_q16_16 - exact->exit_q16_16), recip, player->ramp_ticks);
        exact->speed_q16_16 = exact->cruise_q16_16 - with_sign_of(down, accel >> 1);
        exact->accel_q16_16 = -with_sign_of(down, accel);
    }
}

void exact_begin_section(player_t *player)
{
    const uint16_t done = player->tick, ramp = player->ramp_ticks;
    if (done + 1u >= player->now.ticks) {
        return; /* the tick that sets the target, or none */
    }
    if (done + ramp == player->now.ticks) {
        begin_fall(player);
    } else if (done == ramp) {
        begin_cruise(player);
    }
}

uint8_t exact_tick(player_t *player)
{
    const uint16_t tick = ++player->tick;
    if (tick > player->now.ticks) {
        return 0;
    }
    if (tick < player->now.ticks) {
        move_joints(player);
        return PLAYER_EV_OUTPUT;
    }
    FOR_ALL_JOINTS(player, joint) {
        joint->exact.pos_q16_16 = fix_from_pos(joint->target_pos);
    }
    return PLAYER_EV_OUTPUT;
}

void exact_leave_step(player_t *player)
{
    const bool is_moving = player->tick < player->now.ticks;
    player->left_ticks = is_moving ? (uint16_t)(player->now.ticks - player->tick) : 0;
    FOR_ALL_JOINTS(player, joint) {
        player_exact_t *exact = &joint->exact;
        /* At the border of two ticks the speed is half an acceleration smaller than in the coming tick. */
        exact->speed_q16_16 = is_moving ? exact->speed_q16_16 - half_of(exact->accel_q16_16) : 0;
        exact->exit_q16_16 = 0;
    }
}

static bool is_move(const player_t *player)
{
    return player->now.page == 0;
}

/* A move takes no longer than its own ramp would, so that no joint goes past its target. */
static uint8_t brake_ticks_of(const player_t *player)
{
    const uint8_t ramp = player->ramp_ticks;
    const uint16_t left = (uint16_t)(player->now.ticks - player->tick);
    if (is_move(player)) {
        return left < ramp ? (uint8_t)left : ramp;
    }
    return ramp < BRAKE_TICKS_MIN ? BRAKE_TICKS_MIN : ramp;
}

void exact_brake(player_t *player)
{
    const uint8_t ticks = brake_ticks_of(player);
    const uint16_t recip = fix_ramp_recip(ticks);
    player->brake_ticks = ticks;
    FOR_ALL_JOINTS(player, joint) {
        const int32_t speed = joint->exact.speed_q16_16;
        const int32_t accel = -with_sign_of(speed < 0, fix_by_ramp(size_of(speed), recip, ticks));
        joint->exact.accel_q16_16 = accel;
        joint->exact.speed_q16_16 = speed + half_of(accel);
    }
}

static bool is_outside(int32_t pos_q16_16)
{
    return fix_pos(pos_q16_16) > PAGE_POS_MAX;   /* also below 0 */
}

/* A joint that would leave its range stops at the end of it. One that started outside goes on inward. */
static void keep_in_range(player_exact_t *exact)
{
    const int32_t pos = exact->pos_q16_16 + exact->speed_q16_16;
    if (is_outside(pos) && !is_outside(exact->pos_q16_16)) {
        exact->speed_q16_16 = exact->accel_q16_16 = 0;
        exact->pos_q16_16 = pos < 0 ? 0 : fix_from_pos(PAGE_POS_MAX);
    }
}

bool exact_brake_tick(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        keep_in_range(&joint->exact);
    }
    move_joints(player);
    return --player->brake_ticks != 0;
}

bool exact_resume(player_t *player)
{
    const uint8_t braked = brake_ticks_of(player);
    uint16_t ticks = player->left_ticks;
    if (ticks == 0) {
        return false;
    }
    if (is_move(player)) {
        ticks = (uint16_t)(ticks + braked); /* in less time it could exceed its speed limit */
    } else if (ticks < braked) {
        ticks = braked;
    }
    player->now.ticks = ticks;
    player->now.recip32 = fix_recip32(ticks);
    exact_plan(player);
    return true;
}
