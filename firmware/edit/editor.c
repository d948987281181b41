/* SPDX-License-Identifier: MIT */
#include "editor.h"

#include <string.h>
#include "ansi.h"
#include "commands.h"
#include "compiler.h"
#include "console.h"
#include "editor_parts.h"
#include "pgm.h"
#include "report.h"
#include "text.h"
#include "tick.h"

editor_t the_editor;

enum { ESC_QUIET_TICKS = 7, PAINT_ROOM = CONSOLE_TX_BYTES / 2, BYTES_PER_TURN = 32, MORE_ROWS = 2, MESSAGE_COLUMN_MAX = 40 };

/* ---- start ---- */

void editor_init(void)
{
    const char *notice_P = the_editor.notice_P;
    memset(&the_editor, 0, sizeof the_editor);
    the_editor.notice_P = notice_P;
    the_editor.take_page = EDITOR_NO_PAGE;
    session_init();
    screen_init();
    shell_init(&the_editor.shell, the_editor.line, EDITOR_LINE_BYTES, the_editor.history, EDITOR_HISTORY_BYTES);
    the_editor.source.context = NULL;
    the_editor.source.read = editor_source_read;
    the_editor.source.check = editor_source_check;
    performer_set_source(&the_performer, &the_editor.source);
    robot_init();
    screen_set_present(the_servos.present);
    screen_ask_size();
    screen_sync();
}

/* ---- messages ---- */

void editor_put(char character)
{
    if (character == '\n') {
        the_editor.lines++;
    }
    screen_put(character);
}

void editor_message_begin(void)
{
    if (!the_screen.hidden) {
        screen_open_line();
    }
}

void editor_message_end(void)
{
    if (!the_screen.hidden) {
        the_screen.sink = SCREEN_QUIET;
    }
}

void editor_tell_joints(const char *what_P, uint32_t joints)
{
    if (joints != 0) {
        the_screen.lead = true;
        text_P(what_P);
        TEXT(": ID ");
        report_joints(joints);
    }
}

void editor_tell_failed(void)
{
    if (the_robot.failed) {
        the_robot.failed = false;
        editor_tell_joints(TEXT_P("No answer"), the_servos.silent);
    }
}

/* ---- running a line ---- */

void editor_leave_line(void)
{
    editor_tell_failed();
    shell_clear(&the_editor.shell);
    the_editor.mode = EDITOR_TABLE;
    the_editor.answered = 0;
    the_screen.lead = false;
    if (!the_screen.hidden) {
        the_screen.sink = SCREEN_QUIET;
    }
    screen_sync();
}

static void print_refusal(uint8_t result)
{
    switch (result) {
    case SHELL_ERR_MOVING:
        TEXT("Something moves");
        break;
    case SHELL_ERR_RANGE:
        shell_print_broken();
        break;
    case SHELL_ERR_UNKNOWN:
        TEXT("Bad Command");
        break;
    case SHELL_ERR_COUNT:
        TEXT("Invalid Parameter");
        break;
    default:
        break;
    }
}

static void go_on(uint8_t result)
{
    STATIC_ASSERT((int)EDITOR_ASK > (int)SHELL_ERR_SAID,
                  "what a handler returns is a mode");
    if (result >= EDITOR_ASK && result <= EDITOR_PLAY) {
        the_editor.mode = result;
        if (result == EDITOR_NAME) {
            shell_clear(&the_editor.shell);
            the_screen.lead = false;
        }
        return;
    }
    print_refusal(result);
    editor_leave_line();
}

void editor_run(void)
{
    the_editor.asked = 0;
    the_editor.broken_off = false;
    the_screen.lead = true;
    the_screen.cramped = the_screen.line_column > MESSAGE_COLUMN_MAX;
    the_session.spare = performer_spare(&the_performer);
    go_on(shell_run(commands_table_P, commands_count, NULL, &the_editor.args, !performer_is_idle(&the_performer)));
    the_session.spare = NULL;
}

bool editor_ask(const char *question_P)
{
    the_editor.asked++;
    if (the_editor.asked <= the_editor.answered) {
        return true;
    }
    the_screen.lead = true;
    text_P(question_P);
    TEXT("Are you sure?[y/N]");
    console_drop_input();   /* what was typed ahead knows nothing of the question */
    the_editor.quiet_since = tick_now16();
    return false;
}

bool editor_ask_unsaved(void)
{
    return !the_session.is_changed || editor_ask(TEXT_P("The edits would be lost. "));
}

void ansi_wait(void)
{
    /* Half a millisecond at most, three bytes' time. The tick alone: the rest of editor_serve needs more stack than
     * is left here. */
    for (uint8_t turn = 0; turn < UINT8_MAX && console_room() == 0; turn++) {
        if (!performer_is_idle(&the_performer) && tick_take()) {
            performer_tick(&the_performer);
        }
    }
}

void editor_serve(void)
{
    if (tick_take()) {
        performer_tick(&the_performer);
    }
    performer_poll(&the_performer);
}

uint8_t editor_edited(void)
{
    if (!session_end()) {
        the_screen.lead = true;
        TEXT("This cannot be undone");
    }
    return SHELL_OK;
}

void editor_open(uint8_t page)
{
    bool trim_changes = (page == 0) != the_robot.raw;
    session_open(page);
    if (trim_changes) {
        robot_set_trim();
    }
}

/* ---- lists ---- */

uint8_t editor_list(editor_item_t item, const char *title_P)
{
    screen_hide();
    the_editor.item = item;
    the_editor.next_item = 0;
    the_editor.lines = 0;
    text_P(title_P);
    text_line_end();
    return EDITOR_TO_LIST;
}

static void list_turn(void)
{
    if (the_editor.lines + MORE_ROWS >= the_screen.rows) {
        TEXT("-- more: space --");
        the_editor.mode = EDITOR_MORE;
    } else if (!the_editor.item(the_editor.next_item)) {
        the_editor.item = NULL;
        TEXT("-- end --");
        the_editor.mode = EDITOR_MORE;
    } else {
        the_editor.next_item++;
    }
}

/* ---- the main loop ---- */

/* While a broken play slows down keys wait, for what follows it. */
static bool may_take_bytes(void)
{
    return the_editor.mode != EDITOR_LIST && !(the_editor.mode == EDITOR_PLAY && the_performer.leaving);
}

static void take_bytes(void)
{
    uint8_t byte;
    for (uint8_t i = 0; i < BYTES_PER_TURN && may_take_bytes() && console_get(&byte); i++) {
        editor_byte(byte);
    }
    bool quiet = (uint16_t)(tick_now16() - the_editor.quiet_since) > ESC_QUIET_TICKS;
    if (quiet && keys_is_open(&the_editor.keys)) {
        editor_key(keys_quiet(&the_editor.keys));
    }
}

static void tick_work(void)
{
    performer_tick(&the_performer);
    (void)settings_save_poll(&the_settings_store, &the_settings);
    if (the_editor.late_ticks != 0) {
        the_editor.late_ticks--;
    }
    if (performer_is_idle(&the_performer)) {
        robot_follow();
    } else if (the_editor.mode == EDITOR_PLAY) {
        robot_show_play();
    }
}

/* Behind the first screen, whose size is known by then: what came before it would be wiped. */
static void tell_notice(void)
{
    if (the_editor.notice_P != NULL && the_editor.mode == EDITOR_TABLE) {
        editor_message_begin();
        text_P(the_editor.notice_P);
        editor_message_end();
        the_editor.notice_P = NULL;
    }
}

bool editor_turn(void)
{
    take_bytes();
    if (tick_take()) {
        tick_work();
    }
    performer_poll(&the_performer);
    uint8_t room = console_room();
    if (the_editor.mode == EDITOR_TABLE || the_editor.mode == EDITOR_PLAY) {
        cmd_play_events(room >= CONSOLE_TX_BYTES - 1u);
    }
    if (the_editor.mode == EDITOR_LIST) {
        list_turn();
        return true;
    }
    if (the_screen.hidden && the_editor.mode == EDITOR_TABLE && requests_now_is_due()) {
        the_screen.sink = SCREEN_PLAIN;
        requests_print_now();
        the_screen.sink = SCREEN_QUIET;
    }
    if (the_editor.faults_due || room < PAINT_ROOM) {
        return false;
    }
    if (screen_paint()) {
        return true;
    }
    tell_notice();
    return false;
}
