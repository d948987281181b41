/* SPDX-License-Identifier: MIT
 * editor_keys.c - which key means what, mode by mode (the diagram is in dialog.h). */
#include "commands.h"
#include "dialog.h"
#include "editor_parts.h"
#include "keys.h"
#include "parts.h"
#include "requests.h"
#include "robot.h"
#include "screen.h"
#include "shell.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { PAGE_ROWS = 8, ESC_QUIET_TICKS = 7 };
enum { SWALLOW_TICKS = 60, STREAM_TICKS = 4 };   /* a person's next letter; a stream's next byte */
enum { BACKSLASH = '\\', FIRST_WORD_KEY = '0', LAST_WORD_KEY = 'Z', FIRST_LOWER_KEY = '^', LAST_LOWER_KEY = 'z' };

static keys_t keys;
static bool swallow;    /* ignore the rest of a line whose first letter answered a question */
static bool after_cr;   /* the last byte was CR, so a LF now belongs to it */

void editor_keys_init(void)
{
    keys_init(&keys);
    swallow = after_cr = false;
}

static void open_line(uint8_t key)
{
    bool starts = (key >= FIRST_WORD_KEY && key <= LAST_WORD_KEY) || key == BACKSLASH ||
                  (key >= FIRST_LOWER_KEY && key <= LAST_LOWER_KEY);
    shell_clear(&the_dialog.shell);
    the_dialog.mode = DIALOG_LINE;
    screen_open_line();
    if (starts) {
        (void)shell_byte(&the_dialog.shell, key);
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
    the_dialog.mode = DIALOG_PROGRAM;
    shell_clear(&the_dialog.shell);
    (void)shell_byte(&the_dialog.shell, '@');
}

/* Shows the whole screen again (0.5 s) before a key that may open a line on it. */
static void take_screen_back(void)
{
    requests_end_watch();
    screen_show();
    while (screen_paint()) {
        system_kick();
    }
}

/* Moves the cursor: arrows by one cell, Home and End to the ends of the row, PgUp and PgDn by eight rows. */
static void move_key(uint8_t key)
{
    uint8_t number = (uint8_t)(key - KEY_UP);
    uint8_t cells = number < 4 ? 1 : number < 6 ? (uint8_t)PAGE_ROWS : (uint8_t)CELLS_COLUMNS;
    while (cells-- > 0) {
        screen_move((session_way_t)(SESSION_UP + (number & 3u)));
    }
}

/* true: the key changes the cell under the cursor. */
static bool cell_key(uint8_t key)
{
    switch (key) {
    case ']':
    case '[':
        cmd_cell_change(key == ']' ? 1 : -1);
        return true;
    case '}':
    case '{':
        cmd_cell_change(key == '}' ? 10 : -10);
        return true;
    case ' ':
        if (the_dialog.late_ticks == 0) {
            cmd_cell_space();
        }
        return true;
    default:
        return false;
    }
}

/* Handles a key that changes the table. */
static void table_key(uint8_t key)
{
    if (key == KEY_SIZE) {
        screen_set_rows(keys.rows);
    } else if (key >= KEY_UP && key <= KEY_HOME) {
        move_key(key);
    } else if (!cell_key(key)) {
        open_line(key);
        return;
    }
    if (the_robot.failed) {
        dialog_message_begin();
        dialog_tell_failed();
        dialog_message_end();
    }
    screen_sync();
}

/* Handles a byte after a program's line. */
static bool is_no_key(uint8_t key)
{
    return key == KEY_NONE || key == KEY_CR || key == KEY_LF;
}

/* A program may have hidden the screen or started a motion; then keys must not edit. */
static void first_key(uint8_t key)
{
    if (key == '@') {
        open_program_line();
        return;
    }
    if (!performer_is_idle(&the_performer) || (the_screen.hidden && is_no_key(key))) {
        return;
    }
    if (the_screen.hidden) {
        take_screen_back();
    }
    if (key != KEY_NONE && key != KEY_ESCAPE && key != KEY_CTRL_C) {
        table_key(key);
    }
}

static void line_byte(uint8_t byte)
{
    if (byte == KEY_CTRL_C) {
        dialog_end_line();
        return;
    }
    switch (shell_byte(&the_dialog.shell, byte < 0x80 ? byte : (uint8_t)'?')) {   /* only ASCII is stored */
    case SHELL_TYPING:
        break;
    case SHELL_TOO_LONG:
        dialog_message_begin();   /* no room for a message behind the line */
        TEXT("Line too long");
        dialog_end_line();
        break;
    case SHELL_LINE:
        editor_line();
        break;
    }
}

static void program_byte(uint8_t byte)
{
    shell_event_t event = shell_byte(&the_dialog.shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    if (event == SHELL_LINE) {
        editor_program_line();
    }
    shell_clear(&the_dialog.shell);
    the_dialog.mode = DIALOG_TABLE;
    screen_sync();
}

static void ask_key(uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (key == 'y' || key == 'Y') {
        the_dialog.answered++;
        editor_run();
    } else {
        swallow = key > ' ' && key < KEY_NONE && key != 'n' && key != 'N';
        TEXT(" no");
        dialog_end_line();
    }
}

static void more_key(uint8_t key)
{
    if (key == KEY_NONE || key == KEY_SIZE) {
        return;
    }
    if (the_dialog.item != NULL && (key == ' ' || key == KEY_CR)) {
        the_dialog.lines = 0;
        text_line_end();
        the_dialog.mode = DIALOG_LIST;
        return;
    }
    take_screen_back();
    dialog_end_line();
    the_dialog.late_ticks = LATE_TICKS;
    if (key != ' ' && key != KEY_CR && key != KEY_LF && key != 'q' && key != KEY_ESCAPE && key != KEY_CTRL_C) {
        first_key(key);
    }
}

static void take_key(uint8_t key)
{
    switch (the_dialog.mode) {
    case DIALOG_ASK:
        ask_key(key);
        break;
    case DIALOG_MORE:
        more_key(key);
        break;
    case DIALOG_PLAY:
        cmd_play_key(key);
        break;
    default:
        first_key(key);
        break;
    }
}

void editor_quiet(void)
{
    bool quiet = (uint16_t)(tick_now16() - the_dialog.quiet_since) > ESC_QUIET_TICKS;
    if (quiet && keys_is_open(&keys)) {
        take_key(keys_quiet(&keys));
    }
}

/* Ignores the rest of a line whose first letter answered a question, up to its end or a pause; and bytes that still stream
 * in when a question is asked, which are no answer. */
static bool is_left_over(uint8_t byte, uint16_t quiet_ticks)
{
    if (swallow && quiet_ticks < SWALLOW_TICKS) {
        swallow = byte != KEY_CR && byte != KEY_LF;
        return true;
    }
    swallow = false;
    return the_dialog.mode == DIALOG_ASK && quiet_ticks < STREAM_TICKS;
}

void editor_byte(uint8_t byte)
{
    uint16_t now = tick_now16(), quiet_ticks = (uint16_t)(now - the_dialog.quiet_since);
    bool end_of_cr = byte == KEY_LF && after_cr;
    after_cr = byte == KEY_CR;
    the_dialog.quiet_since = now;
    if (end_of_cr || is_left_over(byte, quiet_ticks)) {
        return;
    }
    if (the_dialog.mode != DIALOG_PLAY && !performer_is_idle(&the_performer) && (byte == ' ' || byte == KEY_CTRL_C) &&
        the_dialog.mode != DIALOG_PROGRAM) {
        performer_break(&the_performer);
        return;
    }
    switch (the_dialog.mode) {
    case DIALOG_LINE:
    case DIALOG_NAME:
        line_byte(byte);
        break;
    case DIALOG_PROGRAM:
        program_byte(byte);
        break;
    default:
        take_key(keys_byte(&keys, byte));
        break;
    }
}
