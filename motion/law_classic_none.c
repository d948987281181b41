/* SPDX-License-Identifier: MIT
 * law_classic_none.c - for programs without the classic law: linked in place of law_classic.c. player_start asks
 * classic_is_there first, so nothing else of this is ever called. */
#include "law.h"

bool classic_is_there(void)
{
    return false;
}

void classic_stand(player_joint_t *joint, uint16_t pos)
{
}

void classic_start(player_t *player)
{
}

void classic_finish_step(player_t *player)
{
}

void classic_plan(player_t *player, uint32_t used)
{
}

void classic_plan_tick(player_t *player)
{
}

bool classic_is_over(const player_t *player)
{
    return true;
}

uint8_t classic_tick(player_t *player)
{
    return 0;
}

uint8_t classic_last_sample(player_t *player)
{
    return 0;
}

void classic_freeze(player_t *player)
{
}

void classic_thaw(player_t *player)
{
}
