/* SPDX-License-Identifier: MIT
 * law_exact.c - the law that robots run (player.md section 2).
 *
 *   speed         cruise                         RISE    ticks 1 .. A            speed += accel,  accel =  (v - w0) / A
 *                ________                        CRUISE  ticks A+1 .. N-A        speed = v
 *               /        \                       FALL    ticks N-A+1 .. N        speed += accel,  accel = -(v - w1) / A
 *   w0 --------/          \------- w1 (exit)     HOLD    then hold_ticks, nothing is made
 *
 * `speed` is the way of the coming tick, so it begins half an acceleration beside the speed at the section's border:
 * w0 + a/2, w0 + 3a/2, ...: the sum over A ticks is exactly (w0 + v) A / 2. Tick N is not computed but set: the target.
 * A step goes one way only (a joint that turns round has way-point speed 0), so all planning is done on sizes, and the
 * direction (`down`) gives the sign at the end. A position carries its rounding with it: going up it starts half a unit
 * above the truth, going down a hair less, so that plain floor rounds to nearest, and mirrored motions mirror.
 *
 * Speeds between steps and in CRUISE are multiples of 2^-15.
 * Ranges: way 0..1023; mean speed m = way / N; w0, w1 <= m; v = m + (m - (w0 + w1) / 2) * A / (N - A) <= 2 m <= 2046. */
#include "fix.h"
#include "law.h"
#include "step_plan.h"

static uint32_t even(uint32_t speed)
{
    return speed & ~(uint32_t)1;
}

static uint16_t way_between(uint16_t from_pos, uint16_t to_pos)
{
    return to_pos > from_pos ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

void exact_move(player_t *player)
{
    FOR_OWN_GOALS(player, joint, goal) {
        int32_t pos = joint->exact.pos_q16_16 + joint->exact.speed_q16_16;
        joint->exact.pos_q16_16 = pos;
        joint->exact.speed_q16_16 += joint->exact.accel_q16_16;
        *goal = fix_pos(pos);
    }
}

/* One tick in CRUISE, where no speed changes. */
static void move_steadily(player_t *player)
{
    FOR_OWN_GOALS(player, joint, goal) {
        int32_t pos = joint->exact.pos_q16_16 + joint->exact.speed_q16_16;
        joint->exact.pos_q16_16 = pos;
        *goal = fix_pos(pos);
    }
}

static void land(player_t *player)
{
    FOR_OWN_GOALS(player, joint, goal) {
        joint->exact.pos_q16_16 = fix_from_pos(joint->target_pos);
        *goal = joint->target_pos;
    }
}

/* --- planning ----------------------------------------------------------------------------------------------------- */

/* Plans RISE and the speed of CRUISE of a joint at from_pos; exit and down are set already. mean, entry: sizes. */
static inline void plan_joint(const player_t *player, player_exact_t *exact, uint16_t from_pos, uint32_t mean,
                              uint32_t entry)
{
    uint32_t cruise = mean, speed = mean, accel = 0;
    uint8_t ramp_ticks = player->ramp_ticks;
    if (ramp_ticks != 0) {
        uint32_t more = mean - ((entry + exact->exit_q16_16) >> 1);
        cruise = even(mean + (player->ramp_share_q0_16 == UINT16_MAX ? more : fix_share(more, player->ramp_share_q0_16)));
        accel = fix_by_ramp(cruise - entry, player->ramp_recip, ramp_ticks);
        speed = entry + (accel >> 1);
    }
    exact->cruise_q16_16 = cruise;
    int32_t pos = fix_from_pos(from_pos) + FIX_ROUND_UP;
    if (exact->down) {
        pos += FIX_ROUND_DOWN - FIX_ROUND_UP;
        speed = 0 - speed;
        accel = 0 - accel;
    }
    exact->pos_q16_16 = pos;
    exact->speed_q16_16 = (int32_t)speed;
    exact->accel_q16_16 = (int32_t)accel;
}

/* Ramp of the step, and its A / (N - A). */
static void set_ramp(player_t *player)
{
    uint16_t ticks = player->step_ticks;
    uint8_t ramp_ticks = step_plan_exact_ramp(player->now.accel_time, ticks);
    player->ramp_ticks = ramp_ticks;
    if (ramp_ticks != 0) {
        player->ramp_recip = fix_ramp_recip(ramp_ticks);
        player->ramp_share_q0_16 = fix_ratio(ramp_ticks, (uint16_t)(ticks - ramp_ticks));
    }
}

/* Speed at target_pos of a joint whose mean speed in this step is `mean`: the smaller of both steps' means, or 0 if it turns
 * round or stays. */
static inline uint32_t exit_speed(const player_t *player, const player_joint_t *joint, uint16_t next_pos, uint32_t mean)
{
    uint16_t at_pos = joint->target_pos;
    if (mean == 0 || !player->runs_on || (joint->exact.down ? next_pos >= at_pos : next_pos <= at_pos)) {
        return 0;
    }
    uint32_t next_mean = even(fix_mean(way_between(at_pos, next_pos), player->coming_recip));
    return mean < next_mean ? mean : next_mean;
}

/* Plans `now`, from where the joints are and with the speed that the step before leaves (exit), to target_pos in step_ticks,
 * for joints first to end - 1. */
static NOINLINE void plan_joints(player_t *player, uint8_t first, uint8_t end)
{
    const uint16_t *coming = &player->coming_pos[first];
    const player_joint_t *const behind = &player->joint[end];
    const uint8_t self = player->self;
    for (player_joint_t *joint = &player->joint[first]; joint < behind; joint++, coming++) {
        if (!law_owns(self, joint)) {
            continue;
        }
        player_exact_t *exact = &joint->exact;
        uint16_t from_pos = fix_pos(exact->pos_q16_16), to_pos = joint->target_pos;
        OPAQUE(from_pos); /* two bytes to keep, not the four they come from: 30 cycles a joint */
        uint32_t entry = exact->exit_q16_16;
        uint32_t mean = even(fix_mean(way_between(from_pos, to_pos), player->step_recip));
        exact->down = to_pos < from_pos;
        exact->exit_q16_16 = exit_speed(player, joint, *coming, mean);
        if (player->step_ticks != 1) { /* such a step goes straight to its target */
            plan_joint(player, exact, from_pos, mean, entry);
        }
    }
    player->planned = end;
}

/* Length of the coming step. */
static void measure_coming(player_t *player)
{
    player->coming_ticks = step_plan_exact_ticks(&player->coming, player->coming_way, &player->carry_q5_11);
    player->coming_recip = fix_recip32(player->coming_ticks);
}

static NOINLINE void begin_cruise(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        int32_t speed = (int32_t)joint->exact.cruise_q16_16;
        joint->exact.speed_q16_16 = joint->exact.down ? -speed : speed;
    }
}

static NOINLINE void begin_fall(player_t *player)
{
    uint16_t recip = player->ramp_recip;
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* rather slow early than go past the target */
    FOR_OWN_JOINTS(player, joint) {
        uint32_t cruise = joint->exact.cruise_q16_16;
        int32_t accel = (int32_t)fix_by_ramp(cruise - joint->exact.exit_q16_16, recip, player->ramp_ticks);
        int32_t speed = (int32_t)cruise - (accel >> 1);
        joint->exact.speed_q16_16 = joint->exact.down ? -speed : speed;
        joint->exact.accel_q16_16 = joint->exact.down ? accel : -accel;
    }
}

/* --- from step to step -------------------------------------------------------------------------------------------- */

/* Joints that are planned in the tick before their step begins. Fewer if that tick is itself a whole step. */
#define PLANNED_AHEAD 13u
#define PLANNED_AHEAD_OF_ONE 5u

/* Takes the coming step: the joints are on target_pos, and it begins with the next tick. */
static NOINLINE void take(player_t *player)
{
    player->joints |= player->coming_joints;
    uint8_t planned_ahead = player->step_ticks == 1 ? PLANNED_AHEAD_OF_ONE : PLANNED_AHEAD;
    player->step_ticks = player->coming_ticks;
    player->step_recip = player->coming_recip;
    player->hold_ticks = step_plan_exact_hold(&player->now, &player->carry_q5_11);
    sequence_take(player);
    if (player->coming.page != 0) {
        measure_coming(player);
    }
    player->tick = 0;
    player->arrived = true;
    player->runs_on = player->coming.page != 0 && player->now.pause == 0;
    set_ramp(player);
    plan_joints(player, 0, planned_ahead);
}

/* By itself: an ordinary tick saves no registers for it. */
static NOINLINE uint8_t come_to_the_end(player_t *player, link_t *link, uint8_t left)
{
    if (sequence_is_early(player, left)) {
        return 0;
    }
    sequence_prepare(player, link, left);
    if (left == 0) {
        if (!player->looked) {
            return law_end_play(player);
        }
        take(player);
    }
    return 0;
}

uint8_t exact_step_over(player_t *player, link_t *link)
{
    uint16_t left = (uint16_t)(player->step_ticks + player->hold_ticks - player->tick);
    return player->arrived || left > SEQUENCE_AHEAD ? 0 : come_to_the_end(player, link, (uint8_t)left);
}

void exact_start(player_t *player, link_t *link)
{
    sequence_take_first(player);
    measure_coming(player);
    sequence_look(player, link);
    take(player);
}

/* One tick of a planned step. */
static void advance(player_t *player)
{
    uint16_t tick = ++player->tick;
    uint8_t ramp = player->ramp_ticks;
    uint16_t fall = (uint16_t)(player->step_ticks - ramp);
    if (tick >= player->step_ticks) {
        land(player);
    } else if (tick > fall) {
        if (tick == fall + 1u) {
            begin_fall(player);
        }
        exact_move(player);
    } else if (tick > ramp) {
        if (tick == ramp + 1u) {
            begin_cruise(player);
        }
        move_steadily(player);
    } else {
        exact_move(player);
    }
}

uint8_t exact_tick(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_OUTPUT;
    if (player->arrived) {
        events |= sequence_announce(player);
        plan_joints(player, player->planned, PAGE_JOINTS);
        advance(player);
    } else if (player->tick < player->step_ticks) {
        advance(player);
    } else {
        player->tick++;
        events = 0;
    }
    return (uint8_t)(events | exact_step_over(player, link));
}

/* --- slowing down, and the rest of an interrupted step ---------------------------------------------------------------- */

static bool is_on_target(const player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        if (joint->target_pos != fix_pos(joint->exact.pos_q16_16)) {
            return false;
        }
    }
    return true;
}

bool exact_rest_start(player_t *player)
{
    uint16_t ticks = (uint16_t)(player->tick < player->step_ticks ? player->step_ticks - player->tick : 0);
    uint8_t braked = law_brake_ticks(player);
    if (ticks == 0 && is_on_target(player)) {
        return false;
    }
    player->step_ticks = ticks < braked ? braked : ticks;
    player->step_recip = fix_recip32(player->step_ticks);
    player->tick = 0;
    set_ramp(player);
    plan_joints(player, 0, PAGE_JOINTS);
    return true;
}

bool exact_rest_tick(player_t *player)
{
    advance(player);
    return player->tick < player->step_ticks;
}
