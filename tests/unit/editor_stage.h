/* SPDX-License-Identifier: MIT
 * editor_stage.h - fixture for the editor tests: the whole editor over the fakes, some pages in flash, three servos and
 * a terminal. Contains setUp and tearDown.
 *
 * Terminal rows and columns count from 1, as in edit/ORIGINAL.md. */
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

/* Servos 1..3 are present, torque off. Flash holds page 1 "one" and page 2 "two" with three steps each, which differ in
 * name, page speed and one position (STP0 of joint 3: 403 and 503). Page 5 "slow" moves joint 1 for 16 s. All other
 * pages are erased. */
uint8_t *flash_page(uint8_t page);

/* Runs the main loop for `ms` milliseconds; the terminal receives the output. */
void run_ms(uint32_t ms);
/* Types `text` (any bytes but NUL) and runs for 0.5 s, until the screen is up to date. */
void type(const char *text);

/* `count` characters of the screen, starting at `row`, `column`. Valid until the next call but one. */
const char *shown(uint8_t row, uint8_t column, uint8_t count);
/* The command row from column 3 on, without trailing blanks. */
const char *message(void);
/* The text of the cell in table row y; x as in cells.h. */
const char *cell(uint8_t x, uint8_t y);

extern uint8_t cursor_row, cursor_column;           /* the terminal's cursor */
/* Characters sent since clear_sent, and whether this position was written. */
void clear_sent(void);
uint32_t sent(void);
bool was_written(uint8_t row, uint8_t column);

/* Types `text`. Returns true if the controller restarted itself. */
bool restarts(const char *text);

#endif
