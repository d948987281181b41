/* SPDX-License-Identifier: MIT */
#include "frame.h"

#include "page_store.h"
#include "pgm.h"

enum { FIRST_MARKER_COLUMN = 25, STEP_WIDTH = 5, FIRST_STEP_COLUMN = 26, SOFTNESS_COLUMN = 61,
       HEADER_COLUMN = 77, HEADER_LABEL_END = 76, NAME_COLUMN = 64, TITLE_COLUMN = 65, HEX_LOWER_FROM = 0x1A };

const char frame_labels_P[] PROGMEM = "STP7  STP0 STP1 STP2 STP3 STP4 STP5 STP6    Go Step:";
const char frame_labels_page0_P[] PROGMEM = "STP7  MSTR SLAV OFST";

/* Labels of header rows 3..19, in the order of bytes 14..30. */
#define HEADER_TEXT_BYTES 14
static const char header_texts[][HEADER_TEXT_BYTES] PROGMEM = {
    "(Reserved) :", "PlayCount:", "(Reserved) :", "(Reserved) :", "(Reserved) :", "(Reserved) :", "Page Step:",
    "ControlCode:", "Page Speed:", "DXL Setup:", "Accel Time:", "Link to Next:", "Link to Exit:", "Linked Page1:",
    "Page1Remocon:", "Linked Page2:", "Page2Remocon:",
};
static const char pause_label[] PROGMEM = "   PauseTime       [";
static const char speed_label[] PROGMEM = "   Speed           [";
static const char time_label[] PROGMEM = "   Time( x 7.8mSec)[";

uint8_t frame_marker_column(uint8_t steps)
{
    return (uint8_t)(FIRST_MARKER_COLUMN + STEP_WIDTH * steps);
}

bool frame_is_marker_column(uint8_t column)
{
    return column >= FIRST_MARKER_COLUMN && column <= FIRST_MARKER_COLUMN + STEP_WIDTH * PAGE_STEPS &&
           (column - FIRST_MARKER_COLUMN) % STEP_WIDTH == 0;
}

uint8_t frame_cell_column(uint8_t x, uint8_t y)
{
    if (x == CELL_X_HEADER) {
        return HEADER_COLUMN;
    }
    if (x == CELL_X_SOFTNESS) {
        return SOFTNESS_COLUMN;
    }
    uint8_t column = x == CELL_X_POSE ? (uint8_t)FRAME_POSE_COLUMN
                                      : (uint8_t)(FIRST_STEP_COLUMN + STEP_WIDTH * (x - CELL_X_STEP0));
    return y >= CELL_Y_PAUSE ? (uint8_t)(column + 1u) : column;
}

void frame_cell_text(const session_t *session, uint8_t x, uint8_t y, char text[CELLS_TEXT_BYTES])
{
    uint16_t address = cell_address(x, y);
    switch (cell_kind(session->page, x, y)) {
    case CELL_POSITION:
        cell_position_text(cell_word(session->cells, address), session->hex, text);
        break;
    case CELL_OFFSET:
        cell_offset_text(cell_word(session->cells, address), text);
        break;
    case CELL_BYTE:
        cell_byte_text(session->cells[address], session->hex, text);
        break;
    case CELL_NONE:
        text[0] = '\0';
        break;
    }
}

/* "Dynamixel 26(0x1a)[": upper case below 0x1A, lower case from there on, as the original has it. */
static void joint_label(uint8_t joint, char text[FRAME_LABEL_BYTES])
{
    strcpy_P(text, PSTR("Dynamixel   (0x  )["));
    text[10] = joint < 10 ? ' ' : (char)('0' + joint / 10);
    text[11] = (char)('0' + joint % 10);
    cell_digits(joint, 2, true, &text[15]);
    if (joint >= HEX_LOWER_FROM) {
        text[16] = (char)(text[16] - 'A' + 'a');
    }
}

void frame_label_text(const session_t *session, uint8_t y, char text[FRAME_LABEL_BYTES])
{
    if (y == CELL_Y_PAUSE) {
        strcpy_P(text, pause_label);
    } else if (y == CELL_Y_SPEED) {
        strcpy_P(text, session->cells[PAGE_AT_SCHEDULE] == PAGE_SCHEDULE_TIME ? time_label : speed_label);
    } else {
        joint_label(y, text);
        uint16_t word = session_pose(session, y);
        uint16_t live = word & PAGE_POS_MAX;
        if (cell_is_off(word) && live != 0) {
            cell_digits(live, 4, session->hex, &text[FRAME_LIVE_COLUMN]);
        }
    }
}

uint8_t frame_header_label(uint8_t y, char label[FRAME_LABEL_BYTES])
{
    if (y == CELL_Y_NAME) {
        label[0] = '\0';
        return NAME_COLUMN;
    }
    if (y < CELL_Y_HEADER) {
        strcpy_P(label, y == CELL_Y_NUMBER ? PSTR("PageNumber:") : PSTR("Addr:"));
        return TITLE_COLUMN;
    }
    strcpy_P(label, header_texts[y - CELL_Y_HEADER]);
    return (uint8_t)(HEADER_LABEL_END + 1u - strlen(label));
}

static void name_text(const session_t *session, char text[FRAME_LABEL_BYTES])
{
    bool ended = false;
    for (uint8_t i = 0; i < PAGE_NAME_BYTES; i++) {
        uint8_t byte = session->cells[i];
        ended = ended || byte == 0;
        text[i] = ended ? ' ' : byte < ' ' || byte > '~' ? '.' : (char)byte;
    }
    text[PAGE_NAME_BYTES] = '\0';
}

uint8_t frame_title_text(const session_t *session, uint8_t y, char text[FRAME_LABEL_BYTES])
{
    if (y == CELL_Y_NAME) {
        name_text(session, text);
        return NAME_COLUMN;
    }
    if (y == CELL_Y_NUMBER) {
        cell_digits(session->page, 4, session->hex, text);
        text[4] = '\0';
        return 76;
    }
    uint32_t address = page_store_addr(session->page);
    cell_digits((uint16_t)(address >> 16), 4, true, text);
    cell_digits((uint16_t)address, 4, true, text + 4);
    text[8] = '\0';
    return 70;
}

uint8_t frame_fault(const session_t *session)
{
    page_status_t status = session_check(session);
    return status == PAGE_ERR_STEPS ? session->cells[PAGE_AT_STEPS] : (uint8_t)status;
}

static const char *fault_name_P(uint8_t fault)
{
    switch (fault) {
    case PAGE_ERR_CHECKSUM: return PSTR("checksum");
    case PAGE_ERR_SCHEDULE: return PSTR("schedule");
    case PAGE_ERR_SPEED: return PSTR("page speed");
    case PAGE_ERR_LINK: return PSTR("link");
    case PAGE_ERR_POSITION: return PSTR("position");
    default: return NULL;
    }
}

void frame_fault_text(uint8_t fault, char text[FRAME_FAULT_BYTES])
{
    memset(text, ' ', FRAME_FAULT_BYTES - 1);
    text[FRAME_FAULT_BYTES - 1] = '\0';
    if (fault == 0) {
        return;
    }
    memcpy_P(text, PSTR("Invalid: "), 9);
    const char *name = fault_name_P(fault);
    if (name != NULL) {
        memcpy_P(text + 9, name, strlen_P(name));
        return;
    }
    char *at = text + 9;
    for (uint8_t unit = 100; unit > 0; unit /= 10) {
        if (fault >= unit) {
            *at++ = (char)('0' + fault / unit % 10);
        }
    }
    memcpy_P(at, PSTR(" steps"), 6);
}
