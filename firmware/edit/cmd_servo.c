/* SPDX-License-Identifier: MIT
 * cmd_servo.c - commands that move servos or switch their torque: GO, MIRROR, ON, OFF; and PAIRS, the setting of MIRROR. */
#include "commands.h"
#include "page_edit.h"
#include "pgm.h"
#include "ranges_own.h"
#include "report.h"
#include "text.h"

/* Sends a step and prints the joints without a value. */
static void send_step(const uint8_t step[PAGE_STEP_BYTES])
{
    uint32_t missing = robot_send(step);
    session_set_byte(CELLS_POSE_AT + PAGE_STEP_AT_PAUSE, step[PAGE_STEP_AT_PAUSE]);
    if (step[PAGE_STEP_AT_SPEED] != 0) { /* an unused step may have none (session_set_steps) */
        session_set_byte(CELLS_POSE_AT + PAGE_STEP_AT_SPEED, step[PAGE_STEP_AT_SPEED]);
    }
    dialog_tell_joints(TEXT_P("No value, not moved"), missing);
}

COMMAND(cmd_go)
{
    uint8_t step = (uint8_t)args->number[0];
    if (cmd_step_is_trim(step)) {
        return SHELL_ERR_REPORTED;
    }
    if (step >= the_session.cells[PAGE_AT_STEPS] && !dialog_ask(TEXT_P("That step is not used"))) {
        return DIALOG_TO_ASK;
    }
    the_session.go_step = step;
    send_step(&the_session.cells[session_step_at(step)]);
    return SHELL_OK;
}

/* ---- mirror ---- */

/* The neutral position of a joint: the middle, or its position in the first step of page 1 in flash (not in RAM). */
static uint16_t neutral_of(uint8_t joint)
{
    uint8_t word[2];
    if (the_settings_store.settings.neutral != SETTINGS_NEUTRAL_PAGE1 || !page_store_is_good(&the_pages, 1)) {
        return PAGE_POS_MIDDLE;
    }
    page_store_read(1, (uint16_t)(PAGE_AT_STEP0 + 2u * joint), word, sizeof word);
    uint16_t pos = page_word(word);
    return cell_is_position(pos) ? pos : PAGE_POS_MIDDLE;
}

/* The partner's position, mirrored for this joint. A word that is not a position is copied. */
static uint16_t mirrored(uint8_t step, uint8_t joint, uint8_t partner)
{
    uint16_t word = session_word(step, partner);
    if (!cell_is_position(word)) {
        return word;
    }
    return page_edit_mirrored(word, neutral_of(joint) + neutral_of(partner));
}

COMMAND(cmd_mirror)
{
    uint8_t step = (uint8_t)args->number[0];
    if (cmd_step_is_trim(step)) {
        return SHELL_ERR_REPORTED;
    }
    uint8_t words[PAGE_STEP_BYTES];
    memcpy(words, &the_session.cells[session_step_at(step)], sizeof words);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint8_t partner = the_settings_store.settings.pair[joint];
        if (partner < PAGE_JOINTS) {
            uint16_t word = mirrored(step, joint, partner);
            words[2 * joint] = (uint8_t)word;
            words[2 * joint + 1] = (uint8_t)(word >> 8);
        }
    }
    send_step(words);
    return SHELL_OK;
}

static void print_pairs(const settings_t *settings)
{
    text_P(settings->neutral == SETTINGS_NEUTRAL_PAGE1 ? TEXT_P("about page1: ") : TEXT_P("about 512: "));
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        if (settings->pair[joint] < PAGE_JOINTS && settings->pair[joint] > joint) {
            text_number(joint);
            text_put('-');
            text_number(settings->pair[joint]);
            text_put(' ');
        }
    }
}

COMMAND(cmd_pairs)
{
    if (args->count == 2) {
        const bool page1 = shell_word_is(args, 1, PSTR("page1"));
        if (!page1 && !shell_word_is(args, 1, PSTR("512"))) {
            return dialog_refuse(TEXT_P("Say two IDs, 512 or page1"));
        }
        if (page1 && !page_store_is_good(&the_pages, 1)) {
            report_bad_page(1, page_store_look(1));
            return SHELL_ERR_REPORTED;
        }
        the_settings_store.settings.neutral = page1 ? SETTINGS_NEUTRAL_PAGE1 : SETTINGS_NEUTRAL_512;
    } else if (args->count == 3) {
        uint16_t a, b;
        if (!shell_take(args, 1, RANGE_ID, &a) || !shell_take(args, 2, RANGE_ID, &b)) {
            return SHELL_ERR_RANGE;
        }
        settings_pair(&the_settings_store.settings, (uint8_t)a, (uint8_t)b);
    }
    if (args->count > 1) {
        settings_save_start(&the_settings_store);
    }
    print_pairs(&the_settings_store.settings);
    return SHELL_OK;
}

/* ---- torque ---- */

/* Switches the joints that the line names, or all present joints. */
static uint8_t switch_named(const shell_args_t *args, bool on)
{
    uint32_t joints = args->count > 1 ? 0 : the_servos.present;
    if (the_servos.present == 0) {
        report_refusal(PERFORMER_ERR_NO_SERVOS, 0, 0);
        return SHELL_ERR_REPORTED;
    }
    if (!ranges_take_joints(args, 1, &joints)) {
        return SHELL_ERR_RANGE;
    }
    dialog_tell_joints(TEXT_P("Not there"), joints & ~the_servos.present);
    robot_switch(joints, on);
    return SHELL_OK;
}

COMMAND(cmd_on)
{
    return switch_named(args, true);
}

COMMAND(cmd_off)
{
    return switch_named(args, false);
}
