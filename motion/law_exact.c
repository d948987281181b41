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

/* Makes the compiler count down instead of comparing pointers: 3 cycles a turn instead of 5. */
#define KEEP_COUNTER(counter) __asm__("" : "+r"(counter))

static int16_t way_between(uint16_t from_pos, uint16_t to_pos)
{
    return (int16_t)((int16_t)to_pos - (int16_t)from_pos);
}

/* For ways that are not 0. */
static inline bool same_direction(int16_t a, int16_t b)
{
    return (a ^ b) >= 0;
}

/* The direction of a step stands in the lowest bit of its cruise speed: the speed itself may be 0 for a while. (Speeds at
 * way-points are even for that.) */
#define DOWN ((uint32_t)1)

/* What planning a joint needs of its step. */
typedef struct {
    uint16_t share_q0_16, ramp_recip;
    uint8_t ramp_ticks;
} ramp_t;

/* RISE, and the speed of CRUISE, of a step from *from_pos to target_pos at `mean` speed, from speed `entry` to exit. In an
 * order that the AVR's registers are enough for: cruise is put away as soon as it is known. */
static inline void plan_joint(player_joint_t *joint, ramp_t ramp, const uint16_t *from_pos, uint32_t mean, uint32_t entry)
{
    uint32_t size = 0, speed = mean;
    if (ramp.ramp_ticks != 0 && mean != 0) {
        uint32_t border = (entry + joint->exact.exit_q16_16) >> 1;
        mean += fix_share(mean - border, ramp.share_q0_16);
        joint->exact.cruise_q16_16 = mean & ~DOWN;
        size = fix_by_ramp(mean - entry, ramp.ramp_recip, ramp.ramp_ticks);
        speed = entry + (size >> 1);
    } else {
        joint->exact.cruise_q16_16 = mean & ~DOWN;
    }
    uint16_t from = *from_pos;
    int32_t pos = fix_from_pos(from) + FIX_ROUND_UP;
    if (joint->target_pos < from) {
        joint->exact.cruise_q16_16 |= DOWN;
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

static uint16_t share_of(const player_step_t *step, uint16_t ticks)
{
    uint8_t ramp_ticks = step_plan_exact_ramp(step->accel_time, ticks);
    return ramp_ticks == 0 ? 0 : fix_ratio(ramp_ticks, (uint16_t)(ticks - ramp_ticks));
}

/* share_q0_16: of `now`, or 0 when nobody has made it yet. */
static void set_ramp(player_t *player, uint16_t share_q0_16)
{
    player->share_q0_16 = share_q0_16 != 0 ? share_q0_16 : share_of(&player->now, player->step_ticks);
    player->ramp_ticks = step_plan_exact_ramp(player->now.accel_time, player->step_ticks);
    player->ramp_recip = player->ramp_ticks == 0 ? 0 : fix_ramp_recip(player->ramp_ticks);
}

static bool runs_through(const player_t *player)
{
    return player_looks_ahead(player) && player->now.pause == 0;
}

static ramp_t ramp_of(const player_t *player)
{
    return (ramp_t){player->share_q0_16, player->ramp_recip, player->ramp_ticks};
}

/* Between two steps (primed) a joint has: in mean still the mean speed of the step to begin, in cruise that of the
 * coming one; in speed the speed it comes with, in exit the speed it is to leave with. Plans the step and makes its first
 * tick. */
RARE static void begin_joints(player_t *player)
{
    ramp_t ramp = ramp_of(player);
    uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--) {
        uint32_t mean = joint->mean_q16_16;
        joint->mean_q16_16 = joint->exact.cruise_q16_16;
        plan_joint(joint, ramp, goal, mean, (uint32_t)joint->exact.speed_q16_16);
        *goal++ = move_joint(joint++);
        KEEP_COUNTER(left);
    }
}

/* Sets all joints on their targets, which makes the step to begin that from goal_pos to target_pos, and takes the coming
 * one's from its 64 bytes. Returns the longest way of a joint in it. */
RARE static uint16_t shift_targets(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t *goal = player->goal_pos, longest = 0;
    const uint8_t *present = (const uint8_t *)&player->present;
    uint8_t *used = (uint8_t *)&player->coming_joints, may = 0, bit = 0;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t target = joint->coming_pos, word = page_word(step);
        step += 2;
        *goal++ = joint->target_pos;
        joint->target_pos = target;
        if (bit == 0) {
            bit = 1;
            may = *present++;
            *used++ = 0;
        }
        if (page_pos_is_used(word) && (may & bit) != 0) {
            uint16_t way = (uint16_t)(word >= target ? word - target : target - word);
            joint->coming_pos = word;
            used[-1] |= bit;
            longest = way > longest ? way : longest;
        }
        bit = (uint8_t)(bit << 1);
    }
    return longest;
}

/* The way-point between the step to begin and the coming one: mean speed of the latter, speeds before and behind. */
RARE static void join_steps(player_t *player)
{
    uint32_t recip = player->coming_recip;
    bool may_run_on = runs_through(player);
    const uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t target = joint->target_pos;
        int16_t way = way_between(*goal++, target), coming_way = way_between(target, joint->coming_pos);
        uint32_t coming_mean = 0, exit = 0;
        joint->exact.speed_q16_16 = (int32_t)joint->exact.exit_q16_16;
        if (coming_way != 0) {
            coming_mean = fix_mean(fix_size(coming_way), recip);
            if (may_run_on && same_direction(way, coming_way)) {
                uint32_t mean = joint->mean_q16_16; /* 0 when the joint comes from a stand */
                exit = (mean < coming_mean ? mean : coming_mean) & ~DOWN;
            }
        }
        joint->exact.cruise_q16_16 = coming_mean;
        joint->exact.exit_q16_16 = exit;
    }
}

/* Looks at the coming step. */
static void look_at_coming(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t longest = shift_targets(player, step);
    if (player->coming.page != 0) {
        player->coming_ticks = step_plan_exact_ticks(&player->coming, longest, &player->carry_q5_11);
        player->coming_recip = fix_recip32(player->coming_ticks);
    }
    join_steps(player);
}

/* Behind the last tick of a step (or of its pause): the next one becomes `now`, which decides the link of a page's last
 * step; the one after it is looked at. This is half of the work of a step's beginning; begin_step is the other. */
RARE static void prime(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    player->step_ticks = player->coming_ticks;
    player->tick = 0;
    player_next_step(player, link, step);
    player->hold_ticks = step_plan_exact_hold(&player->now, &player->carry_q5_11);
    if (!player_looks_ahead(player)) {
        memset(step, PAGE_POS_UNUSED >> 8, sizeof step);
    }
    look_at_coming(player, step);
}

/* Sets the joints on their targets. When the next step is primed in the same tick, that does it. */
static void land(player_t *player)
{
    if (player->hold_ticks == 0 && player->coming.page != 0 && player_is_in_law(player)) {
        return;
    }
    uint16_t *goal = player->goal_pos;
    for (const player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        *goal++ = joint->target_pos;
    }
}

/* What begin_joints does for a step of one tick, which needs no plan. */
static void shift_means(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        joint->mean_q16_16 = joint->exact.cruise_q16_16;
    }
}

/* The tick after: plans what is known now. */
RARE static uint8_t begin_step(player_t *player)
{
    uint8_t events = player_announce(player);
    player->tick = 1;
    if (player->step_ticks == 1) {
        shift_means(player);
        land(player);
    } else {
        set_ramp(player, player->coming_share_q0_16);
        begin_joints(player);
    }
    player->coming_share_q0_16 = 0;
    return events;
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
        int32_t accel = (int32_t)fix_by_ramp(cruise - joint->exact.exit_q16_16, recip, player->ramp_ticks);
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
        KEEP_COUNTER(left);
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
        KEEP_COUNTER(left);
    }
}

bool exact_rest_tick(player_t *player)
{
    if (player->tick == 0) { /* only a rest begins here; a step begins in begin_step */
        set_ramp(player, 0);
        begin_joints(player);
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
    player->coming_share_q0_16 = 0;
    player->look_page = 0;
    look_at_coming(player, step);
    shift_means(player);
    prime(player, link);
}

/* true when the step and its pause are used up. */
static bool is_over(const player_t *player)
{
    return player->tick >= (uint16_t)(player->step_ticks + player->hold_ticks);
}

/* What the coming step needs and a tick with little to do can do for it. */
RARE static void quiet_work(player_t *player)
{
    if (!player_quiet_work(player) && player->coming.page != 0) {
        uint16_t share = share_of(&player->coming, player->coming_ticks);
        player->coming_share_q0_16 = share != 0 ? share : 1;
    }
}

uint8_t exact_tick(player_t *player, link_t *link)
{
    uint8_t events = PLAYER_EV_OUTPUT;
    if (player->held_events == 0 && is_over(player)) { /* behind the rest of an interrupted step */
        if (player->coming.page == 0) {
            return player_end(player);
        }
        prime(player, link);
    }
    if (player->held_events != 0) {
        events |= begin_step(player);
    } else if (player->tick < player->step_ticks) {
        (void)exact_rest_tick(player);
    } else {
        player->tick++;
        events = 0;
    }
    if (!is_over(player)) {
        if (player->coming_share_q0_16 == 0 && (events & PLAYER_EV_STEP) == 0) {
            quiet_work(player);
        }
    } else if (player->coming.page == 0) {
        events |= player_end(player);
    } else {
        prime(player, link);
    }
    return events;
}

/* --- the rest of an interrupted step ------------------------------------------------------------------------------ */

/* Leaves every joint as between two steps, with the rest of the step as the one to begin. */
bool exact_rest_start(player_t *player)
{
    bool exact = player->law == PLAYER_LAW_EXACT, may_run_on = exact && runs_through(player);
    uint16_t ticks = (uint16_t)(player->tick < player->step_ticks ? player->step_ticks - player->tick : 0);
    uint8_t braked = law_brake_ticks(player);
    if (ticks == 0 && is_on_target(player)) {
        return false;
    }
    if (exact && player->held_events != 0) {
        shift_means(player);
    }
    player->step_ticks = ticks < braked ? braked : ticks;
    player->tick = 0;
    uint32_t recip = fix_recip32(player->step_ticks);
    const uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t way = way_between(*goal++, joint->target_pos);
        uint32_t mean = fix_mean(fix_size(way), recip), coming = joint->mean_q16_16, exit = 0;
        if (may_run_on && way != 0 && same_direction(way, way_between(joint->target_pos, joint->coming_pos))) {
            exit = (mean < coming ? mean : coming) & ~DOWN;
        }
        joint->mean_q16_16 = mean;
        joint->exact.cruise_q16_16 = coming;
        joint->exact.speed_q16_16 = 0;
        joint->exact.exit_q16_16 = exit;
    }
    return true;
}
