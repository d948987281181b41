/* SPDX-License-Identifier: MIT
 * editor_keys.c - which key means what, mode by mode (the diagram is in editor.h). */
#include "commands.h"
#include "editor_parts.h"
#include "pgm.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { BACKSLASH = '\\', FIRST_WORD_KEY = '0', LAST_WORD_KEY = 'Z', FIRST_LOWER_KEY = '^', LAST_LOWER_KEY = 'z' };

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
        /* Drawn anew it would cost half a second of ticks: keys wait until the robot stands. */
        if (key == KEY_NONE || key == KEY_CR || key == KEY_LF || !performer_is_idle(&the_performer)) {
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
        if (editor->wait_ticks == 0) {
            cmd_cell_space(editor);
        }
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
    if (editor->robot.failed) {
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
        editor_message_begin(editor);   /* there is no room behind it */
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
    editor->args = shell_split(&editor->shell, the_session.hex);
    editor_run(editor);
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
        editor->args = shell_split(&editor->shell, the_session.hex);
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
        editor_run(editor);
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

void editor_key(editor_t *editor, uint8_t key)
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
    if (editor->mode != EDITOR_PLAY && !performer_is_idle(&the_performer) && (byte == ' ' || byte == KEY_CTRL_C) &&
        editor->mode != EDITOR_PROGRAM) {
        performer_break(&the_performer);
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
        editor_key(editor, keys_byte(&editor->keys, byte));
        break;
    }
}
