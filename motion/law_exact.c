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
 * direction is a sign at the end. A position carries its rounding with it: going up it starts half a unit above the
 * truth, going down a hair less, so that plain floor rounds to nearest, and mirrored motions mirror.
 *
 * Ranges: way 0..1023; mean speed m = way / N; w0, w1 <= m; v = m + (m - (w0 + w1) / 2) * A / (N - A) <= 2 m <= 2046. */
/* The loops over all joints need it: a quarter fewer cycles for 0.5 KiB of flash. */
#pragma GCC optimize("O2")

#include <string.h>
#include "fix.h"
#include "law.h"
#include "step_plan.h"

/* A ramp of this or one tick needs no reciprocal. */
#define SHORT_RAMP 2u

static int16_t way_between(uint16_t from_pos, uint16_t to_pos)
{
    return (int16_t)((int16_t)to_pos - (int16_t)from_pos);
}

/* The direction of a step stands in the lowest bit of its mean and its cruise speed: the speed itself may be 0 for a while.
 * (Speeds at way-points are even for that.) */
#define DOWN ((uint32_t)1)

/* speed / ticks, not more. */
static inline uint32_t by_ramp(uint32_t speed, uint16_t ramp_recip, uint8_t ticks)
{
    return ticks > SHORT_RAMP ? fix_by_ramp(speed, ramp_recip, ticks) : ticks == SHORT_RAMP ? speed >> 1 : speed;
}

/* What planning a joint needs of its step. */
typedef struct {
    uint16_t share_q0_16, ramp_recip;
    uint8_t ramp_ticks;
} ramp_t;

/* RISE, and the speed of CRUISE, of a step from from_pos, from speed `entry` on; its mean speed with its direction stands in
 * cruise, and what the mean is above the way-points' in accel. In an order that the AVR's registers are enough for: cruise
 * is put away as soon as it is known. Steps of few ticks, which leave the ticks between them little room, are spared the
 * multiplications. */
static inline void plan_joint(player_joint_t *joint, ramp_t ramp, const uint16_t *from_pos)
{
    uint32_t speed = joint->exact.cruise_q16_16, size = 0;
    uint8_t down = (uint8_t)((uint8_t)speed & DOWN);
    OPAQUE(down); /* one register, not four */
    speed &= ~DOWN;
    if (ramp.ramp_ticks != 0) {
        uint32_t more = (uint32_t)joint->exact.accel_q16_16;
        speed += ramp.share_q0_16 == UINT16_MAX ? more : fix_share(more, ramp.share_q0_16);
        speed &= ~DOWN;
        joint->exact.cruise_q16_16 = speed | down;
        more = (uint32_t)joint->exact.speed_q16_16;
        size = by_ramp(speed - more, ramp.ramp_recip, ramp.ramp_ticks);
        speed = more + (size >> 1);
    }
    int32_t pos = fix_from_pos(*from_pos) + FIX_ROUND_UP;
    if (down != 0) {
        pos--;
        speed = -speed;
        size = -size;
    }
    joint->exact.accel_q16_16 = (int32_t)size;
    joint->exact.speed_q16_16 = (int32_t)speed;
    joint->exact.pos_q16_16 = pos;
}

static inline uint16_t move_joint(player_joint_t *joint)
{
    int32_t speed = joint->exact.speed_q16_16;
    int32_t pos = joint->exact.pos_q16_16 + speed;
    joint->exact.pos_q16_16 = pos;
    joint->exact.speed_q16_16 = speed + joint->exact.accel_q16_16;
    return fix_pos(pos);
}

/* What planning needs of a step of `now` in so many ticks. A share of 0 stands for `not made yet`: 1 instead. */
RARE static void set_ramp(player_t *player, uint16_t ticks)
{
    uint8_t ramp_ticks = step_plan_exact_ramp(player->now.accel_time, ticks);
    uint16_t share = 0;
    if (ramp_ticks != 0) {
        share = fix_ratio(ramp_ticks, (uint16_t)(ticks - ramp_ticks));
        player->ramp_recip = fix_ramp_recip(ramp_ticks);
    }
    player->share_q0_16 = share != 0 ? share : 1;
}

/* Between two steps (primed) a joint has: in cruise the mean speed of the step to begin, in mean that of the coming one; in
 * speed the speed it comes with, in exit the speed it is to leave with, in accel the mean less the mean of these two. Plans
 * the step and makes its first tick. */
RARE static void begin_joints(player_t *player)
{
    player->ramp_ticks = step_plan_exact_ramp(player->now.accel_time, player->step_ticks);
    ramp_t ramp = {player->share_q0_16, player->ramp_recip, player->ramp_ticks};
    uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--) {
        plan_joint(joint, ramp, goal);
        *goal++ = move_joint(joint++);
        OPAQUE(left); /* count down instead of comparing pointers: 3 cycles a turn instead of 5 */
    }
}

/* Sets all joints on their targets, which makes the step to begin that from goal_pos to target_pos, and takes the coming
 * one's from its 64 bytes. */
RARE static void shift_targets(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    const uint8_t *present = (const uint8_t *)&player->present;
    uint8_t *used = (uint8_t *)&player->coming_joints;
    player->joints |= player->coming_joints;
    for (uint8_t byte = sizeof player->present; byte != 0; byte--) {
        uint8_t may = *present++, taken = 0, bit = 1, end = byte > 1 ? 0 : 1u << (PAGE_JOINTS % 8);
        do {
            uint16_t word = page_word(step);
            step += 2;
            OPAQUE(word); /* load and step in one */
            *goal++ = joint->target_pos;
            OPAQUE(goal);
            joint->target_pos = joint->coming_pos;
            if ((may & bit) != 0 && page_pos_is_used(word)) {
                joint->coming_pos = word;
                taken |= bit;
            }
            joint++;
            bit = (uint8_t)(bit << 1);
        } while (bit != end);
        *used++ = taken;
    }
}

/* The way-point between the step to begin and the coming one: mean speed of the latter, speeds before and behind. */
RARE static void join_steps(player_t *player, bool may_run_on)
{
    uint32_t recip = player->coming_recip;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++) {
        uint16_t way = joint->coming_pos, from = joint->target_pos;
        uint8_t down = 0;
        if (way < from) {
            down = DOWN;
            way = (uint16_t)(from - way);
        } else {
            way = (uint16_t)(way - from);
        }
        OPAQUE(down); /* one register, not four */
        uint32_t coming_mean = fix_mean(way, recip) & ~DOWN, exit = 0;
        uint32_t mean = joint->mean_q16_16;
        joint->mean_q16_16 = coming_mean | down;
        joint->exact.cruise_q16_16 = mean;
        down ^= (uint8_t)((uint8_t)mean & DOWN);
        mean &= ~DOWN;
        if (may_run_on && down == 0) {
            exit = mean < coming_mean ? mean : coming_mean; /* 0 when the joint comes from a stand */
        }
        uint32_t entry = joint->exact.exit_q16_16;
        joint->exact.speed_q16_16 = (int32_t)entry;
        joint->exact.exit_q16_16 = exit;
        joint->exact.accel_q16_16 = (int32_t)(mean - ((entry + exit) >> 1));
        OPAQUE(left); /* count down instead of comparing pointers: 3 cycles a turn instead of 5 */
    }
}

/* Length of the coming step, whose 64 bytes these are; its joints still stand on coming_pos. */
static void measure_coming(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t longest = player->coming.schedule == PAGE_SCHEDULE_SPEED ? law_longest_way(player, step) : 0;
    player->coming_ticks = step_plan_exact_ticks(&player->coming, longest, &player->carry_q5_11);
    player->coming_recip = fix_recip32(player->coming_ticks);
}

/* The next step becomes `now`, which decides the link of a page's last step, and the one after it is looked at: its 64 bytes
 * in `step`. */
RARE static void look(player_t *player, link_t *link, uint8_t step[PAGE_STEP_BYTES])
{
    player->next_ticks = player->coming_ticks;
    player_next_step(player, link, step, 0);
    player->next_hold_ticks = step_plan_exact_hold(&player->now, &player->carry_q5_11);
    if (player_looks_ahead(player)) {
        measure_coming(player, step);
    }
    if (player->next_ticks != 1) {
        set_ramp(player, player->next_ticks);
    }
}

/* Behind the last tick of a step (or of its pause): the joints are set on their targets, the next step begins with the next
 * tick. This is half of the work of a step's beginning; begin_step is the other. */
RARE static void prime(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    if (player->held_events == 0) {
        look(player, link, step);
    } else if (player_looks_ahead(player)) {
        player_read_coming(player, step);
    }
    player->step_ticks = player->next_ticks;
    player->hold_ticks = player->next_hold_ticks;
    player->tick = 0;
    player->primed = true;
    if (!player_looks_ahead(player)) {
        memset(step, PAGE_POS_UNUSED >> 8, sizeof step);
    }
    shift_targets(player, step);
    join_steps(player, player_looks_ahead(player) && player->now.pause == 0);
}

/* Sets the joints on their targets. When the next step is primed in the same tick, that does it. */
static void land(player_t *player)
{
    if (player->hold_ticks == 0 && (player->coming.page | player->held_events) != 0 && player_is_in_law(player)) {
        return;
    }
    uint16_t *goal = player->goal_pos;
    for (const player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        *goal++ = joint->target_pos;
    }
}

/* The tick after. A step of one tick needs no plan. */
RARE static uint8_t begin_step(player_t *player)
{
    uint8_t events = player_announce(player);
    player->tick = 1;
    if (player->step_ticks == 1) {
        land(player);
        return events;
    }
    if (player->share_q0_16 == 0) { /* the rest of the step before has used them */
        set_ramp(player, player->step_ticks);
    }
    begin_joints(player);
    return player->step_ticks > 2 ? (uint8_t)(events | PLAYER_EV_BUSY) : events;
}

RARE static void begin_cruise(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint32_t cruise = joint->exact.cruise_q16_16;
        int32_t speed = (int32_t)(cruise & ~DOWN);
        joint->exact.speed_q16_16 = (cruise & DOWN) != 0 ? -speed : speed;
        joint->exact.accel_q16_16 = 0;
    }
}

RARE static void begin_fall(player_t *player)
{
    uint16_t recip = player->ramp_recip;
    recip = recip == UINT16_MAX ? recip : (uint16_t)(recip + 1u); /* rather slow early than go past the target */
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        bool down = (joint->exact.cruise_q16_16 & DOWN) != 0;
        uint32_t cruise = joint->exact.cruise_q16_16 & ~DOWN;
        int32_t accel = (int32_t)by_ramp(cruise - joint->exact.exit_q16_16, recip, player->ramp_ticks);
        int32_t speed = (int32_t)cruise - (accel >> 1);
        joint->exact.speed_q16_16 = down ? -speed : speed;
        joint->exact.accel_q16_16 = down ? accel : -accel;
    }
}

void exact_move(player_t *player)
{
    uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--) {
        *goal++ = move_joint(joint++);
        OPAQUE(left); /* count down instead of comparing pointers: 3 cycles a turn instead of 5 */
    }
}

/* In CRUISE, where no speed changes. */
RARE static void move_on(player_t *player)
{
    uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++) {
        int32_t pos = joint->exact.pos_q16_16 + joint->exact.speed_q16_16;
        joint->exact.pos_q16_16 = pos;
        *goal++ = fix_pos(pos);
        OPAQUE(left); /* count down instead of comparing pointers: 3 cycles a turn instead of 5 */
    }
}

bool exact_rest_tick(player_t *player)
{
    if (player->tick == 0) { /* only a rest begins here; a step begins in begin_step */
        set_ramp(player, player->step_ticks);
        begin_joints(player);
        player->share_q0_16 = 0;
        player->tick = 1;
        return true;
    }
    uint16_t tick = ++player->tick;
    if (tick >= player->step_ticks) {
        land(player);
        return false;
    }
    uint8_t ramp = player->ramp_ticks;
    uint16_t fall = (uint16_t)(player->step_ticks - ramp);
    if (tick > fall) {
        if (tick == fall + 1u) {
            begin_fall(player);
        }
        exact_move(player);
    } else if (tick > ramp) {
        if (tick == ramp + 1u) {
            begin_cruise(player);
        }
        move_on(player);
    } else {
        exact_move(player);
    }
    return true;
}

static bool is_on_target(const player_t *player)
{
    const uint16_t *goal = player->goal_pos;
    for (const player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        if (joint->target_pos != *goal++) {
            return false;
        }
    }
    return true;
}

void exact_start(player_t *player, link_t *link, const uint8_t step[PAGE_STEP_BYTES])
{
    player->carry_q5_11 = STEP_PLAN_CARRY_START;
    measure_coming(player, step);
    shift_targets(player, step);
    join_steps(player, false);
    prime(player, link);
}

/* Ticks until the step and its pause are used up. */
static uint16_t ticks_left(const player_t *player)
{
    uint16_t ticks = (uint16_t)(player->step_ticks + player->hold_ticks);
    return player->tick < ticks ? (uint16_t)(ticks - player->tick) : 0;
}

/* The look takes place in the tick before the last, and one earlier when FALL begins in that one. */
static bool is_time_to_look(const player_t *player)
{
    return player->held_events == 0 && ticks_left(player) == (player->ramp_ticks == 2 ? 2u : 1u);
}

RARE uint8_t exact_go_on(player_t *player, link_t *link)
{
    if (ticks_left(player) == 0) {
        if ((player->coming.page | player->held_events) == 0) {
            return player_end(player);
        }
        prime(player, link);
        return player->step_ticks > 2 ? PLAYER_EV_BUSY : 0;
    }
    if (player->coming.page != 0 && is_time_to_look(player)) {
        uint8_t step[PAGE_STEP_BYTES];
        look(player, link, step);
    }
    return 0;
}

uint8_t exact_tick(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_OUTPUT;
    if (player->primed) {
        events |= begin_step(player);
    } else if (player->tick < player->step_ticks) {
        (void)exact_rest_tick(player);
    } else {
        player->tick++;
        events = 0;
    }
    /* Two ticks before the end at most there is more to do: most ticks are spared the call. */
    uint16_t left = (uint16_t)(player->step_ticks + player->hold_ticks - player->tick);
    return left > 2 ? events : (uint8_t)(events | exact_go_on(player, link));
}

/* --- the rest of an interrupted step ------------------------------------------------------------------------------ */

/* Leaves every joint as between two steps, with the rest of the step as the one to begin. */
bool exact_rest_start(player_t *player)
{
    uint16_t ticks = (uint16_t)(player->tick < player->step_ticks ? player->step_ticks - player->tick : 0);
    uint8_t braked = law_brake_ticks(player);
    if (ticks == 0 && is_on_target(player)) {
        return false;
    }
    player->step_ticks = ticks < braked ? braked : ticks;
    player->tick = 0;
    uint32_t recip = fix_recip32(player->step_ticks);
    const uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t way = fix_size(way_between(*goal, joint->target_pos));
        uint32_t mean = fix_mean(way, recip), coming = joint->mean_q16_16;
        if (player->law != PLAYER_LAW_EXACT || way == 0) {
            joint->exact.exit_q16_16 = 0;
        } else if (joint->exact.exit_q16_16 != 0) { /* it was to run through */
            joint->exact.exit_q16_16 = (mean < coming ? mean : coming) & ~DOWN;
        }
        joint->exact.cruise_q16_16 = (joint->target_pos < *goal++ ? mean | DOWN : mean & ~DOWN);
        joint->exact.speed_q16_16 = 0;
        joint->exact.accel_q16_16 = (int32_t)(mean - joint->exact.exit_q16_16 / 2);
    }
    return true;
}
