/* SPDX-License-Identifier: MIT */
#include "player.h"
#include "fix.h"
#include "law.h"
#include "step_plan.h"

/*          start            last tick of the last page
 *   IDLE --------> PLAYING ---------------------------> IDLE
 *                  |   ^  ^ rest of the step played
 *            pause |   |  +--------------- RESTING
 *            break |   +-- still standing     ^ resume, or at once when it came while BRAKING
 *                  v                          |
 *                BRAKING ------------> STANDING      (a break ends: IDLE)
 */

#define ALL_JOINTS 0x7FFFFFFFu

void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS],
                 uint16_t goal_pos[PAGE_JOINTS])
{
    *player = (player_t){.source = source, .joint = joint, .goal_pos = goal_pos, .self = PLAYER_OWNER_MAIN};
}

void player_set_shape(player_t *player, const shape_t *shape, shape_step_t *shaping)
{
    player->shape = shape;
    player->shaping = shaping;
}

/* --- joints ------------------------------------------------------------------------------------------------------ */

/* Whether the joints' words are those of the classic law at this moment. */
static bool is_classic(const player_t *player)
{
    return LAW_IS_CLASSIC(player) && player->state == STATE_PLAYING;
}

static void stand(const player_t *player, player_joint_t *joint, uint16_t pos)
{
    *joint = (player_joint_t){.target_pos = pos, .owner = joint->owner};
    if (is_classic(player)) {
        joint->classic.start_pos = joint->classic.out_pos = (int16_t)pos;
    } else {
        joint->exact.pos_q16_16 = fix_from_pos(pos);
    }
}

uint16_t player_asks(const player_t *player, const player_joint_t *joint)
{
    return is_classic(player) ? (uint16_t)joint->classic.out_pos : fix_pos(joint->exact.pos_q16_16);
}

void player_give_joint(player_t *player, uint8_t joint, uint16_t pos)
{
    player->joint[joint].owner = player->self;
    stand(player, &player->joint[joint], pos);
    if (PLAYER_LAYERS) {
        exact_plan_given(player, joint);
        player->aimed = false;
    }
}

void player_drop_joints(player_t *player, uint32_t joints)
{
    /* A step that has been looked at has the length that it has with them: the tick in which it is measured depends on a
     * layer, and the timing of the main play may not. */
    if (PLAYER_LAYERS && player->looked && !player->measured) {
        LAW_IS_CLASSIC(player) ? classic_measure(player) : exact_measure(player);
    }
    player->present &= ~joints;
    player->joints &= ~joints;
    player->coming_joints &= ~joints;
    player->looked_joints &= ~joints;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, joints >>= 1) {
        if (((uint8_t)joints & 1u) == 0) {
            continue;
        }
        player->looked_at[i] = PAGE_POS_UNUSED;
        player->coming_pos[i] = player->goal_pos[i];
        if (law_owns(player->self, &player->joint[i])) {
            stand(player, &player->joint[i], player->goal_pos[i]);
        }
    }
}

/* --- start ------------------------------------------------------------------------------------------------------- */

/* A layer takes its own joints only; the main play all that are not lent. Joints that are not there are nobody's, so no tick
 * works for them. */
static void stand_at(player_t *player, const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    bool is_main = !PLAYER_LAYERS || player->self == PLAYER_OWNER_MAIN;
    player->present = present & ALL_JOINTS;
    player->joints = player->coming_joints = 0;
    uint32_t bit = 1;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bit <<= 1) {
        const bool is_there = (present & bit) != 0;
        uint16_t pos = pose_pos[i] > PAGE_POS_MAX ? PAGE_POS_MAX : pose_pos[i];
        player->coming_pos[i] = pos;
        if (PLAYER_LAYERS && is_main && (player->lent & bit) != 0) {
            player->joint[i].owner = PLAYER_OWNER_CODE;
        } else if (is_main || is_there) {
            player->goal_pos[i] = pos;
            player_give_joint(player, i, pos);
            if (PLAYER_LAYERS && !is_there) {
                player->joint[i].owner = PLAYER_OWNER_NONE;
            }
        }
    }
}

player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                             const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    if (player->state != STATE_IDLE) {
        return PLAYER_ERR_BUSY;
    }
    if (page == 0 || page >= PAGE_COUNT) {
        return PLAYER_ERR_RANGE;
    }
    if (law == PLAYER_LAW_CLASSIC && !PLAYER_CLASSIC) {
        return PLAYER_ERR_LAW;
    }
    if (!sequence_start(player, link, page)) {
        return player->fault == PAGE_OK || player->fault == PAGE_EMPTY ? PLAYER_ERR_EMPTY : PLAYER_ERR_PAGE;
    }
    player->law = (uint8_t)law;
    player->page = player->coming.page;
    player->step = 0;
    player->breaking = false;
    player->ramp_ticks = player->planned = 0;
    player->carry_q5_11 = STEP_PLAN_CARRY_START;
    player->state = STATE_PLAYING;
    stand_at(player, pose_pos, present);
    LAW_IS_CLASSIC(player) ? classic_start(player, link) : exact_start(player, link);
    return PLAYER_OK;
}

/* --- slowing down ------------------------------------------------------------------------------------------------ */

/* Begins to slow down; behind the coming tick if joints are ahead, whose words are those behind it. */
static void slow_down(player_t *player)
{
    const bool of_classic = is_classic(player);
    player->state = STATE_BRAKING;
    if (!player->ahead) {
        of_classic ? classic_freeze(player) : exact_freeze(player);
        brake_start(player);
    }
}

/* --- a tick ------------------------------------------------------------------------------------------------------ */

static uint8_t tick_braking(player_t *player)
{
    if (brake_tick(player)) {
        return PLAYER_EV_OUTPUT;
    }
    if (player->breaking) {
        return (uint8_t)(PLAYER_EV_OUTPUT | PLAYER_EV_STANDING | law_end_play(player));
    }
    player->state = STATE_STANDING;
    if (player->resuming) {
        player_resume(player);
        return PLAYER_EV_OUTPUT;
    }
    return PLAYER_EV_OUTPUT | PLAYER_EV_STANDING;
}

static uint8_t tick_resting(player_t *player, link_t *link)
{
    uint8_t events = (uint8_t)(sequence_announce(player) | PLAYER_EV_OUTPUT);
    if (exact_rest_tick(player)) {
        return events;
    }
    player->state = STATE_PLAYING;
    if (LAW_IS_CLASSIC(player)) {
        classic_thaw(player);
        classic_step_over(player, link);
        return events;
    }
    return (uint8_t)(events | exact_step_over(player, link));
}

static uint8_t tick(player_t *player, link_t *link)
{
    switch (player->state) {
    case STATE_PLAYING:
        return LAW_IS_CLASSIC(player) ? classic_tick(player, link) : exact_tick(player, link);
    case STATE_BRAKING:
        return tick_braking(player);
    case STATE_RESTING:
        return tick_resting(player, link);
    case STATE_STANDING:
        return player->breaking ? (uint8_t)(PLAYER_EV_STANDING | law_end_play(player)) : 0;
    default:
        return 0;
    }
}

uint8_t player_move(player_t *player, link_t *link)
{
    const bool slows_behind = player->state == STATE_BRAKING && player->ahead;
    if (slows_behind) {
        player->state = STATE_PLAYING;
    }
    uint8_t events = tick(player, link);
    if (slows_behind && player->state == STATE_PLAYING) {
        slow_down(player);
        player->brake_ticks--; /* this one counts */
        events |= PLAYER_EV_OUTPUT;
    }
    return events;
}

void player_prepare(player_t *player, link_t *link)
{
    if (player->state == STATE_PLAYING) {
        LAW_IS_CLASSIC(player) ? classic_prepare(player, link) : exact_prepare(player, link);
    }
}

uint8_t player_tick(player_t *player, link_t *link)
{
    player->work = 0;
    const uint8_t events = player_move(player, link);
    player_prepare(player, link);
    return events;
}

/* --- break, pause, resume ---------------------------------------------------------------------------------------- */

void player_break(player_t *player)
{
    if (player->state == STATE_PLAYING || player->state == STATE_RESTING) {
        slow_down(player);
    }
    player->breaking = player->state != STATE_IDLE;
}

void player_pause(player_t *player)
{
    player->resuming = false;
    if (player->state == STATE_PLAYING || player->state == STATE_RESTING) {
        slow_down(player);
    }
}

void player_resume(player_t *player)
{
    player->resuming = player->state == STATE_BRAKING;
    if (player->state != STATE_STANDING || player->breaking) {
        return;
    }
    if (exact_rest_start(player)) {
        player->state = STATE_RESTING;
        return;
    }
    player->state = STATE_PLAYING;
    if (LAW_IS_CLASSIC(player)) {
        classic_thaw(player);
    }
}

bool player_is_moving(const player_t *player)
{
    return player->state != STATE_IDLE;
}

bool player_is_paused(const player_t *player)
{
    return (player->state == STATE_BRAKING || player->state == STATE_STANDING) && !player->breaking && !player->resuming;
}
