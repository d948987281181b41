/* SPDX-License-Identifier: MIT
 * cells.h - the table on the screen: which byte is at (X,Y), its range, and its text of four characters.
 * Pure; knows no terminal, no servo and no flash. Source: ORIGINAL.md sections 1, 3 and 4.
 *
 *   X 0      STP7, the work pose (bytes 512..575, after the page)     Y 0..30  joints
 *   X 1..7   STP0..STP6                                               Y 31     pause
 *   X 8      softness, Y 0..30                                        Y 32     speed or time
 *   X 9      header bytes 14..30, Y 3..19 (Y 0..2: name, number, address: shown, never under the cursor) */
#ifndef CELLS_H
#define CELLS_H

#include <stdbool.h>
#include <stdint.h>
#include "page.h"

#define CELLS_BYTES 576u        /* page and work pose */
#define CELLS_POSE_AT 512u
#define CELLS_COLUMNS 10u
#define CELLS_ROWS 33u
#define CELLS_TEXT_BYTES 5u     /* 4 characters and a NUL */

enum { CELL_X_POSE = 0, CELL_X_STEP0 = 1, CELL_X_OFFSET = 3, CELL_X_SOFTNESS = 8, CELL_X_HEADER = 9 };
enum { CELL_Y_NAME = 0, CELL_Y_NUMBER = 1, CELL_Y_ADDRESS = 2, CELL_Y_HEADER = 3, CELL_Y_STEPS = 9,
       CELL_Y_HEADER_LAST = 19, CELL_Y_PAUSE = 31, CELL_Y_SPEED = 32 };

typedef enum {
    CELL_NONE = 0,      /* nothing there */
    CELL_POSITION,      /* a word: position, ????, ---- */
    CELL_OFFSET,        /* a signed word: the trim of page 0 */
    CELL_BYTE
} cell_kind_t;

/* The kind of the cell at (x, y) on page `page`. Any x and y. */
cell_kind_t cell_kind(uint8_t page, uint8_t x, uint8_t y);

/* Byte offset in page and work pose (the A of the screen). Only where cell_kind is not CELL_NONE. */
uint16_t cell_address(uint8_t x, uint8_t y);

/* The cell that shows byte `address` (0..575); the name's 14 bytes share one cell. false: no cell shows it. */
bool cell_at(uint16_t address, uint8_t *x, uint8_t *y);

/* Highest value that SET and the keys allow at a cell that is not CELL_NONE: 1023, 255, links 127, Page Step 7. */
uint16_t cell_max(cell_kind_t kind, uint8_t x, uint8_t y);

/* A word of page or work pose at an even address. */
uint16_t cell_word(const uint8_t bytes[CELLS_BYTES], uint16_t address);

/* Whether a position word means torque off (????), and whether it is a position. */
bool cell_is_off(uint16_t word);
bool cell_is_position(uint16_t word);

/* The characters of a position word, of an offset, of a byte (3 digits; hexadecimal 2 digits and a space). */
void cell_position_text(uint16_t word, bool hex, char text[CELLS_TEXT_BYTES]);
void cell_offset_text(uint16_t word, char text[CELLS_TEXT_BYTES]);
void cell_byte_text(uint8_t byte, bool hex, char text[CELLS_TEXT_BYTES]);

/* Writes the lowest `digits` decimal or hexadecimal digits, with leading zeros; no NUL. */
void cell_digits(uint16_t number, uint8_t digits, bool hex, char *text);

#endif
