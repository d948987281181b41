/* SPDX-License-Identifier: MIT
 * screen.h - the editor's full screen on an ANSI/VT100 terminal. Sends only what has changed.
 * Knows the session and the console, no command and no servo. Main loop only. RAM: one screen_t.
 * screen.c decides what to send, screen_paint.c sends it.
 *
 * There is no copy of the screen. A cell's text is derived from the session. The session marks the cells that change, and
 * screen_paint sends marked cells, one row at a time, whenever the console has room. So input never waits for a repaint, and
 * a cell that changes twice is sent once. With 35 rows or more the layout is that of ORIGINAL.md section 3. With
 * 24..34 rows only present joints have a row, the joints scroll, and the last four rows stay:
 *
 *      rows 1 .. rows-4     joints          | header, rows 1..20, does not scroll
 *      rows-3, rows-2       pause, speed    | fault of the page; X, Y, A
 *      rows-1               unsaved mark, step labels, Go Step
 *      rows                 command line and messages */
#ifndef SCREEN_H
#define SCREEN_H

#include <stdbool.h>
#include <stdint.h>
#include "session.h"

#define SCREEN_ROWS_FULL 35u
#define SCREEN_ROWS_MIN 24u
#define SCREEN_LINE_COLUMN 3u      /* the command line begins here */
#define SCREEN_COLUMNS 80u

typedef enum {
    SCREEN_QUIET = 0,   /* text is dropped: no line is open */
    SCREEN_LINE,        /* text goes to the command row, cut at its end */
    SCREEN_PLAIN        /* text goes to the terminal unchanged: lists, lines of programs */
} screen_sink_t;

typedef struct {
    uint8_t items;           /* single items to send */
    uint8_t rows;            /* of the terminal, 24..35 */
    uint8_t top;             /* rows scrolled out at the top */
    uint8_t at_row, at_column; /* the terminal's cursor; row 0 = unknown */
    uint8_t line_column;     /* of the next character of the command row; from SCREEN_COLUMNS on it is not shown */
    uint8_t sink;            /* screen_sink_t */
    bool lead;               /* a space precedes the next character of the command row */
    bool cramped;            /* the line is long: a message after it would be cut, so it replaces the line */
    bool hidden;             /* the screen is in other use: nothing is painted */
    uint8_t shown_x, shown_y, shown_go, shown_fault, shown_flags;
} screen_t;

extern screen_t the_screen;     /* the only instance: all functions here use it */

void screen_init(void);

/* Clears the screen, shows an empty command row and sends the rest again in turns. */
void screen_redraw(void);

/* Sets the number of rows of the terminal. Redraws if the layout changes. */
void screen_set_rows(uint8_t rows);

/* Clears the screen for plain text, and shows it again. */
void screen_hide(void);
void screen_show(void);

/* Updates the items that follow the session besides the cells: X Y A, labels, marks. Call after each key or command. */
void screen_sync(void);

/* Sends the next piece, at most about 110 bytes. false: the screen is up to date and the cursor is at its cell (sink
 * SCREEN_LINE: at the end of the line). */
bool screen_paint(void);

/* Clears the command row for a new line. */
void screen_open_line(void);

/* Takes one character of text and sends it where `sink` says. */
void screen_put(char character);

/* Moves the cursor to a neighbouring cell that is shown. */
void screen_move(session_way_t way);

/* Whether joint `joint` has a row (perhaps scrolled out). */
bool screen_has_row(uint8_t joint);

/* Scrolls so that the cursor's cell is visible. */
void screen_follow(void);

/* Asks the terminal for its size; it answers with a cursor position report. */
void screen_ask_size(void);

/* ---- for screen_paint.c ---- */

/* Single items, in the order in which they are sent. */
enum {
    ITEM_LABELS = 1 << 0,
    ITEM_XYA_FRAME = 1 << 1,
    ITEM_XYA = 1 << 2,
    ITEM_GO = 1 << 3,
    ITEM_UNSAVED = 1 << 4,
    ITEM_FAULT = 1 << 5,
    ITEM_ALL = (1 << 6) - 1
};

/* Rows of the screen count from 1. */
bool screen_is_full(void);                          /* every joint has a row, nothing scrolls */
uint8_t screen_table_rows(void);                    /* rows for joints */
uint8_t screen_command_row(void);
uint8_t screen_row_of(uint8_t y);                   /* of table row y; 0: not visible */
uint8_t screen_rows_before(uint8_t joint);          /* number of joints below `joint` with a row, visible or not */
uint8_t screen_joint_in_row(uint8_t row);           /* or the last one above it */

/* Move the terminal's cursor; send characters. screen_go_line: to the end of the command line, at most of its row. */
void screen_go(uint8_t row, uint8_t column);
void screen_go_line(void);
void screen_send(char character);
void screen_send_text(const char *text);
void screen_send_text_P(const char *text);
void screen_send_spaces(uint8_t count);

#endif
