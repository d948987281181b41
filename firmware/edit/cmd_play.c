/* SPDX-License-Identifier: MIT
 * cmd_play.c - PLAY and its keys; servo faults, during a play and at rest. */
#include "commands.h"
#include "dxl.h"
#include "keys.h"
#include "pgm.h"
#include "report.h"
#include "shape.h"
#include "text.h"
#include "tick.h"

/* ---- PLAY ---- */

COMMAND(cmd_play)
{
    uint8_t page = args->count > 1 ? (uint8_t)args->number[0] : the_session.page;
    performer_status_t status = performer_start(&the_performer, page, 0);
    if (status != PERFORMER_OK) {
        report_refusal(status, page, the_performer.fault);
        return SHELL_ERR_REPORTED;
    }
    robot_trim_play();
    /* Sets the rate before the first step is planned. The voltage limits the speed that a high rate may demand. */
    shape_set_voltage(&the_performer.shape, the_servos.voltage_dv);
    the_performer.shape.rate_percent = args->count > 2 ? args->number[1] : SHAPE_NORMAL;
    return DIALOG_TO_PLAY;
}

void cmd_play_key(uint8_t key)
{
    the_screen.lead = false;
    switch (key) {
    case KEY_CR:
    case KEY_LF:
        performer_stop(&the_performer);
        TEXT("[STOP]");
        break;
    case KEY_ESCAPE:
    case KEY_UP:
    case KEY_DOWN:
    case KEY_RIGHT:
    case KEY_LEFT:
        performer_stop_without_exit(&the_performer);
        TEXT("[Exit]");
        break;
    case ' ':
    case KEY_CTRL_C:
        performer_break(&the_performer);
        TEXT("[BREAK]");
        break;
    default:
        break;
    }
}

/* ---- events and faults ---- */

/* The faults of a joint: DXL_ERR_ bits, and three bits that servos do not use. */
enum { BIT_SILENT = 3, BIT_LIMP = 4, BIT_OUTSIDE = 6 };

static uint8_t state_of(uint8_t joint)
{
    if (servo_link_has(&the_servos.silent, joint)) {
        return 1u << BIT_SILENT;
    }
    uint8_t state = the_servos.errors[joint];
    if (the_performer.is_hot && joint == the_servos.hottest_id) {
        state |= DXL_ERR_HEAT;
    }
    if (state == 0 && servo_link_has(&the_performer.faulty, joint)) {
        return servo_link_has(&the_servos.outside, joint) ? 1u << BIT_OUTSIDE : 1u << BIT_LIMP;
    }
    return state;
}

/* Prints all servo faults in one message, because they share one row. Lost torque also shows as ???? in the table. */
static void tell_faults(void)
{
    TEXT_NAMED(voltage, "Low voltage");
    TEXT_NAMED(angle, "Angle limit");
    TEXT_NAMED(heat, "Hot");
    TEXT_NAMED(silent, "No answer");
    TEXT_NAMED(limp, "Lost torque");
    TEXT_NAMED(overload, "Overload");
    static const char *const names[] PROGMEM = { voltage, angle, heat, silent, limp, overload };   /* by bit */
    the_dialog.faults_due = false;
    the_robot.failed &= ~the_servos.silent;   /* silent servos are reported here */
    screen_open_line();
    if (the_dialog.broken_off) {
        TEXT("Ended: a servo failed.");
    }
    uint32_t joints[BIT_OUTSIDE + 1] = {0};   /* by bit; one state_of per joint, or the next goals would be late */
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        uint8_t state = state_of(joint);
        for (uint8_t bit = 0; state != 0; bit++, state >>= 1) {
            servo_link_put(&joints[bit], joint, (state & 1u) != 0);
        }
    }
    const uint8_t column = the_screen.line_column;
    for (uint8_t bit = 0; bit < ARRAY_COUNT(names); bit++) {
        dialog_tell_joints(pgm_read_ptr(&names[bit]), joints[bit]);
    }
    dialog_tell_joints(report_outside_P(), joints[BIT_OUTSIDE]);
    the_screen.lead = true;
    the_dialog.faults_stand = the_performer.battery_reported || the_screen.line_column != column;
    if (the_performer.battery_reported) {
        TEXT("Battery low");
    } else if (!the_dialog.faults_stand) {
        TEXT("All servos are well");
        the_dialog.well_ticks = WELL_TICKS;
    }
}

void cmd_play_tell_again(void)
{
    uint8_t any = the_performer.battery_reported;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        any |= state_of(joint);
    }
    if (any == 0 || the_screen.hidden) {
        return;
    }
    if (the_dialog.mode == DIALOG_LINE && the_dialog.shell.length == 0) {
        dialog_end_line();
    }
    if (the_dialog.mode == DIALOG_TABLE) {
        the_dialog.faults_due = true;
    }
}

static void tell_end(const performer_event_t *event)
{
    switch (event->c) {
    case PERFORMER_END_LOOP:
        TEXT("OK, the exit links loop");
        break;
    case PERFORMER_END_PAGE:
        TEXT("Ended. ");
        report_bad_page(event->a, event->b);
        break;
    case PERFORMER_END_SERVO:
        the_dialog.broken_off = true;
        tell_faults();
        break;
    default:
        TEXT("OK");
        break;
    }
}

static void play_ended(const performer_event_t *event)
{
    the_dialog.late_ticks = LATE_TICKS;
    the_dialog.step_due = false;
    shape_reset(&the_performer.shape);   /* the next @play has the stored rate */
    robot_end_play();
    session_mark_labels();   /* removes the live positions */
    if (the_dialog.mode != DIALOG_PLAY) {
        return;
    }
    the_dialog.quiet_since = tick_now16();   /* keys were held back until now */
    the_screen.lead = true;
    tell_end(event);
    dialog_end_line();
}

/* Prints page, step and repetition. Edit counts steps from 0, like its columns. */
static void tell_step(void)
{
    const player_t *player = &the_performer.player;
    the_dialog.step_due = false;
    screen_open_line();
    text_P_number(TEXT_P("Page "), player->now.page);
    text_P_number(TEXT_P(" step "), (uint16_t)(player->now.step - 1u));
    text_P_number(TEXT_P(" repetition "), player->repetition);
}

void cmd_play_events(bool line_is_free)
{
    performer_event_t event;
    if (performer_next_event(&the_performer, &event)) {
        if (event.kind == PERFORMER_EV_ENDED) {
            play_ended(&event);
        } else if (event.kind >= PERFORMER_EV_SILENT && event.kind <= PERFORMER_EV_COOL) {
            the_dialog.faults_due = !the_screen.hidden;
        } else if (event.kind == PERFORMER_EV_STEP) {
            /* the row keeps the message of a key, and servo faults until they were read */
            the_dialog.step_due = the_dialog.mode == DIALOG_PLAY && !the_dialog.faults_stand && the_dialog.well_ticks == 0 &&
                                  !link_is_stopping(&the_performer.link);
        }
    } else if (the_dialog.step_due && line_is_free) {
        tell_step();
    } else if (the_dialog.faults_due && line_is_free) {
        tell_faults();
        if (the_dialog.mode != DIALOG_PLAY) {
            dialog_message_end();
        }
    }
}
