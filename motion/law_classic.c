/* SPDX-License-Identifier: MIT
 * law_classic.c - the original's law, sample by sample (player.md section 1; names M, N, A, P, K, v, w as there).
 *
 *   speed          ________
 *                /        \        through: v goes on into the next step
 *      w -------/          \       stop: back to 0 in FALL
 *            RISE  CRUISE   FALL  HOLD
 *
 * The original begins a step, plans it and makes its first tick in one call. Here that is spread over three calls (law.h).
 * A tick divides once, c / num for all joints (classic_math.h).
 *
 * Ranges: |M| <= 1023; |v|, |w| <= 1023; acc within +-4893; M - acc within +-5916. */
#include "classic_math.h"
#include "classic_plan.h"

ALWAYS_INLINE void put(player_classic_t *classic, uint16_t *goal, int16_t way)
{
    classic->out_pos = limit_pos((int16_t)(classic->start_pos + way));
    *goal = (uint16_t)classic->out_pos;
}

/* --- from step to step -------------------------------------------------------------------------------------------- */

void classic_start(player_t *player, link_t *link)
{
    sequence_look_first(player);
    sequence_measure(player);
    (void)sequence_take(player);
    classic_enter(player, SECTION_HOLD, 0);
    player->hold_ticks = 0;
    sequence_look(player, link);
    classic_take(player);
    classic_plan_joints(player, PAGE_JOINTS); /* a start is no part of a tick */
}

/* Calls until the step is over. An empty section takes one: without ramps FALL, in a skipped step CRUISE too. */
static uint16_t calls_left(const player_t *player)
{
    uint16_t left = (uint16_t)(player->section_ticks - player->tick);
    switch (player->section) {
    case SECTION_RISE:
        left = (uint16_t)(player->step_ticks - player->tick);
        if (player->ramp_ticks == 0) {
            left = (uint16_t)(left + (left != 0 ? 1u : 2u));
        }
        break;
    case SECTION_CRUISE:
        left = (uint16_t)(left + (player->ramp_ticks != 0 ? player->ramp_ticks : 1u));
        break;
    case SECTION_FALL:
        break;
    default:
        return left;
    }
    return (uint16_t)(left + player->hold_ticks);
}

/* Nothing is to be prepared or taken: the play ends behind this step. */
static bool nothing_follows(const player_t *player)
{
    return !player->looked && player->coming.page == 0;
}

void classic_step_over(player_t *player, link_t *link)
{
    const uint16_t left = calls_left(player);
    law_left(player, left);
    if (!player->arrived && left == 0 && !nothing_follows(player)) {
        (void)sequence_prepare(player, link, 0, false);
        classic_take(player);
    }
}

void classic_prepare(player_t *player, link_t *link)
{
    const uint8_t left = player->left;
    if (player->arrived || left == 0 || left > SEQUENCE_AHEAD || nothing_follows(player)) {
        return;
    }
    if (sequence_prepare(player, link, left, player->section == SECTION_RISE && player->tick == 1)) {
        classic_measure(player);
    }
    if (player->measured && player->section >= SECTION_CRUISE) {
        classic_plan_ahead(player);
    }
}

/* --- a section begins ----------------------------------------------------------------------------------------------- */

/* The speeds that were planned while the joints still needed those of the step before. */
static void take_speeds(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        joint->classic.speed = joint->classic.next_speed;
    }
}

static NOINLINE uint8_t begin_step(player_t *player)
{
    uint8_t events = sequence_announce(player);
    law_work(player, player->own_joints / 4u); /* take_speeds */
    classic_plan_joints(player, PAGE_JOINTS);
    player->planned = 0;
    take_speeds(player);
    classic_enter(player, SECTION_RISE, player->ramp_ticks);
    if (player->ramp_ticks == 0) {
        FOR_OWN_GOALS(player, joint, goal) {
            joint->classic.acc = 0;
            put(&joint->classic, goal, 0);
        }
    }
    return events;
}

static NOINLINE void begin_cruise(player_t *player)
{
    uint8_t ramp = player->ramp_ticks;
    uint16_t ticks = player->step_ticks, cruise = (uint16_t)(ticks - 2u * ramp);
    classic_enter(player, SECTION_CRUISE, cruise);
    if (cruise == 0) {
        return; /* only in a skipped step */
    }
    uint16_t ticks_on = (uint16_t)(ticks - ramp);
    law_work(player, player->own_joints / 2u + 4u);
    part_t part = part_of(cruise, ticks_on);
    FOR_OWN_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->start_pos = classic->out_pos;
        classic->to_go = (int16_t)(classic->to_go - classic->acc);
        if (classic->through) {
            classic->main = share_of(classic->to_go, part);
        } else {
            classic->main = (int16_t)(classic->to_go - fall_way(classic->speed, ramp));
        }
    }
}

static NOINLINE void begin_fall(player_t *player)
{
    classic_enter(player, SECTION_FALL, player->ramp_ticks);
    law_work(player, player->own_joints / 4u);
    FOR_OWN_JOINTS(player, joint) {
        player_classic_t *classic = &joint->classic;
        classic->start_pos = classic->out_pos;
        classic->to_go = (int16_t)(classic->to_go - classic->main);
    }
}

/* --- a tick of a section ------------------------------------------------------------------------------------------- */

static NOINLINE void make_rise(player_t *player)
{
    part_t part = part_of(player->tick, player->section_ticks);
    ramp_share_t share = ramp_share((uint8_t)player->tick);
    FOR_OWN_GOALS(player, joint, goal) {
        player_classic_t *classic = &joint->classic;
        int16_t change = share_of((int16_t)(classic->speed - classic->carried), part);
        classic->acc = ramp_way((int16_t)(classic->carried + (change >> 1)), share);
        put(classic, goal, classic->acc);
    }
}

static NOINLINE void make_cruise(player_t *player)
{
    part_t part = part_of(player->tick, player->section_ticks);
    FOR_OWN_GOALS(player, joint, goal) {
        player_classic_t *classic = &joint->classic;
        put(classic, goal, share_of(classic->main, part));
    }
}

static NOINLINE void make_fall(player_t *player)
{
    part_t part = part_of(player->tick, player->section_ticks);
    ramp_share_t share = ramp_share((uint8_t)player->tick);
    FOR_OWN_GOALS(player, joint, goal) {
        player_classic_t *classic = &joint->classic;
        int16_t way = share_of(classic->through ? classic->to_go : (int16_t)-classic->speed, part);
        if (!classic->through) {
            way = ramp_way((int16_t)(classic->speed + (way >> 1)), share);
        }
        put(classic, goal, way);
    }
}

/* One tick of the running section. An empty section takes the call and makes no output. */
static uint8_t make_tick(player_t *player)
{
    if (player->section_ticks == 0) {
        return 0;
    }
    player->tick++;
    switch (player->section) {
    case SECTION_RISE:
        make_rise(player);
        break;
    case SECTION_CRUISE:
        make_cruise(player);
        break;
    case SECTION_FALL:
        make_fall(player);
        break;
    default:
        return 0;
    }
    return PLAYER_EV_OUTPUT;
}

/* The tick behind the end of a play. The original begins another step before it finds out that nothing follows, and sends
 * its first tick: a RISE from the last output, with the speed of the last step and the length of the last section. The
 * traces in tests/golden end with it, 0 to 8 units off the target. */
static NOINLINE uint8_t end_play(player_t *player)
{
    uint8_t events = law_end_play(player);
    if (player->section_ticks == 0) {
        return events;
    }
    FOR_OWN_JOINTS(player, joint) {
        joint->classic.carried = classic_speed_left(classic_left(player), &joint->classic);
        joint->classic.start_pos = joint->classic.out_pos;
    }
    player->tick = 1;
    make_rise(player);
    return (uint8_t)(events | PLAYER_EV_OUTPUT);
}

/* Begins what follows the section that has ended. false: nothing follows. */
static bool next_section(player_t *player)
{
    if (player->section == SECTION_RISE) {
        begin_cruise(player);
    } else if (player->section == SECTION_CRUISE) {
        begin_fall(player);
    } else if (player->section == SECTION_FALL && player->hold_ticks != 0) {
        classic_enter(player, SECTION_HOLD, player->hold_ticks);
    } else {
        return false;
    }
    return true;
}

uint8_t classic_tick(player_t *player, link_t *link)
{
    uint8_t events = 0;
    law_work(player, player->own_joints / 4u); /* what its tick takes beyond one of the exact law */
    if (player->arrived) {
        events = begin_step(player);
    } else if (player->tick >= player->section_ticks && !next_section(player)) {
        return end_play(player);
    }
    events |= make_tick(player);
    classic_step_over(player, link);
    return events;
}
