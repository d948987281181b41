/* SPDX-License-Identifier: MIT
 * commands_shape.c - words that shape a motion while it plays (performer_shape.h). Each serves a person's word and a
 * program's: `blend -40` and `@blend -40`. */
#include "commands.h"
#include "commands_parts.h"

#include "performer_shape.h"
#include "text.h"
#include "views.h"

/* ---- rate, amplitude, blend ---- */

static uint8_t do_rate(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t percent;
    if (!commands_number(play, args, 1, TEXT_P("Rate"), SHAPE_RATE_MIN, SHAPE_RATE_MAX, &percent)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_rate(&play->performer.shape, percent);
    return REQUEST_OK;
}

static uint8_t do_amplitude(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t percent;
    uint32_t joints = SERVO_LINK_ALL;
    if (!commands_number(play, args, 1, TEXT_P("Amplitude"), 0, SHAPE_AMPLITUDE_MAX, &percent)) {
        return REQUEST_ERR_RANGE;
    }
    if (args->count > 2 && !commands_joints(play, args, 2, &joints)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_amplitude(&play->performer.shape, percent, joints);
    return REQUEST_OK;
}

static uint8_t do_blend(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t percent;
    if (!commands_signed(play, args, 1, TEXT_P("Blend"), SHAPE_BLEND_MAX, &percent)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_blend(&play->performer.shape, percent);
    return REQUEST_OK;
}

/* Blend, rate and amplitude in one line: a joystick sends it 20 times a second. */
static uint8_t do_drive(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t blend;
    uint16_t rate, amplitude;
    if (!commands_signed(play, args, 1, TEXT_P("Blend"), SHAPE_BLEND_MAX, &blend) ||
        !commands_number(play, args, 2, TEXT_P("Rate"), SHAPE_RATE_MIN, SHAPE_RATE_MAX, &rate) ||
        !commands_number(play, args, 3, TEXT_P("Amplitude"), 0, SHAPE_AMPLITUDE_MAX, &amplitude)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!performer_drive(&play->performer, blend, rate, amplitude);
    return REQUEST_OK;
}

/* ---- what is in force ---- */

static uint8_t do_shape(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count == 1) {
        if (play->program_asks) {
            views_print_shape_fields(&play->performer);
        } else {
            views_print_shape(&play->performer);
        }
        return REQUEST_OK;
    }
    if (!shell_word_is(args, 1, PSTR("reset"))) {
        return commands_sentence(play, REQUEST_ERR_RANGE, TEXT_P("Say shape, or shape reset"));
    }
    shape_reset(&play->performer.shape);
    return REQUEST_OK;
}

TEXT_NAMED(word_rate, "rate  percent  speed of the motion, 10..400");
TEXT_NAMED(word_amplitude, "amplitude  percent [id ...]  size of the motion, 0..150");
TEXT_NAMED(word_blend, "blend  percent  towards the partner page: right 1..100, left -1..-100");
TEXT_NAMED(word_drive, "drive  blend rate amplitude  all three; again and again, or the play is stopped");
TEXT_NAMED(word_shape, "shape  [reset]  what of this is in force");

const shell_command_t commands_shape_table[COMMANDS_SHAPE_COUNT] PROGMEM = {
    { word_rate, do_rate, SHELL_ARGS(1, 1), 0 },
    { word_amplitude, do_amplitude, SHELL_ARGS(1, SHELL_ANY_ARGS), 0 },
    { word_blend, do_blend, SHELL_ARGS(1, 1), 0 },
    { word_drive, do_drive, SHELL_ARGS(3, 3), 0 },
    { word_shape, do_shape, SHELL_ARGS(0, 1), 0 },
};

uint8_t commands_run_for_program(play_t *play, const shell_args_t *args)
{
    shell_args_t word = *args;
    word.words++; /* behind the @ */
    play->program_asks = true;
    const uint8_t status = shell_run(commands_shape_table, COMMANDS_SHAPE_COUNT, play, &word, false);
    play->program_asks = false;
    return status;
}
