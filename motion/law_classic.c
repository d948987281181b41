/* SPDX-License-Identifier: MIT
 * law_classic.c - the original's law, sample by sample (player.md section 1; names M, N, A, K, P, v, w as there).
 *
 *   speed          ________
 *                /        \        through: v goes on into the next step
 *      w -------/          \       stop: back to 0 in FALL
 *            RISE  CRUISE   FALL  HOLD
 *
 * Nothing is divided in a tick: x * c / num for c = 1, 2, .. num is a running sum (classic_math.h). What a remote code
 * cannot change any more is made ready while the step before is played (classic_ahead.c). Whether a joint stops or goes
 * through is known when the step before is over, and at the last step of a page that is when the link is decided.
 *
 * Ranges: |M| <= 1023; |v|, |w| <= 1023; acc within +-4893; M - acc within +-5916. */
/* The loops over all joints need it: a quarter fewer cycles for 0.6 KiB of flash. Before the headers, or their inline
 * functions are called. */
#pragma GCC optimize("O2")

#include "classic_math.h"
#include "fix.h"
#include "law.h"
#include "step_plan.h"

/* 720 / 1024 degrees/s in q16.16 servo units per tick: 0.01875 * 2^16 = 1228.8 */
#define SPEED_UNIT_Q16_16 1229

/* --- sections ---------------------------------------------------------------------------------------------------- */

static void enter(player_t *player, uint8_t section, uint16_t ticks)
{
    player->section = section;
    player->section_ticks = ticks;
    player->tick = 0;
}

/* Between two steps (primed) a joint has in carried, through and speed what belongs to the step to begin, which leads from
 * target_pos to coming_pos. */
RARE static void prime_known(player_t *player, uint8_t left)
{
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        joint->classic.carried = classic_speed_left(left, joint);
        joint->classic.speed = joint->stop_speed;
        joint->classic.through = (uint8_t)joint->through_speed;
    }
}

/* The link has been decided. step: the step that it leads to, when the player looks ahead. */
RARE static void prime_decided(player_t *player, uint8_t left, const uint8_t *step)
{
    bool may_run_on = player_looks_ahead(player) && step_plan_classic_hold(&player->now) == 0;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++, step += 2) {
        bool through = may_run_on && classic_runs_on(joint, page_word(step));
        joint->classic.carried = classic_speed_left(left, joint);
        joint->classic.speed = through ? joint->through_speed : joint->stop_speed;
        joint->classic.through = through;
    }
}

/* Behind the last tick of a step: the link of a page's last step is decided, and with it which joints run through. */
RARE static void prime(player_t *player, link_t *link)
{
    uint8_t step[PAGE_STEP_BYTES];
    classic_prepare_all(player);
    bool known = classic_knows_behind(player);
    player->joints |= player->coming_joints;
    player_next_step(player, link, step, known ? PAGE_STEP_AT_PAUSE : 0);
    player->primed = true;
    uint8_t left = classic_left(player);
    known ? prime_known(player, left) : prime_decided(player, left, step);
}

/* Behind a section's first tick. An empty section has none: it uses up a call without output. */
static uint8_t begun(player_t *player, uint8_t events)
{
    if (player->section_ticks == 0) {
        return events;
    }
    player->tick = 1;
    return (uint8_t)(events | PLAYER_EV_OUTPUT);
}

/* The way that a joint makes in the first tick of a ramp, in which its speed changes by so much. */
static inline int16_t first_rise_way(int16_t speed, int16_t change)
{
    return first_ramp_way((int16_t)(speed + (change >> 1)));
}

static void enter_step(player_t *player)
{
    player->step_ticks = player->coming_ticks;
    player->ramp_ticks = player->coming_ramp_ticks;
    player->hold_ticks = step_plan_classic_hold(&player->now);
    player->prepared = 0;
    player->pace = classic_pace((uint16_t)(player->step_ticks + player->hold_ticks));
    enter(player, SECTION_RISE, player->ramp_ticks);
}

/* --- a section begins: what it needs of each joint is set up, and its first tick made, in one loop ------------------ */

/* Every joint begins on its target with its speed known. */
RARE static uint8_t begin_step(player_t *player)
{
    enter_step(player);
    uint8_t ramp = player->ramp_ticks, events = player_announce(player);
    spread_t over = spread_over(ramp);
    uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        uint16_t from = joint->target_pos, to = joint->coming_pos;
        int16_t speed = joint->classic.speed, acc = 0;
        joint->target_pos = to;
        joint->classic.base = (int16_t)from;
        joint->classic.main = (int16_t)(to - from);
        if (ramp != 0) {
            int16_t carried = joint->classic.carried;
            acc = first_rise_way(carried, first_share(joint, (int16_t)(speed - carried), over));
        }
        joint->classic.acc = acc;
        *goal++ = (uint16_t)limit_pos((int16_t)((int16_t)from + acc));
    }
    return begun(player, events);
}

RARE static uint8_t begin_cruise(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t ticks = player->step_ticks, cruise = (uint16_t)(ticks - 2u * ramp), rest = (uint16_t)(ticks - ramp);
    enter(player, SECTION_CRUISE, cruise);
    if (cruise == 0) {
        return 0;
    }
    spread_t over = spread_over(cruise);
    uint16_t share = cruise == rest ? UINT16_MAX : classic_divide_on(cruise, rest, 0), *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t way = (int16_t)(joint->classic.main - joint->classic.acc), fall;
        if (joint->classic.through) {
            fall = (int16_t)(way - share_of(way, cruise, rest, share));
        } else {
            fall = fall_way(joint->classic.speed, ramp);
        }
        joint->classic.acc = fall;
        int16_t base = (int16_t)*goal, first = first_share(joint, (int16_t)(way - fall), over);
        joint->classic.base = base;
        *goal++ = (uint16_t)limit_pos((int16_t)(base + first));
    }
    return begun(player, 0);
}

RARE static uint8_t begin_fall(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    enter(player, SECTION_FALL, ramp);
    if (ramp == 0) {
        return 0;
    }
    spread_t over = spread_over(ramp);
    uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t base = (int16_t)*goal, speed = joint->classic.speed, way = joint->classic.acc;
        bool through = joint->classic.through;
        int16_t first = first_share(joint, through ? way : (int16_t)-speed, over);
        if (!through) {
            joint->classic.carried = speed;
            first = first_rise_way(speed, first);
        }
        joint->classic.base = base;
        *goal++ = (uint16_t)limit_pos((int16_t)(base + first));
    }
    return begun(player, 0);
}

/* --- the other ticks of a section ----------------------------------------------------------------------------------- */

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
    uint8_t events = player_end(player);
    if (num == 0) {
        return events;
    }
    uint8_t left = classic_left(player);
    spread_t over = spread_over(num);
    uint16_t *goal = player->goal_pos;
    for (player_joint_t *joint = player->joint; joint < &player->joint[PAGE_JOINTS]; joint++) {
        int16_t carried = classic_speed_left(left, joint);
        int16_t change = first_share(joint, (int16_t)(joint->classic.speed - carried), over);
        *goal = (uint16_t)limit_pos((int16_t)((int16_t)*goal + first_rise_way(carried, change)));
        goal++;
    }
    return events | PLAYER_EV_OUTPUT;
}

/* The running section is used up. */
static uint8_t next_section(player_t *player, link_t *link)
{
    switch (player->section) {
    case SECTION_RISE:
        return begin_cruise(player);
    case SECTION_CRUISE:
        return begin_fall(player);
    case SECTION_FALL:
        if (player->hold_ticks != 0) {
            enter(player, SECTION_HOLD, player->hold_ticks);
            player->tick = 1;
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

/* Slopes and health polls wait for a tick with less to do. In a step of three ticks that is its last, shorter ones have
 * none. */
static bool may_wait(const player_t *player)
{
    uint16_t ticks = player->step_ticks;
    return ticks > 3 || (ticks == 3 && player->section != SECTION_FALL);
}

/* true when the next call begins a step. */
static bool is_over(const player_t *player)
{
    return player->tick >= player->section_ticks &&
           (player->section == SECTION_HOLD || (player->section == SECTION_FALL && player->hold_ticks == 0));
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
    } else {
        player->tick++;
        if (player->section != SECTION_HOLD) {
            make_goals(player);
            events = PLAYER_EV_OUTPUT;
        }
    }
    bool busy = change;
    if (is_over(player) && player->coming.page != 0) {
        prime(player, link);
        busy = true;
    } else if (classic_work_ahead(player, change, (events & PLAYER_EV_STEP) != 0)) {
        busy = true;
    }
    return busy && may_wait(player) ? (uint8_t)(events | PLAYER_EV_BUSY) : events;
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
    if (player->section_ticks == 1) {
        return (int32_t)((uint32_t)joint->classic.value << FIX_POS_BITS);
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
    classic_prepare(player, PAGE_JOINTS / 8 + 1);
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
