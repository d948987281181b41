/* SPDX-License-Identifier: MIT */
#include "dialog.h"

#include <string.h>
#include "console.h"
#include "pgm.h"
#include "report.h"
#include "robot.h"
#include "parts.h"
#include "screen.h"
#include "session.h"
#include "text.h"
#include "tick.h"

dialog_t the_dialog;

enum { MORE_ROWS = 2 };

void dialog_init(void)
{
    memset(&the_dialog, 0, sizeof the_dialog);
    shell_init(&the_dialog.shell, the_dialog.line, DIALOG_LINE_BYTES, the_dialog.history, DIALOG_HISTORY_BYTES);
}

/* ---- messages ---- */

void dialog_message_begin(void)
{
    if (!the_screen.hidden) {
        screen_open_line();
    }
}

void dialog_message_end(void)
{
    if (!the_screen.hidden) {
        the_screen.sink = SCREEN_QUIET;
    }
}

void dialog_tell_joints(const char *what_P, uint32_t joints)
{
    if (joints != 0) {
        the_screen.lead = true;
        text_P(what_P);
        TEXT(": ID ");
        report_joints(joints);
    }
}

void dialog_tell_failed(void)
{
    if (the_robot.failed != 0) {
        dialog_tell_joints(TEXT_P("No answer"), the_servos.silent);
        the_robot.failed &= ~the_servos.silent;
        const char *why_P = report_disobedience_P(&the_servos, &the_robot.failed);
        dialog_tell_joints(why_P, the_robot.failed);
        the_robot.failed = 0;
    }
}

void dialog_end_line(void)
{
    dialog_tell_failed();
    shell_clear(&the_dialog.shell);
    the_dialog.mode = DIALOG_TABLE;
    the_dialog.answered = 0;
    the_dialog.row_ticks = ROW_TICKS;
    the_screen.lead = false;
    dialog_message_end();
    screen_sync();
}

/* ---- for commands ---- */

bool dialog_ask(const char *question_P)
{
    the_dialog.asked++;
    if (the_dialog.asked <= the_dialog.answered) {
        return true;
    }
    the_screen.lead = true;
    text_P(question_P);
    TEXT(". Are you sure?[y/N]");
    the_dialog.stale_bytes = console_waiting();
    the_dialog.quiet_since = tick_now16();
    return false;
}

bool dialog_ask_unsaved(void)
{
    return !the_session.is_changed || dialog_ask(TEXT_P("The edits would be lost"));
}

uint8_t dialog_refuse(const char *sentence_P)
{
    text_P(sentence_P);
    return SHELL_ERR_REPORTED;
}

uint8_t dialog_edited(void)
{
    const bool is_same = the_session.is_begun;
    const bool is_kept = session_end();
    if (is_same || !is_kept) {
        the_screen.lead = true;
        text_P(is_same ? TEXT_P("No change") : TEXT_P("This cannot be undone"));
    }
    return SHELL_OK;
}

/* ---- lists ---- */

uint8_t dialog_list(dialog_item_t item, const char *title_P)
{
    screen_hide();
    the_dialog.item = item;
    the_dialog.next_item = 0;
    the_dialog.lines = 0;
    text_P(title_P);
    text_line_end();
    return DIALOG_TO_LIST;
}

void dialog_list_turn(void)
{
    if (the_dialog.lines + MORE_ROWS >= the_screen.rows) {
        TEXT("-- more: space --");
        the_dialog.mode = DIALOG_MORE;
    } else if (!the_dialog.item(the_dialog.next_item)) {
        the_dialog.item = NULL;
        TEXT("-- end --");
        the_dialog.mode = DIALOG_MORE;
    } else {
        the_dialog.next_item++;
    }
}
