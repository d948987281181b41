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
    divider_t stop = {stop_divisor(player), player->coming_recip, (uint32_t)stop_divisor(player) << 10};
    divider_t through = {through_divisor(player), player->through_recip, (uint32_t)through_divisor(player) << 10};
    uint16_t twice_ramp = (uint16_t)(2 * player->coming_ramp_ticks);
    bool moving = player_is_in_law(player);
    for (; count != 0 && player->prepared < PREPARED_ALL; count--) {
        player_joint_t *joint = &player->joint[player->prepared++ - 1];
        prepare_joint(joint, moving ? classic_speed_left(player, joint) : 0, twice_ramp, &stop, &through);
    }
}

void classic_prepare_all(player_t *player)
{
    while (player->coming.page != 0 && player->prepared < PREPARED_ALL) {
        classic_prepare(player, PAGE_JOINTS);
    }
}

/* How many joints to make ready in a tick, so that the coming step is ready in time; a quarter as many where a section
 * changes, none (but in a very short step) where the step begins. */
#define SHORT_TICKS 8u
uint8_t classic_joints_a_tick(uint16_t ticks)
{
    if (ticks < 4) {
        return 16;
    }
    if (ticks < SHORT_TICKS) {
        return (uint8_t)((PAGE_JOINTS + ticks - 2u) / (ticks - 1u));
    }
    return ticks < 16 ? 9 : ticks < 44 ? 4 : 1;
}

uint8_t classic_joints_now(const player_t *player, bool change, bool begins)
{
    if (!change || player->step_ticks + player->hold_ticks < SHORT_TICKS) {
        return player->quota;
    }
    return begins || player->prepared == 0 ? 0 : player->quota / 4;
}
