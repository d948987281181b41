/* SPDX-License-Identifier: MIT
 * keys.h - converts terminal bytes to keys: arrows, the terminal's size report, a lone ESC; all else passes unchanged.
 * Pure. Main loop only.
 *
 *   GROUND --ESC--> ESCAPE --'[' or 'O'--> SEQUENCE --final byte--> GROUND (arrow, report, or swallowed)
 *                      \--other--> GROUND (swallowed)         ESCAPE --quiet--> GROUND (KEY_ESCAPE) */
#ifndef KEYS_H
#define KEYS_H

#include <stdbool.h>
#include <stdint.h>

/* Twice in the order of session_way_t: up, down, right, left. */
enum { KEY_NONE = 0x80, KEY_UP, KEY_DOWN, KEY_RIGHT, KEY_LEFT, KEY_PAGE_UP, KEY_PAGE_DOWN, KEY_END, KEY_HOME,
       KEY_ESCAPE, KEY_SIZE };
enum { KEY_CTRL_C = 3, KEY_CR = '\r', KEY_LF = '\n' };

typedef struct {
    uint8_t state;
    uint8_t number, first; /* the last two parameters of the open sequence: the newest and the one before */
    uint8_t rows;          /* of the last KEY_SIZE */
} keys_t;

void keys_init(keys_t *keys);

/* Takes one byte. Returns a character below 0x80 or a KEY_. NUL and bytes from 0x80 on give KEY_NONE. */
uint8_t keys_byte(keys_t *keys, uint8_t byte);

/* Call after 50 ms without a byte: a lone ESC was the Esc key. */
uint8_t keys_quiet(keys_t *keys);

/* Whether a sequence is open; its bytes must not reach a line. */
bool keys_is_open(const keys_t *keys);

#endif
