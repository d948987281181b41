/* SPDX-License-Identifier: MIT
 * law_classic.c - the original's law, sample by sample (player.md section 1; names M, N, A, K, P, v, w as there).
 *
 *   speed          ________
 *                /        \        through: v goes on into the next step
 *      w -------/          \       stop: back to 0 in FALL
 *            RISE  CRUISE   FALL  HOLD
 *
 * Nothing is divided in a tick. x * c / num for c = 1, 2, .. num is a running sum: quotient of x / num each time, and one
 * more whenever the remainders have made up a whole num (`spread`). The factor 144 / 15 >> 9 is 3 / 160 (floor).
 * What a step needs that a remote code cannot change any more (its way and both speeds it may take, stopping or going
 * through) is made ready a few joints a tick while the step before is played (`prepare`). Which of the two it is, is
 * only known when it begins, and at the last step of a page that is when the link is decided.
 *
 * Ranges: |M| <= 1023; |v|, |w| <= 1023; acc within +-4893; M - acc within +-5916. */
#include "fix.h"
#include "law.h"
#include "step_plan.h"

#define SPEED_MAX 1023
/* 720 / 1024 degrees/s in q12.20 servo units per tick: 0.01875 * 2^20 = 19660.8 */
#define SPEED_UNIT_Q12_20 19661

static int16_t limit_pos(int16_t pos)
{
    return pos < 0 ? 0 : pos > (int16_t)PAGE_POS_MAX ? (int16_t)PAGE_POS_MAX : pos;
}

/* floor(3 x / 160) for |x| <= 1023 * 255. Shifted to the positive side by 5000, so that the 16 upper bits can be divided
 * by 5 exactly with one multiplication. */
static int16_t three_160ths(int32_t x)
{
    uint16_t fifths = (uint16_t)((uint32_t)(3 * x + 160l * 5000) >> 5);
    return (int16_t)((mul_u16_high(fifths, 52429u) >> 2) - 5000u);
}

/* int16((v * A * 12 / 5) >> 8): way of a FALL to a stand. trunc, then floor: (3 x) / 320, one 3 x of mercy below 0. */
static int16_t fall_way(int16_t v, uint8_t ramp)
{
    int32_t x = (int32_t)v * ramp;
    uint32_t size = (uint32_t)(x < 0 ? -3 * x + 318 : 3 * x);
    int16_t way = (int16_t)(mul_u16_high((uint16_t)(size >> 6), 52429u) >> 2);
    return x < 0 ? (int16_t)-way : way;
}

/* x * c / num (toward zero) from now on by next_share, c = 1, 2, ... */
static void spread(player_joint_t *joint, int16_t x, uint16_t num, uint16_t recip16)
{
    uint16_t remainder;
    int16_t quotient = (int16_t)fix_divide(fix_size(x), num, recip16, &remainder);
    joint->classic.quotient = x < 0 ? (int16_t)-quotient : quotient;
    joint->classic.remainder = remainder;
    joint->classic.error = 0;
    joint->classic.value = 0;
}

/* `negative`: x of spread was below 0 */
static int16_t next_share(player_joint_t *joint, uint16_t num, bool negative)
{
    int16_t value = (int16_t)(joint->classic.value + joint->classic.quotient);
    uint16_t error = (uint16_t)(joint->classic.error + joint->classic.remainder);
    if (error >= num) {
        error = (uint16_t)(error - num);
        value = (int16_t)(negative ? value - 1 : value + 1);
    }
    joint->classic.error = error;
    joint->classic.value = value;
    return value;
}

/* --- making the coming step ready -------------------------------------------------------------------------------- */

/* The speed that a joint still has when the step playing now is over: w of the coming one. */
static int16_t speed_left(const player_t *player, const player_joint_t *joint)
{
    if (player->hold_ticks != 0) {
        return 0;
    }
    if (player->step_ticks == 0) {
        return joint->classic.carried; /* a skipped step changes nothing */
    }
    return joint->classic.through || player->ramp_ticks == 0 ? joint->classic.speed : 0;
}

/* int16(num / divisor) toward zero, then limited. recip: 2^32 / divisor. num below 2^20 in size. */
static int16_t divide_speed(int32_t num, uint16_t divisor, uint32_t recip)
{
    bool negative = num < 0;
    uint32_t size = (uint32_t)(negative ? -num : num);
    uint16_t quotient = SPEED_MAX;
    if (size < (uint32_t)divisor << 10) {
        uint32_t estimate = mul_u32_u16_shift16(recip, (uint16_t)size);
        uint8_t above = (uint8_t)(size >> 16);
        if (above != 0) {
            estimate += recip * above;
        }
        quotient = (uint16_t)(estimate >> 16);
        if (size - (uint32_t)quotient * divisor >= divisor) {
            quotient++;
        }
    } else if (size >= (uint32_t)divisor << 15) {
        negative = !negative; /* the quotient wraps to the other sign before it is limited */
    }
    if (quotient > SPEED_MAX) {
        quotient = SPEED_MAX;
    }
    return (int16_t)(negative ? -(int16_t)quotient : (int16_t)quotient);
}

/* K = M * 2560 / 12 = M * 640 / 3, toward zero. */
static int32_t way_in_speed_units(int16_t way)
{
    uint16_t size = fix_size(way);
    uint16_t third = mul_u16_high(size, 21846u);
    uint8_t rest = (uint8_t)(size - 3 * third);
    int32_t units = (int32_t)((uint32_t)third * 640u) + (rest == 0 ? 0 : rest == 1 ? 213 : 426);
    return way < 0 ? -units : units;
}

static uint16_t stop_divisor(const player_t *player)
{
    uint16_t ticks = player->coming_ticks;
    return ticks == 0 ? 1 : (uint16_t)(4 * (ticks - player->coming_ramp_ticks));
}

static uint16_t through_divisor(const player_t *player)
{
    uint16_t ticks = player->coming_ticks;
    return ticks == 0 ? 1 : (uint16_t)(4 * ticks - 2 * player->coming_ramp_ticks);
}

/* Length and ramp of the coming step; 2^32 over the divisors. */
static void measure_coming(player_t *player, uint16_t longest_way)
{
    player->coming_ticks = step_plan_classic_ticks(&player->coming, longest_way);
    player->coming_ramp_ticks = step_plan_classic_ramp(player->coming.accel_time, &player->coming_ticks);
    player->coming_recip = UINT32_MAX / stop_divisor(player);
    player->through_recip = UINT32_MAX / through_divisor(player);
}

static void prepare_joint(const player_t *player, player_joint_t *joint, int16_t carried)
{
    int32_t num = way_in_speed_units((int16_t)(joint->coming_pos - joint->target_pos));
    if (carried != 0) {
        num -= (int32_t)carried * (2 * player->coming_ramp_ticks);
    }
    joint->stop_speed = divide_speed(num, stop_divisor(player), player->coming_recip);
    joint->through_speed = divide_speed(num, through_divisor(player), player->through_recip);
}

/* Reads the coming step: length, ramp, targets. */
static void look_at_coming(player_t *player)
{
    uint8_t step[PAGE_STEP_BYTES];
    player->source->read(player->source->context, player->coming.page,
                         (uint16_t)(PAGE_STEP_BYTES * player->coming.step), step, PAGE_STEP_BYTES);
    measure_coming(player, player->coming.schedule == PAGE_SCHEDULE_SPEED ? law_longest_way(player, step) : 0);
    player->coming_joints = 0;
    const uint8_t *word = step;
    uint32_t bit = 1;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++, word += 2, bit <<= 1) {
        uint16_t pos = page_word(word);
        if (page_pos_is_used(pos) && (player->present & bit) != 0) {
            player->coming_joints |= bit;
            joint->coming_pos = pos;
        }
    }
}

/* Goes on making the coming step ready: looks at it, or does up to `count` more joints. player->prepared counts both. */
#define PREPARED_ALL (1u + PAGE_JOINTS)
static void prepare(player_t *player, uint8_t count)
{
    if (player->coming.page == 0 || player->prepared >= PREPARED_ALL) {
        return;
    }
    if (player->prepared == 0) {
        look_at_coming(player);
        player->prepared = 1;
        return;
    }
    bool moving = player_is_in_law(player);
    for (; count != 0 && player->prepared < PREPARED_ALL; count--) {
        player_joint_t *joint = &player->joint[player->prepared++ - 1];
        prepare_joint(player, joint, moving ? speed_left(player, joint) : 0);
    }
}

static void prepare_all(player_t *player)
{
    prepare(player, PAGE_JOINTS);
    prepare(player, PAGE_JOINTS); /* in case the first one only looked */
}

/* --- sections ---------------------------------------------------------------------------------------------------- */

static void enter(player_t *player, uint8_t section, uint16_t ticks)
{
    player->section = section;
    player->section_ticks = ticks;
    player->tick = 0;
}

static void begin_joint(player_joint_t *joint, int16_t carried, bool through, uint8_t ramp, uint16_t recip16)
{
    int16_t speed = through ? joint->through_speed : joint->stop_speed;
    joint->classic.base = (int16_t)joint->target_pos;
    joint->classic.main = (int16_t)(joint->coming_pos - joint->target_pos);
    joint->classic.acc = 0;
    joint->classic.through = through;
    joint->classic.speed = speed;
    joint->classic.carried = carried;
    joint->target_pos = joint->coming_pos;
    if (ramp != 0) {
        spread(joint, (int16_t)(speed - carried), ramp, recip16);
    }
}

static bool runs_on(const player_joint_t *joint, uint16_t next_pos)
{
    return (joint->target_pos < joint->coming_pos && joint->coming_pos < next_pos) ||
           (joint->target_pos > joint->coming_pos && joint->coming_pos > next_pos);
}

/* How many joints to make ready in each tick, so that the coming step is ready in time. A short step shares the work
 * out over all its ticks, a longer one over those without a change of section. */
static void share_out_work(player_t *player)
{
    uint16_t ticks = (uint16_t)(player->step_ticks + player->hold_ticks);
    player->every_tick = ticks < 12;
    player->quota = player->every_tick ? (uint8_t)(PAGE_JOINTS / 3 + 1) : ticks < 36 ? 4 : 1;
}

static uint8_t begin_step(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    prepare_all(player);
    uint8_t events = player_next_step(player, link, step);
    events |= player_announce(player);
    uint8_t ramp = player->coming_ramp_ticks;
    uint16_t recip16 = ramp == 0 ? 0 : fix_recip16(ramp);
    uint16_t hold = step_plan_classic_hold(&player->now);
    bool may_run_on = hold == 0 && player_looks_ahead(player);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        uint16_t word = page_word(&step[2 * i]);
        bool through = may_run_on && page_pos_is_used(word) && runs_on(joint, word);
        player->goal_pos[i] = joint->target_pos;
        begin_joint(joint, speed_left(player, joint), through, ramp, recip16);
    }
    player->step_ticks = player->coming_ticks;
    player->ramp_ticks = ramp;
    player->hold_ticks = hold;
    player->prepared = 0;
    share_out_work(player);
    enter(player, SECTION_RISE, ramp);
    return events;
}

/* way * part / whole, toward zero; share = part / whole. The estimate is at most one too small, and what is left of
 * the product below 2 * whole: 16 bits are enough to see which. */
static int16_t share_of(int16_t way, uint16_t part, uint16_t whole, uint16_t share_q0_16)
{
    uint16_t size = fix_size(way);
    uint16_t quotient = mul_u16_high(size, share_q0_16);
    uint16_t left = (uint16_t)((uint16_t)(size * part) - (uint16_t)(quotient * whole));
    if (part != 0 && left >= whole) {
        quotient++;
    }
    return way < 0 ? (int16_t)-(int16_t)quotient : (int16_t)quotient;
}

static void begin_cruise(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t ticks = player->step_ticks, cruise = (uint16_t)(ticks - 2u * ramp), rest = (uint16_t)(ticks - ramp);
    uint16_t share = rest == 0 ? 0 : fix_ratio(cruise, rest), recip16 = cruise == 0 ? 0 : fix_recip16(cruise);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int16_t way = (int16_t)(joint->classic.main - joint->classic.acc), cruise_way;
        if (joint->classic.through) {
            cruise_way = share_of(way, cruise, rest, share);
        } else {
            cruise_way = (int16_t)(way - fall_way(joint->classic.speed, ramp));
        }
        joint->classic.main = cruise_way;
        joint->classic.acc = (int16_t)(way - cruise_way);
        joint->classic.base = (int16_t)player->goal_pos[i];
        if (cruise != 0) {
            spread(joint, cruise_way, cruise, recip16);
        }
    }
    enter(player, SECTION_CRUISE, cruise);
}

static void begin_fall(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t recip16 = ramp == 0 ? 0 : fix_recip16(ramp);
    for (uint8_t i = 0; i < PAGE_JOINTS && ramp != 0; i++) {
        player_joint_t *joint = &player->joint[i];
        joint->classic.base = (int16_t)player->goal_pos[i];
        if (joint->classic.through) {
            joint->classic.main = joint->classic.acc;
            spread(joint, joint->classic.main, ramp, recip16);
        } else {
            joint->classic.carried = joint->classic.speed;
            spread(joint, (int16_t)-joint->classic.speed, ramp, recip16);
        }
    }
    enter(player, SECTION_FALL, ramp);
}

/* `sign`: that of what `spread` spread */
static int16_t ramp_pos(player_joint_t *joint, uint8_t c, uint16_t num, bool negative)
{
    int16_t change = next_share(joint, num, negative);
    int16_t speed = (int16_t)(joint->classic.carried + (change >> 1));
    joint->classic.acc = three_160ths((int32_t)speed * c);
    return limit_pos((int16_t)(joint->classic.base + joint->classic.acc));
}

static int16_t line_pos(player_joint_t *joint, uint16_t num)
{
    return limit_pos((int16_t)(joint->classic.base + next_share(joint, num, joint->classic.main < 0)));
}

static void make_goals(player_t *player)
{
    uint16_t num = player->section_ticks, *goal = player->goal_pos;
    uint8_t section = player->section, c = (uint8_t)player->tick;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t pos;
        if (section == SECTION_RISE) {
            pos = ramp_pos(joint, c, num, joint->classic.speed < joint->classic.carried);
        } else if (section == SECTION_FALL && !joint->classic.through) {
            pos = ramp_pos(joint, c, num, joint->classic.speed > 0);
        } else {
            pos = line_pos(joint, num);
        }
        *goal++ = (uint16_t)pos;
    }
}

/* When nothing follows, the original has begun a step all the same before it finds out: it sends one more tick, the first
 * of a RISE from the last output with the last step's speed and the last section's length. The traces in tests/golden
 * end with it, 0 to 8 units off the target. */
static uint8_t end_play(player_t *player)
{
    uint16_t num = player->section_ticks;
    bool has_tick = num != 0;
    uint16_t recip16 = has_tick ? fix_recip16(num) : 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int16_t speed = joint->classic.speed, carried = speed_left(player, joint);
        joint->classic.base = (int16_t)player->goal_pos[i];
        joint->classic.carried = carried;
        if (has_tick) {
            spread(joint, (int16_t)(speed - carried), num, recip16);
        }
    }
    uint8_t events = player_end(player);
    if (has_tick) {
        player->section = SECTION_RISE;
        player->tick = 1;
        make_goals(player);
        events |= PLAYER_EV_OUTPUT;
    }
    return events;
}

/* The running section is used up. */
static uint8_t next_section(player_t *player, link_t *link)
{
    switch (player->section) {
    case SECTION_RISE:
        begin_cruise(player);
        return 0;
    case SECTION_CRUISE:
        begin_fall(player);
        return 0;
    case SECTION_FALL:
        if (player->hold_ticks != 0) {
            enter(player, SECTION_HOLD, player->hold_ticks);
            return 0;
        }
        break;
    default:
        break;
    }
    if (player->coming.page == 0) {
        return end_play(player);
    }
    return begin_step(player, link);
}

bool classic_is_here(void)
{
    return true;
}

void classic_start(player_t *player)
{
    player->step_ticks = player->hold_ticks = 0;
    player->ramp_ticks = 0;
    player->prepared = 0;
    enter(player, SECTION_HOLD, 0);
    prepare_all(player);
}

uint8_t classic_tick(player_t *player, link_t *link)
{
    uint8_t events = 0;
    bool change = player->tick >= player->section_ticks;
    if (change) {
        events = next_section(player, link);
        if ((events & PLAYER_EV_ENDED) != 0) {
            return events;
        }
    }
    if (player->tick < player->section_ticks) {
        player->tick++;
        if (player->section != SECTION_HOLD) {
            make_goals(player);
            events |= PLAYER_EV_OUTPUT;
        }
    }
    if (!change || player->every_tick) {
        player_quiet_work(player);
        prepare(player, player->quota);
    }
    return events;
}

/* --- breaking and pausing ---------------------------------------------------------------------------------------- */

static uint16_t ticks_left(const player_t *player)
{
    uint16_t left = (uint16_t)(player->section_ticks - player->tick);
    switch (player->section) {
    case SECTION_RISE:
        return (uint16_t)(player->step_ticks - player->tick);
    case SECTION_CRUISE:
        return (uint16_t)(left + player->ramp_ticks);
    case SECTION_FALL:
        return left;
    default:
        return 0;
    }
}

/* Speed at this moment, q12.20. recip28: 2^28 / section_ticks */
static int32_t speed_now(const player_t *player, const player_joint_t *joint, uint32_t recip28)
{
    if (player->section == SECTION_HOLD || player->section_ticks == 0) {
        return 0;
    }
    if (player->section == SECTION_RISE || (player->section == SECTION_FALL && !joint->classic.through)) {
        return (int32_t)(joint->classic.carried + joint->classic.value) * SPEED_UNIT_Q12_20;
    }
    int32_t speed = ((int32_t)fix_size(joint->classic.quotient) << FIX_POS_BITS) +
                    (int32_t)fix_mean(joint->classic.remainder, recip28);
    return joint->classic.main < 0 ? -speed : speed;
}

void classic_freeze(player_t *player)
{
    uint32_t recip28 = player->section_ticks == 0 ? 0 : fix_recip28(player->section_ticks);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int32_t speed = speed_now(player, joint, recip28);
        joint->exact.pos_q12_20 = ((int32_t)player->goal_pos[i] << FIX_POS_BITS) + FIX_POS_ONE / 2;
        joint->exact.speed_q12_20 = speed;
        joint->coming_pos = joint->target_pos; /* not looked at yet */
    }
    player->step_ticks = ticks_left(player);
    if (player->section != SECTION_HOLD) {
        player->tick = 0;
    }
    player->prepared = 0;
}

void classic_prepare_at_rest(player_t *player)
{
    prepare(player, PAGE_JOINTS / 8 + 1);
}

void classic_thaw(player_t *player)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        joint->classic.speed = joint->classic.carried = 0;
        joint->classic.through = false;
    }
    if (player->section != SECTION_HOLD) {
        enter(player, SECTION_FALL, 0); /* used up */
    }
    player->step_ticks = 1; /* not a skipped one */
}
