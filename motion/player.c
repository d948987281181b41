/* SPDX-License-Identifier: MIT */
#include "player.h"
#include "law.h"
#include "sequence.h"
#include "step_ticks.h"

/*            player_start               last tick of the last step
 *   IDLE -------------------> PLAYING --------------------------> IDLE
 *                             |     ^
 *          wish PAUSE, BREAK  |     | wish GO: what is left of the step is planned
 *                             v     |
 *                          BRAKING -> STOPPED --> (wish BREAK) IDLE
 *
 * break, pause and resume only set the wish. BRAKING ends when all joints have stopped, whatever the wish is by then. */
enum { STATE_IDLE, STATE_PLAYING, STATE_BRAKING, STATE_STOPPED };
enum { WISH_GO, WISH_PAUSE, WISH_BREAK };

#define ALL_JOINTS 0x7FFFFFFFu
#define MOVE_RAMP_TICKS 32u

void player_init(player_t *player, const page_source_t *source, player_joint_t joint[PAGE_JOINTS])
{
    *player = (player_t){.source = source, .joint = joint};
}

/* --- goals -------------------------------------------------------------------------------------------------------- */

static bool moves_by_classic(const player_t *player)
{
    return player->moving_by == PLAYER_LAW_CLASSIC;
}

static uint16_t goal_of(const player_t *player, const player_joint_t *joint)
{
    return moves_by_classic(player) ? (uint16_t)joint->classic.out_pos : fix_pos(joint->exact.pos_q16_16);
}

uint16_t player_goal(const player_t *player, uint8_t joint)
{
    return goal_of(player, &player->joint[joint]);
}

void player_goals(const player_t *player, uint32_t joints, uint16_t goal_pos[PAGE_JOINTS])
{
    FOR_JOINTS(player, joints & player->present, i, joint) {
        goal_pos[i] = goal_of(player, joint);
    }
}

/* --- start, from step to step ------------------------------------------------------------------------------------- */

/* All joints rest on their targets. */
static void rest(player_t *player)
{
    player->carry_q5_11 = STEP_TICKS_CARRY_START;
    if (player->law == PLAYER_LAW_CLASSIC) {
        classic_start(player);
    } else {
        exact_start(player);
    }
}

/* A play begins: all joints rest at pose_pos. */
static void begin_play(player_t *player, player_law_t law, const uint16_t pose_pos[PAGE_JOINTS], uint32_t present)
{
    player->law = player->moving_by = (uint8_t)law;
    player->present = present & ALL_JOINTS;
    player->joints = 0;
    player->state = STATE_PLAYING;
    player->wish = WISH_GO;
    player->is_planned = false;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        player->joint[i].target_pos = pose_pos[i];
    }
    rest(player);
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
    sequence_read_next(player);
    if (law == PLAYER_LAW_EXACT) {
        exact_measure_next(player);
    }
    return PLAYER_OK;
}

void player_is_there(player_t *player, uint32_t joints)
{
    FOR_JOINTS(player, joints, i, joint) {
        joint->target_pos = player->next_pos[i];
    }
    rest(player);
    if (player->law == PLAYER_LAW_EXACT) {
        exact_measure_next(player);
    }
}

uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS])
{
    uint16_t words[PAGE_JOINTS];
    uint32_t joints = 0;
    sequence_read_words(source, shape, page, 1, words);
    for (uint8_t i = PAGE_JOINTS; i-- > 0;) {
        const bool is_used = page_pos_is_used(words[i]);
        joints = joints << 1 | is_used;
        pose_pos[i] = is_used ? words[i] : pose_pos[i];
    }
    return joints;
}

uint16_t player_move(player_t *player, const uint16_t from_pos[PAGE_JOINTS], uint32_t joints, uint16_t deg_s,
                     uint8_t near_pos)
{
    uint16_t longest = 0;
    begin_play(player, PLAYER_LAW_EXACT, from_pos, joints);
    player->joints = player->present;
    FOR_JOINTS(player, player->present, i, joint) {
        const uint16_t distance = fix_distance(joint->target_pos, player->next_pos[i]);
        longest = distance > longest ? distance : longest;
        joint->target_pos = player->next_pos[i];
    }
    if (longest <= near_pos) {
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
    if (player->law == PLAYER_LAW_CLASSIC) {
        classic_finish_step(player);
    }
    player->joints |= player->next.joints;
    FOR_JOINTS(player, player->next.joints, i, joint) {
        joint->target_pos = player->next_pos[i];
    }
    player->begun_events = sequence_advance(player, link);
    if (player->law == PLAYER_LAW_EXACT) {
        sequence_read_next(player);
        exact_measure_next(player);
        exact_plan(player);
    } else if ((player->begun_events & PLAYER_EV_LINK) != 0 && player->link_page != player->next.page) {
        /* The play passes over the page that the link names, or ends there. Rule 4 of LAWS.md looks at it all the same. */
        (void)sequence_read_positions(player, player->link_page, 1);
        classic_plan(player);
        sequence_read_next(player);
    } else {
        sequence_read_next(player);
        classic_plan(player);
    }
}

/* --- plan --------------------------------------------------------------------------------------------------------- */

static bool step_is_over(const player_t *player)
{
    return moves_by_classic(player) ? classic_is_over(player) : exact_is_over(player);
}

static void begin_section(player_t *player)
{
    if (moves_by_classic(player)) {
        classic_begin_section(player);
    } else {
        exact_begin_section(player);
    }
}

static void slow_down(player_t *player)
{
    player->state = STATE_BRAKING;
    if (moves_by_classic(player)) {
        classic_leave_step(player);
    } else {
        exact_leave_step(player);
    }
    exact_brake(player);
}

static void go_on(player_t *player)
{
    player->state = STATE_PLAYING;
    if (!exact_resume(player) && player->law == PLAYER_LAW_CLASSIC) {
        classic_take_back(player);
    }
}

void player_plan(player_t *player, link_t *link)
{
    if (player->is_planned) {
        return;
    }
    player->is_planned = true;
    if (player->state == STATE_STOPPED && player->wish == WISH_GO) {
        go_on(player);
    }
    if (player->state != STATE_PLAYING) {
        return;
    }
    if (step_is_over(player) && player->next.page != 0) {
        begin_step(player, link);
    }
    if (player->wish == WISH_GO) {
        begin_section(player);
    } else {
        slow_down(player);
    }
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

static uint8_t end_play(player_t *player, uint8_t events)
{
    player->state = STATE_IDLE;
    return events | PLAYER_EV_ENDED;
}

static uint8_t tick_of_classic(player_t *player)
{
    /* The original finds out one tick after the last one that nothing follows. */
    return classic_is_over(player) ? end_play(player, classic_last_tick(player)) : classic_tick(player);
}

static uint8_t tick_of_exact(player_t *player)
{
    const uint8_t events = exact_tick(player);
    if (player->law == PLAYER_LAW_CLASSIC) { /* what was left of a step after a pause */
        if (player->tick >= player->now.ticks) {
            classic_take_back(player);
        }
        return events;
    }
    return exact_is_over(player) && player->next.page == 0 ? end_play(player, events) : events;
}

static uint8_t tick_playing(player_t *player)
{
    const uint8_t begun = player->begun_events;
    player->begun_events = 0;
    return begun | (moves_by_classic(player) ? tick_of_classic(player) : tick_of_exact(player));
}

static uint8_t tick_braking(player_t *player)
{
    if (exact_brake_tick(player)) {
        return PLAYER_EV_OUTPUT;
    }
    player->state = STATE_STOPPED;
    switch (player->wish) {
    case WISH_BREAK:
        return end_play(player, PLAYER_EV_OUTPUT | PLAYER_EV_STOPPED);
    case WISH_PAUSE:
        return PLAYER_EV_OUTPUT | PLAYER_EV_STOPPED;
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
    case STATE_STOPPED:
        return player->wish == WISH_BREAK ? end_play(player, PLAYER_EV_STOPPED) : 0;
    default:
        return 0;
    }
}

/* --- break, pause, resume, lost joints ---------------------------------------------------------------------------- */

/* player_plan looks at the wish again before the coming tick. A step that it has begun stays begun. */
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
    player->next.joints &= ~joints;
}
