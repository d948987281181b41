/* SPDX-License-Identifier: MIT
 * screen_paint.c - paints what is marked, one row or one item a turn. */
#include "ansi.h"
#include "frame.h"
#include "parts.h"
#include "pgm.h"
#include "report.h"
#include "screen_parts.h"
#include "text.h"

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

static void paint_item(uint16_t item)
{
    switch (item) {
    case ITEM_CLEAR:
        ansi_clear();
        the_screen.at_row = 1;
        the_screen.at_column = 1;
        break;
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
    case ITEM_FAULT:
        paint_fault();
        break;
    default:
        screen_go(screen_command_row(), 1);
        screen_send_text_P(the_screen.sink == SCREEN_QUIET ? TEXT_P("] _") : TEXT_P("] "));
        break;
    }
}

static bool paint_next_item(uint16_t among)
{
    for (uint16_t item = ITEM_CLEAR; item < ITEM_ALL; item = (uint16_t)(item << 1)) {
        if ((the_screen.items & among & item) != 0) {
            the_screen.items &= (uint16_t)~item;
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
    uint8_t row = the_session.x == CELL_X_HEADER ? (uint8_t)(the_session.y + 1u) : screen_row_of(the_session.y);
    screen_go(row, frame_cell_column(the_session.x, the_session.y));
}

bool screen_paint(void)
{
    if (the_screen.hidden) {
        return false;
    }
    if (paint_next_item(ITEM_CLEAR | ITEM_PROMPT)) {
        return true;
    }
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        if (screen_paint_row(y)) {
            return true;
        }
    }
    if (paint_next_item(ITEM_ALL)) {
        return true;
    }
    rest();
    return false;
}
