/* SPDX-License-Identifier: MIT
 * screen_parts.h - how the files of the screen see each other. For screen*.c only.
 *
 *   screen.c             what has to be sent: follows the session, scrolls, the command row
 *     screen_paint.c     paints what is marked, one row or one item a turn
 *       screen_row.c     a row of the table
 *         screen_send.c    characters and the cursor, the shortest way
 *         screen_layout.c  which row of the table stands in which row of the screen
 *
 * Each uses only files below it. */
#ifndef SCREEN_PARTS_H
#define SCREEN_PARTS_H

#include "screen.h"

/* Single items, in the order in which they are sent. */
enum {
    ITEM_CLEAR = 1 << 0,
    ITEM_LABELS = 1 << 1,
    ITEM_XYA_FRAME = 1 << 2,
    ITEM_XYA = 1 << 3,
    ITEM_GO = 1 << 4,
    ITEM_UNSAVED = 1 << 5,
    ITEM_FAULT = 1 << 6,
    ITEM_PROMPT = 1 << 7,
    ITEM_ALL = (1 << 8) - 1
};

/* ---- screen_layout.c; rows of the screen count from 1 ---- */

bool screen_is_full(void);                          /* every joint has a row, nothing scrolls */
uint8_t screen_table_rows(void);                    /* rows for joints */
uint8_t screen_command_row(void);
uint8_t screen_row_of(uint8_t y);                   /* of table row y; 0: it is not in sight */
uint8_t screen_rows_before(uint8_t joint);          /* how many joints below `joint` have a row, in sight or not */
uint8_t screen_joint_in_row(uint8_t row);           /* or the last one above it */

/* ---- screen_row.c ---- */

bool screen_paint_row(uint8_t y);                   /* false: nothing was marked */

/* ---- screen_send.c ---- */

/* Places the terminal's cursor; sends characters there. screen_go_line: at the end of the command line, or of its row. */
void screen_go(uint8_t row, uint8_t column);
void screen_go_line(void);
void screen_send(char character);
void screen_send_text(const char *text);
void screen_send_text_P(const char *text);
void screen_send_spaces(uint8_t count);

#endif
