/* SPDX-License-Identifier: MIT */
#include "player.h"
#include "law.h"
#include "step_plan.h"

/*            player_start               last tick of the last step
 *   IDLE -------------------> PLAYING --------------------------> IDLE
 *                             |     ^
 *          wish PAUSE, BREAK  |     | wish GO: the rest of the step is planned
 *                             v     |
 *                         BRAKING --+--> STANDING --> (wish BREAK) IDLE
 *
 * break, pause and resume only set the wish; player_plan acts on it. */
enum { STATE_IDLE, STATE_PLAYING, STATE_BRAKING, STATE_STANDING };
enum { WISH_GO, WISH_PAUSE, WISH_BREAK };

#define ALL_JOINTS 0x7FFFFFFFu
#define MOVE_RAMP_TICKS 32u

void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS])
{
    *player = (player_t){.source = source, .joint = joint};
}

void player_set_shape(player_t *player, const shape_t *shape)
{
    player->shape = shape;
}

/* --- goals -------------------------------------------------------------------------------------------------------- */

static bool moves_by_classic(const player_t *player)
{
    return player->moving_by == PLAYER_LAW_CLASSIC;
}

static inline uint16_t goal_of(bool by_classic, const player_joint_t *joint)
{
    return by_classic ? (uint16_t)joint->classic.out_pos : fix_pos(joint->exact.pos_q16_16);
}

uint16_t player_goal(const player_t *player, uint8_t joint)
{
    return goal_of(moves_by_classic(player), &player->joint[joint]);
}

void player_goals(const player_t *player, uint32_t joints, uint16_t goal_pos[PAGE_JOINTS])
{
    const bool by_classic = moves_by_classic(player);
    FOR_JOINTS(player, joints & player->present, i, joint) {
        goal_pos[i] = goal_of(by_classic, joint);
    }
}

/* --- start, from step to step ------------------------------------------------------------------------------------- */

/* A play begins: all joints rest at pose_pos. */
static void begin_play(player_t *player, player_law_t law, const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    player->law = player->moving_by = (uint8_t)law;
    player->present = present & ALL_JOINTS;
    player->joints = 0;
    player->state = STATE_PLAYING;
    player->wish = WISH_GO;
    player->is_planned = false;
    player->ramp_ticks = 0;
    player->tick = player->step_ticks = player->hold_ticks = 0;
    player->carry_q5_11 = STEP_PLAN_CARRY_START;
    FOR_ALL_JOINTS(player, joint) {
        const uint16_t pos = *pose_pos > PAGE_POS_MAX ? PAGE_POS_MAX : *pose_pos;
        pose_pos++;
        joint->target_pos = pos;
        moves_by_classic(player) ? classic_stand(joint, pos) : exact_stand(joint, pos);
    }
}

static void look_and_measure(player_t *player)
{
    sequence_look(player);
    if (player->law == PLAYER_LAW_EXACT) {
        exact_measure_next(player);
    }
}

player_status_t player_start(player_t *player, link_t *link, uint8_t page, player_law_t law,
                             const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    if (player->state != STATE_IDLE) {
        return PLAYER_ERR_BUSY;
    }
    if (page == 0 || !page_is_there(page)) {
        return PLAYER_ERR_RANGE;
    }
    if (law == PLAYER_LAW_CLASSIC && !classic_is_there()) {
        return PLAYER_ERR_LAW;
    }
    if (!sequence_start(player, link, page)) {
        return player->fault == PAGE_OK || player->fault == PAGE_EMPTY ? PLAYER_ERR_EMPTY : PLAYER_ERR_PAGE;
    }
    begin_play(player, law, pose_pos, present);
    if (moves_by_classic(player)) {
        classic_start(player);
    }
    look_and_measure(player);
    return PLAYER_OK;
}

uint16_t player_move(player_t *player, const uint16_t from_pos[PAGE_JOINTS], uint32_t joints, uint16_t deg_s)
{
    uint16_t longest = 0;
    begin_play(player, PLAYER_LAW_EXACT, from_pos, joints);
    player->joints = player->present;
    FOR_JOINTS(player, player->present, i, joint) {
        const uint16_t distance = fix_size((int16_t)(player->next_pos[i] - joint->target_pos));
        longest = distance > longest ? distance : longest;
        joint->target_pos = player->next_pos[i];
    }
    if (longest <= PLAYER_NEAR_POS) {
        player->state = STATE_IDLE;
        return 0;
    }
    /* N - A, the ticks of the longest distance at the limit: 1 degree/s is 1024 / 300 / 128 = 2 / 75 servo units a tick. */
    const uint16_t limit = (uint16_t)(2u * deg_s);
    const uint16_t steady = (uint16_t)(((uint32_t)longest * 75u + limit - 1u) / limit);
    const uint8_t ramp = (uint8_t)(steady < MOVE_RAMP_TICKS ? steady : MOVE_RAMP_TICKS);
    const uint16_t ticks = (uint16_t)(steady + ramp);
    player->now = (player_step_t){.accel_time = ramp, .ticks = ticks, .recip32 = fix_recip32(ticks)};
    player->next.page = 0;
    exact_plan(player);
    return ticks;
}

static void begin_step(player_t *player, link_t *link)
{
    if (moves_by_classic(player)) {
        classic_finish_step(player);
    }
    const uint32_t used = player->next_joints;
    player->joints |= used;
    FOR_JOINTS(player, used, i, joint) {
        joint->target_pos = player->next_pos[i];
    }
    player->begun_events = sequence_advance(player, link);
    if (player->law == PLAYER_LAW_CLASSIC) {
        if (sequence_looks_elsewhere(player)) {
            sequence_look_at_named(player);
            classic_plan(player, used);
            sequence_look(player);
        } else {
            sequence_look(player);
            classic_plan(player, used);
        }
    } else {
        look_and_measure(player);
        exact_plan(player);
    }
}

/* --- plan --------------------------------------------------------------------------------------------------------- */

static void slow_down(player_t *player)
{
    player->state = STATE_BRAKING;
    if (moves_by_classic(player)) {
        classic_freeze(player);
    } else {
        exact_stop_steps(player);
    }
    exact_brake(player);
}

static void go_on(player_t *player)
{
    player->state = STATE_PLAYING;
    if (!exact_plan_rest(player) && player->law == PLAYER_LAW_CLASSIC) {
        classic_thaw(player);
    }
}

static bool step_is_over(const player_t *player)
{
    return moves_by_classic(player) ? classic_is_over(player) : exact_is_over(player);
}

void player_plan(player_t *player, link_t *link)
{
    if (player->is_planned) {
        return;
    }
    player->is_planned = true;
    if (player->state == STATE_STANDING && player->wish == WISH_GO) {
        go_on(player);
    }
    if (player->state != STATE_PLAYING) {
        return;
    }
    if (step_is_over(player) && player->next.page != 0) {
        begin_step(player, link);
    }
    if (player->wish != WISH_GO) {
        slow_down(player);
    } else {
        moves_by_classic(player) ? classic_plan_tick(player) : exact_plan_tick(player);
    }
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

static uint8_t end_play(player_t *player)
{
    player->state = STATE_IDLE;
    return PLAYER_EV_ENDED;
}

static uint8_t tick_of_classic(player_t *player)
{
    /* The original finds out one tick after the last one that nothing follows. */
    return classic_is_over(player) ? (uint8_t)(classic_last_sample(player) | end_play(player)) : classic_tick(player);
}

static uint8_t tick_of_exact(player_t *player)
{
    const uint8_t events = exact_tick(player);
    if (player->law == PLAYER_LAW_CLASSIC) { /* the rest of an interrupted step */
        if (player->tick >= player->step_ticks) {
            classic_thaw(player);
        }
        return events;
    }
    return exact_is_over(player) && player->next.page == 0 ? (uint8_t)(events | end_play(player)) : events;
}

static uint8_t tick_playing(player_t *player)
{
    const uint8_t begun = player->begun_events;
    player->begun_events = 0;
    return (uint8_t)(begun | (moves_by_classic(player) ? tick_of_classic(player) : tick_of_exact(player)));
}

static uint8_t tick_braking(player_t *player)
{
    if (exact_brake_tick(player)) {
        return PLAYER_EV_OUTPUT;
    }
    player->state = STATE_STANDING;
    switch (player->wish) {
    case WISH_BREAK:
        return (uint8_t)(PLAYER_EV_OUTPUT | PLAYER_EV_STANDING | end_play(player));
    case WISH_PAUSE:
        return PLAYER_EV_OUTPUT | PLAYER_EV_STANDING;
    default:
        return PLAYER_EV_OUTPUT;
    }
}

uint8_t player_tick(player_t *player, link_t *link)
{
    player_plan(player, link);
    player->is_planned = false;
    switch (player->state) {
    case STATE_PLAYING:
        return tick_playing(player);
    case STATE_BRAKING:
        return tick_braking(player);
    case STATE_STANDING:
        return player->wish == WISH_BREAK ? (uint8_t)(PLAYER_EV_STANDING | end_play(player)) : 0;
    default:
        return 0;
    }
}

/* --- break, pause, resume, lost joints ---------------------------------------------------------------------------- */

/* What was planned for the coming tick is planned anew. */
static void set_wish(player_t *player, uint8_t wish)
{
    player->wish = wish;
    player->is_planned = false;
}

void player_break(player_t *player)
{
    set_wish(player, WISH_BREAK);
}

void player_pause(player_t *player)
{
    if (player->wish == WISH_GO) {
        set_wish(player, WISH_PAUSE);
    }
}

void player_resume(player_t *player)
{
    if (player->wish == WISH_PAUSE) {
        set_wish(player, WISH_GO);
    }
}

bool player_is_moving(const player_t *player)
{
    return player->state != STATE_IDLE;
}

bool player_is_paused(const player_t *player)
{
    return player_is_moving(player) && player->wish == WISH_PAUSE;
}

void player_drop_joints(player_t *player, uint32_t joints)
{
    player->present &= ~joints;
    player->joints &= ~joints;
    player->next_joints &= ~joints;
}
