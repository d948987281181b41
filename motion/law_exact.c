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
 * Ranges: distance 0..1023; mean = distance / N; entry, exit <= mean;
 * cruise = mean + (mean - (entry + exit) / 2) A / (N - A) <= 2 mean <= 2046. entry, exit and cruise are multiples of
 * 2^-15. */
#include "law.h"
#include "step_plan.h"

#define BRAKE_TICKS_MIN 8u

static uint32_t even(uint32_t speed)
{
    return speed & ~(uint32_t)1;
}

static uint16_t distance_of(uint16_t from_pos, uint16_t to_pos)
{
    return to_pos > from_pos ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
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

static void set_pos(player_exact_t *exact, uint16_t pos, bool down)
{
    exact->pos_q16_16 = fix_from_pos(pos) + (down ? FIX_ROUND_DOWN : FIX_ROUND_UP);
}

void exact_stand(player_joint_t *joint, uint16_t pos)
{
    joint->exact = (player_exact_t){.pos_q16_16 = fix_from_pos(pos)};
}

/* --- plan --------------------------------------------------------------------------------------------------------- */

void exact_measure_next(player_t *player)
{
    player_step_t *next = &player->next;
    if (next->page == 0) {
        return;
    }
    const bool depends = next->schedule == PAGE_SCHEDULE_SPEED || next->top_speed_q4_4 != 0;
    uint16_t longest = 0;
    FOR_JOINTS(player, depends ? player->next_joints : 0, i, joint) {
        const uint16_t distance = distance_of(joint->target_pos, player->next_pos[i]);
        longest = distance > longest ? distance : longest;
    }
    next->ticks = step_plan_exact_ticks(next, longest, &player->carry_q5_11);
    next->hold_ticks = step_plan_exact_hold(next, &player->carry_q5_11);
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
    if (!plan->runs_on || (down ? next_pos >= at_pos : next_pos <= at_pos)) {
        return 0;
    }
    const uint32_t next_mean = even(fix_mean(distance_of(at_pos, next_pos), plan->next_recip));
    return mean < next_mean ? mean : next_mean;
}

static void plan_joint(const plan_t *plan, player_joint_t *joint, uint16_t next_pos)
{
    player_exact_t *exact = &joint->exact;
    const uint16_t from_pos = fix_pos(exact->pos_q16_16), to_pos = joint->target_pos;
    const bool down = to_pos < from_pos;
    const uint32_t mean = even(fix_mean(distance_of(from_pos, to_pos), plan->recip));
    const uint32_t entry = size_of(exact->exit_q16_16);
    const uint32_t exit = mean != 0 ? exit_speed(plan, down, to_pos, next_pos, mean) : 0;
    uint32_t cruise = mean, speed = entry, accel = 0;
    if (plan->ramp_ticks != 0) {
        const uint32_t missing = mean - ((entry + exit) >> 1);
        /* A share of 65535 stands for 1. */
        cruise = even(mean + (plan->share_q0_16 == UINT16_MAX ? missing : fix_share(missing, plan->share_q0_16)));
        accel = fix_by_ramp(cruise - entry, plan->ramp_recip, plan->ramp_ticks);
        speed = entry + (accel >> 1);
    }
    set_pos(exact, from_pos, down);
    exact->speed_q16_16 = with_sign_of(down, speed);
    exact->accel_q16_16 = with_sign_of(down, accel);
    exact->cruise_q16_16 = with_sign_of(down, cruise);
    exact->exit_q16_16 = with_sign_of(down, exit);
}

/* Plans step_ticks ticks for all joints, from where they are to target_pos; recip32 is 2^32 / step_ticks. The exit speed
 * that each has from the step before is its entry speed. */
static void plan_joints(player_t *player, uint32_t recip32)
{
    const uint16_t ticks = player->step_ticks;
    const uint8_t accel_time = player->now.accel_time;
    const bool runs_on = player->law == PLAYER_LAW_EXACT && player->next.page != 0 && player->now.pause == 0;
    plan_t plan = {.recip = recip32,
                   .next_recip = player->next.recip32,
                   .ramp_ticks = accel_time <= ticks / 2 ? accel_time : (uint8_t)(ticks / 2),
                   .runs_on = runs_on};
    if (plan.ramp_ticks != 0) {
        plan.ramp_recip = fix_ramp_recip(plan.ramp_ticks);
        plan.share_q0_16 = fix_ratio(plan.ramp_ticks, (uint16_t)(ticks - plan.ramp_ticks));
    }
    player->ramp_ticks = plan.ramp_ticks;
    player->tick = 0;
    FOR_JOINTS(player, player->present, i, joint) {
        plan_joint(&plan, joint, player->next_pos[i]);
    }
}

void exact_plan(player_t *player)
{
    player->step_ticks = player->now.ticks;
    player->hold_ticks = player->now.hold_ticks;
    plan_joints(player, player->now.recip32);
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

bool exact_is_over(const player_t *player)
{
    return player->tick >= player->step_ticks + player->hold_ticks;
}

/* By one tick, at the present speed and acceleration. */
static void move(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
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
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* rather too slow early than past the target */
    FOR_JOINTS(player, player->present, i, joint) {
        player_exact_t *exact = &joint->exact;
        const bool down = exact->cruise_q16_16 < 0;
        const uint32_t accel = fix_by_ramp(size_of(exact->cruise_q16_16 - exact->exit_q16_16), recip, player->ramp_ticks);
        exact->speed_q16_16 = exact->cruise_q16_16 - with_sign_of(down, accel >> 1);
        exact->accel_q16_16 = -with_sign_of(down, accel);
    }
}

void exact_plan_tick(player_t *player)
{
    const uint16_t done = player->tick, ramp = player->ramp_ticks;
    if (done + 1u >= player->step_ticks) {
        return; /* the tick that sets the target, or none */
    }
    if (done + ramp == player->step_ticks) {
        begin_fall(player);
    } else if (done == ramp) {
        begin_cruise(player);
    }
}

static void reach_target(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        joint->exact.pos_q16_16 = fix_from_pos(joint->target_pos);
    }
}

uint8_t exact_tick(player_t *player)
{
    const uint16_t tick = ++player->tick;
    if (tick > player->step_ticks) {
        return 0;
    }
    if (tick == player->step_ticks) {
        reach_target(player);
        return PLAYER_EV_OUTPUT;
    }
    move(player);
    return PLAYER_EV_OUTPUT;
}

/* --- break, pause, rest ------------------------------------------------------------------------------------------- */

void exact_stop_steps(player_t *player)
{
    const bool is_moving = player->tick < player->step_ticks;
    player->rest_ticks = is_moving ? (uint16_t)(player->step_ticks - player->tick) : 0;
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
    const uint16_t left = (uint16_t)(player->step_ticks - player->tick);
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

/* A joint that would leave its range stops at the end of it. */
static void keep_in_range(player_exact_t *exact)
{
    const int32_t pos = exact->pos_q16_16 + exact->speed_q16_16;
    if (pos < 0 || pos >= fix_from_pos(PAGE_POS_MAX + 1u)) {
        exact->speed_q16_16 = exact->accel_q16_16 = 0;
        exact->pos_q16_16 = pos < 0 ? 0 : fix_from_pos(PAGE_POS_MAX);
    }
}

bool exact_brake_tick(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        keep_in_range(&joint->exact);
    }
    move(player);
    return --player->brake_ticks != 0;
}

bool exact_plan_rest(player_t *player)
{
    const uint8_t braked = brake_ticks_of(player);
    if (player->rest_ticks == 0) {
        return false;
    }
    if (is_move(player)) {
        player->step_ticks = (uint16_t)(player->rest_ticks + braked); /* in less time it could exceed its speed limit */
    } else {
        player->step_ticks = player->rest_ticks < braked ? braked : player->rest_ticks;
    }
    plan_joints(player, fix_recip32(player->step_ticks));
    return true;
}
