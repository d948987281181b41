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

/* The last tick. A joint that is planned ahead is on the target already. */
static void land(player_t *player)
{
    const player_joint_t *planned = &player->joint[PLAYER_LAYERS ? player->planned : 0];
    FOR_OWN_GOALS(player, joint, goal) {
        if (joint >= planned) {
            joint->exact.pos_q16_16 = fix_from_pos(joint->target_pos);
        }
        *goal = joint->target_pos;
    }
}

/* --- planning ----------------------------------------------------------------------------------------------------- */

/* Plans RISE and the speed of CRUISE of a joint at from_pos; exit is set already. mean, entry: sizes. */
static inline void plan_joint(const player_t *player, player_exact_t *exact, uint16_t from_pos, bool down, uint32_t mean,
                              uint32_t entry)
{
    uint32_t cruise = mean, speed = entry, accel = 0; /* without a ramp begin_cruise sets the speed */
    uint8_t ramp_ticks = player->ramp_ticks;
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

/* Speed at at_pos, the end of a step in which a joint's mean speed is `mean`: the smaller of both steps' means, or 0 if it
 * turns round or stays. */
static inline uint32_t exit_speed(const player_t *player, bool down, uint16_t at_pos, uint16_t next_pos, uint32_t mean,
                                  uint32_t next_recip)
{
    if (mean == 0 || !player->runs_on || (down ? next_pos >= at_pos : next_pos <= at_pos)) {
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
    const uint16_t *coming = &player->coming_pos[planned];
    const uint8_t self = player->self;
    const bool is_of_one = !ahead && player->step_ticks == 1; /* no time for the multiplication in such a step */
    const uint32_t next_recip = player->looked && !ahead ? player->now.recip : player->coming.recip;
    uint8_t left = most;
    for (player_joint_t *joint = &player->joint[planned]; planned < PAGE_JOINTS && left != 0; planned++, joint++, coming++) {
        if (!law_owns(self, joint)) {
            continue;
        }
        left--;
        player_exact_t *exact = &joint->exact;
        uint16_t from_pos = fix_pos(exact->pos_q16_16), to_pos = joint->target_pos, next_pos = *coming;
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
        const uint32_t mean = even(!is_of_one ? fix_mean(way, player->recip) : way != 0 ? ((uint32_t)way << 16) - 1u : 0);
        bool down = to_pos < from_pos;
        joint->down = down;
        exact->exit_q16_16 = exit_speed(player, down, to_pos, next_pos, mean, next_recip);
        if (!is_of_one) {
            plan_joint(player, exact, from_pos, down, mean, entry);
        }
    }
    player->planned = planned;
    law_work(player, (uint8_t)(LAW_WORK_PLAN_JOINT * (uint8_t)(most - left)));
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

static NOINLINE void begin_cruise(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        int32_t speed = (int32_t)joint->exact.cruise_q16_16;
        joint->exact.speed_q16_16 = joint->down ? -speed : speed;
    }
}

static NOINLINE void begin_fall(player_t *player)
{
    uint16_t recip = player->ramp_recip;
    law_work(player, player->own_joints / 2u);
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* rather slow early than go past the target */
    FOR_OWN_JOINTS(player, joint) {
        uint32_t cruise = joint->exact.cruise_q16_16;
        int32_t accel = (int32_t)fix_by_ramp(cruise - joint->exact.exit_q16_16, recip, player->ramp_ticks);
        int32_t speed = (int32_t)cruise - (accel >> 1);
        joint->exact.speed_q16_16 = joint->down ? -speed : speed;
        joint->exact.accel_q16_16 = joint->down ? accel : -accel;
    }
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

/* In the last tick but one: a third of the joints, fewer after other work. */
static void plan_ahead(player_t *player)
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
    return player->step_ticks <= short_ticks ? (uint8_t)(joints - joints / 3u) : (uint8_t)((joints - 1u) / 2u);
}

/* Takes the coming step: the joints are on target_pos, and it begins with the next tick. */
static NOINLINE void take(player_t *player)
{
    const uint16_t old_ticks = player->step_ticks;
    player->joints |= player->coming_joints;
    player->step_ticks = player->now.ticks;
    player->hold_ticks = player->now.hold_ticks;
    prepare_plan(player);
    player->own_joints = sequence_take(player);
    player->tick = 0;
    player->ahead = false;
    player->arrived = true;
    plan_joints(player, false, planned_last(player, player->own_joints, old_ticks));
}

/* By itself: an ordinary tick saves no registers for it. */
static NOINLINE uint8_t come_to_the_end(player_t *player, link_t *link, uint8_t left)
{
    if (sequence_prepare(player, link, left, player->tick == 1)) {
        exact_measure(player);
    }
    if (left == 0) {
        if (!player->looked) {
            return law_end_play(player);
        }
        take(player);
    } else if (PLAYER_LAYERS && left == 1 && player->measured) {
        plan_ahead(player);
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
    sequence_look_first(player);
    exact_measure(player);
    (void)sequence_take(player);
    sequence_look(player, link);
    exact_measure(player);
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
        plan_joints(player, false, PAGE_JOINTS);
        player->planned = 0;
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
    player->recip = fix_recip32(player->step_ticks);
    player->tick = 0;
    player->ramp_ticks =
        measure_ramp(player->accel_time, player->step_ticks, &player->ramp_recip, &player->ramp_share_q0_16);
    player->planned = 0;
    plan_joints(player, false, PAGE_JOINTS);
    player->planned = 0;
    return true;
}

bool exact_rest_tick(player_t *player)
{
    advance(player);
    return player->tick < player->step_ticks;
}
