/* SPDX-License-Identifier: MIT
 * commands_shape.c - words that shape a motion while it plays (performer_shape.h). Each serves a person's word and a
 * program's: `blend -40` and `@blend -40`. */
#include "commands.h"
#include "commands_parts.h"

#include "performer_shape.h"
#include "pgm.h"
#include "text.h"
#include "views.h"

TEXT_NAMED(blend_text, "Blend");
TEXT_NAMED(rate_text, "Rate");
TEXT_NAMED(amplitude_text, "Amplitude");
/* In the order of drive's words. */
static const commands_range_t ranges[] PROGMEM = {
    { blend_text, -SHAPE_BLEND_MAX, SHAPE_BLEND_MAX },
    { rate_text, SHAPE_RATE_MIN, SHAPE_RATE_MAX },
    { amplitude_text, 0, SHAPE_AMPLITUDE_MAX },
};
enum { BLEND, RATE, AMPLITUDE };

static uint8_t do_rate(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t percent;
    if (!commands_numbers(play, args, 1, &ranges[RATE], 1, &percent)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_rate(&play->performer.shape, (uint16_t)percent);
    return REQUEST_OK;
}

static uint8_t do_amplitude(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t percent;
    uint32_t joints = SERVO_LINK_ALL;
    if (!commands_numbers(play, args, 1, &ranges[AMPLITUDE], 1, &percent) ||
        (args->count > 2 && !commands_joints(play, args, 2, &joints))) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_amplitude(&play->performer.shape, (uint16_t)percent, joints);
    return REQUEST_OK;
}

static uint8_t do_blend(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t percent;
    if (!commands_numbers(play, args, 1, &ranges[BLEND], 1, &percent)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!shape_set_blend(&play->performer.shape, percent);
    return REQUEST_OK;
}

/* Blend, rate and amplitude in one line: a joystick sends it 20 times a second. */
static uint8_t do_drive(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t percent[ARRAY_COUNT(ranges)];
    if (!commands_numbers(play, args, 1, ranges, ARRAY_COUNT(ranges), percent)) {
        return REQUEST_ERR_RANGE;
    }
    (void)!performer_drive(&play->performer, percent[BLEND], (uint16_t)percent[RATE], (uint16_t)percent[AMPLITUDE]);
    return REQUEST_OK;
}

/* ---- what is in force ---- */

static uint8_t do_shape(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count == 1) {
        views_print_shape(&play->performer);
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
TEXT_NAMED(word_blend, "blend  percent  towards the partner page: left -100..100 right");
TEXT_NAMED(word_drive, "drive  blend rate amplitude  all three, again and again");
TEXT_NAMED(word_layer, "layer  n [id ...]|off  a second page, on joints of its own");
TEXT_NAMED(word_shape, "shape  [reset]  what of this is in force");

const shell_command_t commands_shape_table[COMMANDS_SHAPE_COUNT] PROGMEM = {
    { word_rate, do_rate, SHELL_ARGS(1, 1), 0 },
    { word_amplitude, do_amplitude, SHELL_ARGS(1, SHELL_ANY_ARGS), 0 },
    { word_blend, do_blend, SHELL_ARGS(1, 1), 0 },
    { word_drive, do_drive, SHELL_ARGS(3, 3), 0 },
    { word_layer, commands_do_layer, SHELL_ARGS(1, SHELL_ANY_ARGS), 0 },
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
