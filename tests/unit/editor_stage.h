/* SPDX-License-Identifier: MIT
 * editor_stage.h - what the tests of the editor share: the whole of it over the fakes, a page or two in flash, three servos,
 * and the terminal before it. setUp and tearDown are here.
 *
 * The terminal has rows and columns from 1, as edit/ORIGINAL.md counts them. */
#ifndef EDITOR_STAGE_H
#define EDITOR_STAGE_H

#include <stdbool.h>
#include <stdint.h>
#include "commands.h"
#include "editor.h"
#include "fake_bus.h"
#include "fake_console.h"
#include "fake_flash.h"
#include "parts.h"

enum { TERMINAL_ROWS = 36, TERMINAL_COLUMNS = 80, COMMAND_ROW = 35 };

/* IDs 1..3 are there, without torque. Pages in flash: 1 "one" and 2 "two" with three steps each, which differ in name, page
 * speed and one position (STP0 of joint 3: 403 and 503); 5 "slow" moves joint 1 for 16 s; the others are erased. */
uint8_t *flash_page(uint8_t page);

/* So many ms go by: the main loop goes round, the terminal hears what is sent. */
void run_ms(uint32_t ms);
/* Text is typed (it may hold any byte but NUL) and half a second goes by; the screen is at rest again. */
void type(const char *text);

/* What stands there: `count` characters from `row`, `column` on. Good until the next call but one. */
const char *shown(uint8_t row, uint8_t column, uint8_t count);
/* The command row from column 3 on, without the blanks at its end. */
const char *message(void);
/* A cell of table row y by its text; x as in cells.h. */
const char *cell(uint8_t x, uint8_t y);

extern uint8_t cursor_row, cursor_column;           /* the terminal's cursor */
/* Characters that were sent since clear_sent, and whether this place was written. */
void clear_sent(void);
uint32_t sent(void);
bool was_written(uint8_t row, uint8_t column);

/* Types `text`; true: the controller restarted itself. */
bool restarts(const char *text);

#endif
