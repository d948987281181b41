/* SPDX-License-Identifier: MIT */
#include "frame.h"

#include "page_store.h"
#include "parts.h"
#include "pgm.h"
#include "text.h"

enum { FIRST_MARKER_COLUMN = 25, STEP_WIDTH = 5, FIRST_STEP_COLUMN = 26, SOFTNESS_COLUMN = 61,
       HEADER_COLUMN = 77, HEADER_LABEL_END = 76, NAME_COLUMN = 65, TITLE_COLUMN = 65, HEX_LOWER_FROM = 0x1A };

/* Labels of header rows 1..19, each terminated by a semicolon; from row 3 on in the order of bytes 14..30. */
TEXT_NAMED(header_texts,
           "PageNumber:;Addr:;"
           "(Reserved) :;PlayCount:;(Reserved) :;Blend Right:;Blend Left:;(Reserved) :;Page Step:;"
           "ControlCode:;Page Speed:;DXL Setup:;Accel Time:;Link to Next:;Link to Exit:;Linked Page1:;"
           "Page1Remocon:;Linked Page2:;Page2Remocon:;");

uint8_t frame_marker_column(uint8_t steps)
{
    return (uint8_t)(FIRST_MARKER_COLUMN + STEP_WIDTH * steps);
}

bool frame_is_marker_column(uint8_t column)
{
    return column >= FIRST_MARKER_COLUMN && column <= FIRST_MARKER_COLUMN + STEP_WIDTH * PAGE_STEPS &&
           (uint8_t)(column - FIRST_MARKER_COLUMN) % STEP_WIDTH == 0;
}

uint8_t frame_cell_column(uint8_t x, uint8_t y)
{
    if (x == CELL_X_HEADER) {
        return HEADER_COLUMN;
    }
    if (x == CELL_X_SOFTNESS) {
        return SOFTNESS_COLUMN;
    }
    uint8_t column = x == CELL_X_POSE ? FRAME_POSE_COLUMN
                                      : (uint8_t)(FIRST_STEP_COLUMN + STEP_WIDTH * (x - CELL_X_STEP0));
    return y >= CELL_Y_PAUSE ? column + 1u : column;
}

void frame_cell_text(uint8_t x, uint8_t y, char text[CELLS_TEXT_BYTES])
{
    uint16_t address = cell_address(x, y);
    switch (cell_kind(the_session.page, x, y)) {
    case CELL_POSITION:
        cell_position_text(cell_word(the_session.cells, address), the_session.hex, text);
        break;
    case CELL_OFFSET:
        cell_offset_text(cell_word(the_session.cells, address), text);
        break;
    case CELL_BYTE:
        cell_byte_text(the_session.cells[address], the_session.hex, text);
        break;
    case CELL_NONE:
        text[0] = '\0';
        break;
    }
}

/* "Dynamixel 26(0x1a)[": upper case below 0x1A, lower case from there on, as in the original. */
static void joint_label(uint8_t joint, char text[FRAME_LABEL_BYTES])
{
    (void)text_copy_P(text, TEXT_P("Dynamixel   (0x  )["));
    text[10] = joint < 10 ? ' ' : (char)('0' + joint / 10);
    text[11] = (char)('0' + joint % 10);
    cell_digits(joint, 2, true, &text[15]);
    if (joint >= HEX_LOWER_FROM) {
        text[16] = text[16] - 'A' + 'a';
    }
}

void frame_label_text(uint8_t y, char text[FRAME_LABEL_BYTES])
{
    if (y == CELL_Y_PAUSE) {
        (void)text_copy_P(text, TEXT_P("   PauseTime       ["));
    } else if (y == CELL_Y_SPEED) {
        (void)text_copy_P(text, the_session.cells[PAGE_AT_SCHEDULE] == PAGE_SCHEDULE_TIME ? TEXT_P("   Time( x 7.8mSec)[")
                                                                                 : TEXT_P("   Speed           ["));
    } else {
        joint_label(y, text);
        uint16_t word = session_pose(y);
        bool follows = cell_is_off(word) || !performer_is_idle(&the_performer);
        uint16_t live = cell_is_off(word) ? word & PAGE_POS_MAX : the_servos.present_pos[y];
        if (follows && live <= PAGE_POS_MAX) {
            cell_digits(live, 4, the_session.hex, &text[FRAME_LIVE_COLUMN]);
        }
    }
}

uint8_t frame_header_label(uint8_t y, char label[FRAME_LABEL_BYTES])
{
    text_reader_t reader;
    uint8_t length = 0;
    text_open_P(&reader, header_texts);
    for (uint8_t row = 0; row < y; row++) {
        length = 0;
        while ((label[length] = text_next(&reader)) != ';') {
            length++;
        }
    }
    label[length] = '\0';
    return y < CELL_Y_HEADER ? TITLE_COLUMN : HEADER_LABEL_END + 1u - length;
}

static void name_text(char text[FRAME_LABEL_BYTES])
{
    bool ended = false;
    for (uint8_t i = 0; i < PAGE_NAME_BYTES; i++) {
        uint8_t byte = the_session.cells[i];
        ended = ended || byte == 0;
        text[i] = ended ? ' ' : byte < ' ' || byte > '~' ? '.' : (char)byte;
    }
    text[PAGE_NAME_BYTES] = '\0';
}

uint8_t frame_title_text(uint8_t y, char text[FRAME_LABEL_BYTES])
{
    if (y == CELL_Y_NAME) {
        name_text(text);
        return NAME_COLUMN;
    }
    if (y == CELL_Y_NUMBER) {
        cell_digits(the_session.page, 4, the_session.hex, text);
        text[4] = '\0';
        return 76;
    }
    uint32_t address = page_store_addr(the_session.page);
    cell_digits((uint16_t)(address >> 16), 4, true, text);
    cell_digits((uint16_t)address, 4, true, text + 4);
    text[8] = '\0';
    return 70;
}
