/* SPDX-License-Identifier: MIT */
#include "editor.h"

#include "commands.h"
#include "console.h"
#include "page_save.h"
#include "pgm.h"
#include "report.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { ESC_QUIET_TICKS = 7, PAINT_ROOM = CONSOLE_TX_BYTES / 2, BYTES_PER_TURN = 32, MORE_ROWS = 2 };
enum { BACKSLASH = '\\', FIRST_WORD_KEY = '0', LAST_WORD_KEY = 'Z', FIRST_LOWER_KEY = '^', LAST_LOWER_KEY = 'z' };

/* ---- pages from RAM and flash, for the performer ---- */

static void source_read(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    editor_t *editor = context;
    if (page == editor->session.page) {
        memcpy(to, &editor->session.cells[offset], count);
    } else {
        page_store_read(page, offset, to, count);
    }
}

static uint8_t source_check(void *context, uint8_t page)
{
    editor_t *editor = context;
    return page == editor->session.page ? (uint8_t)session_check(&editor->session)
                                        : (uint8_t)page_store_check(editor->pages, page);
}

/* ---- what programs may do with the page in RAM ---- */

static uint8_t *program_page(void *context)
{
    editor_t *editor = context;
    return editor->session.cells;
}

static machine_status_t program_open(void *context, uint8_t page)
{
    editor_t *editor = context;
    if (editor->session.is_changed) {
        return MACHINE_ERR_UNSAVED;
    }
    editor_open(editor, page);
    return MACHINE_OK;
}

static void program_changed(void *context)
{
    editor_t *editor = context;
    session_t *session = &editor->session;
    undo_clear(&session->undo);
    session_mark_all(session);
    session_end(session);
}

static machine_status_t program_save(void *context, uint8_t page)
{
    editor_t *editor = context;
    page_save_status_t status = page_save(editor->pages, page, editor->session.cells);
    if (status != PAGE_SAVE_OK && status != PAGE_SAVE_UNCHANGED) {
        return MACHINE_ERR_SAVE;
    }
    if (page == editor->session.page) {
        session_saved(&editor->session);
    }
    return MACHINE_OK;
}

/* What goes on between the parts of a long command. */
static void program_service(void *context)
{
    editor_t *editor = context;
    if (tick_take()) {
        performer_tick(editor->performer);
    }
    performer_poll(editor->performer);
}

static const char image_name[] PROGMEM = "edit";
static machine_image_t program_image = { image_name, program_service, program_page, program_open, program_changed,
                                         program_save, NULL };

/* ---- start ---- */

void editor_init(editor_t *editor, servo_link_t *servos, performer_t *performer, page_store_t *pages,
                 settings_t *settings, settings_store_t *settings_store)
{
    editor->servos = servos;
    editor->performer = performer;
    editor->pages = pages;
    editor->settings = settings;
    editor->settings_store = settings_store;
    editor->mode = EDITOR_TABLE;
    editor->asked = 0;
    editor->answered = 0;
    editor->take_page = EDITOR_NO_PAGE;
    editor->cid = 1;
    editor->after_cr = false;
    editor->quiet_since = tick_now16();
    session_init(&editor->session);
    screen_init(&editor->screen, &editor->session);
    keys_init(&editor->keys);
    shell_init(&editor->shell, editor->line, EDITOR_LINE_BYTES, editor->history, EDITOR_HISTORY_BYTES);
    editor->source.context = editor;
    editor->source.read = source_read;
    editor->source.check = source_check;
    performer_set_source(performer, &editor->source);
    robot_init(&editor->robot, &editor->session, servos, performer, pages);
    screen_set_present(&editor->screen, servos->present);
    program_image.context = editor;
    machine_init(&editor->machine, performer, servos, pages, &program_image);
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

void editor_tell_failed(editor_t *editor)
{
    uint32_t failed = editor->robot.failed;
    editor->robot.failed = 0;
    if (failed != 0) {
        editor->screen.lead = true;
        TEXT("No answer from ID ");
        report_joints(failed);
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
    switch (result) {
    case EDITOR_TO_ASK:
        editor->mode = EDITOR_ASK;
        return;
    case EDITOR_TO_NAME:
        shell_clear(&editor->shell);
        editor->screen.lead = false;
        editor->mode = EDITOR_NAME;
        return;
    case EDITOR_TO_LIST:
        editor->mode = EDITOR_LIST;
        return;
    case EDITOR_TO_PLAY:
        editor->mode = EDITOR_PLAY;
        return;
    case EDITOR_TO_BALANCE:
        editor->mode = EDITOR_BALANCE;
        return;
    case EDITOR_TO_MONITOR:
        shell_clear(&editor->shell);
        editor->mode = EDITOR_MONITOR;
        return;
    case SHELL_ERR_UNKNOWN:
        TEXT("Bad Command");
        break;
    case SHELL_ERR_COUNT:
        TEXT("Invalid Parameter");
        break;
    default:
        break;
    }
    editor_leave_line(editor);
}

static void run(editor_t *editor)
{
    editor->asked = 0;
    editor->screen.lead = true;
    go_on(editor, commands_numbers(editor) ? shell_run(commands_table_P, commands_count, editor, &editor->args)
                                           : (uint8_t)SHELL_ERR_SAID);
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
    return !editor->session.is_changed || editor_ask(editor, PSTR(""));
}

bool editor_may_move(editor_t *editor)
{
    if (performer_is_idle(editor->performer)) {
        return true;
    }
    TEXT("Something moves");
    return false;
}

uint8_t editor_edited(editor_t *editor)
{
    if (!session_end(&editor->session)) {
        editor->screen.lead = true;
        TEXT("This cannot be undone");
    }
    return SHELL_OK;
}

void editor_open(editor_t *editor, uint8_t page)
{
    bool trim_changes = (page == 0) != editor->robot.raw;
    session_open(&editor->session, page);
    if (trim_changes) {
        robot_set_trim(&editor->robot);
    }
}

/* ---- keys, by mode ---- */

static void open_line(editor_t *editor, uint8_t key)
{
    bool starts = (key >= FIRST_WORD_KEY && key <= LAST_WORD_KEY) || key == BACKSLASH ||
                  (key >= FIRST_LOWER_KEY && key <= LAST_LOWER_KEY);
    shell_clear(&editor->shell);
    editor->mode = EDITOR_LINE;
    screen_open_line(&editor->screen);
    if (starts) {
        (void)shell_byte(&editor->shell, key);
    }
}

static void open_program_line(editor_t *editor)
{
    if (!editor->screen.hidden) {
        editor->screen.hidden = true;
        editor->screen.sink = SCREEN_PLAIN;
        text_line_end();
    }
    editor->screen.sink = SCREEN_QUIET;
    editor->mode = EDITOR_PROGRAM;
    shell_clear(&editor->shell);
    (void)shell_byte(&editor->shell, '@');
}

/* The screen again, whole, before a key that may open a line on it: 0.5 s. */
static void take_screen_back(editor_t *editor)
{
    screen_show(&editor->screen);
    while (screen_paint(&editor->screen)) {
        system_kick();
    }
}

static void table_key(editor_t *editor, uint8_t key)
{
    if (editor->screen.hidden && key != '@') {
        if (key == KEY_NONE || key == KEY_CR || key == KEY_LF) {
            return;
        }
        take_screen_back(editor);
    }
    switch (key) {
    case KEY_UP:
    case KEY_DOWN:
    case KEY_RIGHT:
    case KEY_LEFT:
        screen_move(&editor->screen, (session_way_t)(SESSION_UP + (key - KEY_UP)));
        break;
    case ']':
    case '[':
        cmd_cell_change(editor, key == ']' ? 1 : -1);
        break;
    case '}':
    case '{':
        cmd_cell_change(editor, key == '}' ? 10 : -10);
        break;
    case ' ':
        cmd_cell_space(editor);
        break;
    case '@':
        open_program_line(editor);
        return;
    case KEY_SIZE:
        screen_set_rows(&editor->screen, editor->keys.rows);
        break;
    case KEY_NONE:
    case KEY_ESCAPE:
    case KEY_CTRL_C:
        return;
    default:
        open_line(editor, key);
        return;
    }
    if (editor->robot.failed != 0) {
        editor_message_begin(editor);
        editor_tell_failed(editor);
        editor_message_end(editor);
    }
    screen_sync(&editor->screen);
}

static void line_byte(editor_t *editor, uint8_t byte)
{
    if (byte == KEY_CTRL_C) {
        editor_leave_line(editor);
        return;
    }
    switch (shell_byte(&editor->shell, byte)) {
    case SHELL_TYPING:
        return;
    case SHELL_TOO_LONG:
        editor->screen.lead = true;
        TEXT("Line too long");
        editor_leave_line(editor);
        return;
    case SHELL_LINE:
        break;
    }
    if (editor->mode == EDITOR_NAME) {
        cmd_name_done(editor, editor->line);
        editor_leave_line(editor);
        return;
    }
    editor->args = shell_split(&editor->shell, editor->session.hex);
    run(editor);
}

static void program_byte(editor_t *editor, uint8_t byte)
{
    shell_event_t event = shell_byte(&editor->shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    editor->screen.sink = SCREEN_PLAIN;
    if (event == SHELL_LINE) {
        editor->args = shell_split(&editor->shell, false);
        (void)machine_run(&editor->machine, &editor->args);
    }
    shell_clear(&editor->shell);
    editor->mode = EDITOR_TABLE;
    screen_sync(&editor->screen);
}

static void monitor_byte(editor_t *editor, uint8_t byte)
{
    shell_event_t event = shell_byte(&editor->shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    text_line_end();
    if (event == SHELL_LINE) {
        editor->args = shell_split(&editor->shell, editor->session.hex);
        mon_line(editor, &editor->args);
    }
    shell_clear(&editor->shell);
    if (editor->mode == EDITOR_MONITOR) {
        mon_prompt(editor);
    }
}

static void ask_key(editor_t *editor, uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (key == 'y' || key == 'Y') {
        editor->answered++;
        run(editor);
    } else {
        editor_leave_line(editor);
    }
}

static void more_key(editor_t *editor, uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (editor->item != NULL && (key == ' ' || key == KEY_CR)) {
        editor->lines = 0;
        text_line_end();
        editor->mode = EDITOR_LIST;
        return;
    }
    take_screen_back(editor);
    editor_leave_line(editor);
    if (key != ' ' && key != KEY_CR && key != KEY_LF && key != 'q' && key != KEY_ESCAPE && key != KEY_CTRL_C) {
        table_key(editor, key);
    }
}

static void mode_key(editor_t *editor, uint8_t key)
{
    switch (editor->mode) {
    case EDITOR_ASK:
        ask_key(editor, key);
        break;
    case EDITOR_MORE:
        more_key(editor, key);
        break;
    case EDITOR_PLAY:
        cmd_play_key(editor, key);
        break;
    case EDITOR_BALANCE:
        if (key != KEY_NONE && key != KEY_SIZE) {
            editor_leave_line(editor);
            table_key(editor, key);
        }
        break;
    default:
        table_key(editor, key);
        break;
    }
}

void editor_byte(editor_t *editor, uint8_t byte)
{
    bool end_of_cr = byte == KEY_LF && editor->after_cr;
    editor->after_cr = byte == KEY_CR;
    editor->quiet_since = tick_now16();
    if (end_of_cr) {
        return;
    }
    if (editor->mode != EDITOR_PLAY && !performer_is_idle(editor->performer) && (byte == ' ' || byte == KEY_CTRL_C) &&
        editor->mode != EDITOR_PROGRAM) {
        performer_break(editor->performer);
        return;
    }
    switch (editor->mode) {
    case EDITOR_LINE:
    case EDITOR_NAME:
        line_byte(editor, byte);
        break;
    case EDITOR_PROGRAM:
        program_byte(editor, byte);
        break;
    case EDITOR_MONITOR:
        monitor_byte(editor, byte);
        break;
    default:
        mode_key(editor, keys_byte(&editor->keys, byte));
        break;
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

static void take_bytes(editor_t *editor)
{
    uint8_t byte;
    for (uint8_t i = 0; i < BYTES_PER_TURN && editor->mode != EDITOR_LIST && console_get(&byte); i++) {
        editor_byte(editor, byte);
    }
    bool quiet = (uint16_t)(tick_now16() - editor->quiet_since) > ESC_QUIET_TICKS;
    if (quiet && keys_is_open(&editor->keys)) {
        mode_key(editor, keys_quiet(&editor->keys));
    }
}

static void tick_work(editor_t *editor)
{
    performer_tick(editor->performer);
    (void)settings_save_poll(editor->settings_store, editor->settings);
    if (editor->mode == EDITOR_BALANCE) {
        cmd_balance_tick(editor);
    }
    if (performer_is_idle(editor->performer) && editor->mode != EDITOR_MONITOR) {
        robot_follow(&editor->robot);
    }
}

bool editor_turn(editor_t *editor)
{
    take_bytes(editor);
    if (tick_take()) {
        tick_work(editor);
    }
    performer_poll(editor->performer);
    if (editor->mode == EDITOR_TABLE || editor->mode == EDITOR_PLAY) {
        cmd_play_events(editor);
    }
    if (editor->mode == EDITOR_LIST) {
        list_turn(editor);
        return true;
    }
    /* A row may wait for the line longer than a tick: not while something moves. */
    if (console_room() < PAINT_ROOM || !performer_is_idle(editor->performer)) {
        return false;
    }
    return screen_paint(&editor->screen);
}
