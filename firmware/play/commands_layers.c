/* SPDX-License-Identifier: MIT
 * commands_layers.c - layer, aim, swing, free: a second page over the play, and joints moved by code (performer_shape.h). */
#include "commands_parts.h"

#include "performer_shape.h"
#include "pgm.h"
#include "text.h"

static uint8_t answer_of(layers_status_t status)
{
    switch (status) {
    case LAYERS_OK:
        return REQUEST_OK;
    case LAYERS_ERR_PAGE:
        return requests_refusal(PERFORMER_ERR_PAGE);
    case LAYERS_ERR_EMPTY:
        return requests_refusal(PERFORMER_ERR_EMPTY);
    case LAYERS_ERR_JOINTS:
        return requests_refuse(REQUEST_ERR_SERVOS, TEXT_P("None of these servos can be moved"));
    case LAYERS_ERR_FULL:
        return requests_refuse(REQUEST_ERR_FULL, TEXT_P("Four joints are moved already: free one"));
    case LAYERS_ERR_BUSY:
        return SHELL_ERR_MOVING;
    case LAYERS_ERR_RANGE:
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Too far or too fast"));
    default:
        return requests_refuse(REQUEST_ERR_IDLE, TEXT_P("Nothing is playing"));
    }
}

uint8_t commands_do_layer(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t page;
    uint32_t joints = 0;
    if (args->count == 2 && shell_word_is(args, 1, PSTR("off"))) {
        performer_layer_off(&play->performer);
        return REQUEST_OK;
    }
    if (!shell_take(args, 1, RANGE_PLAYED, &page)) {
        return SHELL_ERR_RANGE;
    }
    if (args->count > 2) {
        const uint8_t status = requests_take_joints(args, 2, &joints);
        if (status != REQUEST_OK) {
            return status;
        }
    }
    return answer_of(performer_layer(&play->performer, (uint8_t)page, joints));
}

uint8_t commands_do_aim(void *context, const shell_args_t *args)
{
    play_t *play = context;
    const uint8_t id = (uint8_t)args->number[0];
    uint16_t deg_s = 0;
    if (args->count > 3 && !shell_take(args, 3, RANGE_DEG_S, &deg_s)) {
        return SHELL_ERR_RANGE;
    }
    const layers_status_t status = performer_take_for_code(&play->performer, id);
    return answer_of(status != LAYERS_OK ? status : layers_aim(&play->layers, id, args->number[1], deg_s));
}

/* id centre amplitude ms [phase] */
uint8_t commands_do_swing(void *context, const shell_args_t *args)
{
    play_t *play = context;
    const uint8_t id = (uint8_t)args->number[0];
    uint16_t amplitude, ms, phase_deg = 0;
    if (!shell_take(args, 3, RANGE_POSITION, &amplitude) || !shell_take(args, 4, RANGE_SWING_MS, &ms) ||
        (args->count > 5 && !shell_take(args, 5, RANGE_PHASE, &phase_deg))) {
        return SHELL_ERR_RANGE;
    }
    const uint16_t ticks = (uint16_t)((uint32_t)ms * PLAYER_TICKS_PER_SECOND / 1000u);
    layers_status_t status = LAYERS_ERR_RANGE;
    if (layers_can_swing(args->number[1], amplitude, ticks)) {
        status = performer_take_for_code(&play->performer, id);
    }
    return answer_of(status != LAYERS_OK ? status
                         : layers_swing(&play->layers, id, args->number[1], amplitude, ticks, phase_deg));
}

uint8_t commands_do_free(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    const uint8_t status = requests_take_joints(args, 1, &joints);
    if (status == REQUEST_OK) {
        layers_free(&play->layers, joints);
    }
    return status;
}
