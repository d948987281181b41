/* SPDX-License-Identifier: MIT */
#include "commands_motion.h"

#include <string.h>
#include "performer_shape.h"
#include "pgm.h"
#include "play.h"
#include "ranges_own.h"
#include "report.h"
#include "shape_step.h"
#include "text.h"
#include "views.h"

/* ---- play, stop, break, pause, resume, code ---- */

/* Whether the page's name, split into words like a line, equals the words after the command. */
static bool has_name(uint8_t page, const shell_args_t *args)
{
    char name[PAGE_NAME_BYTES];
    shell_args_t own;
    page_store_name(page, name);
    shell_words(name, false, &own);
    bool same = own.count + 1u == args->count;
    for (uint8_t i = 0; same && i < own.count; i++) {
        same = strcasecmp(shell_word(&own, i), shell_word(args, i + 1u)) == 0;
    }
    return same;
}

/* The lowest good page above `page` with the name in the line; 0: none. */
static uint8_t next_of_name(uint8_t page, const shell_args_t *args)
{
    for (uint16_t number = page + 1u; number < PAGE_COUNT; number++) {
        if (page_store_is_good(&the_play.pages, (uint8_t)number) && has_name((uint8_t)number, args)) {
            return (uint8_t)number;
        }
    }
    return 0;
}

/* The page with the name in the line; 0: none or several, error printed. */
static uint8_t page_of_name(const shell_args_t *args)
{
    const uint8_t page = next_of_name(0, args);
    const uint8_t other = page == 0 ? 0 : next_of_name(page, args);
    if (page != 0 && other == 0) {
        return page;
    }
    (void)requests_error(REQUEST_ERR_RANGE);
    if (page == 0) {
        TEXT("No page is named");
    } else {
        text_P_number(TEXT_P("Say which by its number: pages "), page);
        text_P_number(TEXT_P(" and "), other);
        TEXT(" are named");
    }
    for (uint8_t i = 1; i < args->count; i++) {
        text_put(' ');
        text_string(shell_word(args, i));
    }
    return 0;
}

/* Whether the word is digits only, even more than a number may have. */
static bool is_digits(const char *word)
{
    while (*word >= '0' && *word <= '9') {
        word++;
    }
    return *word == '\0';
}

/* Plays a page by its number, or by its name if the first word is not a number. A code may follow the number, as if from the
 * remote. */
uint8_t commands_do_play(const shell_args_t *args)
{
    uint16_t page, code = LINK_CODE_NONE;
    if (shell_parse(shell_word(args, 1), false, &page) || is_digits(shell_word(args, 1))) {
        if (args->count > 3) {
            return SHELL_ERR_COUNT;
        }
        if (!shell_take(args, 1, RANGE_PLAYED, &page) || (args->count > 2 && !shell_take(args, 2, RANGE_CODE, &code))) {
            return SHELL_ERR_RANGE;
        }
    } else {
        page = page_of_name(args);
        if (page == 0) {
            return SHELL_ERR_REPORTED;
        }
    }
    return requests_refusal(performer_start(&the_play.performer, (uint8_t)page, (uint8_t)code));
}

/* A person gets a refusal if there is nothing to do. A program gets OK and asks @where. */
static uint8_t done(bool something, const char *nothing_P)
{
    return something || requests_from_program() ? REQUEST_OK : requests_refuse(REQUEST_ERR_IDLE, nothing_P);
}

static uint8_t end(bool at_once)
{
    const bool moves = !performer_is_still(&the_play.performer) || performer_layers_joints(&the_play.performer) != 0;
    if (at_once) {
        performer_break(&the_play.performer);
    } else {
        performer_stop(&the_play.performer);
    }
    return done(moves, TEXT_P("Nothing is playing"));
}

uint8_t commands_do_stop(const shell_args_t *args)
{
    return end(false);
}

uint8_t commands_do_break(const shell_args_t *args)
{
    return end(true);
}

uint8_t commands_do_pause(const shell_args_t *args)
{
    return done(performer_pause(&the_play.performer), TEXT_P("Nothing to pause"));
}

uint8_t commands_do_resume(const shell_args_t *args)
{
    return done(performer_resume(&the_play.performer), TEXT_P("Nothing is paused"));
}

/* Acts like the remote, for boards without a panel. */
uint8_t commands_do_code(const shell_args_t *args)
{
    inputs_refusal_t refusal;
    inputs_code(&the_play.inputs, (uint8_t)args->number[0]);
    if (!inputs_next_refusal(&the_play.inputs, &refusal)) {
        return REQUEST_OK;
    }
    views_print_refusal(&refusal);
    return SHELL_ERR_REPORTED;
}

/* ---- rate, amplitude, blend, drive, shape: shaping while a page plays (performer_shape.h) ---- */

uint8_t commands_do_rate(const shell_args_t *args)
{
    the_play.performer.shape.rate_percent = args->number[0];
    return REQUEST_OK;
}

/* The joints about whose position an amplitude can scale: those of the centre pose. */
static uint32_t centre_joints(void)
{
    uint16_t pose_pos[PAGE_JOINTS];
    const page_source_t *source = &the_play.pages.source;
    const uint8_t page = the_play.store.settings.centre_page;
    return shape_steps_of(source, page) != 0 ? player_first_pose(source, NULL, page, pose_pos) : 0;
}

/* A person is refused an amplitude that does nothing; a program gets OK. */
static uint8_t check_amplitude(uint16_t percent, uint32_t joints)
{
    if (percent == SHAPE_NORMAL || requests_from_program() || (centre_joints() & joints) != 0) {
        return REQUEST_OK;
    }
    return requests_refuse(REQUEST_ERR_IDLE, TEXT_P("None is a joint of the centre page: settings centre"));
}

uint8_t commands_do_amplitude(const shell_args_t *args)
{
    uint32_t joints = SERVO_LINK_ALL;
    if (args->count > 2) {
        const uint8_t status = requests_take_joints(args, 2, &joints);
        if (status != REQUEST_OK) {
            return status;
        }
    }
    const uint8_t status = check_amplitude(args->number[0], joints);
    if (status == REQUEST_OK) {
        shape_set_amplitude(&the_play.performer.shape, (uint8_t)args->number[0], joints);
    }
    return status;
}

uint8_t commands_do_blend(const shell_args_t *args)
{
    the_play.performer.shape.blend_percent = (int8_t)args->number[0];
    return REQUEST_OK;
}

/* Blend, rate and amplitude in one line, because a joystick sends it 20 times a second. */
uint8_t commands_do_drive(const shell_args_t *args)
{
    uint16_t amplitude;
    if (!shell_take(args, 3, RANGE_AMPLITUDE, &amplitude)) {
        return SHELL_ERR_RANGE;
    }
    const uint8_t status = check_amplitude(amplitude, SERVO_LINK_ALL);
    if (status == REQUEST_OK) {
        performer_drive(&the_play.performer, (int8_t)args->number[0], args->number[1], (uint8_t)amplitude);
    }
    return status;
}

uint8_t commands_do_shape(const shell_args_t *args)
{
    if (args->count == 1) {
        views_print_shape();
        return REQUEST_OK;
    }
    if (!shell_word_is(args, 1, PSTR("reset"))) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Say shape, or shape reset"));
    }
    shape_reset(&the_play.performer.shape);
    return REQUEST_OK;
}

/* ---- layer, aim, swing, free: a second page over the main play, and joints moved by code ---- */

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
        return requests_refuse(REQUEST_ERR_SERVOS,
                               TEXT_P("None of these servos can be moved: missing, or off (stop, then on)"));
    case LAYERS_ERR_FULL:
        return requests_refuse(REQUEST_ERR_FULL, TEXT_P("Four joints are moved already: free one"));
    case LAYERS_ERR_BUSY:
        return SHELL_ERR_MOVING;
    default:
        return requests_refuse(REQUEST_ERR_IDLE, TEXT_P("A layer needs a page that plays"));
    }
}

uint8_t commands_do_layer(const shell_args_t *args)
{
    uint16_t page;
    uint32_t joints = 0;
    if (args->count == 2 && shell_word_is(args, 1, PSTR("off"))) {
        performer_layer_off(&the_play.performer);
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
    const layers_status_t status = performer_layer(&the_play.performer, (uint8_t)page, joints);
    const uint32_t by_code = the_play.layers.code.joints;
    if (status == LAYERS_ERR_JOINTS && (joints != 0 ? by_code & joints : by_code) != 0) {
        return requests_refuse(REQUEST_ERR_SERVOS,
                               TEXT_P("None of these servos can be moved: missing, off, or moved by code (free first)"));
    }
    return answer_of(status);
}

uint8_t commands_do_aim(const shell_args_t *args)
{
    const uint8_t id = (uint8_t)args->number[0];
    uint16_t deg_s = 0;
    if (args->count > 3 && !shell_take(args, 3, RANGE_DEG_S, &deg_s)) {
        return SHELL_ERR_RANGE;
    }
    const layers_status_t status = performer_take_for_code(&the_play.performer, id);
    return answer_of(status != LAYERS_OK ? status : layers_aim(&the_play.layers, id, args->number[1], deg_s));
}

/* id centre amplitude ms [phase] */
uint8_t commands_do_swing(const shell_args_t *args)
{
    const uint8_t id = (uint8_t)args->number[0];
    uint16_t amplitude, ms, phase_deg = 0;
    if (!shell_take(args, 3, RANGE_POSITION, &amplitude) || !shell_take(args, 4, RANGE_SWING_MS, &ms) ||
        (args->count > 5 && !shell_take(args, 5, RANGE_PHASE, &phase_deg))) {
        return SHELL_ERR_RANGE;
    }
    const uint16_t ticks = (uint16_t)((uint32_t)ms * PLAYER_TICKS_PER_SECOND / 1000u);
    if (!code_motion_can_swing(args->number[1], amplitude, ticks)) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Too far or too fast"));
    }
    const layers_status_t status = performer_take_for_code(&the_play.performer, id);
    return answer_of(status != LAYERS_OK ? status
                         : layers_swing(&the_play.layers, id, args->number[1], amplitude, ticks, phase_deg));
}

uint8_t commands_do_free(const shell_args_t *args)
{
    uint32_t joints;
    const uint8_t status = requests_take_joints(args, 1, &joints);
    if (status == REQUEST_OK) {
        layers_free(&the_play.layers, joints);
    }
    return status;
}
