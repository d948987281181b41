/* SPDX-License-Identifier: MIT
 * editor_keys.c - which key means what, mode by mode (the diagram is in editor.h). */
#include "commands.h"
#include "editor_parts.h"
#include "pgm.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { PAGE_ROWS = 8 };
enum { SWALLOW_TICKS = 60, STREAM_TICKS = 4 };   /* a person's next letter; a stream's next byte */
enum { BACKSLASH = '\\', FIRST_WORD_KEY = '0', LAST_WORD_KEY = 'Z', FIRST_LOWER_KEY = '^', LAST_LOWER_KEY = 'z' };

static void open_line(uint8_t key)
{
    bool starts = (key >= FIRST_WORD_KEY && key <= LAST_WORD_KEY) || key == BACKSLASH ||
                  (key >= FIRST_LOWER_KEY && key <= LAST_LOWER_KEY);
    shell_clear(&the_editor.shell);
    the_editor.mode = EDITOR_LINE;
    screen_open_line();
    if (starts) {
        (void)shell_byte(&the_editor.shell, key);
    }
}

static void open_program_line(void)
{
    if (!the_screen.hidden) {
        the_screen.hidden = true;
        the_screen.sink = SCREEN_PLAIN;
        text_line_end();
    }
    the_screen.sink = SCREEN_QUIET;
    the_editor.mode = EDITOR_PROGRAM;
    shell_clear(&the_editor.shell);
    (void)shell_byte(&the_editor.shell, '@');
}

/* The screen again, whole, before a key that may open a line on it: 0.5 s. */
static void take_screen_back(void)
{
    requests_end_watch();
    screen_show();
    while (screen_paint()) {
        system_kick();
    }
}

static void jump(session_way_t way, uint8_t cells)
{
    while (cells-- > 0) {
        screen_move(way);
    }
}

static void table_key(uint8_t key)
{
    if (key != '@' && !performer_is_idle(&the_performer)) {
        return;   /* only programs may have started what moves; nothing is edited under it */
    }
    if (the_screen.hidden && key != '@') {
        if (key == KEY_NONE || key == KEY_CR || key == KEY_LF) {
            return;
        }
        take_screen_back();
    }
    switch (key) {
    case KEY_UP:
    case KEY_DOWN:
    case KEY_RIGHT:
    case KEY_LEFT:
        screen_move((session_way_t)(SESSION_UP + (key - KEY_UP)));
        break;
    case KEY_HOME:
        jump(SESSION_LEFT, CELLS_COLUMNS);
        break;
    case KEY_END:
        jump(SESSION_RIGHT, CELLS_COLUMNS);
        break;
    case KEY_PAGE_UP:
        jump(SESSION_UP, PAGE_ROWS);
        break;
    case KEY_PAGE_DOWN:
        jump(SESSION_DOWN, PAGE_ROWS);
        break;
    case ']':
    case '[':
        cmd_cell_change(key == ']' ? 1 : -1);
        break;
    case '}':
    case '{':
        cmd_cell_change(key == '}' ? 10 : -10);
        break;
    case ' ':
        if (the_editor.late_ticks == 0) {
            cmd_cell_space();
        }
        break;
    case '@':
        open_program_line();
        return;
    case KEY_SIZE:
        screen_set_rows(the_editor.keys.rows);
        break;
    case KEY_NONE:
    case KEY_ESCAPE:
    case KEY_CTRL_C:
        return;
    default:
        open_line(key);
        return;
    }
    if (the_robot.failed) {
        editor_message_begin();
        editor_tell_failed();
        editor_message_end();
    }
    screen_sync();
}

static void line_byte(uint8_t byte)
{
    if (byte == KEY_CTRL_C) {
        editor_leave_line();
        return;
    }
    switch (shell_byte(&the_editor.shell, byte < 0x80 ? byte : (uint8_t)'?')) {   /* an umlaut is seen to be none */
    case SHELL_TYPING:
        return;
    case SHELL_TOO_LONG:
        editor_message_begin();   /* there is no room behind it */
        TEXT("Line too long");
        editor_leave_line();
        return;
    case SHELL_LINE:
        break;
    }
    if (the_editor.mode == EDITOR_NAME) {
        cmd_name_done(the_editor.line);
        editor_leave_line();
        return;
    }
    the_editor.args = shell_split(&the_editor.shell, the_session.hex);
    editor_run();
}

static void program_byte(uint8_t byte)
{
    shell_event_t event = shell_byte(&the_editor.shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    the_screen.sink = SCREEN_PLAIN;
    if (event == SHELL_LINE) {
        the_editor.args = shell_split(&the_editor.shell, false);
        requests_run(&the_editor.args);
    }
    shell_clear(&the_editor.shell);
    the_editor.mode = EDITOR_TABLE;
    screen_sync();
}

static void ask_key(uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (key == 'y' || key == 'Y') {
        the_editor.answered++;
        editor_run();
    } else {
        the_editor.swallow = key > ' ' && key < KEY_NONE && key != 'n' && key != 'N';
        TEXT(" no");
        editor_leave_line();
    }
}

static void more_key(uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (the_editor.item != NULL && (key == ' ' || key == KEY_CR)) {
        the_editor.lines = 0;
        text_line_end();
        the_editor.mode = EDITOR_LIST;
        return;
    }
    take_screen_back();
    editor_leave_line();
    the_editor.late_ticks = LATE_TICKS;
    if (key != ' ' && key != KEY_CR && key != KEY_LF && key != 'q' && key != KEY_ESCAPE && key != KEY_CTRL_C) {
        table_key(key);
    }
}

void editor_key(uint8_t key)
{
    switch (the_editor.mode) {
    case EDITOR_ASK:
        ask_key(key);
        break;
    case EDITOR_MORE:
        more_key(key);
        break;
    case EDITOR_PLAY:
        cmd_play_key(key);
        break;
    default:
        table_key(key);
        break;
    }
}

/* A question was answered with the first letter of a line: the rest of that line is no command, up to its end or a pause.
 * And what still streams in behind a question is no answer. */
static bool is_left_over(uint8_t byte, uint16_t quiet_ticks)
{
    if (the_editor.swallow && quiet_ticks < SWALLOW_TICKS) {
        the_editor.swallow = byte != KEY_CR && byte != KEY_LF;
        return true;
    }
    the_editor.swallow = false;
    return the_editor.mode == EDITOR_ASK && quiet_ticks < STREAM_TICKS;
}

void editor_byte(uint8_t byte)
{
    uint16_t now = tick_now16(), quiet_ticks = (uint16_t)(now - the_editor.quiet_since);
    bool end_of_cr = byte == KEY_LF && the_editor.after_cr;
    the_editor.after_cr = byte == KEY_CR;
    the_editor.quiet_since = now;
    if (end_of_cr || is_left_over(byte, quiet_ticks)) {
        return;
    }
    if (the_editor.mode != EDITOR_PLAY && !performer_is_idle(&the_performer) && (byte == ' ' || byte == KEY_CTRL_C) &&
        the_editor.mode != EDITOR_PROGRAM) {
        performer_break(&the_performer);
        return;
    }
    switch (the_editor.mode) {
    case EDITOR_LINE:
    case EDITOR_NAME:
        line_byte(byte);
        break;
    case EDITOR_PROGRAM:
        program_byte(byte);
        break;
    default:
        editor_key(keys_byte(&the_editor.keys, byte));
        break;
    }
}
