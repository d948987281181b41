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
#include "fix.h"
#include "law.h"
#include "step_plan.h"

#define ROUND_UP (FIX_POS_ONE / 2)       /* start + this, then floor: nearest, halves up */
#define ROUND_DOWN (FIX_POS_ONE / 2 - 1) /* nearest, halves down */

static int16_t way_between(uint16_t from_pos, uint16_t to_pos)
{
    return (int16_t)((int16_t)to_pos - (int16_t)from_pos);
}

static bool same_direction(int16_t a, int16_t b)
{
    return (a > 0 && b > 0) || (a < 0 && b < 0);
}

/* Where the coming step takes joint `index`: its word, or where it is when the step does not use it. */
static uint16_t coming_target(player_t *player, uint8_t index, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t word = page_word(&step[2 * index]);
    if (!page_pos_is_used(word) || !law_has_joint(player->present, index)) {
        return player->joint[index].target_pos;
    }
    player->coming_joints |= (uint32_t)1 << index;
    return word;
}

static uint16_t longest_way(const player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t longest = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint16_t word = page_word(&step[2 * i]);
        if (page_pos_is_used(word) && law_has_joint(player->present, i)) {
            uint16_t way = fix_size(way_between(player->joint[i].target_pos, word));
            longest = way > longest ? way : longest;
        }
    }
    return longest;
}

/* Length of the coming step. The joints' target_pos is where it starts. */
static void measure_coming(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    uint16_t longest = player->coming.schedule == PAGE_SCHEDULE_SPEED ? longest_way(player, step) : 0;
    player->coming_ticks = step_plan_exact_ticks(&player->coming, longest, &player->carry_q5_11);
    player->coming_recip = fix_recip31(player->coming_ticks);
    player->coming_joints = 0;
}

static void look_at_coming(player_t *player, uint8_t index, const uint8_t step[PAGE_STEP_BYTES])
{
    player_joint_t *joint = &player->joint[index];
    joint->coming_pos = coming_target(player, index, step);
    joint->mean_q12_20 = fix_mean(fix_size(way_between(joint->target_pos, joint->coming_pos)), player->coming_recip);
}

/* RISE and all that is known of the step, from a start at `from_pos` with speed w0 = exit of the last step. */
static void plan_joint(const player_t *player, player_joint_t *joint, uint16_t from_pos, uint32_t mean, uint32_t entry)
{
    uint32_t accel = 0, speed, cruise = mean;
    if (player->ramp_ticks != 0) {
        uint32_t border = (entry + joint->exact.exit_q12_20) >> 1;
        cruise = mean + fix_share(mean - border, player->share_q0_16);
        accel = fix_by_ramp(cruise - entry, player->ramp_recip, player->ramp_ticks);
        speed = entry + (accel >> 1);
    } else {
        speed = mean;
    }
    joint->exact.cruise_q12_20 = cruise;
    bool down = joint->target_pos < from_pos;
    joint->exact.pos_q12_20 = ((int32_t)from_pos << FIX_POS_BITS) + (down ? ROUND_DOWN : ROUND_UP);
    joint->exact.speed_q12_20 = down ? -(int32_t)speed : (int32_t)speed;
    joint->exact.accel_q12_20 = down ? -(int32_t)accel : (int32_t)accel;
}

/* Speed at the way-point between a step of way `way` and the coming one. */
static uint32_t exit_speed(const player_joint_t *joint, int16_t way, uint32_t mean)
{
    if (!same_direction(way, way_between(joint->target_pos, joint->coming_pos))) {
        return 0;
    }
    return mean < joint->mean_q12_20 ? mean : joint->mean_q12_20;
}

static void set_ramp(player_t *player, uint8_t ramp_ticks)
{
    player->ramp_ticks = ramp_ticks;
    if (ramp_ticks != 0) {
        player->share_q0_16 = fix_ratio(ramp_ticks, (uint16_t)(player->step_ticks - ramp_ticks));
        player->ramp_recip = fix_ramp_recip(ramp_ticks);
    }
}

static bool runs_through(const player_t *player)
{
    return player_looks_ahead(player) && player->now.pause == 0;
}

static uint8_t begin_step(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    player->step_ticks = player->coming_ticks;
    uint8_t events = player_next_step(player, link, step);
    set_ramp(player, step_plan_exact_ramp(player->now.accel_time, player->step_ticks));
    player->hold_ticks = step_plan_exact_hold(&player->now, &player->carry_q5_11);
    player->tick = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player->joint[i].target_pos = player->joint[i].coming_pos;
    }
    bool ahead = player_looks_ahead(player);
    if (ahead) {
        measure_coming(player, step);
    }
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        uint32_t mean = joint->mean_q12_20, entry = joint->exact.exit_q12_20;
        uint16_t from_pos = player->goal_pos[i];
        if (ahead) {
            look_at_coming(player, i, step);
        }
        joint->exact.exit_q12_20 = runs_through(player) ? exit_speed(joint, way_between(from_pos, joint->target_pos), mean) : 0;
        plan_joint(player, joint, from_pos, mean, entry);
    }
    return events;
}

static void begin_cruise(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int32_t cruise = (int32_t)joint->exact.cruise_q12_20;
        joint->exact.speed_q12_20 = joint->exact.speed_q12_20 < 0 ? -cruise : cruise;
        joint->exact.accel_q12_20 = 0;
    }
}

static void begin_fall(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint32_t cruise = joint->exact.cruise_q12_20;
        int32_t accel = (int32_t)fix_by_ramp(cruise - joint->exact.exit_q12_20, player->ramp_recip, player->ramp_ticks);
        int32_t speed = (int32_t)cruise - (accel >> 1);
        bool down = joint->exact.speed_q12_20 < 0;
        joint->exact.speed_q12_20 = down ? -speed : speed;
        joint->exact.accel_q12_20 = down ? accel : -accel;
    }
}

static void move(player_t *player)
{
    uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int32_t pos = joint->exact.pos_q12_20 + joint->exact.speed_q12_20;
        joint->exact.pos_q12_20 = pos;
        joint->exact.speed_q12_20 += joint->exact.accel_q12_20;
        *goal++ = fix_pos(pos);
    }
}

static void land(player_t *player)
{
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player->goal_pos[i] = player->joint[i].target_pos;
    }
}

bool exact_rest_tick(player_t *player)
{
    uint16_t tick = ++player->tick;
    if (tick >= player->step_ticks) {
        land(player);
        return false;
    }
    uint16_t before_fall = (uint16_t)(player->step_ticks - player->ramp_ticks);
    if (player->ramp_ticks != 0) {
        if (tick == before_fall + 1u) {
            begin_fall(player);
        } else if (tick == player->ramp_ticks + 1u) {
            begin_cruise(player);
        }
    }
    move(player);
    return true;
}

void exact_start(player_t *player, const uint8_t step[PAGE_STEP_BYTES])
{
    player->carry_q5_11 = STEP_PLAN_CARRY_START;
    player->step_ticks = player->hold_ticks = player->tick = 0;
    player->ramp_ticks = 0;
    measure_coming(player, step);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        look_at_coming(player, i, step);
    }
}

uint8_t exact_tick(player_t *player, link_t *link)
{
    uint8_t events = 0;
    uint16_t last = (uint16_t)(player->step_ticks + player->hold_ticks);
    if (player->tick >= last) {
        events = begin_step(player, link);
        last = (uint16_t)(player->step_ticks + player->hold_ticks);
    } else {
        player_quiet_work(player);
    }
    if (player->tick < player->step_ticks) {
        (void)exact_rest_tick(player);
        events |= PLAYER_EV_OUTPUT;
    } else {
        player->tick++;
    }
    if (player->tick == last && player->coming.page == 0) {
        events |= player_end(player);
    }
    return events;
}

/* --- slowing down and going on ----------------------------------------------------------------------------------- */

void exact_freeze(player_t *player)
{
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int32_t speed = joint->exact.speed_q12_20 - joint->exact.accel_q12_20 / 2;
        if (player->tick >= player->step_ticks) { /* on target: the speed is that of the way-point */
            bool down = joint->coming_pos < joint->target_pos;
            speed = (int32_t)joint->exact.exit_q12_20;
            speed = down ? -speed : speed;
            joint->exact.pos_q12_20 = ((int32_t)joint->target_pos << FIX_POS_BITS) + (down ? ROUND_DOWN : ROUND_UP);
        }
        joint->exact.speed_q12_20 = speed;
    }
}

/* The rest of a step takes the time it still had, but at least as long as slowing down did. Standing on the target
 * already (between steps, in a pause) there is nothing to do. */
bool exact_rest_start(player_t *player)
{
    uint16_t ticks = (uint16_t)(player->tick < player->step_ticks ? player->step_ticks - player->tick : 0);
    bool on_target = true;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        on_target = on_target && player->goal_pos[i] == player->joint[i].target_pos;
    }
    if (ticks == 0 && on_target) {
        return false;
    }
    uint8_t braked = law_brake_ticks(player);
    player->step_ticks = ticks < braked ? braked : ticks;
    player->tick = 0;
    set_ramp(player, step_plan_exact_ramp(player->now.accel_time, player->step_ticks));
    uint32_t recip = fix_recip31(player->step_ticks);
    bool through = player->law == PLAYER_LAW_EXACT && runs_through(player);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int16_t way = way_between(player->goal_pos[i], joint->target_pos);
        uint32_t mean = fix_mean(fix_size(way), recip);
        joint->exact.exit_q12_20 = through ? exit_speed(joint, way, mean) : 0;
        plan_joint(player, joint, player->goal_pos[i], mean, 0);
    }
    return true;
}

uint8_t law_brake_ticks(const player_t *player)
{
    return player->ramp_ticks < BRAKE_TICKS_MIN ? BRAKE_TICKS_MIN : player->ramp_ticks;
}

void brake_start(player_t *player)
{
    player->brake_ticks = law_brake_ticks(player);
    uint16_t recip = fix_ramp_recip(player->brake_ticks);
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int32_t speed = joint->exact.speed_q12_20;
        bool down = speed < 0;
        uint32_t size = (uint32_t)(down ? -speed : speed);
        int32_t accel = (int32_t)fix_by_ramp(size, recip, player->brake_ticks);
        joint->exact.accel_q12_20 = down ? accel : -accel;
        joint->exact.speed_q12_20 = down ? speed + (accel >> 1) : speed - (accel >> 1);
    }
}

/* A joint that reaches an end of its range while slowing down stands there. */
static void keep_in_range(player_joint_t *joint)
{
    int32_t pos = joint->exact.pos_q12_20 + joint->exact.speed_q12_20;
    if (pos < 0 || pos >= (int32_t)(PAGE_POS_MAX + 1) << FIX_POS_BITS) {
        joint->exact.speed_q12_20 = joint->exact.accel_q12_20 = 0;
        joint->exact.pos_q12_20 = pos < 0 ? 0 : (int32_t)PAGE_POS_MAX << FIX_POS_BITS;
    }
}

bool brake_tick(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        keep_in_range(joint);
    }
    move(player);
    return --player->brake_ticks != 0;
}
