/* SPDX-License-Identifier: MIT
 * classic_ahead.c - makes the coming step of the classic law ready while the running one is played: targets, length, and
 * for each joint both speeds that it may take, stopping at the step's end or going through. Which of the two is only known
 * when the step begins; at the last step of a page that is when the link is decided.
 * (N, A, M, K, v, w as in player.md section 1.) */
#pragma GCC optimize("O2") /* as in law_classic.c */

#include "classic_math.h"
#include "fix.h"
#include "law.h"
#include "step_plan.h"

#define SPEED_MAX 1023

typedef struct {
    uint16_t divisor;
    uint32_t recip; /* 2^32 / divisor, rounded up */
} divider_t;

/* Below this divisor the product with the reciprocal is the quotient: size * divisor < 1024 * divisor^2 < 2^32. */
#define EXACT_BELOW 2048u

/* int16(size / divisor), then limited: not negative, or -SPEED_MAX when the quotient wraps before it is limited.
 * size: below 2^20. */
static inline int16_t divide_speed(uint32_t size, const divider_t *by)
{
    uint16_t upper = (uint16_t)(size >> 8), divisor = by->divisor;
    if (upper >> 2 >= divisor) { /* the quotient is 1024 or more */
        return upper >> 7 >= divisor ? -SPEED_MAX : SPEED_MAX;
    }
    uint16_t quotient = mul_u24_u32_shift32(size, by->recip);
    if (divisor >= EXACT_BELOW) {
        if (mul_u16_u16(quotient, divisor) > size) {
            quotient--;
        }
    }
    return (int16_t)quotient;
}

/* K = M * 2560 / 12 = M * 640 / 3, of a way 0..1023: 640 / 3 * 2^16 rounded up is less than 1 / 1023 of a third too much. */
static inline uint32_t way_in_speed_units(uint16_t size)
{
    return mul_u16_u24_shift16(size, 13981014u);
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

speed_left_t classic_left(const player_t *player)
{
    if (player->hold_ticks != 0) {
        return LEFT_NONE;
    }
    if (player->step_ticks == 0) {
        return LEFT_CARRIED; /* a skipped step changes nothing */
    }
    return player->ramp_ticks == 0 ? LEFT_SPEED : LEFT_IF_THROUGH;
}

/* K - w * 2A as a size, and whether it is negative. */
static inline uint32_t way_to_divide(const player_joint_t *joint, int16_t carried, uint16_t twice_ramp, bool *negative)
{
    int16_t way = (int16_t)(joint->coming_pos - joint->target_pos);
    uint32_t size = way_in_speed_units(fix_size(way));
    bool down = way < 0;
    if (carried != 0) {
        uint32_t taken = mul_u16_u16(fix_size(carried), twice_ramp);
        size = (carried < 0) == down ? size - taken : size + taken;
        if ((int32_t)size < 0) {
            size = 0 - size;
            down = !down;
        }
    }
    *negative = down;
    return size;
}

/* Of a joint whose way in the step behind the coming one is known, through_speed says whether it runs through, and stop_speed
 * is the one speed that it then needs. Of the others they are what their names say. */
static inline void prepare_known(player_joint_t *joint, int16_t carried, uint16_t twice_ramp, bool through, const divider_t *by)
{
    bool negative;
    uint32_t size = way_to_divide(joint, carried, twice_ramp, &negative);
    int16_t speed = divide_speed(size, by);
    joint->stop_speed = negative ? (int16_t)-speed : speed;
    joint->through_speed = through;
}

static inline void prepare_both(player_joint_t *joint, int16_t carried, uint16_t twice_ramp, const divider_t by[2])
{
    bool negative;
    uint32_t size = way_to_divide(joint, carried, twice_ramp, &negative);
    int16_t speed = divide_speed(size, &by[0]);
    joint->stop_speed = negative ? (int16_t)-speed : speed;
    speed = divide_speed(size, &by[1]);
    joint->through_speed = negative ? (int16_t)-speed : speed;
}

static inline void take_targets(player_t *player, const uint8_t *word)
{
    player_joint_t *joint = player->joint;
    const uint8_t *present = (const uint8_t *)&player->present;
    uint8_t *used = (uint8_t *)&player->coming_joints, may = 0, bit = 0;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++, word += 2) {
        if (bit == 0) {
            bit = 1;
            may = *present++;
            *used++ = 0;
        }
        uint16_t pos = page_word(word);
        if (page_pos_is_used(pos) && (may & bit) != 0) {
            used[-1] |= bit;
            joint->coming_pos = pos;
        }
        bit = (uint8_t)(bit << 1);
    }
}

/* Reads the coming step: length, ramp, targets. */
RARE static void look_at_coming(player_t *player)
{
    uint8_t step[PAGE_STEP_BYTES];
    player->source->read(player->source->context, player->coming.page,
                         (uint16_t)(PAGE_STEP_BYTES * player->coming.step), step, PAGE_STEP_BYTES);
    measure_coming(player, player->coming.schedule == PAGE_SCHEDULE_SPEED ? law_longest_way(player, step) : 0);
    take_targets(player, step);
}

/* The step behind the coming one is of the same page: where the joints go on to is settled. */
bool classic_knows_behind(const player_t *player)
{
    return player->coming.step < player->coming.steps;
}

/* Goes on making the coming step ready: looks at it, or does up to `count` more joints. player->prepared counts both. */
#define PREPARED_ALL (1u + PAGE_JOINTS)
#define AT_ONCE 16u

static RARE void prepare_joints(player_t *player, uint8_t first, uint8_t count)
{
    divider_t by[2] = {{stop_divisor(player), player->coming_recip}, {through_divisor(player), player->through_recip}};
    uint16_t twice_ramp = (uint16_t)(2 * player->coming_ramp_ticks);
    speed_left_t carry = player_is_in_law(player) ? classic_left(player) : LEFT_NONE;
    player_joint_t *joint = &player->joint[first];
    if (!classic_knows_behind(player)) {
        for (; count != 0; count--, joint++) {
            prepare_both(joint, classic_speed_left(carry, joint), twice_ramp, by);
        }
        return;
    }
    uint8_t words[2 * AT_ONCE], *at = words;
    player->source->read(player->source->context, player->coming.page,
                         (uint16_t)(PAGE_STEP_BYTES * (player->coming.step + 1u) + 2u * first), words, (uint8_t)(2u * count));
    bool may_run_on = step_plan_classic_hold(&player->coming) == 0;
    for (; count != 0; count--, joint++, at += 2) {
        bool through = may_run_on && classic_runs_on(joint, page_word(at));
        prepare_known(joint, classic_speed_left(carry, joint), twice_ramp, through, through ? &by[1] : &by[0]);
    }
}

void classic_prepare(player_t *player, uint8_t count)
{
    if (player->coming.page == 0 || player->prepared >= PREPARED_ALL) {
        return;
    }
    if (player->prepared == 0) {
        look_at_coming(player);
        player->prepared = 1;
        return;
    }
    uint8_t first = (uint8_t)(player->prepared - 1), left = (uint8_t)(PAGE_JOINTS - first);
    if (count > left) {
        count = left;
    }
    if (count > AT_ONCE) {
        count = AT_ONCE;
    }
    player->prepared = (uint8_t)(player->prepared + count);
    prepare_joints(player, first, count);
}

void classic_prepare_all(player_t *player)
{
    while (player->coming.page != 0 && player->prepared < PREPARED_ALL) {
        classic_prepare(player, PAGE_JOINTS);
    }
}

/* How many joints to make ready in a tick, so that the coming step is ready in time; about a fifth as many where a section
 * changes, none (but in a very short step) where the step begins. The short steps have a share for each kind of tick. */
#define SHORT_TICKS 8u
#define SHORT_QUOTA 24u
#define VERY_SHORT_QUOTA 16u
uint8_t classic_joints_a_tick(uint16_t ticks)
{
    if (ticks < 4) {
        return VERY_SHORT_QUOTA;
    }
    return ticks < SHORT_TICKS ? SHORT_QUOTA : ticks < 16 ? 9 : ticks < 44 ? 4 : 1;
}

uint8_t classic_joints_now(const player_t *player, bool change, bool begins)
{
    uint8_t quota = player->quota;
    bool cruises = player->section == SECTION_CRUISE;
    if (change && player->prepared == 0) {
        return quota > 9 ? 1 : 0; /* not a joint, but a look at the step */
    }
    if (quota == VERY_SHORT_QUOTA) {
        return quota;
    }
    if (begins) {
        return 0;
    }
    if (quota == SHORT_QUOTA) {
        return change ? (cruises ? 5 : 9) : cruises ? 18 : 14;
    }
    return change ? (uint8_t)((quota + 1u) / 5u) : quota;
}
