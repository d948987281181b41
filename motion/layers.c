/* SPDX-License-Identifier: MIT */
#include "layers_parts.h"

#include <string.h>
#include "approach.h"
#include "law.h"

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
    if (player_start(&layers->play, &link, page, PLAYER_LAW_EXACT, layers->goal_pos, joints) != PLAYER_OK) {
        return LAYERS_ERR_PAGE; /* unreachable: the page has just been checked */
    }
    FOR_JOINTS(i, joints) { /* they belong to the layer already, and its first step is planned from where they are */
        layers_follow_from_here(layers, i, false);
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

/* Prepares both plays; the second one gets what is left of the tick's time. work: done already. */
static void prepare(player_t *first, link_t *first_link, player_t *second, link_t *second_link, uint8_t work)
{
    first->work = work;
    player_prepare(first, first_link);
    second->work = first->work;
    player_prepare(second, second_link);
}

/* The play whose coming step is nearer comes first. */
static void prepare_both(layers_t *layers, link_t *main_link, link_t *layer_link)
{
    player_t *main_play = layers->main, *layer = &layers->play;
    if (layer->left < main_play->left) {
        prepare(layer, layer_link, main_play, main_link, main_play->work);
    } else {
        prepare(main_play, main_link, layer, layer_link, main_play->work);
    }
}

/* As layers_tick, while something but the main play moves joints. */
static NOINLINE uint8_t tick_all(layers_t *layers, link_t *main_link, uint8_t *layer_events)
{
    uint8_t events = 0;
    if (layers->main != NULL) {
        const bool changing = layers->changing;
        link_t link; /* the layer gets no codes and no stop, so a fresh one will do */
        link_init(&link, LINK_LATCH);
        layers->play.work = changing ? LAW_WORK_FOLLOW : 0;
        *layer_events = player_move(&layers->play, &link);
        layers->main->work = layers->play.work;
        events = player_move(layers->main, main_link);
        prepare_both(layers, main_link, &link);
        if (changing) {
            layers_follow_plays(layers, events, *layer_events);
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
