/* SPDX-License-Identifier: MIT
 * frame.h - the columns of the screen and the texts around the table (ORIGINAL.md section 3).
 * Pure: derives columns and characters from the session. No RAM. */
#ifndef FRAME_H
#define FRAME_H

#include <stdbool.h>
#include <stdint.h>
#include "session.h"

#define FRAME_POSE_COLUMN 20u      /* STP7 */
#define FRAME_BRACKET_COLUMN 24u   /* the bracket that closes it */
#define FRAME_LIVE_COLUMN 13u      /* (0x05), or (0337): the live position, if torque is off or the performer is not idle */
#define FRAME_LIVE_CHARS 6u
#define FRAME_FAULT_COLUMN 61u
#define FRAME_GO_COLUMN 72u
#define FRAME_LABEL_BYTES 21u

uint8_t frame_marker_column(uint8_t steps);
bool frame_is_marker_column(uint8_t column);

/* Column of the first character of a cell. */
uint8_t frame_cell_column(uint8_t x, uint8_t y);

/* The cell's text: 4 characters for positions, 3 for bytes. */
void frame_cell_text(uint8_t x, uint8_t y, char text[CELLS_TEXT_BYTES]);

/* Columns 1..19 of table row y, including the opening bracket; 1..20 in the rows of bytes. */
void frame_label_text(uint8_t y, char text[FRAME_LABEL_BYTES]);

/* Label of header row y (0..19), "" for row 0; returns its column. */
uint8_t frame_header_label(uint8_t y, char label[FRAME_LABEL_BYTES]);

/* Name, page number, flash address (y 0..2); returns the column. */
uint8_t frame_title_text(uint8_t y, char text[FRAME_LABEL_BYTES]);

#endif
