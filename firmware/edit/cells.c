/* SPDX-License-Identifier: MIT */
#include "cells.h"

#include <string.h>

enum { HEADER_SHIFT = 11, FIRST_DIRECT_WORD = 0x8000 };

cell_kind_t cell_kind(uint8_t page, uint8_t x, uint8_t y)
{
    if (x == CELL_X_HEADER) {
        return y >= CELL_Y_HEADER && y <= CELL_Y_HEADER_LAST ? CELL_BYTE : CELL_NONE;
    }
    if (x == CELL_X_SOFTNESS) {
        return y < PAGE_JOINTS ? CELL_BYTE : CELL_NONE;
    }
    if (x > CELL_X_HEADER || y >= CELLS_ROWS) {
        return CELL_NONE;
    }
    if (y >= CELL_Y_PAUSE) {
        return CELL_BYTE;
    }
    return page == 0 && x == CELL_X_OFFSET ? CELL_OFFSET : CELL_POSITION;
}

uint16_t cell_address(uint8_t x, uint8_t y)
{
    if (x == CELL_X_HEADER) {
        return HEADER_SHIFT + y;
    }
    if (x == CELL_X_SOFTNESS) {
        return PAGE_AT_COMPLIANCE + y;
    }
    uint16_t step = x == CELL_X_POSE ? CELLS_POSE_AT : PAGE_STEP_BYTES * x;
    if (y >= CELL_Y_PAUSE) {
        return (uint16_t)(step + PAGE_STEP_AT_PAUSE + (y - CELL_Y_PAUSE));
    }
    return (uint16_t)(step + 2u * y);
}

bool cell_at(uint16_t address, uint8_t *x, uint8_t *y)
{
    if (address < PAGE_NAME_BYTES) {
        *x = CELL_X_HEADER;
        *y = CELL_Y_NAME;
        return true;
    }
    if (address < PAGE_AT_COMPLIANCE) {
        *x = CELL_X_HEADER;
        *y = (uint8_t)(address - HEADER_SHIFT);
        return address != PAGE_AT_CHECKSUM;
    }
    if (address < PAGE_AT_STEP0) {
        *x = CELL_X_SOFTNESS;
        *y = (uint8_t)(address - PAGE_AT_COMPLIANCE);
        return *y < PAGE_JOINTS;
    }
    uint8_t column = (uint8_t)(address / PAGE_STEP_BYTES);
    uint8_t place = address % PAGE_STEP_BYTES;
    *x = address >= CELLS_POSE_AT ? CELL_X_POSE : column;
    *y = place < PAGE_STEP_AT_PAUSE ? place / 2u : (uint8_t)(CELL_Y_PAUSE + (place - PAGE_STEP_AT_PAUSE));
    return true;
}

/* Whether the byte is a page number: a link, or a partner for blending. */
static bool is_link(uint16_t address)
{
    switch (address) {
    case PAGE_AT_BLEND_RIGHT:
    case PAGE_AT_BLEND_LEFT:
    case PAGE_AT_NEXT_PAGE:
    case PAGE_AT_EXIT_PAGE:
    case PAGE_AT_LINKED1_PAGE:
    case PAGE_AT_LINKED2_PAGE:
        return true;
    default:
        return false;
    }
}

uint16_t cell_max(cell_kind_t kind, uint8_t x, uint8_t y)
{
    if (kind != CELL_BYTE) {
        return PAGE_POS_MAX;
    }
    if (x != CELL_X_HEADER) {
        return UINT8_MAX;
    }
    if (y == CELL_Y_STEPS) {
        return PAGE_STEPS;
    }
    return is_link(cell_address(x, y)) ? PAGE_COUNT - 1u : UINT8_MAX;
}

uint16_t cell_word(const uint8_t bytes[CELLS_BYTES], uint16_t address)
{
    return page_word(&bytes[address]);
}

bool cell_is_off(uint16_t word)
{
    return word < FIRST_DIRECT_WORD && (word & PAGE_POS_TORQUE_OFF) != 0;
}

bool cell_is_position(uint16_t word)
{
    return word <= PAGE_POS_MAX;
}

void cell_digits(uint16_t number, uint8_t digits, bool hex, char *text)
{
    uint8_t base = hex ? 16 : 10;
    while (digits > 0) {
        uint8_t digit = (uint8_t)(number % base);
        number = (uint16_t)(number / base);
        digits--;
        text[digits] = (char)(digit < 10 ? '0' + digit : 'A' + digit - 10);
    }
}

static void fill(char text[CELLS_TEXT_BYTES], char character)
{
    memset(text, character, CELLS_TEXT_BYTES - 1u);
    text[CELLS_TEXT_BYTES - 1u] = '\0';
}

void cell_position_text(uint16_t word, bool hex, char text[CELLS_TEXT_BYTES])
{
    if (cell_is_off(word)) {
        fill(text, '?');
    } else if (word > PAGE_POS_MAX && word < FIRST_DIRECT_WORD) {
        fill(text, '-');
    } else {
        cell_digits(word, 4, hex, text);
        text[4] = '\0';
    }
}

void cell_offset_text(uint16_t word, char text[CELLS_TEXT_BYTES])
{
    int16_t offset = (int16_t)word;
    uint16_t size = (uint16_t)(offset < 0 ? -offset : offset);
    if (offset < -(int16_t)PAGE_POS_MAX || offset > (int16_t)PAGE_POS_MAX) {
        fill(text, '-');
        return;
    }
    text[0] = offset < 0 ? '-' : '+';
    cell_digits(size, offset == 0 || size > 999 ? 4 : 3, false, offset == 0 || size > 999 ? text : text + 1);
    text[4] = '\0';
}

void cell_byte_text(uint8_t byte, bool hex, char text[CELLS_TEXT_BYTES])
{
    cell_digits(byte, hex ? 2 : 3, hex, text);
    if (hex) {
        text[2] = ' ';
    }
    text[3] = '\0';
}
