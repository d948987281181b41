/* SPDX-License-Identifier: MIT
 * commands_shape.c - rate, amplitude, blend, drive, shape: shape a motion while it plays (performer_shape.h). */
#include "commands_parts.h"

#include "performer_shape.h"
#include "pgm.h"
#include "text.h"
#include "views.h"

uint8_t commands_do_rate(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)!shape_set_rate(&play->performer.shape, args->number[0]);
    return REQUEST_OK;
}

uint8_t commands_do_amplitude(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints = SERVO_LINK_ALL;
    if (args->count > 2) {
        const uint8_t status = requests_take_joints(args, 2, &joints);
        if (status != REQUEST_OK) {
            return status;
        }
    }
    (void)!shape_set_amplitude(&play->performer.shape, args->number[0], joints);
    return REQUEST_OK;
}

uint8_t commands_do_blend(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)!shape_set_blend(&play->performer.shape, (int16_t)args->number[0]);
    return REQUEST_OK;
}

/* Blend, rate and amplitude in one line, because a joystick sends it 20 times a second. */
uint8_t commands_do_drive(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t amplitude;
    if (!shell_take(args, 3, RANGE_AMPLITUDE, &amplitude)) {
        return SHELL_ERR_RANGE;
    }
    (void)!performer_drive(&play->performer, (int16_t)args->number[0], args->number[1], amplitude);
    return REQUEST_OK;
}

/* ---- what is in force ---- */

uint8_t commands_do_shape(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count == 1) {
        views_print_shape(&play->performer);
        return REQUEST_OK;
    }
    if (!shell_word_is(args, 1, PSTR("reset"))) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Say shape, or shape reset"));
    }
    shape_reset(&play->performer.shape);
    return REQUEST_OK;
}
