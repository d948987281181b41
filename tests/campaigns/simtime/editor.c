/* SPDX-License-Identifier: MIT
 * editor.c - keys and lines of the model of Edit; see editor.h. */
#include "editor.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define HELD 12u                   /* ticks: below the 150 ms of a held key; a key may take that long to be read */
#define LEFT_OVER 88u              /* ticks: below the 0.75 s after a list, a play, or a space without effect */
#define LONE 4u                    /* ticks: below the time after which an ESC is a key by itself */
#define LATER 16u                  /* ticks: a key this long after a question answers it */

editor_t editor;

void editor_lose(void)
{
    editor.is_known = editor.can_undo = editor.can_redo = editor.is_play = editor.is_repainted = false;
    editor.mode = LOST;
    editor.saved_as = UNKNOWN;
    editor.noted_count = 0;
    editor_undo_lose();
    for (unsigned id = 0; id < JOINTS; id++) {
        editor.torque[id] = UNKNOWN;
    }
}

bool editor_is_there(unsigned id)
{
    return session.joint[id].servo != NULL && session.joint[id].is_known;
}

/* ---- lines ---- */

static void line_ends(void)
{
    editor.line[editor.count] = '\0';
    editor.mode = TABLE;
    editor.is_view = editor.is_request = false;
    editor.line_tick = session.tick;
    editor.lines++;
    if (editor.is_known && editor.line[0] == '@') {
        static const char *const asks[] = {"@where", "@pose", "@ver", "@list", "@page", "@dense", "@crcs"};
        bool is_asking = false;
        for (unsigned i = 0; i < sizeof asks / sizeof asks[0]; i++) {
            is_asking = is_asking || strncmp(editor.line, asks[i], strlen(asks[i])) == 0;
        }
        if (is_asking) {
            editor_view();
            editor.is_request = true;
        } else {
            editor_lose();
        }
        return;
    }
    editor_split_line();
    editor.is_repainted = editor.is_repainted && editor.words == 1 && strcasecmp(editor.word[0], "re") == 0;
    if (!editor.is_known) {
        editor_lose();
    } else if (editor.words > 0) {
        editor_run_line();
    } else {
        editor.message = ANY;
    }
}

static void line_key(uint8_t key)
{
    if (key == '\r') {
        line_ends();
    } else if (key == '\b' || key == 0x7F) {
        editor.count -= editor.count > 0 ? 1 : 0;
    } else if (key == 0x15) {
        editor.count = 0;
    } else if (key >= ' ' && key < 0x7F && editor.count < LONG_LINE) {
        editor.line[editor.count++] = (char)key;
    } else {
        editor_lose();
    }
}

/* ---- keys ---- */

static void add(int much)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (!editor.has_cursor) {
        editor_lose();
        return;
    }
    const int is = *editor_cell();
    if (is < 0 || (x == 0 && y < ROW_PAUSE && !editor_is_there(y))) {
        if (is == UNKNOWN || (x == 0 && y < ROW_PAUSE && session.joint[y].servo != NULL)) {
            editor_lose();
        }
        return;
    }
    const bool is_position = x < 8 && y < ROW_PAUSE, is_steps = x == 9 && y - 3 == FIELD_STEPS;
    int to = is + much;
    if (is_steps && is > STEPS_MOST) {
        editor_lose();   /* such a page came from a program */
        return;
    }
    if (is_position || is_steps) {
        const int most = is_steps ? STEPS_MOST : 1023;
        if (is_steps && abs(much) > 1 && (to < 0 || to > most)) {
            editor_lose();
            return;
        }
        to = to < 0 || to > most ? is : to;
    } else {
        to = to & 255;
    }
    const bool was_key = editor.is_key_edit;
    editor_put(to);
    if (x > 0 || y >= ROW_PAUSE) {
        editor.can_undo = editor.can_undo && !was_key;
        editor.is_key_edit = true;
    }
}

/* A space too soon after another one, a list or a play has no effect. */
static void space(uint32_t mute, uint32_t counts)
{
    editor.mute_tick = session.tick + mute;
    editor.counts_tick = session.tick + counts;
}

static void mark_off(void)
{
    const unsigned x = editor.now.x, y = editor.now.y;
    if (!editor.has_cursor || x == 0) {
        editor_lose();
    } else if (x < 8 && y < ROW_PAUSE) {
        editor_edit_begins();
        *editor_cell() = *editor_cell() >= 0 || *editor_cell() == NO_VALUE ? OFF : UNKNOWN;
        editor_edit_ends();
        editor.can_undo = false;
    }
}

static void put_cursor(int x, int y)
{
    y = y < 0 ? 0 : y > 32 ? 32 : y;
    x = x < 0 ? 0 : x;
    while (!editor_is_cell(x, y)) {
        x--;
    }
    editor.now.x = (unsigned)x;
    editor.now.y = (unsigned)y;
}

static void escape_ends(void)
{
    const int x = (int)editor.now.x, y = (int)editor.now.y;
    const char *sequence = editor.sequence;
    editor.has_cursor = editor.has_cursor && editor_has_all_rows();
    if (strcmp(sequence, "A") == 0) {
        put_cursor(x, y - 1);
    } else if (strcmp(sequence, "B") == 0) {
        put_cursor(x, y + 1);
    } else if (strcmp(sequence, "C") == 0) {
        put_cursor(x + 1, y);
    } else if (strcmp(sequence, "D") == 0) {
        put_cursor(x - 1, y);
    } else if (strcmp(sequence, "H") == 0) {
        put_cursor(0, y);
    } else if (strcmp(sequence, "F") == 0) {
        put_cursor(9, y);
    } else if (strcmp(sequence, "5~") == 0) {
        put_cursor(x, y - 8);
    } else if (strcmp(sequence, "6~") == 0) {
        put_cursor(x, y + 8);
    } else if (sequence[strlen(sequence) - 1] == 'R') {
        editor.has_cursor = false;   /* the terminal's size: joints may lose their rows, and the cursor moves on */
    }
    editor.mode = TABLE;
}

static void escape_key(uint8_t key)
{
    if (session.tick - editor.escape_tick > LONE) {
        editor_lose();   /* the sequence may have ended: what comes is a key of its own */
        return;
    }
    editor.escape_tick = session.tick;
    if (editor.sequence_count == 0 && key == '[') {
        editor.sequence_count = 1;
        return;
    }
    const unsigned at = editor.sequence_count - 1;
    if (editor.sequence_count == 0 || at + 1 >= sizeof editor.sequence || key < ' ' || key > '~') {
        editor_lose();
        return;
    }
    editor.sequence[at] = (char)key;
    editor.sequence[at + 1] = '\0';
    editor.sequence_count++;
    if (key >= '@') {
        escape_ends();
    }
}

static void table_key(uint8_t key)
{
    editor.is_repainted = editor.is_repainted && key >= '0' && key != '[' && key != ']' && key < '{';
    if (key == 0x1B) {
        editor.mode = ESCAPE;
        editor.sequence_count = 0;
        editor.escape_tick = session.tick;
    } else if (key == ']' || key == '[') {
        add(key == ']' ? 1 : -1);
    } else if (key == '}' || key == '{') {
        add(key == '}' ? 10 : -10);
    } else if (key == ' ' && session.tick < editor.mute_tick) {
        space(LEFT_OVER, SECOND);
        reached("space without effect in Edit");
    } else if (key == ' ' && session.tick < editor.counts_tick) {
        space(0, 2u * SECOND);
        editor_lose();
    } else if (key == ' ') {
        space(HELD, SECOND / 4u);
        mark_off();
    } else if (key == '\r') {
        editor.mode = LINE;
        editor.count = 0;
    } else if (key >= '0' && key <= 'z') {
        editor.mode = LINE;
        editor.line[0] = (char)key;
        editor.count = 1;
    } else if (key == '@') {
        editor.mode = LINE;
        editor.line[0] = (char)key;
        editor.count = 1;
    } else {
        editor_lose();
    }
}

static void answer_key(uint8_t key)
{
    const bool is_yes = key == 'y' || key == 'Y', is_no = key == 'n' || key == 'N';
    if (session.tick - editor.line_tick < LATER || (!is_yes && !is_no)) {
        editor_lose();
        return;
    }
    editor.mode = TABLE;
    editor.is_repainted = false;
    if (is_yes) {
        editor.if_yes();
    }
}

/* The program has read a key. */
void editor_typed(uint8_t key)
{
    editor.key = key;
    if (editor.mode == LOST || editor.mode == UNSURE) {
        space(0, 2u * SECOND);   /* it may leave a list */
    }
    editor.is_repainted = editor.is_repainted && (editor.mode == TABLE || editor.mode == LINE);
    if (editor.mode == TABLE) {
        table_key(key);
    } else if (editor.mode == ESCAPE) {
        escape_key(key);
    } else if (editor.mode == LINE) {
        line_key(key);
    } else if (editor.mode == QUESTION) {
        answer_key(key);
    } else if (editor.mode == UNSURE && !(editor.is_view && (key == '\r' || (key == ' ' && !editor.is_request)))) {
        editor_lose();
    }
}

/* A line has been typed, possibly in a state that the model does not know. */
void editor_line(const char *line)
{
    if (strchr(line, '@') != NULL) {
        screen_put_away();
    }
    editor.is_pose_copied = editor.is_pose_copied || strcasestr(line, "move") != NULL;   /* servos do not get a copy */
    editor.is_play_line = strcasestr(line, "play") != NULL;
}

void editor_boot(void)
{
    editor_lose();
    editor.is_pose_copied = false;
    editor.lines = 0;
    editor.look_tick = NEVER_TICK;
}
