/* SPDX-License-Identifier: MIT
 * screen_paint.c - paints what is marked, one row of the table or one item per turn. */
#include "ansi.h"
#include "frame.h"
#include "parts.h"
#include "pgm.h"
#include "report.h"
#include "screen.h"
#include "text.h"

/* ---- a row of the table: cells, label, the marker after the last step ---- */

static char marker_at(uint8_t column)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    return steps <= PAGE_STEPS && column == frame_marker_column(steps) ? '|' : ' ';
}

/* Moves right within table row y. Across a short gap, resends its characters (the bracket of the work pose, a marker or a
 * space), because that is shorter than a cursor sequence. */
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
    uint16_t shown = steps > PAGE_STEPS ? MARK_STEP_NONE : steps;
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
        screen_go(row, skip + 1);
        screen_send_text(text + skip);
    }
}

/* The bracket after the work pose is sent with the label, although it is to the right of the cell. */
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
    uint8_t row = y + 1u;
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
    uint8_t wanted = steps > PAGE_STEPS ? MARK_STEP_NONE : steps;
    /* screen_row_of comes last because it is slow: 31 calls in every idle turn delay the answer to a key by 1 ms */
    return y < PAGE_JOINTS && the_session.marks[y] >> MARK_STEP_SHIFT != wanted && screen_row_of(y) != 0;
}

static bool paint_row(uint8_t y)
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

/* ---- single items ---- */

static void paint_labels(void)
{
    screen_go((uint8_t)(screen_command_row() - 1u), FRAME_POSE_COLUMN);
    screen_send_text_P(TEXT_P("STP7  STP0 STP1 STP2 STP3 STP4 STP5 STP6    Go Step:"));
    if (the_session.page == 0) {
        screen_go((uint8_t)(screen_command_row() - 1u), FRAME_POSE_COLUMN);
        screen_send_text_P(TEXT_P("STP7  MSTR SLAV OFST"));
    }
}

static void paint_number(uint8_t column, uint16_t number, uint8_t digits)
{
    char text[CELLS_TEXT_BYTES];
    screen_go(screen_row_of(CELL_Y_SPEED), column);
    cell_digits(number, digits, the_session.hex, text);
    text[digits] = '\0';
    screen_send_text(text);
}

static void paint_xya(void)
{
    paint_number(64, the_session.x, 2);
    paint_number(69, the_session.y, 2);
    paint_number(74, cell_address(the_session.x, the_session.y), 4);
}

static void paint_go(void)
{
    screen_go((uint8_t)(screen_command_row() - 1u), FRAME_GO_COLUMN);
    if (the_session.go_step == SESSION_NO_STEP) {
        screen_send_spaces(3);
    } else {
        char text[CELLS_TEXT_BYTES];
        cell_byte_text(the_session.go_step, the_session.hex, text);
        screen_send_text(text);
    }
}

static void paint_unsaved(void)
{
    screen_go((uint8_t)(screen_command_row() - 1u), 1);
    if (the_session.is_changed) {
        screen_send_text_P(TEXT_P("* unsaved"));
    } else {
        screen_send_spaces(9);
    }
}

static void paint_fault(void)
{
    screen_go(screen_row_of(CELL_Y_PAUSE), FRAME_FAULT_COLUMN);
    if (the_screen.shown_fault != PAGE_OK) {
        screen_send_text_P(report_page_fault_P(the_screen.shown_fault));
    }
    ansi_erase_line();
}

static void paint_item(uint8_t item)
{
    switch (item) {
    case ITEM_LABELS:
        paint_labels();
        break;
    case ITEM_XYA_FRAME:
        screen_go(screen_row_of(CELL_Y_SPEED), FRAME_FAULT_COLUMN);
        screen_send_text_P(TEXT_P("[X:--,Y:--,A:----]"));
        break;
    case ITEM_XYA:
        paint_xya();
        break;
    case ITEM_GO:
        paint_go();
        break;
    case ITEM_UNSAVED:
        paint_unsaved();
        break;
    default:
        paint_fault();
        break;
    }
}

static bool paint_next_item(void)
{
    for (uint8_t item = ITEM_LABELS; item <= ITEM_FAULT; item <<= 1) {
        if ((the_screen.items & item) != 0) {
            the_screen.items &= ~item;
            paint_item(item);
            return true;
        }
    }
    return false;
}

static void rest(void)
{
    if (the_screen.sink == SCREEN_LINE) {
        screen_go_line();
        return;
    }
    uint8_t row = the_session.x == CELL_X_HEADER ? the_session.y + 1u : screen_row_of(the_session.y);
    screen_go(row, frame_cell_column(the_session.x, the_session.y));
}

bool screen_paint(void)
{
    if (the_screen.hidden) {
        return false;
    }
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        if (paint_row(y)) {
            return true;
        }
    }
    if (paint_next_item()) {
        return true;
    }
    rest();
    return false;
}
