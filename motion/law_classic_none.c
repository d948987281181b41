/* SPDX-License-Identifier: MIT
 * law_classic_none.c - linked in place of law_classic.c by an image that has no room for it: player_start refuses the
 * classic law, and nothing else here is ever called. */
#include "law.h"

bool classic_is_here(void)
{
    return false;
}

void classic_start(player_t *player, link_t *link)
{
    (void)player;
    (void)link;
}

uint8_t classic_tick(player_t *player, link_t *link)
{
    (void)link;
    return player_end(player);
}

void classic_step_over(player_t *player, link_t *link)
{
    (void)player;
    (void)link;
}

void classic_freeze(player_t *player)
{
    (void)player;
}

void classic_thaw(player_t *player)
{
    (void)player;
}
