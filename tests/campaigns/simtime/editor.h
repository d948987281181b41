/* SPDX-License-Identifier: MIT
 * editor.h - a second model of Edit: the interfaces between its files.
 *
 *   editor.c            keys and lines
 *   editor_commands.c   what commands do
 *   editor_look.c       compares the model with the screen
 *   editor_undo.c       UNDO in a row
 *
 * Based on edit/ORIGINAL.md, edit/DIFFERENCES.md and the words of `help`: what lines and keys do to the table and
 * the servos. The model is read from the screen while nothing happens, changed by what is typed, and compared with
 * the screen when nothing happens again. What those pages leave open is UNKNOWN until then. */
#ifndef EDITOR_H
#define EDITOR_H

#include "session.h"

#define STEPS_MOST 7
#define WORDS 8u
#define LONG_LINE 40u              /* a message after a longer line may need the row */
#define TABLE_LOWEST 34u           /* number of rows above the command line */

typedef enum { ANY, GOOD, BAD_COMMAND, BAD_PARAMETER, BAD_RANGE } message_t;

typedef struct {
    table_t now;                   /* what the table must show */
    table_t before, after;         /* the pages for UNDO and REDO */
    bool is_known, can_undo, can_redo, has_cursor;
    enum { LOST, TABLE, ESCAPE, LINE, QUESTION, UNSURE } mode;
    bool is_view;                  /* in UNSURE: a list or help, left by a key */
    bool is_request;               /* in UNSURE: a line of a program; the next key keeps its meaning for the table */
    bool is_edited;                /* possibly, since the last look */
    bool is_unsure;                /* an UNDO or REDO since the last look may have taken back all edits */
    bool is_key_edit;              /* the newest edit was by key; UNDO may combine several of them */
    uint8_t key;                   /* the newest key */
    uint32_t look_tick, line_tick;
    uint32_t mute_tick, counts_tick;   /* a space before mute_tick changes no cell; from counts_tick on it does */
    char line[LINE_BYTES];
    unsigned count;
    char sequence[8];
    unsigned sequence_count;
    uint32_t escape_tick;          /* the newest key of a sequence */
    char *word[WORDS];
    int number[WORDS];             /* UNKNOWN: not a number */
    unsigned words;
    void (*if_yes)(void);
    message_t message;
    unsigned lines;                /* since the last look */
    int torque[JOINTS];            /* required: 0, 1, UNKNOWN */
    int saved_as;                  /* number of the saved page; UNKNOWN: no save */
    table_t noted;                 /* by TAKE */
    int noted_first, noted_count;
    int played[JOINTS];            /* required end of a play */
    bool is_play;
    bool is_repainted;             /* only RE was typed since the screen was stored in `kept` */
    uint32_t kept_tick;
    char kept[TABLE_LOWEST][SCREEN_COLUMNS + 1];
    bool is_pose_copied, is_play_line;
    bool has_pairs;                /* PAIRS may have been changed */
} editor_t;

extern editor_t editor;

/* editor.c */
void editor_lose(void);            /* nothing is known until the next look */
bool editor_is_there(unsigned id);

/* editor_undo.c */
void editor_undo_lose(void);        /* what was shown counts no more */
void editor_undo_look(const table_t *shown);

/* editor_commands.c */
void editor_split_line(void);
void editor_run_line(void);        /* runs the words of the line */
void editor_view(void);            /* hides the table until a key */
void editor_edit_begins(void);
void editor_edit_ends(void);
int *editor_cell(void);            /* under the cursor */
void editor_put(int value);        /* into the cell under the cursor */
bool editor_is_cell(int x, int y);
bool editor_has_all_rows(void);
bool editor_is_whole(unsigned page);
bool editor_differs_from_flash(void);

#endif
