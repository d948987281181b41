/* SPDX-License-Identifier: MIT
 * classic_ahead.c - makes the coming step of the classic law ready while the running one is played: targets, length, and
 * for each joint both speeds that it may take, stopping at the step's end or going through. Which of the two is only known
 * when the step begins; at the last step of a page that is when the link is decided.
 * (N, A, M, K, v, w as in player.md section 1.) */
#pragma GCC optimize("O2") /* as in law_classic.c */

#include "classic_math.h"
#include "fix.h"
#include "law.h"
#include "pgm.h"
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

uint16_t NOINLINE classic_divide_on(uint16_t rest, uint16_t divisor, uint8_t bit)
{
    uint16_t quotient = 0;
    for (uint8_t left = 16; left != 0; left--) {
        bool over = (rest & 0x8000u) != 0;
        rest = (uint16_t)((uint16_t)(rest << 1) | bit);
        quotient = (uint16_t)(quotient << 1);
        if (over || rest >= divisor) {
            rest = (uint16_t)(rest - divisor);
            quotient |= 1u;
        }
        OPAQUE(left);
    }
    return quotient;
}

/* 2^32 / divisor, rounded up; of 1: 0. */
static uint32_t recip_of(uint16_t divisor)
{
    uint16_t high = (uint16_t)(UINT16_MAX / divisor), rest = (uint16_t)(UINT16_MAX - (uint16_t)(high * divisor));
    return ((uint32_t)high << 16 | classic_divide_on(rest, divisor, 1)) + 1u;
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
    player->coming_recip = recip_of(stop_divisor(player));
    player->through_recip = recip_of(through_divisor(player));
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

/* Of a joint whose way in the step behind the coming one is known, through_speed says whether it runs through, and
 * stop_speed is the one speed that it then needs. Of the others they are what their names say. */
static inline void prepare_known(player_joint_t *joint, int16_t carried, uint16_t twice_ramp, bool through,
                                 const divider_t *by)
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
                         (uint16_t)(PAGE_STEP_BYTES * (player->coming.step + 1u) + 2u * first), words,
                         (uint8_t)(2u * count));
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

/* --- which tick does how much -----------------------------------------------------------------------------------------
 *
 * Cycles of a tick without work ahead, 31 joints; a look takes 2,600 (in speed base 3,800), a joint 195 (280 when the
 * link is not decided), and a frame leaves a tick 8,400, 8,000 with a health poll, 6,300 with slopes:
 *
 *   a step begins, in RISE     5,700 (ramp of 1 tick: 3,000, of 2: 4,300)     later ticks of RISE, FALL    4,100
 *   CRUISE begins              4,600 to 7,600                                 of CRUISE                    1,700
 *   FALL begins                5,700 (as a step)                              prime                        1,700 to 2,800 */
enum { PACE_HURRY, PACE_SHORT, PACE_BRISK, PACE_EASY, PACE_SLOW };

#define RAMP_SHORT 2u

typedef struct {
    uint8_t cruise_begins, long_cruise_begins, fall_begins, cruise, ramp; /* joints to make ready in such a tick */
} shares_t;

uint8_t classic_pace(uint16_t ticks)
{
    return ticks < 4 ? PACE_HURRY : ticks < 8 ? PACE_SHORT : ticks < 16 ? PACE_BRISK : ticks < 44 ? PACE_EASY : PACE_SLOW;
}

static uint8_t share_now(const player_t *player, bool change)
{
    static const shares_t shares[] PROGMEM = {{13, 13, 12, 12, 12}, {11, 3, 12, 16, 8}, {0, 0, 0, 16, 8}, {0, 0, 0, 4, 4},
                                              {0, 0, 0, 1, 1}};
    const shares_t *share = &shares[player->pace];
    bool ramps = player->section == SECTION_RISE || player->section == SECTION_FALL;
    if (change) {
        bool dear = player->section_ticks != 1 && player->ramp_ticks != 1; /* and more cheap ticks follow */
        return pgm_read_byte(ramps ? &share->fall_begins : dear ? &share->long_cruise_begins : &share->cruise_begins);
    }
    return pgm_read_byte(ramps ? &share->ramp : &share->cruise);
}

/* Where a step begins there is only room for a look, and that behind a short ramp. */
#define HURRY_AT_ONCE 6u
static bool begin_work(player_t *player)
{
    bool hurries = player->pace == PACE_HURRY;
    bool looks = hurries || (player->pace == PACE_SHORT && player->ramp_ticks <= RAMP_SHORT);
    if (looks) {
        classic_prepare(player, 0);
    }
    if (hurries) {
        classic_prepare(player, HURRY_AT_ONCE);
    }
    return looks;
}

bool classic_work_ahead(player_t *player, bool change, bool begins)
{
    if (begins) {
        return begin_work(player);
    }
    bool looks = player->prepared == 0;
    if (!looks || !change || player->pace <= PACE_SHORT) {
        uint8_t share = share_now(player, change);
        if (looks || share != 0) {
            classic_prepare(player, share);
        }
    }
    return looks;
}
