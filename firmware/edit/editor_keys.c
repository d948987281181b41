/* SPDX-License-Identifier: MIT
 * editor_keys.c - runs complete lines; defines the keys of each mode (see the diagram in dialog.h). */
#include "editor_keys.h"

#include "commands.h"
#include "console.h"
#include "dialog.h"
#include "keys.h"
#include "parts.h"
#include "requests.h"
#include "robot.h"
#include "screen.h"
#include "session.h"
#include "shell.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { REPEAT_TICKS = 20 };   /* 150 ms: a key that comes sooner is held down, not pressed again */
enum { PAGE_ROWS = 8, ESC_QUIET_TICKS = 7 };
enum { SWALLOW_TICKS = 60, STREAM_TICKS = 4 };   /* longest gap between a person's letters; between bytes of a stream */
enum { PACKET_START = 0xFF, PACKET_BYTES = 6 };   /* of a remote control: REMOTE.md */
enum { MESSAGE_COLUMN_MAX = 40 };   /* after a longer line a message would be cut */
enum { BACKSLASH = '\\', FIRST_WORD_KEY = '0', LAST_WORD_KEY = 'Z', FIRST_LOWER_KEY = '^', LAST_LOWER_KEY = 'z' };

static keys_t keys;
static bool swallow;    /* ignore the rest of a line whose first letters answered a question or were typed during a play */
static bool after_cr;   /* the last byte was CR, so an LF now belongs to it */
static uint8_t packet_left, packet_tick;   /* bytes of a remote's packet that have not come; when its last one came */

void editor_keys_init(void)
{
    keys_init(&keys);
    swallow = after_cr = false;
    packet_left = 0;
}

/* ---- running a complete line, again after each answered question ---- */

static void print_refusal(uint8_t result)
{
    switch (result) {
    case SHELL_ERR_MOVING:
        TEXT("Something moves");
        break;
    case SHELL_ERR_RANGE:
        shell_print_range_error();
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
    STATIC_ASSERT(DIALOG_ASK > (int)SHELL_ERR_REPORTED, "what a handler returns is a mode");
    if (result >= DIALOG_ASK && result <= DIALOG_PLAY) {
        the_dialog.mode = result;
        if (result == DIALOG_NAME) {
            shell_clear(&the_dialog.shell);
            the_screen.lead = false;
        }
        return;
    }
    print_refusal(result);
    dialog_end_line();
}

static void run(void)
{
    the_dialog.asked = 0;
    the_dialog.broken_off = the_dialog.faults_stand = false;
    the_screen.lead = true;
    the_screen.cramped = the_screen.line_column > MESSAGE_COLUMN_MAX;
    the_session.spare = performer_spare(&the_performer);
    go_on(shell_run(commands_table_P, commands_count, &the_dialog.args, !performer_is_idle(&the_performer)));
    the_session.spare = NULL;
}

static void run_line(void)
{
    if (the_dialog.mode == DIALOG_NAME) {
        cmd_name_done(the_dialog.line);
        dialog_end_line();
        return;
    }
    shell_split(&the_dialog.shell, the_session.hex, &the_dialog.args);
    run();
}

/* ---- keys ---- */

static void open_line(uint8_t key)
{
    bool starts = (key >= FIRST_WORD_KEY && key <= LAST_WORD_KEY) || key == BACKSLASH ||
                  (key >= FIRST_LOWER_KEY && key <= LAST_LOWER_KEY);
    shell_clear(&the_dialog.shell);
    shell_lose(&the_dialog.shell, console_lost());   /* bytes lost before this key may belong to the line */
    the_dialog.mode = DIALOG_LINE;
    the_dialog.row_ticks = ROW_TICKS;
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
    shell_lose(&the_dialog.shell, console_lost());
    (void)shell_byte(&the_dialog.shell, '@');
}

/* Repaints the whole screen (0.5 s) before a key that may open a line on it. */
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
    uint8_t number = key - KEY_UP;
    uint8_t cells = number < 4 ? 1 : number < 6 ? PAGE_ROWS : CELLS_COLUMNS;
    while (cells-- > 0) {
        screen_move((session_way_t)(SESSION_UP + (number & 3u)));
    }
}

/* Ignores spaces that quickly follow another one, because a person pages a list with spaces or holds the key down. */
static void space_key(void)
{
    const bool is_late = the_dialog.late_ticks != 0;
    if (!is_late) {
        cmd_cell_space();
    }
    the_dialog.late_ticks = is_late ? LATE_TICKS : REPEAT_TICKS;
}

/* true: the key was one for the cell under the cursor. */
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
        space_key();
        return true;
    default:
        return false;
    }
}

/* Handles a key of the table, or opens a line with it. */
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
    if (the_robot.failed != 0) {
        dialog_message_begin();
        dialog_tell_failed();
        dialog_message_end();
    }
    screen_sync();
}

/* Whether the key leaves a hidden screen hidden. */
static bool is_no_key(uint8_t key)
{
    return key == KEY_NONE || key == KEY_CR || key == KEY_LF;
}

static bool is_letter(uint8_t key)
{
    const uint8_t small = key | 0x20u;
    return small >= 'a' && small <= 'z';
}

/* A program may have hidden the screen or started a motion. Then keys must not edit. During a motion a line may be typed if
 * the screen is shown: the command table decides which commands may run. */
static void first_key(uint8_t key)
{
    if (key == '@') {
        open_program_line();
        return;
    }
    if (!performer_is_idle(&the_performer) && (the_screen.hidden || !is_letter(key))) {
        return;
    }
    if (the_screen.hidden && is_no_key(key)) {
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
    case SHELL_REFUSED:
        dialog_message_begin();   /* no room for a message after the line */
        shell_print_refusal(the_dialog.shell.fault);
        dialog_end_line();
        break;
    case SHELL_LINE:
        run_line();
        break;
    }
}

static void program_byte(uint8_t byte)
{
    if (shell_byte(&the_dialog.shell, byte) == SHELL_TYPING) {
        return;
    }
    the_screen.sink = SCREEN_PLAIN;
    requests_line(the_dialog.line, the_dialog.shell.fault);
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
        run();
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
        swallow = is_letter(key) || (swallow && key != KEY_CR && key != KEY_LF);
        break;
    default:
        first_key(key);
        break;
    }
}

void editor_quiet(void)
{
    bool quiet = (uint16_t)(tick_now16() - the_dialog.quiet_since) > ESC_QUIET_TICKS;
    if (quiet) {
        shell_quiet(&the_dialog.shell);
        if (keys_is_open(&keys)) {
            take_key(keys_quiet(&keys));
        }
    }
}

/* Ignores the rest of a line whose first letters answered a question or were typed during a play (the end of `help off`
 * is not a command), up to its end or a pause. Also ignores bytes that still stream in when a question is asked, because
 * they are not an answer. Keeps the bytes after an ESC: without them it would count as the Esc key. */
static bool is_left_over(uint8_t byte, uint16_t quiet_ticks)
{
    if (the_dialog.mode == DIALOG_PLAY) {
        return false;   /* each key counts: space breaks */
    }
    if (swallow && quiet_ticks < SWALLOW_TICKS) {
        swallow = byte != KEY_CR && byte != KEY_LF;
        return true;
    }
    swallow = false;
    return the_dialog.mode == DIALOG_ASK && quiet_ticks < STREAM_TICKS && !keys_is_open(&keys);
}

/* A remote control may share the line. Edit has no use for its packets, and among their bytes are U for UNDO, and CR. The
 * bytes of a packet follow each other at once, and nobody types 0xFF. */
static bool is_of_remote(uint8_t byte, uint8_t now)
{
    if ((uint8_t)(now - packet_tick) > 1) {
        packet_left = 0;
    }
    if (packet_left == 0) {
        if (byte != PACKET_START) {
            return false;
        }
        packet_left = PACKET_BYTES;
    }
    packet_left--;
    packet_tick = now;
    return true;
}

void editor_byte(uint8_t byte)
{
    uint16_t now = tick_now16(), quiet_ticks = now - the_dialog.quiet_since;
    if (is_of_remote(byte, (uint8_t)now)) {
        return;
    }
    bool end_of_cr = byte == KEY_LF && after_cr;
    after_cr = byte == KEY_CR;
    the_dialog.quiet_since = now;
    if (end_of_cr || is_left_over(byte, quiet_ticks)) {
        return;
    }
    if (the_dialog.mode != DIALOG_PLAY && !performer_is_idle(&the_performer) &&
        (byte == KEY_CTRL_C || (byte == ' ' && the_dialog.mode != DIALOG_PROGRAM))) {
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
