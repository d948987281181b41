/* SPDX-License-Identifier: MIT
 * law_classic.c - the original's law, sample by sample (player.md section 1; names M, N, A, K, P, v, w as there).
 *
 *   speed          ________
 *                /        \        through: v goes on into the next step
 *      w -------/          \       stop: back to 0 in FALL
 *            RISE  CRUISE   FALL  HOLD
 *
 * Nothing is divided in a tick. x * c / num for c = 1, 2, .. num is a running sum: quotient of x / num each time, and one
 * more whenever the remainders have made up a whole num (`spread`). The factor 144 / 15 >> 9 is 3 / 160, floor.
 * What a step needs that a remote code cannot change any more (its way and both speeds it may take, stopping or going
 * through) is made ready a few joints a tick while the step before is played (`prepare`). Which of the two it is, is
 * only known when it begins, and at the last step of a page that is when the link is decided.
 *
 * Ranges: |M| <= 1023; |v|, |w| <= 1023; acc within +-4893; M - acc within +-5916. */
#include "fix.h"
#include "law.h"
#include "step_plan.h"

#pragma GCC optimize("O2") /* the loops over all joints need it: a quarter fewer cycles for 0.6 KiB of flash */

/* Kept out of line, so that each loop over the joints has the registers for itself. */
#define RARE __attribute__((noinline))

#define SPEED_MAX 1023
/* 720 / 1024 degrees/s in q16.16 servo units per tick: 0.01875 * 2^16 = 1228.8 */
#define SPEED_UNIT_Q16_16 1229

static inline int16_t limit_pos(int16_t pos)
{
    if ((uint16_t)pos > PAGE_POS_MAX) {
        pos = pos < 0 ? 0 : (int16_t)PAGE_POS_MAX;
    }
    return pos;
}

/* acc = floor(3 * speed * c / 160) for |speed| <= 2047, c <= 255, without signs and long shifts: speed and acc are made
 * positive (+ 2048, + 5000), and 3 / 160 is 24 / 256 / 5: a byte dropped, and an exact division by 5 of 16 bits. */
typedef struct {
    uint16_t factor; /* 24 c */
    uint32_t bias;   /* 256 * 5 * 5000 - 24 c * 2048 */
} ramp_share_t;

static ramp_share_t ramp_share(uint8_t c)
{
    uint16_t factor = (uint16_t)(24u * c);
    return (ramp_share_t){factor, 256ul * 5 * 5000 - (uint32_t)factor * 2048};
}

static inline int16_t ramp_way(int16_t speed, ramp_share_t share)
{
    uint16_t fifths = (uint16_t)(((uint32_t)(uint16_t)(speed + 2048) * share.factor + share.bias) >> 8);
    return (int16_t)((mul_u16_high(fifths, 52429u) >> 2) - 5000u);
}

/* int16((v * A * 12 / 5) >> 8): way of a FALL to a stand. The truncated and then floored quotient is 3 v A / 320, of
 * negative products (3 |v| A + 318) / 320 with a minus; 320 is 64 * 5, and / 64 is << 2 and a byte dropped. */
static inline int16_t fall_way(int16_t v, uint16_t thrice_ramp)
{
    uint32_t size = (uint32_t)fix_size(v) * thrice_ramp;
    if (v < 0) {
        size += 318;
    }
    int16_t way = (int16_t)(mul_u16_high((uint16_t)((size << 2) >> 8), 52429u) >> 2);
    return v < 0 ? (int16_t)-way : way;
}

/* x * c / num (toward zero) from now on by next_share, c = 1, 2, ... Toward zero is down for x >= 0 and up below: up is
 * down of the same plus (num - 1) / num, with which the sum of remainders then begins. */
static inline void spread(player_joint_t *joint, int16_t x, uint16_t num, uint16_t recip16)
{
    uint16_t remainder = 0, error = 0;
    int16_t quotient = x;
    if (num != 1) {
        quotient = (int16_t)fix_divide(fix_size(x), num, recip16, &remainder);
        if (x < 0) {
            quotient = (int16_t)-quotient;
            error = (uint16_t)(num - 1);
            if (remainder != 0) {
                quotient--;
                remainder = (uint16_t)(num - remainder);
            }
        }
    }
    joint->classic.quotient = quotient;
    joint->classic.remainder = remainder;
    joint->classic.error = error;
    joint->classic.value = 0;
}

static inline int16_t next_share(player_joint_t *joint, uint16_t num)
{
    int16_t value = (int16_t)(joint->classic.value + joint->classic.quotient);
    uint16_t error = (uint16_t)(joint->classic.error + joint->classic.remainder);
    if (error >= num) {
        error = (uint16_t)(error - num);
        value++;
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

typedef struct {
    uint16_t divisor;
    uint32_t recip; /* 2^32 / divisor, rounded up */
    uint32_t limit; /* divisor * 1024 */
} divider_t;

/* Below this divisor the product with the reciprocal is the quotient: size * divisor < 1024 * divisor^2 < 2^32. */
#define EXACT_BELOW 2048u

/* int16(num / divisor) toward zero, then limited. size: of num, below 2^20. */
static inline int16_t divide_speed(uint32_t size, bool negative, const divider_t *by)
{
    uint16_t quotient = SPEED_MAX;
    if (size < by->limit) {
        uint32_t recip = by->recip, product = mul_u32_u16_shift16(recip, (uint16_t)size);
        uint8_t above = (uint8_t)(size >> 16);
        if (above != 0) { /* then recip is below 2^26 */
            product += (uint32_t)(uint16_t)recip * above + ((uint32_t)(uint16_t)((uint16_t)(recip >> 16) * above) << 16);
        }
        quotient = (uint16_t)(product >> 16);
        if (by->divisor >= EXACT_BELOW && (uint32_t)quotient * by->divisor > size) {
            quotient--;
        }
        if (quotient > SPEED_MAX) {
            quotient = SPEED_MAX;
        }
    } else if (size >> 15 >= by->divisor) {
        negative = !negative; /* the quotient wraps to the other sign before it is limited */
    }
    return (int16_t)(negative ? -(int16_t)quotient : (int16_t)quotient);
}

/* K = M * 2560 / 12 = M * 640 / 3, toward zero. */
static int32_t way_in_speed_units(int16_t way)
{
    uint16_t size = fix_size(way);
    uint16_t third = mul_u16_high(size, 21846u);
    uint8_t rest = (uint8_t)(size - 3 * third);
    int32_t units = (int32_t)(((uint32_t)(third * 5u) << 8) >> 1) + (rest == 0 ? 0 : rest == 1 ? 213 : 426);
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

/* Length and ramp of the coming step; 2^32 over the divisors, rounded up (of 1, in a step that is skipped: 0). */
static void measure_coming(player_t *player, uint16_t longest_way)
{
    player->coming_ticks = step_plan_classic_ticks(&player->coming, longest_way);
    player->coming_ramp_ticks = step_plan_classic_ramp(player->coming.accel_time, &player->coming_ticks);
    player->coming_recip = UINT32_MAX / stop_divisor(player) + 1u;
    player->through_recip = UINT32_MAX / through_divisor(player) + 1u;
}

static inline void prepare_joint(player_joint_t *joint, int16_t carried, uint16_t twice_ramp, const divider_t *stop,
                                 const divider_t *through)
{
    int32_t num = way_in_speed_units((int16_t)(joint->coming_pos - joint->target_pos));
    if (carried != 0) {
        num -= (int32_t)carried * (int16_t)twice_ramp;
    }
    bool negative = num < 0;
    uint32_t size = (uint32_t)(negative ? -num : num);
    joint->stop_speed = size == 0 ? 0 : divide_speed(size, negative, stop);
    joint->through_speed = size == 0 ? 0 : divide_speed(size, negative, through);
}

/* Reads the coming step: length, ramp, targets. */
RARE static void look_at_coming(player_t *player)
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
RARE static void prepare(player_t *player, uint8_t count)
{
    if (player->coming.page == 0 || player->prepared >= PREPARED_ALL) {
        return;
    }
    if (player->prepared == 0) {
        look_at_coming(player);
        player->prepared = 1;
        return;
    }
    divider_t stop = {stop_divisor(player), player->coming_recip, (uint32_t)stop_divisor(player) << 10};
    divider_t through = {through_divisor(player), player->through_recip, (uint32_t)through_divisor(player) << 10};
    uint16_t twice_ramp = (uint16_t)(2 * player->coming_ramp_ticks);
    bool moving = player_is_in_law(player);
    for (; count != 0 && player->prepared < PREPARED_ALL; count--) {
        player_joint_t *joint = &player->joint[player->prepared++ - 1];
        prepare_joint(joint, moving ? speed_left(player, joint) : 0, twice_ramp, &stop, &through);
    }
}

static void prepare_all(player_t *player)
{
    while (player->coming.page != 0 && player->prepared < PREPARED_ALL) {
        prepare(player, PAGE_JOINTS);
    }
}

/* --- sections ---------------------------------------------------------------------------------------------------- */

static void enter(player_t *player, uint8_t section, uint16_t ticks)
{
    player->section = section;
    player->section_ticks = ticks;
    player->tick = 0;
}

static inline bool runs_on(const player_joint_t *joint, uint16_t next_pos)
{
    return (joint->target_pos < joint->coming_pos && joint->coming_pos < next_pos) ||
           (joint->target_pos > joint->coming_pos && joint->coming_pos > next_pos);
}

/* Behind the last tick of a step: the link of a page's last step is decided, and with it which joints run through.
 * Between two steps (primed) a joint has in carried and through what belongs to the step to begin, which leads from
 * target_pos to coming_pos. */
RARE static void prime(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    prepare_all(player);
    player_next_step(player, link, step);
    bool may_run_on = player_looks_ahead(player) && step_plan_classic_hold(&player->now) == 0;
    const uint8_t *at = step;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++, at += 2) {
        uint16_t word = page_word(at);
        joint->classic.carried = speed_left(player, joint);
        joint->classic.through = may_run_on && page_pos_is_used(word) && runs_on(joint, word);
    }
}

/* How many joints to make ready in a tick, so that the coming step is ready in time; a quarter as many where a section
 * changes, none (but in a very short step) where the step begins. */
#define SHORT_TICKS 8u
static uint8_t joints_a_tick(uint16_t ticks)
{
    if (ticks < 4) {
        return 16;
    }
    if (ticks < SHORT_TICKS) {
        return (uint8_t)((PAGE_JOINTS + ticks - 2u) / (ticks - 1u));
    }
    return ticks < 16 ? 9 : ticks < 44 ? 4 : 1;
}

static uint8_t joints_now(const player_t *player, bool change, bool begins)
{
    if (!change || player->step_ticks + player->hold_ticks < SHORT_TICKS) {
        return player->quota;
    }
    return begins || player->prepared == 0 ? 0 : player->quota / 4;
}

static void enter_step(player_t *player)
{
    player->step_ticks = player->coming_ticks;
    player->ramp_ticks = player->coming_ramp_ticks;
    player->hold_ticks = step_plan_classic_hold(&player->now);
    player->prepared = 0;
    player->quota = joints_a_tick((uint16_t)(player->step_ticks + player->hold_ticks));
    enter(player, SECTION_RISE, player->ramp_ticks);
}

/* The tick after: every joint begins on its target with its speed known. */
RARE static uint8_t begin_step(player_t *player)
{
    enter_step(player);
    uint8_t ramp = player->ramp_ticks;
    uint16_t recip16 = ramp == 0 ? 0 : fix_recip16(ramp), *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t from = joint->target_pos, to = joint->coming_pos;
        int16_t speed = joint->classic.through ? joint->through_speed : joint->stop_speed;
        *goal++ = from;
        joint->target_pos = to;
        joint->classic.base = (int16_t)from;
        joint->classic.main = (int16_t)(to - from);
        joint->classic.acc = 0;
        joint->classic.speed = speed;
        if (ramp != 0) {
            spread(joint, (int16_t)(speed - joint->classic.carried), ramp, recip16);
        }
    }
    return player_announce(player);
}

/* way * part / whole, toward zero; share = part / whole. The estimate is at most one too small, and what is left of
 * the product below 2 * whole: 16 bits are enough to see which. */
static inline int16_t share_of(int16_t way, uint16_t part, uint16_t whole, uint16_t share_q0_16)
{
    uint16_t size = fix_size(way);
    uint16_t quotient = mul_u16_high(size, share_q0_16);
    uint16_t left = (uint16_t)((uint16_t)(size * part) - (uint16_t)(quotient * whole));
    if (part != 0 && left >= whole) {
        quotient++;
    }
    return way < 0 ? (int16_t)-(int16_t)quotient : (int16_t)quotient;
}

RARE static void begin_cruise(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t ticks = player->step_ticks, cruise = (uint16_t)(ticks - 2u * ramp), rest = (uint16_t)(ticks - ramp);
    uint16_t thrice_ramp = (uint16_t)(3u * ramp);
    uint16_t share = rest == 0 ? 0 : fix_ratio(cruise, rest), recip16 = cruise == 0 ? 0 : fix_recip16(cruise);
    const uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t way = (int16_t)(joint->classic.main - joint->classic.acc), cruise_way;
        if (joint->classic.through) {
            cruise_way = share_of(way, cruise, rest, share);
        } else {
            cruise_way = (int16_t)(way - fall_way(joint->classic.speed, thrice_ramp));
        }
        joint->classic.main = cruise_way;
        joint->classic.acc = (int16_t)(way - cruise_way);
        joint->classic.base = (int16_t)*goal++;
        if (cruise != 0) {
            spread(joint, cruise_way, cruise, recip16);
        }
    }
    enter(player, SECTION_CRUISE, cruise);
}

RARE static void begin_fall(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t recip16 = ramp == 0 ? 0 : fix_recip16(ramp);
    const uint16_t *goal = player->goal_pos;
    player_joint_t *joint = player->joint;
    for (; ramp != 0 && joint < &player->joint[PAGE_JOINTS]; joint++) {
        joint->classic.base = (int16_t)*goal++;
        int16_t rest = joint->classic.acc; /* of the way */
        if (joint->classic.through) {
            joint->classic.main = rest;
        } else {
            joint->classic.carried = joint->classic.speed;
            rest = (int16_t)-joint->classic.speed; /* of the speed */
        }
        spread(joint, rest, ramp, recip16);
    }
    enter(player, SECTION_FALL, ramp);
}

/* Way since the section began, of a joint whose speed changes. */
static inline int16_t ramp_acc(player_joint_t *joint, ramp_share_t share, uint16_t num)
{
    int16_t change = next_share(joint, num);
    return ramp_way((int16_t)(joint->classic.carried + (change >> 1)), share);
}

static inline int16_t line_pos(player_joint_t *joint, uint16_t num)
{
    return limit_pos((int16_t)(joint->classic.base + next_share(joint, num)));
}

/* One tick of RISE. */
RARE static void make_rise(player_t *player)
{
    uint16_t num = player->section_ticks, *goal = player->goal_pos;
    ramp_share_t share = ramp_share((uint8_t)player->tick);
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t acc = ramp_acc(joint, share, num);
        joint->classic.acc = acc; /* CRUISE takes it from here */
        *goal++ = (uint16_t)limit_pos((int16_t)(joint->classic.base + acc));
    }
}

/* One tick of FALL: joints that stop, and joints that go through. */
RARE static void make_fall(player_t *player)
{
    uint16_t num = player->section_ticks, *goal = player->goal_pos;
    ramp_share_t share = ramp_share((uint8_t)player->tick);
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        bool through = joint->classic.through;
        int16_t way = through ? next_share(joint, num) : ramp_acc(joint, share, num);
        *goal++ = (uint16_t)limit_pos((int16_t)(joint->classic.base + way));
    }
}

/* One tick of CRUISE. */
RARE static void make_cruise(player_t *player)
{
    uint16_t num = player->section_ticks, *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        *goal++ = (uint16_t)line_pos(joint, num);
    }
}

static void make_goals(player_t *player)
{
    switch (player->section) {
    case SECTION_RISE:
        make_rise(player);
        break;
    case SECTION_CRUISE:
        make_cruise(player);
        break;
    default:
        make_fall(player);
        break;
    }
}

/* When nothing follows, the original has begun a step all the same before it finds out: it sends one more tick, the first
 * of a RISE from the last output with the last step's speed and the last section's length. The traces in tests/golden
 * end with it, 0 to 8 units off the target. */
RARE static uint8_t end_play(player_t *player)
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
    prime(player, link); /* the first step, or one behind the rest of an interrupted one */
    return begin_step(player);
}

bool classic_is_here(void)
{
    return true;
}

void classic_start(player_t *player, link_t *link)
{
    player->step_ticks = player->hold_ticks = 0;
    player->ramp_ticks = 0;
    player->prepared = 0;
    enter(player, SECTION_HOLD, 0);
    prime(player, link);
}

/* true when the next call begins a step. */
static bool is_over(const player_t *player)
{
    return player->tick >= player->section_ticks &&
           (player->section == SECTION_HOLD || (player->section == SECTION_FALL && player->hold_ticks == 0));
}

static void work_ahead(player_t *player, uint8_t joints)
{
    if (joints != 0 && !player_quiet_work(player)) {
        prepare(player, joints);
    }
}

uint8_t classic_tick(player_t *player, link_t *link)
{
    uint8_t events = 0;
    bool change = player->tick >= player->section_ticks;
    if (player->held_events != 0) {
        events = begin_step(player);
    } else if (change) {
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
    if (is_over(player) && player->coming.page != 0) {
        prime(player, link);
    } else {
        work_ahead(player, joints_now(player, change, (events & PLAYER_EV_STEP) != 0));
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

/* Speed at this moment, q16.16. recip32: 2^32 / section_ticks */
static int32_t speed_now(const player_t *player, const player_joint_t *joint, uint32_t recip32)
{
    if (player->section == SECTION_HOLD || player->section_ticks == 0) {
        return 0;
    }
    if (player->section == SECTION_RISE || (player->section == SECTION_FALL && !joint->classic.through)) {
        return (int32_t)(joint->classic.carried + joint->classic.value) * SPEED_UNIT_Q16_16;
    }
    return (int32_t)((uint32_t)joint->classic.quotient << FIX_POS_BITS) +
           (int32_t)fix_mean(joint->classic.remainder, recip32);
}

/* Whatever a primed step needs of classic_tick's bookkeeping is done, so that its rest, all of it, can be played. */
static void freeze_primed(player_t *player)
{
    enter_step(player);
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        joint->target_pos = joint->coming_pos;
        joint->classic.value = 0;
        joint->classic.speed = joint->classic.carried;
    }
    player->section_ticks = 1; /* RISE even where the ramp is 0: the speed is `carried` */
}

void classic_freeze(player_t *player)
{
    if (player->held_events != 0) {
        freeze_primed(player);
    }
    uint32_t recip32 = player->section_ticks == 0 ? 0 : fix_recip32(player->section_ticks);
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player_joint_t *joint = &player->joint[i];
        int32_t speed = speed_now(player, joint, recip32);
        joint->exact.pos_q16_16 = ((int32_t)player->goal_pos[i] << FIX_POS_BITS) + FIX_POS_ONE / 2;
        joint->exact.speed_q16_16 = speed;
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
