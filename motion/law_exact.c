/* SPDX-License-Identifier: MIT
 * law_exact.c - the law that robots run (player.md section 2): its ticks. exact_plan.c plans the steps.
 *
 *   speed         cruise                         RISE    ticks 1 .. A            speed += accel,  accel =  (v - w0) / A
 *                ________                        CRUISE  ticks A+1 .. N-A        speed = v
 *               /        \                       FALL    ticks N-A+1 .. N        speed += accel,  accel = -(v - w1) / A
 *   w0 --------/          \------- w1 (exit)     HOLD    then hold_ticks, nothing is made
 *
 * `speed` is the way of the coming tick, so it begins half an acceleration beside the speed at the section's border:
 * w0 + a/2, w0 + 3a/2, ...: the sum over A ticks is exactly (w0 + v) A / 2. Tick N is not computed but set: the target. */
#include "exact_plan.h"
#include "fix.h"

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

/* --- a section begins --------------------------------------------------------------------------------------------- */

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
    law_work(player, (uint8_t)(player->own_joints * 2u) / 3u);
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* rather slow early than go past the target */
    FOR_OWN_JOINTS(player, joint) {
        uint32_t cruise = joint->exact.cruise_q16_16;
        int32_t accel = (int32_t)fix_by_ramp(cruise - joint->exact.exit_q16_16, recip, player->ramp_ticks);
        int32_t speed = (int32_t)cruise - (accel >> 1);
        joint->exact.speed_q16_16 = joint->down ? -speed : speed;
        joint->exact.accel_q16_16 = joint->down ? accel : -accel;
    }
}

/* --- a tick of a step --------------------------------------------------------------------------------------------- */

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

/* --- from step to step -------------------------------------------------------------------------------------------- */

uint8_t exact_step_over(player_t *player, link_t *link)
{
    const uint16_t left = (uint16_t)(player->step_ticks + player->hold_ticks - player->tick);
    law_left(player, left);
    if (player->arrived || left != 0) {
        return 0;
    }
    if (sequence_prepare(player, link, 0, player->tick == 1)) {
        exact_measure(player);
    }
    if (!player->looked) {
        return law_end_play(player);
    }
    exact_take(player);
    return 0;
}

void exact_prepare(player_t *player, link_t *link)
{
    const uint8_t left = player->left;
    if (player->arrived || left == 0 || left > SEQUENCE_AHEAD) {
        return;
    }
    if (sequence_prepare(player, link, left, player->tick == 1)) {
        exact_measure(player);
    }
    if (PLAYER_LAYERS && left == 1 && player->measured) {
        exact_plan_ahead(player);
    }
}

void exact_start(player_t *player, link_t *link)
{
    sequence_look_first(player);
    exact_measure(player);
    (void)sequence_take(player);
    sequence_look(player, link);
    exact_measure(player);
    exact_take(player);
    exact_plan_others(player); /* a start is no part of a tick */
    player->work = 0;
}

uint8_t exact_tick(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_OUTPUT;
    if (player->arrived) {
        events |= sequence_announce(player);
        exact_plan_others(player);
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

/* --- slowing down, and the rest of an interrupted step ------------------------------------------------------------ */

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
    player->tick = 0;
    exact_plan_rest(player);
    return true;
}

bool exact_rest_tick(player_t *player)
{
    advance(player);
    return player->tick < player->step_ticks;
}
