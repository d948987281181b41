/* SPDX-License-Identifier: MIT
 * performer_shape.c - a second page over the main play, joints moved by code, driving by a program. */
#include "performer_shape.h"

void performer_set_layers(performer_t *performer, layers_t *layers)
{
    performer->layers = layers;
    layers_init(layers, performer->goal_pos);
}

/* Joints join and leave a play at the speed of the approach. */
static void set_speed(performer_t *performer)
{
    layers_set_speed(performer->layers, performer->settings->approach_deg_s);
}

/* ---- a second page ---- */

layers_status_t performer_layer(performer_t *performer, uint8_t page, uint32_t joints)
{
    if (performer->state != PERFORMER_PLAY || performer->leaving || performer_is_paused(performer)) {
        return LAYERS_ERR_IDLE;
    }
    set_speed(performer);
    const layers_status_t status = layers_start(performer->layers, page, joints);
    performer->fault_page = performer->layers->play.fault_page;
    performer->fault = performer->layers->play.fault;
    return status;
}

void performer_layer_off(performer_t *performer)
{
    layers_end(performer->layers);
    performer->slopes_due = true;
}

uint8_t performer_layer_page(const performer_t *performer)
{
    const player_t *play = &performer->layers->play;
    return player_is_moving(play) ? play->now.page : 0;
}

/* ---- code ---- */

layers_status_t performer_take_for_code(performer_t *performer, uint8_t id)
{
    const uint32_t joint = servo_link_bit(id);
    set_speed(performer);
    if (code_motion_slot(&performer->layers->code, id) == NULL) {
        return LAYERS_ERR_FULL;
    }
    if (!performer_is_idle(performer) && performer->leaving) {
        return LAYERS_ERR_BUSY;
    }
    if ((layers_joints(performer->layers) & joint) != 0 || performer->state == PERFORMER_PLAY) {
        return LAYERS_OK; /* its goal is up to date */
    }
    if (!performer_is_idle(performer)) {
        return LAYERS_ERR_BUSY;
    }
    if ((performer_usable(performer) & joint) == 0 || !performer_engage(performer, id)) {
        return LAYERS_ERR_JOINTS;
    }
    return LAYERS_OK;
}

/* ---- for performer*.c ---- */

uint32_t performer_layers_joints(const performer_t *performer)
{
    return layers_joints(performer->layers);
}

bool performer_layers_are_moving(const performer_t *performer)
{
    return layers_are_moving(performer->layers);
}

uint8_t performer_layers_tick(performer_t *performer, bool with_play)
{
    uint8_t of_layer = 0;
    if (!with_play && !layers_are_moving(performer->layers)) {
        return 0;
    }
    const uint8_t events = layers_tick(performer->layers, &performer->link, &of_layer);
    if ((of_layer & (PLAYER_EV_PAGE | PLAYER_EV_ENDED)) != 0) {
        performer->slopes_due = true;
    }
    if ((of_layer & PLAYER_EV_ENDED) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_LAYER_ENDED, performer->layers->play.now.page, 0, 0);
    }
    return (uint8_t)(events | (of_layer & PLAYER_EV_OUTPUT));
}

void performer_layers_plan(performer_t *performer)
{
    layers_plan(performer->layers, &performer->link);
}

void performer_layers_slopes(const performer_t *performer, uint8_t compliance[PAGE_JOINTS])
{
    const player_t *play = &performer->layers->play;
    if (!player_is_moving(play)) {
        return;
    }
    uint8_t of_layer[PAGE_JOINTS];
    performer->source->read(performer->source->context, play->now.page, PAGE_AT_COMPLIANCE, of_layer, sizeof of_layer);
    uint32_t joints = play->present;
    for (uint8_t i = 0; joints != 0; i++, joints >>= 1) {
        if (((uint8_t)joints & 1u) != 0) {
            compliance[i] = of_layer[i];
        }
    }
}

void performer_layers_bind(performer_t *performer, bool with_play)
{
    layers_bind(performer->layers, with_play ? &performer->player : NULL);
}

void performer_layers_drop(performer_t *performer, uint32_t joints)
{
    layers_drop_joints(performer->layers, joints);
}

void performer_layers_break(performer_t *performer)
{
    layers_break(performer->layers);
}

void performer_layers_pause(performer_t *performer, bool pause)
{
    if (pause) {
        layers_pause(performer->layers);
    } else {
        layers_resume(performer->layers);
    }
}

/* ---- driving by a program: if it falls silent, the play stops ---- */

void performer_drive(performer_t *performer, int8_t blend, uint16_t rate, uint8_t amplitude)
{
    performer->shape.blend_percent = blend;
    performer->shape.rate_percent = rate;
    shape_set_amplitude(&performer->shape, amplitude, SERVO_LINK_ALL);
    /* 12.8 ticks per 0.1 s. */
    performer->drive_left_ticks = (uint16_t)(performer->settings->drive_ds * (PLAYER_TICKS_PER_SECOND / 2) / 5);
    performer->is_driven = true;
}

bool performer_drive_is_lost(performer_t *performer)
{
    return performer->drive_left_ticks != 0 && !performer_is_paused(performer) && --performer->drive_left_ticks == 0;
}

void performer_drive_end(performer_t *performer)
{
    if (performer->is_driven) {
        shape_reset(&performer->shape);
    }
    performer->is_driven = false;
    performer->drive_left_ticks = 0;
}

void performer_shape_follow(performer_t *performer)
{
    const uint8_t now_dv = performer->servos->voltage_dv;
    performer->shape.centre_page = performer->settings->centre_page;
    if (now_dv != performer->shape_voltage_dv) {
        performer->shape_voltage_dv = now_dv;
        shape_set_voltage(&performer->shape, now_dv);
    }
}
