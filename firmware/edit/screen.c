/* SPDX-License-Identifier: MIT
 * screen.c - decides what to send: follows the session, scrolls; the command row; characters and the terminal's cursor. */
#include "screen.h"

#include <string.h>
#include "ansi.h"
#include "frame.h"
#include "parts.h"
#include "text.h"

screen_t the_screen;

enum { SHOWN_UNSAVED = 1, SHOWN_HEX = 2, SHOWN_PAGE0 = 4 };
enum { SCROLL_STEP = 4 };
enum { FIXED_ROWS = 4 };   /* below the table: labels, pause, speed, command */

/* ---- table rows and screen rows ---- */

bool screen_is_full(void)
{
    return the_screen.rows >= SCREEN_ROWS_FULL;
}

uint8_t screen_table_rows(void)
{
    return the_screen.rows - FIXED_ROWS;
}

uint8_t screen_command_row(void)
{
    return the_screen.rows;
}

bool screen_has_row(uint8_t joint)
{
    return screen_is_full() || the_servos.present == 0 || joint >= PAGE_JOINTS ||
           servo_link_has(&the_servos.present, joint);
}

uint8_t screen_rows_before(uint8_t joint)
{
    uint8_t count = 0;
    for (uint8_t i = 0; i < joint; i++) {
        count += screen_has_row(i);
    }
    return count;
}

uint8_t screen_row_of(uint8_t y)
{
    if (y >= PAGE_JOINTS) {
        return (uint8_t)(screen_table_rows() + 1u + (y - PAGE_JOINTS));
    }
    if (!screen_has_row(y)) {
        return 0;
    }
    uint8_t before = screen_rows_before(y);
    if (before < the_screen.top || before >= the_screen.top + screen_table_rows()) {
        return 0;
    }
    return (uint8_t)(before - the_screen.top + 1u);
}

uint8_t screen_joint_in_row(uint8_t row)
{
    uint8_t joint = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint8_t at = screen_row_of(i);
        if (at != 0 && at <= row) {
            joint = i;
        }
    }
    return joint;
}

/* ---- characters and the cursor, with the fewest bytes ---- */

void screen_send(char character)
{
    ansi_put(character);
    the_screen.at_column++;
    if (the_screen.at_column > SCREEN_COLUMNS) {
        the_screen.at_row = 0;
    }
}

void screen_send_text(const char *text)
{
    while (*text != '\0') {
        screen_send(*text++);
    }
}

void screen_send_text_P(const char *text)
{
    text_reader_t reader;
    text_open_P(&reader, text);
    for (char character; (character = text_next(&reader)) != '\0';) {
        screen_send(character);
    }
}

void screen_send_spaces(uint8_t count)
{
    while (count-- > 0) {
        screen_send(' ');
    }
}

void screen_go(uint8_t row, uint8_t column)
{
    if (the_screen.at_row == row && column > the_screen.at_column) {
        ansi_right(column - the_screen.at_column);
    } else if (the_screen.at_row != row || the_screen.at_column != column) {
        ansi_goto(row, column);
    }
    the_screen.at_row = row;
    the_screen.at_column = column;
}

void screen_go_line(void)
{
    uint8_t column = the_screen.line_column;
    screen_go(screen_command_row(), column < SCREEN_COLUMNS ? column : SCREEN_COLUMNS);
}

/* ---- following the session ---- */

static uint8_t flags_of(void)
{
    return (the_session.is_changed ? SHOWN_UNSAVED : 0) | (the_session.hex ? SHOWN_HEX : 0) |
           (the_session.page == 0 ? SHOWN_PAGE0 : 0);
}

void screen_sync(void)
{
    uint8_t flags = flags_of();
    uint8_t turned = flags ^ the_screen.shown_flags;
    uint8_t fault = session_check();
    screen_follow();
    uint8_t items = 0;
    if (the_session.x != the_screen.shown_x || the_session.y != the_screen.shown_y) {
        items |= ITEM_XYA;
    }
    if ((turned & SHOWN_HEX) != 0) {
        session_mark_all();
        session_mark_labels();   /* live positions */
        items |= ITEM_XYA | ITEM_GO;
    }
    if ((turned & SHOWN_PAGE0) != 0) {
        items |= ITEM_LABELS | ITEM_GO;
    }
    if ((turned & SHOWN_UNSAVED) != 0) {
        items |= ITEM_UNSAVED;
    }
    if (the_session.go_step != the_screen.shown_go) {
        items |= ITEM_GO;
    }
    if (fault != the_screen.shown_fault) {
        items |= ITEM_FAULT;
    }
    the_screen.items |= items;
    the_screen.shown_x = the_session.x;
    the_screen.shown_y = the_session.y;
    the_screen.shown_go = the_session.go_step;
    the_screen.shown_flags = flags;
    the_screen.shown_fault = fault;
}

/* ---- whole screen ---- */

static void mark_frame(void)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        the_session.marks[y] = MARK_CELLS | MARK_HEADER_LABEL | (unsigned)MARK_STEP_NONE << MARK_STEP_SHIFT;
    }
}

/* Clears at once, because a later clear would erase what the command row shows by then. */
void screen_redraw(void)
{
    mark_frame();
    the_screen.items = ITEM_ALL;
    the_screen.at_row = 0;
    ansi_clear();
    screen_go(screen_command_row(), 1);
    screen_send_text_P(TEXT_P("] _"));
}

void screen_init(void)
{
    memset(&the_screen, 0, sizeof the_screen);
    the_screen.rows = SCREEN_ROWS_FULL;
    the_screen.line_column = SCREEN_LINE_COLUMN;
    the_screen.shown_go = SESSION_NO_STEP;
    screen_redraw();
}

void screen_set_rows(uint8_t rows)
{
    uint8_t usable = rows < SCREEN_ROWS_MIN ? SCREEN_ROWS_MIN : rows;
    if (usable > SCREEN_ROWS_FULL) {
        usable = SCREEN_ROWS_FULL;
    }
    if (usable != the_screen.rows) {
        the_screen.rows = usable;
        the_screen.top = 0;
        screen_redraw();
        screen_follow();
    }
}

void screen_hide(void)
{
    ansi_clear();
    the_screen.hidden = true;
    the_screen.sink = SCREEN_PLAIN;
}

void screen_show(void)
{
    the_screen.hidden = false;
    the_screen.sink = SCREEN_QUIET;
    screen_redraw();
}

/* ---- scrolling ---- */

void screen_follow(void)
{
    if (screen_is_full() || the_session.x == CELL_X_HEADER || the_session.y >= PAGE_JOINTS) {
        return;
    }
    while (!screen_has_row(the_session.y)) {
        the_session.y++;   /* stops at the pause, which always has a row */
    }
    uint8_t before = screen_rows_before(the_session.y);
    uint8_t top = the_screen.top;
    if (before < top) {
        top = before > SCROLL_STEP ? before - SCROLL_STEP : 0;
    } else if (before >= top + screen_table_rows()) {
        uint8_t last = (uint8_t)(screen_rows_before(PAGE_JOINTS) - 1u);
        uint8_t bottom = before + SCROLL_STEP > last ? last : before + SCROLL_STEP;
        top = (uint8_t)(bottom + 1u - screen_table_rows());
    }
    if (top != the_screen.top) {
        the_screen.top = top;
        mark_frame();
    }
}

static void move_to_header(void)
{
    uint8_t row = screen_row_of(the_session.y);
    if (row != 0 && cell_kind(the_session.page, CELL_X_HEADER, (uint8_t)(row - 1u)) != CELL_NONE) {
        the_session.x = CELL_X_HEADER;
        the_session.y = (uint8_t)(row - 1u);
    }
}

void screen_move(session_way_t way)
{
    if (screen_is_full()) {
        session_move(way);
        return;
    }
    if (way == SESSION_RIGHT && the_session.x == CELL_X_SOFTNESS) {
        move_to_header();
        return;
    }
    uint8_t x = the_session.x, y = the_session.y;
    session_move(way);
    if (x == CELL_X_HEADER && the_session.x != CELL_X_HEADER) {
        the_session.y = screen_joint_in_row(the_session.y + 1u);
    }
    while (the_session.x != CELL_X_HEADER && !screen_has_row(the_session.y)) {   /* the header has all its rows */
        uint8_t before = the_session.y;
        session_move(way);
        if (the_session.y == before) {
            the_session.x = x;
            the_session.y = y;
            return;   /* the start row may have lost its servo meanwhile */
        }
    }
}

/* ---- command row ---- */

void screen_open_line(void)
{
    the_screen.sink = SCREEN_LINE;
    the_screen.lead = false;
    the_screen.cramped = false;
    screen_go(screen_command_row(), SCREEN_LINE_COLUMN);
    ansi_erase_line();
    the_screen.line_column = SCREEN_LINE_COLUMN;
}

static void back_in_line(void)
{
    if (the_screen.line_column <= SCREEN_COLUMNS) {
        screen_go_line();
        ansi_put('\b');
        the_screen.at_column--;
    }
    the_screen.line_column--;
}

static void put_in_line(char character)
{
    if (character == '\r' || character == '\a') {
        return;
    }
    if (character == '\n') {
        character = ' ';
    }
    if (character == '\b') {
        back_in_line();
        return;
    }
    if (the_screen.line_column < SCREEN_COLUMNS) {
        screen_go_line();
        screen_send(character);
    }
    if (the_screen.line_column < UINT8_MAX) {   /* no line that can be edited is this long */
        the_screen.line_column++;
    }
}

void screen_put(char character)
{
    if (the_screen.sink == SCREEN_PLAIN) {
        ansi_put(character);
    } else if (the_screen.sink == SCREEN_LINE) {
        if (the_screen.lead) {
            the_screen.lead = false;
            if (the_screen.cramped) {
                screen_open_line();
            } else {
                put_in_line(' ');
            }
        }
        put_in_line(character);
    }
}

void screen_ask_size(void)
{
    ansi_ask_size();
    the_screen.at_row = 0;
}
