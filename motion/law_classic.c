/* SPDX-License-Identifier: MIT
 * law_classic.c - the law of the original, sample by sample (LAWS.md, "The classic law", has its rules; the letters are
 * those of that page).
 *
 *   speed          ________
 *                /        \        a joint that runs through keeps v in FALL and carries it into the next step;
 *      w -------/          \       one that stops falls from v to 0
 *            RISE  CRUISE   FALL  HOLD
 *              A   N - 2A     A     P    ticks
 *
 * Ranges: |M| <= 1323; |v|, |w|, |g| <= 1023; acc within +-4893; M - acc within +-6216. */
#include "classic_math.h"
#include "law.h"
#include "step_ticks.h"

enum { SECTION_RISE, SECTION_CRUISE, SECTION_FALL, SECTION_HOLD };

#define SPEED_MAX 1023
/* The law's unit of speed, 720 / 1024 degrees/s, in q16.16 servo units a tick: 0.01875 * 2^16 = 1228.8 */
#define SPEED_UNIT_Q16_16 1229

bool classic_is_there(void)
{
    return true;
}

static void rest_at(player_joint_t *joint, uint16_t pos)
{
    joint->classic = (player_classic_t){.start_pos = (int16_t)pos, .out_pos = (int16_t)pos};
}

/* --- sections ----------------------------------------------------------------------------------------------------- */

static void enter(player_t *player, uint8_t section, uint16_t ticks)
{
    player->section = section;
    player->section_ticks = ticks;
    player->section_tick = 0;
}

/* Enters the section after one of the same step. The joints go on from where they are, at the speed they have reached. */
static void change_section(player_t *player, uint8_t section, uint16_t ticks)
{
    const bool has_moved = player->section_ticks != 0;
    enter(player, section, ticks);
    FOR_ALL_JOINTS(player, joint) {
        if (has_moved) {
            joint->classic.start_pos = joint->classic.out_pos;
            joint->classic.entry = joint->classic.reached;
        }
    }
}

/* Enters a section that is used up. */
static void enter_used_up(player_t *player, uint8_t section)
{
    enter(player, section, 0);
    player->section_tick = 1;
}

/* An empty section takes a tick, in which nothing is made. */
static bool is_used_up(const player_t *player)
{
    return player->section_tick >= (player->section_ticks != 0 ? player->section_ticks : 1u);
}

bool classic_is_over(const player_t *player)
{
    return is_used_up(player) &&
           (player->section == SECTION_HOLD || (player->section == SECTION_FALL && player->now.hold_ticks == 0));
}

void classic_start(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        rest_at(joint, joint->target_pos);
    }
    enter_used_up(player, SECTION_HOLD);
}

/* --- a step begins ------------------------------------------------------------------------------------------------ */

void classic_finish_step(player_t *player)
{
    const bool was_hold = player->section == SECTION_HOLD;
    FOR_ALL_JOINTS(player, joint) {
        if (was_hold) {
            joint->classic.reached = 0;
        } else {
            joint->classic.start_pos = (int16_t)joint->target_pos; /* drops what rounding has left */
        }
    }
}

/* A divisor of rule 7. */
typedef struct {
    uint16_t divisor;
    uint32_t recip32;
} divisor_t;

static divisor_t divisor_of(uint16_t divisor)
{
    const uint16_t by = divisor != 0 ? divisor : 1;
    return (divisor_t){by, fix_recip32(by)};
}

/* Rule 7: (K - w * 2A) / divisor. The original has the quotient in 16 bits before it limits it. */
static int16_t speed_of(const player_classic_t *classic, uint8_t ramp, const divisor_t *by)
{
    const uint16_t size_pos = fix_size(classic->distance);   /* longer only from outside the range: see player_start */
    const int32_t speed_units = (int32_t)speed_units_of(size_pos > PAGE_POS_MAX ? PAGE_POS_MAX : size_pos);
    const int32_t gained = (int32_t)classic->entry * (2 * ramp);
    const int32_t dividend = (classic->distance < 0 ? -speed_units : speed_units) - gained;
    const uint32_t size = (uint32_t)(dividend < 0 ? -dividend : dividend);
    const int16_t quotient = (int16_t)divide_speed(size, by->divisor, by->recip32);
    const int16_t speed = (int16_t)(dividend < 0 ? -quotient : quotient);
    return speed > SPEED_MAX ? SPEED_MAX : speed < -SPEED_MAX ? -SPEED_MAX : speed;
}

/* Joints that the step does not use stay where they are. */
static void keep_joints(player_t *player, uint32_t unused)
{
    FOR_JOINTS(player, unused, i, joint) {
        joint->classic = (player_classic_t){.start_pos = joint->classic.start_pos, .out_pos = joint->classic.out_pos};
    }
}

/* Rule 4. Each joint begins with the speed that it has reached. Returns max |M|. */
static uint16_t set_distances(player_t *player)
{
    uint16_t longest = 0;
    FOR_JOINTS(player, player->now.joints, i, joint) {
        player_classic_t *classic = &joint->classic;
        const int16_t to_pos = (int16_t)joint->target_pos, next_pos = (int16_t)player->next_pos[i];
        const int16_t distance = (int16_t)(to_pos - classic->start_pos);
        const bool goes_on = distance > 0 ? next_pos > to_pos : distance < 0 && next_pos < to_pos;
        classic->entry = classic->reached;
        classic->rise_distance = 0;
        classic->distance = distance;
        classic->through = goes_on && player->now.hold_ticks == 0;
        longest = fix_size(distance) > longest ? fix_size(distance) : longest;
    }
    return longest;
}

void classic_plan(player_t *player)
{
    player_step_t *now = &player->now;
    keep_joints(player, player->present & ~now->joints);
    now->hold_ticks = step_ticks_classic_hold(now, &player->carry_q5_11);
    now->ticks = step_ticks_classic(now, set_distances(player), &player->carry_q5_11);
    const uint8_t ramp = player->ramp_ticks = step_ticks_classic_ramp(now->accel_time, &now->ticks);
    const divisor_t stop = divisor_of((uint16_t)(4u * (now->ticks - ramp)));
    const divisor_t through = divisor_of((uint16_t)(4u * now->ticks - 2u * ramp));
    FOR_JOINTS(player, now->joints, i, joint) {
        joint->classic.speed = speed_of(&joint->classic, ramp, joint->classic.through ? &through : &stop);
    }
    enter(player, SECTION_RISE, ramp);
}

/* --- the other sections begin ------------------------------------------------------------------------------------- */

static void begin_cruise(player_t *player)
{
    const uint8_t ramp = player->ramp_ticks;
    const uint16_t ticks = player->now.ticks, cruise = (uint16_t)(ticks - 2u * ramp);
    change_section(player, SECTION_CRUISE, cruise);
    if (cruise == 0) {
        return; /* a skipped step */
    }
    const part_t part = part_of(cruise, (uint16_t)(ticks - ramp));
    FOR_ALL_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        const int16_t left = (int16_t)(classic->distance - classic->rise_distance);
        const int16_t fall = (int16_t)((int32_t)classic->speed * ramp * 12 / 5 >> 8);
        classic->section_distance = classic->through ? share_of(left, part) : (int16_t)(left - fall);
    }
}

static void begin_fall(player_t *player)
{
    change_section(player, SECTION_FALL, player->ramp_ticks);
    FOR_ALL_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->section_distance = (int16_t)(classic->distance - classic->section_distance - classic->rise_distance);
    }
}

/* --- a tick of a section ------------------------------------------------------------------------------------------ */

ALWAYS_INLINE void put(player_classic_t *classic, int16_t distance)
{
    int16_t pos = (int16_t)(classic->start_pos + distance);
    if ((uint16_t)pos > PAGE_POS_MAX) {   /* a joint that started outside may still be there */
        const int16_t end = pos < 0 ? 0 : (int16_t)PAGE_POS_MAX;
        const bool is_outside = pos < 0 ? classic->start_pos < 0 : classic->start_pos > (int16_t)PAGE_POS_MAX;
        pos = is_outside ? pos : end;
    }
    classic->out_pos = pos;
}

/* Covers distance while the speed changes by `change` from w on. Returns the distance. */
ALWAYS_INLINE int16_t ramp_to(player_classic_t *classic, int16_t change, ramp_share_t share)
{
    const int16_t distance = ramp_distance((int16_t)(classic->entry + (change >> 1)), share);
    classic->reached = (int16_t)(classic->entry + change);
    put(classic, distance);
    return distance;
}

static void make_rise(player_t *player)
{
    const part_t part = part_of(player->section_tick, player->section_ticks);
    const ramp_share_t share = ramp_share((uint8_t)player->section_tick);
    FOR_ALL_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->rise_distance = ramp_to(classic, share_of((int16_t)(classic->speed - classic->entry), part), share);
    }
}

static void make_cruise(player_t *player)
{
    const part_t part = part_of(player->section_tick, player->section_ticks);
    FOR_ALL_JOINTS(player, joint) {
        put(&joint->classic, share_of(joint->classic.section_distance, part));
        joint->classic.reached = joint->classic.speed;
    }
}

static void make_fall(player_t *player)
{
    const part_t part = part_of(player->section_tick, player->section_ticks);
    const ramp_share_t share = ramp_share((uint8_t)player->section_tick);
    FOR_ALL_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        if (classic->through) {
            put(classic, share_of(classic->section_distance, part));
            classic->reached = classic->speed;
        } else {
            (void)ramp_to(classic, share_of((int16_t)-classic->entry, part), share);
        }
    }
}

void classic_begin_section(player_t *player)
{
    if (!is_used_up(player)) {
        return;
    }
    if (player->section == SECTION_RISE) {
        begin_cruise(player);
    } else if (player->section == SECTION_CRUISE) {
        begin_fall(player);
    } else if (player->section == SECTION_FALL && player->now.hold_ticks != 0) {
        change_section(player, SECTION_HOLD, player->now.hold_ticks);
    }
}

uint8_t classic_tick(player_t *player)
{
    player->section_tick++;
    if (player->section_ticks == 0 || player->section == SECTION_HOLD) {
        return 0;
    }
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
    return PLAYER_EV_OUTPUT;
}

/* The original begins another step before it finds out that nothing follows, and sends its first tick: a RISE with the speed
 * of the last step, as long as the section before it. */
uint8_t classic_last_tick(player_t *player)
{
    if (player->section_ticks == 0) {
        return 0;
    }
    const bool was_hold = player->section == SECTION_HOLD;
    FOR_ALL_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->entry = was_hold ? 0 : classic->reached;
        classic->start_pos = was_hold ? classic->start_pos : classic->out_pos;
    }
    enter(player, SECTION_RISE, player->section_ticks);
    player->section_tick = 1;
    make_rise(player);
    return PLAYER_EV_OUTPUT;
}

/* --- break, pause, resume --------------------------------------------------------------------------------------- */

static uint16_t ticks_left(const player_t *player)
{
    const uint16_t of_section = is_used_up(player) ? 0 : (uint16_t)(player->section_ticks - player->section_tick);
    switch (player->section) {
    case SECTION_RISE:
        return player->now.ticks != 0 ? (uint16_t)(player->now.ticks - player->section_tick) : 1u;
    case SECTION_CRUISE:
        return (uint16_t)(of_section + player->ramp_ticks);
    case SECTION_FALL:
        return of_section;
    default:
        return 0;
    }
}

/* In q16.16 servo units a tick. */
static int32_t speed_now(const player_t *player, const player_classic_t *classic)
{
    const uint8_t section = player->section;
    if (section == SECTION_HOLD) {
        return 0;
    }
    if (player->section_ticks != 0 && (section == SECTION_CRUISE || (section == SECTION_FALL && classic->through))) {
        const int32_t speed = (int32_t)((uint32_t)fix_from_pos(fix_size(classic->section_distance)) / player->section_ticks);
        return classic->section_distance < 0 ? -speed : speed;
    }
    return (int32_t)classic->reached * SPEED_UNIT_Q16_16;
}

void classic_leave_step(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        const int32_t speed = speed_now(player, &joint->classic);
        const uint16_t pos = (uint16_t)joint->classic.out_pos;
        joint->exact = (player_exact_t){.pos_q16_16 = fix_from_pos(pos) + FIX_ROUND_UP, .speed_q16_16 = speed};
    }
    player->left_ticks = ticks_left(player);
    player->moving_by = PLAYER_LAW_EXACT;
}

void classic_take_back(player_t *player)
{
    FOR_ALL_JOINTS(player, joint) {
        rest_at(joint, fix_pos(joint->exact.pos_q16_16));
    }
    if (player->section != SECTION_HOLD) {
        enter_used_up(player, SECTION_FALL);
    }
    player->moving_by = PLAYER_LAW_CLASSIC;
}
