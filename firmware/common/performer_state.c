/* SPDX-License-Identifier: MIT
 * performer_state.c - questions about the state of a performer that all its files ask. */
#include "performer_parts.h"

#include "bound.h"

bool performer_is_idle(const performer_t *performer)
{
    return performer->state == PERFORMER_IDLE;
}

bool performer_is_paused(const performer_t *performer)
{
    return performer->state == PERFORMER_APPROACH_PAUSED ||
           (performer->state == PERFORMER_PLAY && player_is_paused(&performer->engine.player));
}

uint32_t performer_usable(const performer_t *performer)
{
    return PERFORMER_SERVOS(performer)->present & ~performer->released;
}
