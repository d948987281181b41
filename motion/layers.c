/* SPDX-License-Identifier: MIT */
#include "layers.h"

#include <string.h>

void layers_init(layers_t *layers, uint16_t goal_pos[PAGE_JOINTS])
{
    memset(layers, 0, sizeof *layers);
    layers->goal_pos = goal_pos;
    layers_set_speed(layers, 0);
    code_motion_init(&layers->code);
}

void layers_set_speed(layers_t *layers, uint16_t deg_s)
{
    layers->mux.speed.speed_q8_8 = mux_units_per_tick_q8_8(deg_s != 0 ? deg_s : LAYERS_SPEED_DEFAULT_DEG_S);
}

static void init_play(layers_t *layers)
{
    player_init(&layers->play, layers->main != NULL ? layers->main->source : NULL, layers->joint);
}

void layers_bind(layers_t *layers, player_t *main_play)
{
    layers->main = main_play;
    layers->holds = false;
    if (main_play != NULL && player_is_moving(main_play) && layers->code.joints != 0) {
        player_is_there(main_play, layers->code.joints);
    }
    mux_forget(&layers->mux, ~layers->code.joints);
    layers->sought = 0;
    init_play(layers);
}

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
    const uint8_t fault = source->check(source->context, page);
    if (fault != PAGE_OK) {
        return refuse(layers, page, fault, LAYERS_ERR_PAGE);
    }
    source->read(source->context, page, 0, header, sizeof header);
    return page_is_playable(header) ? LAYERS_OK : refuse(layers, page, PAGE_EMPTY, LAYERS_ERR_EMPTY);
}

/* NOINLINE: else the pose lies on the stack while a refusal is printed. */
static NOINLINE uint32_t joints_of_first_step(const layers_t *layers, uint8_t page)
{
    uint16_t pose_pos[PAGE_JOINTS];
    return player_first_pose(layers->main->source, NULL, page, pose_pos);
}

layers_status_t layers_start(layers_t *layers, uint8_t page, uint32_t joints)
{
    if (layers->main == NULL || !player_is_moving(layers->main)) {
        return LAYERS_ERR_IDLE;
    }
    const layers_status_t status = check_page(layers, page);
    if (status != LAYERS_OK) {
        return status;
    }
    joints = (joints != 0 ? joints : joints_of_first_step(layers, page)) & layers->main->present & ~layers->code.joints;
    if (joints == 0) {
        return LAYERS_ERR_JOINTS;
    }
    layers_end(layers);
    if (player_start(&layers->play, NULL, page, PLAYER_LAW_EXACT, layers->goal_pos, joints) != PLAYER_OK) {
        return LAYERS_ERR_PAGE; /* unreachable: the page has just been checked */
    }
    layers->steps_begun = 0;
    mux_change(&layers->mux, joints);
    if (player_is_paused(layers->main)) {
        player_pause(&layers->play);
    }
    player_plan(&layers->play, NULL);
    return LAYERS_OK;
}

/* Their source is the main play again. */
static void hand_back(layers_t *layers, uint32_t joints)
{
    mux_forget(&layers->mux, joints);
    if (layers->main != NULL && player_is_moving(layers->main)) {
        mux_change(&layers->mux, joints & layers->main->present);
    }
}

void layers_end(layers_t *layers)
{
    if (player_is_moving(&layers->play)) {
        const uint32_t joints = layers->play.present;
        init_play(layers);
        hand_back(layers, joints);
    }
}

/* A slot for the joint, which from now on belongs to code. */
static layers_status_t take_for_code(layers_t *layers, uint8_t id, code_slot_t **slot)
{
    const player_t *main_play = layers->main;
    const uint32_t bit = (uint32_t)1 << id;
    if (main_play != NULL && player_is_moving(main_play) && (main_play->present & bit) == 0) {
        return LAYERS_ERR_JOINTS;
    }
    *slot = code_motion_slot(&layers->code, id);
    if (*slot == NULL) {
        return LAYERS_ERR_FULL;
    }
    player_drop_joints(&layers->play, bit);
    mux_change(&layers->mux, bit);
    code_motion_take(&layers->code, *slot, id, layers->mux.speed.speed_q8_8);
    return LAYERS_OK;
}

layers_status_t layers_aim(layers_t *layers, uint8_t id, uint16_t pos, uint16_t deg_s)
{
    code_slot_t *slot;
    const layers_status_t status = take_for_code(layers, id, &slot);
    if (status == LAYERS_OK) {
        slot->centre_pos = pos;
        if (deg_s != 0) {
            slot->speed.speed_q8_8 = mux_units_per_tick_q8_8(deg_s);
        }
    }
    return status;
}

layers_status_t layers_swing(layers_t *layers, uint8_t id, uint16_t centre, uint16_t amplitude, uint16_t period_ticks,
                             uint16_t phase_deg)
{
    code_slot_t *slot;
    const layers_status_t status = take_for_code(layers, id, &slot);
    if (status == LAYERS_OK) {
        code_motion_swing(slot, centre, amplitude, period_ticks, phase_deg);
    }
    return status;
}

void layers_free(layers_t *layers, uint32_t joints)
{
    joints &= layers->code.joints;
    code_motion_free(&layers->code, joints);
    hand_back(layers, joints);
}

/* The goals of the joints that the plays move, from the play that each belongs to. of_layer: joints of the page layer. */
static void follow_plays(layers_t *layers, uint32_t of_layer)
{
    const uint8_t most_pos = layers->holds ? 0 : mux_allow(&layers->mux.speed);
    const uint32_t with_source = ~layers->code.joints & ~layers->mux.seeking;
    player_goals(layers->main, with_source & ~of_layer, layers->goal_pos);
    player_goals(&layers->play, with_source & of_layer, layers->goal_pos);
    uint32_t seeking = layers->mux.seeking & ~layers->code.joints;
    for (uint8_t i = 0; seeking != 0; i++, seeking >>= 1, of_layer >>= 1) {
        if (((uint8_t)seeking & 1u) != 0) {
            const bool is_of_layer = ((uint8_t)of_layer & 1u) != 0;
            const uint16_t asked_pos = player_goal(is_of_layer ? &layers->play : layers->main, i);
            uint16_t *goal = &layers->goal_pos[i];
            *goal = mux_goal(&layers->mux, i, *goal, asked_pos, most_pos, !is_of_layer || layers->steps_begun > 1);
        }
    }
}

static void follow_code(layers_t *layers)
{
    for (code_slot_t *slot = layers->code.slot; slot < &layers->code.slot[CODE_MOTION_JOINTS]; slot++) {
        if (slot->joint != CODE_MOTION_NO_JOINT) {
            uint16_t *goal = &layers->goal_pos[slot->joint];
            const uint16_t asked_pos = code_motion_tick(slot);
            *goal = mux_goal(&layers->mux, slot->joint, *goal, asked_pos, mux_allow(&slot->speed), true);
        }
    }
}

/* As layers_tick, with a main play, while joints have another source or seek theirs. */
static uint8_t tick_plays(layers_t *layers, link_t *main_link, uint8_t *layer_events)
{
    const uint32_t of_layer = player_is_moving(&layers->play) ? layers->play.present : 0;
    const uint8_t events = player_tick(layers->main, main_link);
    layers->sought = layers->mux.seeking;
    *layer_events = player_tick(&layers->play, NULL);
    if ((*layer_events & PLAYER_EV_STEP) != 0 && layers->steps_begun < 2) {
        layers->steps_begun++;
    }
    follow_plays(layers, of_layer);
    if ((*layer_events & PLAYER_EV_ENDED) != 0) {
        hand_back(layers, of_layer);
    }
    if ((events & PLAYER_EV_ENDED) != 0) {
        mux_forget(&layers->mux, ~layers->code.joints); /* nobody moves them any more */
        layers->sought = 0;
    }
    return events;
}

uint8_t layers_tick(layers_t *layers, link_t *main_link, uint8_t *layer_events)
{
    uint8_t events = 0;
    *layer_events = 0;
    if (layers_joints(layers) == 0) {
        if (layers->main != NULL) {
            events = player_tick(layers->main, main_link);
            if ((events & PLAYER_EV_OUTPUT) != 0) {
                player_goals(layers->main, layers->main->present, layers->goal_pos);
            }
        }
        return events;
    }
    if (layers->main != NULL) {
        events = tick_plays(layers, main_link, layer_events);
    }
    if (!layers->holds) {
        follow_code(layers);
    }
    *layer_events |= PLAYER_EV_OUTPUT;
    return events;
}

void layers_plan(layers_t *layers, link_t *main_link)
{
    if (layers->main != NULL) {
        player_plan(layers->main, main_link);
        player_plan(&layers->play, NULL);
    }
}

bool layers_are_moving(const layers_t *layers)
{
    return layers->mux.seeking != 0 || player_is_moving(&layers->play) || code_motion_swings(&layers->code);
}

uint32_t layers_joints(const layers_t *layers)
{
    const uint32_t of_layer = player_is_moving(&layers->play) ? layers->play.present : 0;
    return layers->code.joints | layers->mux.seeking | layers->sought | of_layer;
}

void layers_drop_joints(layers_t *layers, uint32_t joints)
{
    player_drop_joints(&layers->play, joints);
    layers_free(layers, joints);
    mux_forget(&layers->mux, joints);
    layers->sought &= ~joints;
}

void layers_break(layers_t *layers)
{
    player_break(&layers->play);
    layers_free(layers, layers->code.joints);
    layers->holds = layers->main != NULL;
}

void layers_pause(layers_t *layers)
{
    player_pause(&layers->play);
    layers->holds = true;
}

void layers_resume(layers_t *layers)
{
    player_resume(&layers->play);
    layers->holds = false;
}
