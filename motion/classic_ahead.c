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

uint8_t classic_left(const player_t *player)
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

static inline void take_targets(player_t *player, const uint8_t *step)
{
    player_joint_t *joint = player->joint;
    const uint8_t *present = (const uint8_t *)&player->present;
    uint8_t *used = (uint8_t *)&player->coming_joints;
    for (uint8_t byte = sizeof player->present; byte != 0; byte--) {
        uint8_t may = *present++, taken = 0, bit = 1, end = byte > 1 ? 0 : 1u << (PAGE_JOINTS % 8);
        do {
            uint16_t word = page_word(step);
            step += 2;
            OPAQUE(word); /* load and step in one */
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

/* Of a joint whose way in the step behind the coming one is known, through_speed says whether it runs through, and
 * stop_speed is the one speed that it then needs. Of the others they are what their names say. */
static RARE void prepare_joints(player_t *player, uint8_t first, uint8_t count)
{
    divider_t by[2] = {{stop_divisor(player), player->coming_recip}, {through_divisor(player), player->through_recip}};
    uint16_t twice_ramp = (uint16_t)(2 * player->coming_ramp_ticks);
    uint8_t carry = player_is_in_law(player) ? classic_left(player) : LEFT_NONE;
    bool known = classic_knows_behind(player), may_run_on = known && step_plan_classic_hold(&player->coming) == 0;
    uint8_t words[2 * AT_ONCE], *at = words;
    if (may_run_on) {
        player->source->read(player->source->context, player->coming.page,
                             (uint16_t)(PAGE_STEP_BYTES * (player->coming.step + 1u) + 2u * first), words,
                             (uint8_t)(2u * count));
    }
    for (player_joint_t *joint = &player->joint[first]; count != 0; count--, joint++) {
        const divider_t *with = by;
        bool negative, through = false;
        if (may_run_on) {
            uint16_t word = page_word(at);
            at += 2;
            OPAQUE(word);
            through = classic_runs_on(joint, word);
            with += through ? 1 : 0;
        }
        joint->through_speed = through;
        uint32_t size = way_to_divide(joint, classic_speed_left(carry, joint), twice_ramp, &negative);
        int16_t *speed = &joint->stop_speed;
        uint8_t left = known ? 1 : 2;
        do {
            int16_t quotient = divide_speed(size, with++);
            *speed++ = negative ? (int16_t)-quotient : quotient;
        } while (--left != 0);
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
    if (count > AT_ONCE && classic_knows_behind(player)) {
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
 * Cycles of a tick without work ahead, 31 joints; a look takes 2,200 (in speed base 3,400), a joint 190 (310 with a
 * speed carried, 380 when the link is not decided), and a frame leaves a tick 8,400, 8,000 with a health poll, 7,000 with
 * slopes:
 *
 *   a step begins, in RISE     5,700 (ramp of 1 tick: 3,000, of 2: 4,300)     later ticks of RISE, FALL    4,100
 *   CRUISE begins              4,600 to 7,600                                 of CRUISE                    1,700
 *   FALL begins                5,700 (as a step)                              prime                        1,700 to 2,800 */
enum { PACE_HURRY, PACE_SHORT, PACE_BRISK, PACE_EASY, PACE_SLOW };

#define RAMP_SHORT 2u

/* Joints to make ready in such a tick. CRUISE begins cheaper when it has one tick, or two behind a ramp of one; FALL
 * behind a short ramp. */
typedef struct {
    uint8_t begin, cruise_of_one, cruise_of_two, cruise_begins, short_fall_begins, fall_begins, cruise, ramp;
} shares_t;

uint8_t classic_pace(uint16_t ticks)
{
    return ticks < 4 ? PACE_HURRY : ticks < 8 ? PACE_SHORT : ticks < 16 ? PACE_BRISK : ticks < 44 ? PACE_EASY : PACE_SLOW;
}

/* When the link behind the coming step is not decided, when it is known where the joints go on to. */
static const shares_t shares[2][PACE_SLOW + 1] PROGMEM = {
    {{7, 14, 14, 14, 10, 10, 10, 10}, {5, 9, 6, 3, 12, 6, 15, 9}, {0, 0, 0, 0, 6, 4, 12, 7}, {0, 0, 0, 0, 0, 0, 4, 4},
     {0, 0, 0, 0, 0, 0, 1, 1}},
    {{7, 14, 14, 14, 10, 10, 10, 10}, {5, 11, 8, 3, 12, 6, 15, 8}, {0, 0, 0, 0, 2, 2, 14, 7}, {0, 0, 0, 0, 0, 0, 4, 4},
     {0, 0, 0, 0, 0, 0, 1, 1}}};

static uint8_t share_now(const player_t *player, bool change, bool begins)
{
    const shares_t *share = &shares[classic_knows_behind(player) ? 1 : 0][player->pace];
    const uint8_t *at;
    if (begins) {
        at = &share->begin;
    } else if (player->section == SECTION_RISE || player->section == SECTION_FALL) {
        bool is_short = player->ramp_ticks <= RAMP_SHORT;
        at = !change ? &share->ramp : is_short ? &share->short_fall_begins : &share->fall_begins;
    } else {
        uint16_t ticks = player->section_ticks;
        bool is_cheap = ticks == 2 && player->ramp_ticks == 1;
        at = !change ? &share->cruise : ticks == 1 ? &share->cruise_of_one : is_cheap ? &share->cruise_of_two
                                                                                     : &share->cruise_begins;
    }
    return pgm_read_byte(at);
}

/* Where a step begins there is only room for a look, and that behind a short ramp; behind a ramp of one tick for joints
 * too, but for few in speed base. */
#define BEGIN_IN_SPEED_BASE 1u
static bool begin_work(player_t *player)
{
    bool hurries = player->pace == PACE_HURRY;
    if (!hurries && (player->pace != PACE_SHORT || player->ramp_ticks > RAMP_SHORT)) {
        return false;
    }
    classic_prepare(player, 0);
    if (player->ramp_ticks < RAMP_SHORT) {
        bool measures = player->coming.schedule == PAGE_SCHEDULE_SPEED;
        classic_prepare(player, measures && !hurries ? BEGIN_IN_SPEED_BASE : share_now(player, true, true));
    }
    return true;
}

bool classic_work_ahead(player_t *player, bool change, bool begins)
{
    if (begins) {
        return begin_work(player);
    }
    bool looks = player->prepared == 0;
    if (!looks || !change || player->pace <= PACE_SHORT) {
        uint8_t share = share_now(player, change, false);
        if (looks || share != 0) {
            classic_prepare(player, share);
        }
    }
    return looks;
}
