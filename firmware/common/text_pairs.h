/* SPDX-License-Identifier: MIT
 * text_pairs.h - the dictionary of packed texts, for text.c alone. This one is empty: it is that of programs whose texts
 * are not packed (all tests). An image whose texts are packed has its own, made by tools/dev/pack_texts; its text.c lies
 * beside that in the build folder and finds it first. */
#ifndef TEXT_PAIRS_H
#define TEXT_PAIRS_H

#include "pgm.h"

#define TEXT_PAIRS_DEPTH 1u   /* second halves that wait while a first half is taken apart */

/* The pairs for 0x80..0xFF, 0x00 (none) and 0x01..0x1F: each byte a character, 0 (the end) or such a code. */
static const uint8_t text_pairs[][2] PROGMEM = { { 0, 0 } };

#endif
