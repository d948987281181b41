/* SPDX-License-Identifier: MIT
 * performer_start.c - begins a play or a move: whether it can, and the player's own start. */
#include "performer_parts.h"

#include <string.h>
#include "bound.h"
#include "performer_shape.h"

void performer_fresh_player(performer_t *performer)
{
    player_t *player = &performer->engine.player;
    player_init(player, performer->source, performer->engine.joint, performer->goal_pos);
    player_set_shape(player, &performer->shape, performer->shaping);
}

player_status_t performer_start_player(performer_t *performer, uint8_t page, uint32_t joints)
{
    const player_law_t law =
        PERFORMER_SETTINGS(performer)->law == PLAYER_LAW_CLASSIC ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT;
    return player_start(&performer->engine.player, &performer->link, page, law, performer->goal_pos, joints);
}

static performer_status_t somebody_can_move(const performer_t *performer)
{
    if (!performer_is_idle(performer)) {
        return PERFORMER_ERR_BUSY;
    }
    if (PERFORMER_SERVOS(performer)->present == 0) {
        return PERFORMER_ERR_NO_SERVOS;
    }
    return performer_usable(performer) == 0 ? PERFORMER_ERR_RELEASED : PERFORMER_OK;
}

static performer_status_t refusal(performer_t *performer, player_status_t status)
{
    performer->fault = performer->engine.player.fault;
    performer->fault_page = performer->engine.player.fault_page;
    STATIC_ASSERT((int)PERFORMER_ERR_RANGE == (int)PLAYER_ERR_RANGE && (int)PERFORMER_ERR_PAGE == (int)PLAYER_ERR_PAGE &&
                      (int)PERFORMER_ERR_EMPTY == (int)PLAYER_ERR_EMPTY && (int)PERFORMER_ERR_BUSY == (int)PLAYER_ERR_BUSY &&
                      (int)PERFORMER_ERR_LAW == (int)PLAYER_ERR_LAW,
                  "the performer's errors begin with the player's");
    return (performer_status_t)status;
}

static void call_link(performer_t *performer, uint8_t code)
{
    link_init(&performer->link, PERFORMER_SETTINGS(performer)->remote_mode == LINK_HOLD ? LINK_HOLD : LINK_LATCH);
    link_call(&performer->link, code);
}

performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code)
{
    performer_status_t status = somebody_can_move(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    /* Starts a player without joints, to learn whether it accepts the page. */
    performer_shape_follow(performer);
    call_link(performer, code);
    performer_fresh_player(performer);
    status = refusal(performer, performer_start_player(performer, page, 0));
    performer->first_page = performer->engine.player.page;
    performer_fresh_player(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    call_link(performer, code);
    performer->page = page;
    performer->move_deg_s = 0;
    performer->since_stop_ticks = UINT8_MAX;
    performer_get_ready(performer);
    return PERFORMER_OK;
}

performer_status_t performer_move(performer_t *performer, const uint16_t to_pos[PAGE_JOINTS], uint32_t joints,
                                  uint16_t deg_s)
{
    const performer_status_t status = somebody_can_move(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    memcpy(performer->engine.approach.target_pos, to_pos, sizeof performer->engine.approach.target_pos);
    performer->page = 0;
    performer->move_deg_s = deg_s;
    performer->move_joints = joints;
    performer->since_stop_ticks = UINT8_MAX;
    performer_get_ready(performer);
    return PERFORMER_OK;
}
