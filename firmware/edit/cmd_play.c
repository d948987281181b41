/* SPDX-License-Identifier: MIT
 * cmd_play.c - PLAY and its keys, what happens to servos meanwhile and at rest, and BALANCE. */
#include "bus_call.h"
#include "commands.h"
#include "dxl.h"
#include "pgm.h"
#include "report.h"
#include "text.h"

/* ---- PLAY ---- */

COMMAND(cmd_play)
{
    editor_t *editor = context;
    uint8_t page = args->count > 1 ? (uint8_t)editor->number[0] : editor->session.page;
    performer_status_t status = performer_start(editor->performer, page, 0);
    if (status != PERFORMER_OK) {
        report_refusal(status, page, editor->performer->fault);
        return SHELL_ERR_SAID;
    }
    return EDITOR_TO_PLAY;
}

void cmd_play_key(editor_t *editor, uint8_t key)
{
    editor->screen.lead = false;
    switch (key) {
    case KEY_CR:
    case KEY_LF:
        performer_stop(editor->performer);
        TEXT("[STOP]");
        break;
    case KEY_ESCAPE:
    case KEY_UP:
    case KEY_DOWN:
    case KEY_RIGHT:
    case KEY_LEFT:
        performer_end(editor->performer);
        TEXT("[Exit]");
        break;
    case ' ':
    case KEY_CTRL_C:
        performer_break(editor->performer);
        TEXT("[BREAK]");
        break;
    default:
        break;
    }
}

/* ---- what happened ---- */

static bool is_worth_telling(const performer_event_t *event)
{
    return event->kind >= PERFORMER_EV_SILENT && event->kind <= PERFORMER_EV_HOT;
}

static const char *servo_text_P(const performer_event_t *event)
{
    if (event->kind == PERFORMER_EV_SILENT) {
        return TEXT_P(" does not answer");
    }
    if (event->kind == PERFORMER_EV_BACK) {
        return TEXT_P(" answers again");
    }
    if (event->kind == PERFORMER_EV_HOT || (event->b & DXL_ERR_HEAT) != 0) {
        return TEXT_P(" is hot");
    }
    return (event->b & DXL_ERR_OVERLOAD) != 0 ? TEXT_P(" is overloaded")
           : (event->b & DXL_ERR_ANGLE) != 0  ? TEXT_P(" is outside its angle limits")
                                              : TEXT_P(" reports low voltage");
}

/* Shorter than report_event, which Edit has no flash for. */
static void tell(editor_t *editor, const performer_event_t *event)
{
    editor->screen.lead = true;
    if (event->kind == PERFORMER_EV_BATTERY) {
        TEXT("The battery is low");
        return;
    }
    TEXT("ID ");
    text_number(event->a);
    text_P(servo_text_P(event));
}

static void tell_end(const performer_event_t *event)
{
    switch (event->c) {
    case PERFORMER_END_LOOP:
        TEXT("OK, the exit links loop");
        break;
    case PERFORMER_END_PAGE:
        TEXT("Ended: invalid page ");
        text_number(event->a);
        break;
    case PERFORMER_END_SERVO:
        TEXT("Ended: a servo failed");
        break;
    default:
        TEXT("OK");
        break;
    }
}

/* The play is over: the work pose is what the servos hold now. */
static void play_ended(editor_t *editor, const performer_event_t *event)
{
    editor->screen.lead = true;
    tell_end(event);
    robot_read(&editor->robot);
    editor_leave_line(editor);
}

void cmd_play_events(editor_t *editor)
{
    performer_event_t event;
    if (!performer_next_event(editor->performer, &event)) {
        return;
    }
    if (editor->mode == EDITOR_PLAY) {
        if (event.kind == PERFORMER_EV_ENDED) {
            play_ended(editor, &event);
        } else if (is_worth_telling(&event)) {
            tell(editor, &event);
        }
    } else if (event.kind == PERFORMER_EV_ENDED) {
        robot_read(&editor->robot);
    } else if (is_worth_telling(&event) && !editor->screen.hidden) {
        editor_message_begin(editor);
        tell(editor, &event);
        editor_message_end(editor);
    }
}

/* ---- BALANCE ---- */

enum { BALANCE_TICKS = 29, BALANCE_FIRST_ID = 102, BALANCE_SECOND_ID = 101, BALANCE_AT = 34, BALANCE_BYTES = 3 };

COMMAND(cmd_balance)
{
    editor_t *editor = context;
    (void)args;
    editor->balance_ticks = 0;
    return EDITOR_TO_BALANCE;
}

static void print_device(uint8_t id, char end)
{
    uint8_t bytes[BALANCE_BYTES];
    if (bus_call_read(id, BALANCE_AT, bytes, BALANCE_BYTES, NULL) != BUS_OK) {
        TEXT("no answer ");
        return;
    }
    for (uint8_t i = 0; i < BALANCE_BYTES; i++) {
        text_padded(bytes[i], 3, '0');
        text_put(i + 1 < BALANCE_BYTES ? ' ' : end);
    }
}

void cmd_balance_tick(editor_t *editor)
{
    if (editor->balance_ticks > 0) {
        editor->balance_ticks--;
        return;
    }
    editor->balance_ticks = BALANCE_TICKS - 1;
    servo_link_quiet(editor->servos);
    screen_open_line(&editor->screen);
    print_device(BALANCE_FIRST_ID, ',');
    print_device(BALANCE_SECOND_ID, ' ');
}
