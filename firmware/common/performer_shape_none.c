/* SPDX-License-Identifier: MIT
 * performer_shape_none.c - for images without layers and driving: empty versions of the functions for performer*.c. */
#include "performer_shape.h"

uint32_t performer_layers_joints(const performer_t *performer)
{
    return 0;
}

bool performer_layers_are_moving(const performer_t *performer)
{
    return false;
}

uint8_t performer_layers_tick(performer_t *performer, bool with_play)
{
    const uint8_t events = with_play ? player_tick(&performer->player, &performer->link) : 0;
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        player_goals(&performer->player, UINT32_MAX, performer->goal_pos);
    }
    return events;
}

void performer_layers_plan(performer_t *performer)
{
    player_plan(&performer->player, &performer->link);
}

void performer_layers_slopes(const performer_t *performer, uint8_t compliance[PAGE_JOINTS])
{
}

void performer_layers_bind(performer_t *performer, bool with_play)
{
}

void performer_layers_drop(performer_t *performer, uint32_t joints)
{
}

void performer_layers_break(performer_t *performer)
{
}

void performer_layers_pause(performer_t *performer, bool pause)
{
}

bool performer_drive_is_lost(performer_t *performer)
{
    return false;
}

void performer_drive_end(performer_t *performer)
{
}

void performer_shape_follow(performer_t *performer)
{
}
