/* SPDX-License-Identifier: MIT
 * screen_parts.h - what screen.c (layout, what follows from the session) and screen_paint.c (sending) share. */
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

/* Screen row of table row y; 0: it is not in sight. */
uint8_t screen_row_of(uint8_t y);
uint8_t screen_command_row(void);

/* Places the terminal's cursor; sends one character there. */
void screen_go(uint8_t row, uint8_t column);
void screen_send(char character);

#endif
