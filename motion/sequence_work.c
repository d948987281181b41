/* SPDX-License-Identifier: MIT
 * sequence_work.c - in which tick a step is looked at, shaped and measured, so that no tick takes too long (law.h). */
#include "sequence_parts.h"
#include "shape_step.h"

/* Whether a piece of work is done in this tick: if the tick has time for it, or if there are not more ticks than pieces. */
static bool fits(player_t *player, uint8_t ticks, uint8_t pieces, uint8_t work)
{
    if (PLAYER_LAYERS && pieces < ticks && player->work + work > LAW_WORK_MOST) {
        return false;
    }
    law_work(player, work);
    return true;
}

/* Whether the play may look in this tick. When a main play does depends on itself alone: with a layer and without, the same
 * settings, codes and stops count. */
static bool may_look(player_t *player, uint8_t left, bool begins)
{
    if (PLAYER_LAYERS && player->self == PLAYER_OWNER_LAYER) {
        return fits(player, left, 2, LAW_WORK_LOOK);
    }
    if (left > 1 &&
        (left > SEQUENCE_AHEAD_SHAPED || (begins && left > SHAPE_STEP_SHARES) || !sequence_shapes(player->shape))) {
        return false;
    }
    law_work(player, LAW_WORK_LOOK);
    return true;
}

bool sequence_prepare(player_t *player, link_t *link, uint8_t left, bool begins)
{
    if (!player->looked) {
        if (player->coming.page == 0 || !may_look(player, left, begins)) {
            return false;
        }
        sequence_look(player, link);
    }
    const uint8_t ticks = (uint8_t)(left + begins); /* a tick that has begun a step has little time */
    while (player->shares_left != 0) {
        const uint8_t work = player->shares_left > SHAPE_STEP_SHARES ? LAW_WORK_READ : LAW_WORK_SHARE;
        if (!fits(player, ticks, (uint8_t)(player->shares_left + 1u), work)) {
            return false;
        }
        sequence_shape_a_share(player);
    }
    return !player->measured && fits(player, ticks, 1, LAW_WORK_MEASURE(player));
}
