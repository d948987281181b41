/* SPDX-License-Identifier: MIT
 * classic_pause.c - the joints' words when a play under the classic law breaks or pauses, and when it goes on. While it
 * slows down, and while the rest of a step is played, they are those of the exact law (law.h: freeze, thaw). */
#include "classic_math.h"
#include "classic_plan.h"

/* 720 / 1024 degrees/s in q16.16 servo units per tick: 0.01875 * 2^16 = 1228.8 */
#define SPEED_UNIT_Q16_16 1229

static uint16_t ticks_left(const player_t *player)
{
    uint16_t left = (uint16_t)(player->section_ticks - player->tick);
    if (player->arrived) {
        return player->step_ticks;
    }
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

/* Speed at this moment, q16.16. */
static int32_t speed_now(const player_t *player, const player_classic_t *classic)
{
    uint16_t num = player->section_ticks;
    if (player->arrived) {
        return (int32_t)classic->carried * SPEED_UNIT_Q16_16;
    }
    if (player->section == SECTION_HOLD || num == 0 || player->tick == 0) {
        return 0;
    }
    if (player->section == SECTION_CRUISE || (player->section == SECTION_FALL && classic->through)) {
        int16_t way = player->section == SECTION_CRUISE ? classic->main : classic->to_go;
        int32_t speed = (int32_t)((uint32_t)fix_from_pos(fix_size(way)) / num);
        return way < 0 ? -speed : speed;
    }
    int16_t from = classic->carried, to = classic->speed;
    if (player->section == SECTION_FALL) {
        from = to;
        to = 0;
    }
    return (int32_t)(from + share_of((int16_t)(to - from), part_of(player->tick, num))) * SPEED_UNIT_Q16_16;
}

void classic_freeze(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        int32_t speed = speed_now(player, &joint->classic);
        uint16_t out_pos = (uint16_t)joint->classic.out_pos;
        joint->exact.pos_q16_16 = fix_from_pos(out_pos) + FIX_ROUND_UP;
        joint->exact.speed_q16_16 = speed;
        joint->exact.exit_q16_16 = 0;
    }
    player->aimed = false;
    player->step_ticks = ticks_left(player);
    if (player->arrived || player->section != SECTION_HOLD) {
        player->tick = 0;
    }
}

void classic_thaw(player_t *player)
{
    FOR_OWN_JOINTS(player, joint) {
        int16_t pos = (int16_t)fix_pos(joint->exact.pos_q16_16);
        int16_t to_go = player->arrived ? (int16_t)((int16_t)joint->target_pos - pos) : 0;
        joint->classic = (player_classic_t){.start_pos = pos, .out_pos = pos, .to_go = to_go, .next_to_go = to_go};
    }
    if (!player->arrived && player->section != SECTION_HOLD) {
        classic_enter(player, SECTION_FALL, 0); /* used up */
    }
    player->planned = 0;
    player->step_ticks = player->arrived ? 0 : 1; /* 0 only where the step is skipped */
}
