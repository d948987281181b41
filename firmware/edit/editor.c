/* SPDX-License-Identifier: MIT */
#include "editor.h"

#include "commands.h"
#include "compiler.h"
#include "console.h"
#include "editor_parts.h"
#include "pgm.h"
#include "report.h"
#include "text.h"
#include "tick.h"

enum { ESC_QUIET_TICKS = 7, PAINT_ROOM = CONSOLE_TX_BYTES / 2, BYTES_PER_TURN = 32, MORE_ROWS = 2 };

/* ---- start ---- */

void editor_init(editor_t *editor)
{
    editor->mode = EDITOR_TABLE;
    editor->asked = 0;
    editor->answered = 0;
    editor->take_page = EDITOR_NO_PAGE;
    editor->cid = 1;
    editor->faults_due = false;
    editor->after_cr = false;
    editor->quiet_since = tick_now16();
    session_init(&the_session);
    screen_init(&editor->screen);
    keys_init(&editor->keys);
    shell_init(&editor->shell, editor->line, EDITOR_LINE_BYTES, editor->history, EDITOR_HISTORY_BYTES);
    editor->source.context = editor;
    editor->source.read = editor_source_read;
    editor->source.check = editor_source_check;
    performer_set_source(&the_performer, &editor->source);
    robot_init(&editor->robot);
    screen_set_present(&editor->screen, the_servos.present);
    machine_init(&editor->machine, &the_performer, &the_servos, &the_pages, &editor_image);
    screen_ask_size(&editor->screen);
    screen_sync(&editor->screen);
}

/* ---- messages ---- */

void editor_put(editor_t *editor, char character)
{
    if (character == '\n') {
        editor->lines++;
    }
    screen_put(&editor->screen, character);
}

void editor_message_begin(editor_t *editor)
{
    if (!editor->screen.hidden) {
        screen_open_line(&editor->screen);
    }
}

void editor_message_end(editor_t *editor)
{
    if (!editor->screen.hidden) {
        editor->screen.sink = SCREEN_QUIET;
    }
}

void editor_tell_joints(editor_t *editor, const char *what_P, uint32_t joints)
{
    if (joints != 0) {
        editor->screen.lead = true;
        text_P(what_P);
        TEXT(": ID ");
        report_joints(joints);
    }
}

void editor_tell_failed(editor_t *editor)
{
    if (editor->robot.failed) {
        editor->robot.failed = false;
        editor_tell_joints(editor, TEXT_P("No answer"), the_servos.silent);
    }
}

/* ---- running a line ---- */

void editor_leave_line(editor_t *editor)
{
    editor_tell_failed(editor);
    shell_clear(&editor->shell);
    editor->mode = EDITOR_TABLE;
    editor->answered = 0;
    editor->screen.lead = false;
    if (!editor->screen.hidden) {
        editor->screen.sink = SCREEN_QUIET;
    }
    screen_sync(&editor->screen);
}

static void go_on(editor_t *editor, uint8_t result)
{
    STATIC_ASSERT((int)EDITOR_ASK > (int)SHELL_ERR_SAID && EDITOR_MORE == EDITOR_MONITOR + 1,
                  "what a handler returns is a mode");
    if (result >= EDITOR_ASK && result <= EDITOR_MONITOR) {
        editor->mode = result;
        if (result == EDITOR_NAME || result == EDITOR_MONITOR) {
            shell_clear(&editor->shell);
            editor->screen.lead = false;
        }
        return;
    }
    if (result >= SHELL_ERR_UNKNOWN) {
        text_P(result == SHELL_ERR_UNKNOWN ? TEXT_P("Bad Command") : TEXT_P("Invalid Parameter"));
    }
    editor_leave_line(editor);
}

void editor_run(editor_t *editor)
{
    editor->asked = 0;
    editor->broken_off = false;
    editor->screen.lead = true;
    the_session.spare = performer_spare(&the_performer);
    go_on(editor, commands_numbers(editor) ? shell_run(commands_table_P, commands_count, editor, &editor->args)
                                           : (uint8_t)SHELL_ERR_SAID);
    the_session.spare = NULL;
}

bool editor_ask(editor_t *editor, const char *question_P)
{
    editor->asked++;
    if (editor->asked <= editor->answered) {
        return true;
    }
    editor->screen.lead = true;
    text_P(question_P);
    TEXT("Are you sure?[y/N]");
    return false;
}

bool editor_ask_unsaved(editor_t *editor)
{
    return !the_session.is_changed || editor_ask(editor, TEXT_P(""));
}

bool editor_may_move(void)
{
    if (performer_is_idle(&the_performer)) {
        return true;
    }
    TEXT("Something moves");
    return false;
}

uint8_t editor_edited(editor_t *editor)
{
    if (!session_end(&the_session)) {
        editor->screen.lead = true;
        TEXT("This cannot be undone");
    }
    return SHELL_OK;
}

void editor_open(editor_t *editor, uint8_t page)
{
    bool trim_changes = (page == 0) != editor->robot.raw;
    session_open(&the_session, page);
    if (trim_changes) {
        robot_set_trim(&editor->robot);
    }
}

/* ---- lists ---- */

uint8_t editor_list(editor_t *editor, editor_item_t item, const char *title_P)
{
    screen_hide(&editor->screen);
    editor->item = item;
    editor->next_item = 0;
    editor->lines = 0;
    text_P(title_P);
    text_line_end();
    return EDITOR_TO_LIST;
}

static void list_turn(editor_t *editor)
{
    if (editor->lines + MORE_ROWS >= editor->screen.rows) {
        TEXT("-- more: space --");
        editor->mode = EDITOR_MORE;
    } else if (!editor->item(editor, editor->next_item)) {
        editor->item = NULL;
        TEXT("-- end --");
        editor->mode = EDITOR_MORE;
    } else {
        editor->next_item++;
    }
}

/* ---- the main loop ---- */

/* While a broken play slows down keys wait, for what follows it. */
static bool may_take_bytes(const editor_t *editor)
{
    return editor->mode != EDITOR_LIST && !(editor->mode == EDITOR_PLAY && the_performer.leaving);
}

static void take_bytes(editor_t *editor)
{
    uint8_t byte;
    for (uint8_t i = 0; i < BYTES_PER_TURN && may_take_bytes(editor) && console_get(&byte); i++) {
        editor_byte(editor, byte);
    }
    bool quiet = (uint16_t)(tick_now16() - editor->quiet_since) > ESC_QUIET_TICKS;
    if (quiet && keys_is_open(&editor->keys)) {
        editor_key(editor, keys_quiet(&editor->keys));
    }
}

static void tick_work(editor_t *editor)
{
    performer_tick(&the_performer);
    (void)settings_save_poll(&the_settings_store, &the_settings);
    if (editor->wait_ticks != 0) {
        editor->wait_ticks--;
    } else if (editor->mode == EDITOR_BALANCE) {
        cmd_balance_tick(editor);
    }
    if (performer_is_idle(&the_performer) && editor->mode != EDITOR_MONITOR) {
        robot_follow();
    }
}

/* Behind the first screen, whose size is known by then: what came before it would be wiped. */
static void tell_notice(editor_t *editor)
{
    if (editor->notice_P != NULL && editor->mode == EDITOR_TABLE) {
        editor_message_begin(editor);
        text_P(editor->notice_P);
        editor_message_end(editor);
        editor->notice_P = NULL;
    }
}

bool editor_turn(editor_t *editor)
{
    take_bytes(editor);
    if (tick_take()) {
        tick_work(editor);
    }
    performer_poll(&the_performer);
    uint8_t room = console_room();
    if (editor->mode == EDITOR_TABLE || editor->mode == EDITOR_PLAY) {
        cmd_play_events(editor, room >= CONSOLE_TX_BYTES - 1u);
    }
    if (editor->mode == EDITOR_LIST) {
        list_turn(editor);
        return true;
    }
    /* A row may wait for the line longer than a tick: not while something moves. */
    if (editor->faults_due || room < PAINT_ROOM || !performer_is_idle(&the_performer)) {
        return false;
    }
    if (screen_paint(&editor->screen)) {
        return true;
    }
    tell_notice(editor);
    return false;
}
