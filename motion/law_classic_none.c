/* SPDX-License-Identifier: MIT
 * law_classic_none.c - for programs without the classic law. player_start asks classic_is_there first, so no other
 * function of this file is called. */
#include "law.h"

bool classic_is_there(void)
{
    return false;
}

bool classic_is_over(const player_t *player)
{
    return true;
}

uint8_t classic_tick(player_t *player)
{
    return 0;
}

uint8_t classic_last_tick(player_t *player)
{
    return 0;
}

void classic_start(player_t *player) {}
void classic_finish_step(player_t *player) {}
void classic_plan(player_t *player) {}
void classic_begin_section(player_t *player) {}
void classic_leave_step(player_t *player) {}
void classic_take_back(player_t *player) {}
