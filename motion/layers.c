/* SPDX-License-Identifier: MIT */
#include "layers_parts.h"

#include <string.h>
#include "approach.h"

/* hand_over of a joint. WAITS: its owner is about to begin a step that was planned without it. FRESH: the owner has not
 * begun a step with it. FIRST_STEP: the owner plays its first step with it. CATCHES_UP: that step is over; the joint only
 * has to catch up. ASKED_BELOW, ASKED_ABOVE: the same, and the position that the owner asked for last was below or above
 * the joint. */
enum { HAND_OVER_DONE, HAND_OVER_WAITS, HAND_OVER_FRESH, HAND_OVER_FIRST_STEP, HAND_OVER_CATCHES_UP,
       HAND_OVER_ASKED_BELOW, HAND_OVER_ASKED_ABOVE };

/* --- hand-over ---------------------------------------------------------------------------------------------------- */

uint8_t layers_allow(uint16_t *allowance_q8_8, uint16_t speed_q8_8)
{
    uint16_t sum = (uint16_t)(*allowance_q8_8 + speed_q8_8);
    *allowance_q8_8 = sum & 0xFFu;
    return (uint8_t)(sum >> 8);
}

uint16_t layers_approach_by(uint16_t from, uint16_t to, uint8_t most)
{
    if (to > from) {
        return to - from > most ? (uint16_t)(from + most) : to;
    }
    return from - to > most ? (uint16_t)(from - most) : to;
}

/* The joint begins to follow its new owner from where it is. too_late: for the step that begins with the next tick. */
static void follow_from_here(layers_t *layers, uint8_t joint, bool too_late)
{
    layers->main->joint[joint].hand_over = too_late ? HAND_OVER_WAITS : HAND_OVER_FRESH;
    layers->changing = true;
}

void layers_hand_back(layers_t *layers, uint32_t joints)
{
    player_t *main_play = layers->main;
    if (main_play == NULL) {
        return;
    }
    main_play->lent &= ~joints;
    FOR_JOINTS(i, joints) {
        player_give_joint(main_play, i, layers->goal_pos[i]);
        follow_from_here(layers, i, main_play->arrived);
    }
}

/* --- init, bind --------------------------------------------------------------------------------------------------- */

void layers_init(layers_t *layers, uint16_t goal_pos[PAGE_JOINTS])
{
    memset(layers, 0, sizeof *layers);
    layers->goal_pos = goal_pos;
    layers_set_speed(layers, 0);
    layers_forget_code(layers);
}

void layers_set_speed(layers_t *layers, uint16_t deg_s)
{
    layers->speed_q8_8 = layers_units_per_tick_q8_8(deg_s != 0 ? deg_s : APPROACH_SPEED_DEFAULT);
}

static void init_play(layers_t *layers)
{
    player_init(&layers->play, layers->main->source, layers->main->joint, layers->goal_pos);
    layers->play.self = PLAYER_OWNER_LAYER;
}

void layers_bind(layers_t *layers, player_t *main_play)
{
    layers->main = main_play;
    layers->changing = false;
    layers->paused = false;
    memset(&layers->play, 0, sizeof layers->play);
    if (main_play != NULL) {
        init_play(layers);
        main_play->lent = layers->code_joints;
    }
}

/* --- page layer --------------------------------------------------------------------------------------------------- */

static layers_status_t refuse(layers_t *layers, uint8_t page, uint8_t fault, layers_status_t status)
{
    layers->play.fault_page = page;
    layers->play.fault = fault;
    return status;
}

static layers_status_t check_page(layers_t *layers, uint8_t page)
{
    const page_source_t *source = layers->main->source;
    uint8_t header[PAGE_AT_STEPS + 1u];
    if (page == 0 || page >= PAGE_COUNT) {
        return LAYERS_ERR_RANGE;
    }
    uint8_t fault = source->check(source->context, page);
    if (fault != PAGE_OK) {
        return refuse(layers, page, fault, LAYERS_ERR_PAGE);
    }
    source->read(source->context, page, 0, header, sizeof header);
    return page_is_playable(header) ? LAYERS_OK : refuse(layers, page, PAGE_EMPTY, LAYERS_ERR_EMPTY);
}

static uint32_t joints_of_first_step(const layers_t *layers, uint8_t page)
{
    uint16_t pose_pos[PAGE_JOINTS];
    return player_first_pose(layers->main->source, NULL, page, pose_pos);
}

layers_status_t layers_start(layers_t *layers, uint8_t page, uint32_t joints)
{
    if (layers->main == NULL || !player_is_moving(layers->main)) {
        return LAYERS_ERR_IDLE;
    }
    layers_status_t status = check_page(layers, page);
    if (status != LAYERS_OK) {
        return status;
    }
    joints = (joints != 0 ? joints : joints_of_first_step(layers, page)) & layers->main->present & ~layers->code_joints;
    if (joints == 0) {
        return LAYERS_ERR_JOINTS;
    }
    layers_end(layers);
    init_play(layers);
    link_t link;
    link_init(&link, LINK_LATCH);
    if (player_start(&layers->play, &link, page, (player_law_t)layers->main->law, layers->goal_pos, joints) != PLAYER_OK) {
        return LAYERS_ERR_PAGE; /* unreachable: the page has just been checked */
    }
    FOR_JOINTS(i, joints) { /* they belong to the layer already, and its first step is planned from where they are */
        follow_from_here(layers, i, false);
    }
    if (player_is_paused(layers->main)) {
        player_pause(&layers->play);
    }
    return LAYERS_OK;
}

void layers_end(layers_t *layers)
{
    if (layers->main != NULL && player_is_moving(&layers->play)) {
        uint32_t joints = layers->play.present;
        init_play(layers);
        layers_hand_back(layers, joints);
    }
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

/* A joint this near to what its owner asks for has caught up: one that is slower than the owner's page might never meet it
 * exactly. */
#define CAUGHT_UP_POS 1u

/* Whether the position that the owner asks for has passed a joint that catches up since the last tick. Then they have met: a
 * joint much slower than its owner's page might never be near that position at a tick. */
static bool have_met(player_joint_t *joint, uint16_t at, uint16_t asked)
{
    const uint8_t before = joint->hand_over;
    joint->hand_over = asked < at ? HAND_OVER_ASKED_BELOW : HAND_OVER_ASKED_ABOVE;
    return before != HAND_OVER_CATCHES_UP && before != joint->hand_over;
}

/* Where joint i, which changes hands, goes from `from` in this tick, on its way to what its owner asks for. */
static uint16_t follow(layers_t *layers, player_joint_t *joint, uint8_t i, uint16_t from)
{
    const player_t *owner = joint->owner == PLAYER_OWNER_LAYER ? &layers->play : layers->main;
    if (!player_is_moving(owner)) { /* the owner does not play: the joint stays */
        joint->hand_over = HAND_OVER_DONE;
        return from;
    }
    if (joint->hand_over < HAND_OVER_CATCHES_UP && (layers->events[joint->owner] & PLAYER_EV_STEP) != 0) {
        joint->hand_over++;
    }
    uint16_t asked = player_asks(owner, i), goal = layers_approach_by(from, asked, layers->most_pos);
    if (joint->hand_over >= HAND_OVER_CATCHES_UP) {
        goal = have_met(joint, from, asked) ? asked : goal;
        bool near = (uint16_t)(goal - asked + CAUGHT_UP_POS) <= 2u * CAUGHT_UP_POS;
        joint->hand_over = near ? HAND_OVER_DONE : joint->hand_over;
    }
    return goal;
}

static void follow_plays(layers_t *layers, const uint16_t before_pos[PAGE_JOINTS])
{
    player_joint_t *joint = layers->main->joint;
    uint16_t *goal = layers->goal_pos;
    layers->most_pos = layers->paused ? 0 : layers_allow(&layers->allowance_q8_8, layers->speed_q8_8);
    layers->changing = false;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, joint++, goal++) {
        if (joint->hand_over != HAND_OVER_DONE && joint->owner != PLAYER_OWNER_CODE) {
            *goal = follow(layers, joint, i, before_pos[i]);
            layers->changing |= joint->hand_over != HAND_OVER_DONE;
        }
    }
}

/* The layer gets no codes and no stop, so a fresh link_t will do. */
static uint8_t tick_layer(layers_t *layers)
{
    link_t link;
    link_init(&link, LINK_LATCH);
    return player_tick(&layers->play, &link);
}

/* As layers_tick, while something but the main play moves joints. */
static NOINLINE uint8_t tick_all(layers_t *layers, link_t *main_link, uint8_t *layer_events)
{
    uint16_t before_pos[PAGE_JOINTS];
    uint8_t events = 0;
    if (layers->main != NULL) {
        memcpy(before_pos, layers->goal_pos, sizeof before_pos);
        events = player_tick(layers->main, main_link);
        *layer_events = tick_layer(layers);
        if (layers->changing) {
            layers->events[PLAYER_OWNER_MAIN] = events;
            layers->events[PLAYER_OWNER_LAYER] = *layer_events;
            follow_plays(layers, before_pos);
        }
        if ((*layer_events & PLAYER_EV_ENDED) != 0) {
            layers_hand_back(layers, layers->play.present);
        }
    }
    if (!layers->paused) {
        layers_move_by_code(layers);
    }
    *layer_events |= PLAYER_EV_OUTPUT;
    return events;
}

uint8_t layers_tick(layers_t *layers, link_t *main_link, uint8_t *layer_events)
{
    *layer_events = 0;
    if (layers->changing || layers_joints(layers) != 0) {
        return tick_all(layers, main_link, layer_events);
    }
    return layers->main != NULL ? player_tick(layers->main, main_link) : 0;
}

bool layers_are_moving(const layers_t *layers)
{
    bool moving = layers->changing || player_is_moving(&layers->play);
    for (uint8_t i = 0; i < LAYERS_CODE_JOINTS; i++) {
        const layers_code_t *code = &layers->code[i];
        moving |= code->joint != LAYERS_NO_JOINT && (!code->there || code->amplitude_pos != 0);
    }
    return moving;
}

uint32_t layers_joints(const layers_t *layers)
{
    return layers->code_joints | (player_is_moving(&layers->play) ? layers->play.present : 0);
}

/* --- for both kinds ------------------------------------------------------------------------------------------------ */

void layers_drop_joints(layers_t *layers, uint32_t joints)
{
    if (layers->main != NULL) {
        player_drop_joints(&layers->play, joints);
    }
    layers_free(layers, joints);
}

void layers_break(layers_t *layers)
{
    player_break(&layers->play);
    layers_free(layers, layers->code_joints);
}

void layers_pause(layers_t *layers)
{
    player_pause(&layers->play);
    layers->paused = true;
}

void layers_resume(layers_t *layers)
{
    player_resume(&layers->play);
    layers->paused = false;
}
