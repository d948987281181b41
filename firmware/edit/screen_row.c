/* SPDX-License-Identifier: MIT
 * screen_row.c - paints what is marked in a row of the table: cells, label, the marker behind the last step. */
#include "frame.h"
#include "parts.h"
#include "screen_parts.h"

static char marker_at(uint8_t column)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    return steps <= PAGE_STEPS && column == frame_marker_column(steps) ? '|' : ' ';
}

/* Moves right within table row y. Sends the characters of a short gap again, because that is shorter than a cursor sequence:
 * the bracket of the work pose, a marker or a blank. */
static void go_in_row(uint8_t row, uint8_t y, uint8_t column)
{
    if (the_screen.at_row == row && y < PAGE_JOINTS && column > the_screen.at_column && column - the_screen.at_column <= 2) {
        if (the_screen.at_column == FRAME_BRACKET_COLUMN) {
            screen_send(']');
        }
        while (the_screen.at_column < column && frame_is_marker_column(the_screen.at_column)) {
            screen_send(marker_at(the_screen.at_column));
        }
    }
    screen_go(row, column);
}

static void paint_cell(uint8_t row, uint8_t x, uint8_t y)
{
    char text[CELLS_TEXT_BYTES];
    frame_cell_text(x, y, text);
    go_in_row(row, y, frame_cell_column(x, y));
    screen_send_text(text);
}

static void paint_marker(uint8_t row, uint8_t y, uint8_t steps)
{
    uint8_t shown = (uint8_t)(the_session.marks[y] >> MARK_STEP_SHIFT);
    uint8_t wanted = the_session.cells[PAGE_AT_STEPS];
    if (wanted > PAGE_STEPS) {
        wanted = MARK_STEP_NONE;
    }
    if (y < PAGE_JOINTS && shown != wanted && (steps == shown || steps == wanted)) {
        go_in_row(row, y, frame_marker_column(steps));
        screen_send(steps == wanted ? '|' : ' ');
    }
}

static void set_marker_shown(uint8_t y)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    uint16_t shown = steps > PAGE_STEPS ? (uint16_t)MARK_STEP_NONE : steps;
    uint16_t *marks = &the_session.marks[y];
    *marks = (uint16_t)((*marks & ~(0xFu << MARK_STEP_SHIFT)) | shown << MARK_STEP_SHIFT);
}

static void paint_label(uint8_t row, uint8_t y, uint16_t marks)
{
    char text[FRAME_LABEL_BYTES];
    if ((marks & MARK_HEADER_LABEL) != 0) {
        screen_go(row, 1);
        frame_label_text(y, text);
        screen_send_text(text);
    } else if ((marks & MARK_LABEL) != 0) {
        uint8_t skip = y < PAGE_JOINTS ? FRAME_LIVE_COLUMN - 1 : 0;
        frame_label_text(y, text);
        text[y < PAGE_JOINTS ? FRAME_LIVE_COLUMN + FRAME_LIVE_CHARS - 1 : FRAME_BRACKET_COLUMN - 5] = '\0';
        screen_go(row, (uint8_t)(skip + 1));
        screen_send_text(text + skip);
    }
}

/* Sends the bracket behind the work pose, with the label although it is to the right of the cell. */
static void paint_bracket(uint8_t row, uint16_t marks)
{
    if ((marks & MARK_HEADER_LABEL) != 0) {
        screen_go(row, FRAME_BRACKET_COLUMN);
        screen_send(']');
    }
}

static void paint_left(uint8_t y, uint16_t marks)
{
    uint8_t row = screen_row_of(y);
    if (row == 0) {
        return;
    }
    paint_label(row, y, marks);
    for (uint8_t x = 0; x <= CELL_X_SOFTNESS; x++) {
        if ((marks >> x & 1u) != 0 && cell_kind(the_session.page, x, y) != CELL_NONE) {
            paint_cell(row, x, y);
        }
        if (x == CELL_X_POSE) {
            paint_bracket(row, marks);
        }
        if (x <= PAGE_STEPS) {
            paint_marker(row, y, x);
        }
    }
    set_marker_shown(y);
}

static void paint_header(uint8_t y, uint16_t marks)
{
    if (y > CELL_Y_HEADER_LAST) {
        return;
    }
    uint8_t row = (uint8_t)(y + 1u);
    if ((marks & MARK_HEADER_LABEL) != 0) {
        char label[FRAME_LABEL_BYTES];
        uint8_t column = frame_header_label(y, label);
        if (label[0] != '\0') {
            screen_go(row, column);
            screen_send_text(label);
        }
    }
    if ((marks >> CELL_X_HEADER & 1u) == 0) {
        return;
    }
    if (y >= CELL_Y_HEADER) {
        paint_cell(row, CELL_X_HEADER, y);
        return;
    }
    char text[FRAME_LABEL_BYTES];
    uint8_t column = frame_title_text(y, text);
    screen_go(row, column);
    screen_send_text(text);
}

static bool marker_is_old(uint8_t y)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    uint8_t wanted = steps > PAGE_STEPS ? (uint8_t)MARK_STEP_NONE : steps;
    /* screen_row_of comes last because it is slow: 31 calls in every idle turn delay the answer to a key by 1 ms */
    return y < PAGE_JOINTS && the_session.marks[y] >> MARK_STEP_SHIFT != wanted && screen_row_of(y) != 0;
}

bool screen_paint_row(uint8_t y)
{
    uint16_t marks = the_session.marks[y] & 0x0FFFu;
    if (marks == 0 && !marker_is_old(y)) {
        return false;
    }
    the_session.marks[y] &= 0xF000u;
    paint_left(y, marks);
    paint_header(y, marks);
    return true;
}
